#include <folk/analysis/replies/class_replies.h>

#include <folk/games/error.h>

#include <fmt/format.h>

#include <utility>

namespace folk {
namespace {

constexpr unsigned usual_horizon = 100;

}  // namespace

ClassReplies::ClassReplies(std::vector<Strategy> members, const MatchRules& rules, unsigned horizon)
    : members_(std::move(members)),
      horizon_(horizon > 0 ? horizon : usual_horizon),
      machines_(rules) {}

bool ClassReplies::endless(std::size_t member) const {
  return !criterion().is_finite() && !members_[member].machine->finite();
}

const BestReply& ClassReplies::reply(std::size_t member) {
  try {
    return machines_.of(members_[member].machine).reply(horizon_);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}, of the class of beliefs: {}", members_[member].name, error.what()));
  }
}

const Automaton& ClassReplies::table(std::size_t member) {
  return machines_.of(members_[member].machine).table(horizon_);
}

}  // namespace folk
