#include <folk/analysis/replies/posterior.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>

namespace folk {
namespace {

/// Looking ahead leaves out members less likely than this: together they cannot move a decision.
constexpr double negligible = 1e-12;

}  // namespace

Posterior::Posterior(const std::vector<Strategy>& roster) {
  if (roster.empty()) throw UsageError("Bayesian play needs a roster of at least one strategy");
  for (const auto& strategy : roster) {
    if (!strategy.machine)
      throw UsageError(fmt::format("{} is an opaque player: only machines can be learnt about", strategy.name));
    roster_.push_back(strategy.machine);
  }
  reset();
}

void Posterior::reset() {
  members_.clear();
  for (const auto& machine : roster_)
    members_.push_back({machine.get(), machine->start(), 1 / static_cast<double>(roster_.size())});
}

double Posterior::cooperation() const {
  double all = 0;
  double cooperating = 0;
  for (const auto& [machine, state, weight] : members_) {
    all += weight;
    cooperating += weight * machine->cooperation(state);
  }
  return cooperating / all;
}

void Posterior::consistent(const Members& members, Move own, Move theirs, Members& left) {
  left.clear();
  for (const auto& [machine, state, weight] : members) {
    const double p = machine->cooperation(state);
    const double likelihood = theirs == Move::C ? p : 1 - p;
    if (weight * likelihood > 0) left.push_back({machine, machine->next(state, theirs, own), weight * likelihood});
  }
}

void Posterior::observe(Move own, Move theirs) {
  Members left;
  consistent(members_, own, theirs, left);
  double all = 0;
  for (const auto& member : left) all += member.weight;
  for (auto& member : left) member.weight /= all;
  members_ = std::move(left);
}

std::array<double, 2> Posterior::action_values(const std::array<double, 4>& payoffs, unsigned depth,
                                               double continuation) const {
  Members likely;
  double all = 0;
  for (const auto& member : members_)
    if (member.weight >= negligible) likely.push_back(member);
  for (const auto& member : likely) all += member.weight;
  std::vector<Members> rooms(depth);
  auto values = totals(likely, payoffs, depth, continuation, rooms.data());
  for (double& value : values) value /= all;
  return values;
}

std::array<double, 2> Posterior::totals(const Members& members, const std::array<double, 4>& payoffs, unsigned depth,
                                        double continuation, Members* rooms) {
  std::array<double, 2> found{};
  if (depth == 0) return found;
  double all = 0;
  double cooperating = 0;
  for (const auto& [machine, state, weight] : members) {
    all += weight;
    cooperating += weight * machine->cooperation(state);
  }
  for (const Outcome outcome : all_outcomes) {
    const auto [own, theirs] = outcome;
    double& total = found[bit(own)];
    total += (theirs == Move::C ? cooperating : all - cooperating) * payoffs[outcome.index()];
    if (depth == 1) continue;
    consistent(members, own, theirs, rooms[0]);
    if (rooms[0].empty()) continue;
    const auto after = totals(rooms[0], payoffs, depth - 1, continuation, rooms + 1);
    total += continuation * std::max(after[0], after[1]);
  }
  return found;
}

}  // namespace folk
