#include <folk/analysis/play/criterion_table.h>
#include <folk/analysis/replies/class_replies.h>

#include <folk/games/error.h>

#include <fmt/format.h>

#include <utility>

namespace folk {
namespace {

constexpr unsigned usual_horizon = 100;

}  // namespace

ClassReplies::ClassReplies(std::vector<Strategy> members, const Payoffs& payoffs, const Criterion& criterion,
                           unsigned horizon)
    : members_(std::move(members)),
      payoffs_(payoffs),
      criterion_(criterion),
      horizon_(horizon > 0 ? horizon : usual_horizon),
      replies_(members_.size()),
      tables_(members_.size()) {}

bool ClassReplies::endless(std::size_t member) const {
  return !criterion_.is_finite() && !members_[member].machine->finite();
}

const BestReply& ClassReplies::reply(std::size_t member) {
  auto& reply = replies_[member];
  try {
    if (!reply) reply = best_reply(*members_[member].machine, {payoffs_, criterion_}, horizon_);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}, of the class of beliefs: {}", members_[member].name, error.what()));
  }
  return *reply;
}

const Automaton& ClassReplies::table(std::size_t member) {
  auto& table = tables_[member];
  if (!table) table = table_for(*members_[member].machine, criterion_, Sense::own_moves_its_own, horizon_);
  return *table;
}

}  // namespace folk
