#include <folk/analysis/replies/posterior.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk {
namespace {

/// Looking ahead leaves out members less likely than this: together they cannot move a decision.
constexpr double negligible = 1e-12;

}  // namespace

Posterior::Posterior(OpponentPrior prior)
    : prior_(std::move(prior)) {
  if (prior_.known.empty() && prior_.classes.empty())
    throw UsageError("Bayesian play needs a roster of at least one strategy");
  if (!(prior_.slip >= 0 && prior_.slip < 0.5))
    throw UsageError(fmt::format("a slip of {}: expected 0 to less than 0.5", prior_.slip));
  const auto check = [](double weight) {
    if (!(weight > 0) || !std::isfinite(weight))
      throw UsageError(fmt::format("a weight of {}: expected more than 0", weight));
  };
  for (const auto& known : prior_.known) check(known.weight);
  for (const auto& one : prior_.classes) check(one.weight);
  reset();
}

void Posterior::reset() {
  members_ = {};
  double all = 0;
  for (const auto& known : prior_.known) all += known.weight;
  for (const auto& one : prior_.classes) all += one.weight;
  for (const auto& [strategy, weight] : prior_.known)
    members_.machines.push_back({strategy.machine.get(), strategy.machine->start(), weight / all});
  for (const auto& [members, weight] : prior_.classes)
    members_.classes.push_back({ClassPosterior(members), weight / all});
}

double Posterior::slipped(double cooperation) const { return prior_.slip + (1 - 2 * prior_.slip) * cooperation; }

Posterior::Chances Posterior::chances(const Members& members) const {
  Chances sum{0, 0};
  for (const auto& [machine, state, weight] : members.machines) {
    sum.all += weight;
    sum.cooperating += weight * slipped(machine->cooperation(state));
  }
  for (const auto& [known, weight] : members.classes) {
    sum.all += weight;
    sum.cooperating += weight * known.cooperation(prior_.slip);
  }
  return sum;
}

double Posterior::cooperation() const {
  const auto [all, cooperating] = chances(members_);
  return cooperating / all;
}

void Posterior::consistent(const Members& members, Move own, Move theirs, Members& left) const {
  left.machines.clear();
  left.classes.clear();
  const auto likelihood = [&](double cooperation) { return theirs == Move::C ? cooperation : 1 - cooperation; };
  for (const auto& [machine, state, weight] : members.machines) {
    const double after = weight * likelihood(slipped(machine->cooperation(state)));
    if (after > 0) left.machines.push_back({machine, machine->next(state, theirs, own), after});
  }
  for (const auto& [known, weight] : members.classes) {
    const double after = weight * likelihood(known.cooperation(prior_.slip));
    if (after <= 0) continue;
    left.classes.push_back({known, after});
    left.classes.back().known.observe(own, theirs);
  }
}

Posterior::Members Posterior::likely(const Members& members, double weight) {
  Members left;
  for (const auto& member : members.machines)
    if (member.weight >= weight) left.machines.push_back(member);
  for (const auto& member : members.classes)
    if (member.weight >= weight) left.classes.push_back(member);
  return left;
}

void Posterior::observe(Move own, Move theirs) {
  Members left;
  consistent(members_, own, theirs, left);
  const double all = chances(left).all;
  for (auto& member : left.machines) member.weight /= all;
  for (auto& member : left.classes) member.weight /= all;
  members_ = prior_.slip > 0 ? likely(left, negligible) : std::move(left);
}

std::array<double, 2> Posterior::action_values(const std::array<double, 4>& payoffs, unsigned depth,
                                               double continuation, double least_probability) const {
  const Members members = likely(members_, negligible);
  std::vector<Members> rooms(depth);
  auto values = totals(members, {payoffs, continuation, least_probability}, depth, rooms.data());
  const double all = chances(members).all;
  for (double& value : values) value /= all;
  return values;
}

std::array<double, 2> Posterior::totals(const Members& members, const Search& search, unsigned depth,
                                        Members* rooms) const {
  std::array<double, 2> found{};
  if (depth == 0) return found;
  const auto [all, cooperating] = chances(members);
  for (const Move own : {Move::C, Move::D}) {
    double followed = 0, later = 0;
    for (const Move theirs : {Move::C, Move::D}) {
      const double weight = theirs == Move::C ? cooperating : all - cooperating;
      found[bit(own)] += weight * search.payoffs[Outcome{own, theirs}.index()];
      if (depth == 1 || weight < search.least_probability * all) continue;
      consistent(members, own, theirs, rooms[0]);
      if (rooms[0].machines.empty() && rooms[0].classes.empty()) continue;
      const auto after = totals(rooms[0], search, depth - 1, rooms + 1);
      followed += weight;
      later += std::max(after[0], after[1]);
    }
    if (followed > 0)
      found[bit(own)] += search.continuation * later * (search.least_probability > 0 ? all / followed : 1);
  }
  return found;
}

}  // namespace folk
