#include <folk/analysis/equilibria/subgame_perfect_gap.h>
#include <folk/analysis/play/chain_values.h>
#include <folk/analysis/play/joint_play.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/analysis/replies/flow.h>
#include <folk/analysis/replies/stationary_reply.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/games/seat.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace folk {
namespace {

/// A pair seen from one seat: outcomes have the seat's own move first.
class Side {
public:
  Side(const JointPlay& play, Seat seat, Noise noise)
      : play_(play),
        seat_(seat),
        noise_(noise) {}

  std::size_t size() const { return play_.size(); }
  std::uint32_t next(std::size_t s, Outcome outcome) const { return play_.node(s).next[in_play(outcome).index()]; }
  Outcome outcome_in(std::size_t s) const { return in_play(play_.outcome_in(s)); }
  double own_cooperation(std::size_t s) const {
    return seat_ == Seat::first ? play_.first_cooperation(s) : play_.second_cooperation(s);
  }
  /// P(C) and P(D) of the other side's move, as it is really played.
  std::array<double, 2> their_chances(std::size_t s) const {
    return really_played(seat_ == Seat::first ? play_.second_cooperation(s) : play_.first_cooperation(s), noise_);
  }
  Noise noise() const { return noise_; }
  std::uint32_t their_state(std::size_t s) const {
    return seat_ == Seat::first ? play_.node(s).second : play_.node(s).first;
  }
  const Automaton& theirs() const { return seat_ == Seat::first ? play_.second() : play_.first(); }
  std::array<double, 4> chances_in(std::size_t s) const {
    const auto p = really_played(own_cooperation(s), noise_);
    const auto q = their_chances(s);
    return {p[0] * q[0], p[0] * q[1], p[1] * q[0], p[1] * q[1]};
  }

  Witness witness(std::size_t s, Move deviation, const char* then) const {
    Witness witness{play_.history_to(s), deviation, then, {}};
    if (seat_ == Seat::second)
      for (Outcome& round : witness.history) round = round.exchanged();
    return witness;
  }

private:
  /// The seat's outcome as the play has it, and back.
  Outcome in_play(Outcome outcome) const { return seat_ == Seat::first ? outcome : outcome.exchanged(); }

  const JointPlay& play_;
  Seat seat_;
  Noise noise_;
};

/// Nothing happens by chance.
bool is_pure(const JointPlay& play, Noise noise) {
  return noise == 0 && play.first().deterministic() && play.second().deterministic();
}

constexpr const char* as_before = "both go on as their machines say";

Flow flow_of(const Side& side, const WholePayoffs& whole, const Criterion& criterion) {
  std::vector<std::uint32_t> next(side.size());
  std::vector<double> rewards(side.size());
  for (std::size_t s = 0; s < side.size(); ++s) {
    const Outcome outcome = side.outcome_in(s);
    next[s] = side.next(s, outcome);
    rewards[s] = whole.by_outcome[outcome.index()];
  }
  return {std::move(next), std::move(rewards), whole.exact_scale, criterion};
}

/// Deterministic machines, discounted or ending: exact.
Gap one_shot_gap(const Side& side, const Payoffs& payoffs, const Criterion& criterion) {
  const WholePayoffs whole = whole_payoffs(payoffs);
  const Flow flow = flow_of(side, whole, criterion);
  const auto deviation = [&](std::size_t s) { return side.outcome_in(s).deviated(); };
  double best = 0;
  std::vector<double> gains(side.size());
  for (std::uint32_t s = 0; s < side.size(); ++s) {
    gains[s] = flow.rounded_gain(s, whole.by_outcome[deviation(s).index()], side.next(s, deviation(s)));
    best = std::max(best, gains[s]);
  }
  // Only what comes near the best rounded gain can be the largest.
  Rational largest = 0;
  std::size_t at = side.size();
  for (std::uint32_t s = 0; s < side.size(); ++s) {
    if (gains[s] < best - 2 * flow.doubt()) continue;
    if (flow.gain_sign(s, whole.by_outcome[deviation(s).index()], side.next(s, deviation(s))) <= 0) continue;
    const Rational gain = flow.gain(s, whole.by_outcome[deviation(s).index()], side.next(s, deviation(s)));
    if (gain > largest) {
      largest = gain;
      at = s;
    }
  }
  if (at == side.size()) return exact_gap(0, {});
  return exact_gap(largest, side.witness(at, deviation(at).own, as_before));
}

/// Deterministic machines, mean: exact.
Gap mean_gap(const Side& side, const Payoffs& payoffs) {
  const Flow flow = flow_of(side, whole_payoffs(payoffs), Criterion::mean());
  const StationaryReply reply = stationary_reply(reply_problem(side.theirs(), payoffs), Criterion::mean());
  Rational largest = 0;
  std::size_t at = 0;
  for (std::uint32_t s = 0; s < side.size(); ++s) {
    const Rational gain = reply.exact_means[side.their_state(s)] - flow.value(s);
    if (gain > largest) {
      largest = gain;
      at = s;
    }
  }
  const Move move = reply.moves[side.their_state(at)];
  return exact_gap(largest, side.witness(at, move, "best reply from there on"));
}

MarkovChain chain_of(const Side& side) {
  MarkovChain chain(side.size());
  for (std::size_t s = 0; s < side.size(); ++s) {
    chain[s].probability = side.chances_in(s);
    for (const Outcome outcome : all_outcomes) chain[s].next[outcome.index()] = side.next(s, outcome);
  }
  return chain;
}

/// What follows when the side really plays `own` in state s and play goes on: weight * payoff + continuation * value.
double worth_of_playing(const Side& side, std::size_t s, Move own, const std::array<double, 4>& payoffs, double weight,
                        double continuation, const std::vector<double>& values) {
  const auto chances = side.their_chances(s);
  double sum = 0;
  for (const Move theirs : {Move::C, Move::D}) {
    const double chance = chances[bit(theirs)];
    if (chance == 0) continue;
    const Outcome outcome{own, theirs};
    sum += chance * (weight * payoffs[outcome.index()] + continuation * values[side.next(s, outcome)]);
  }
  return sum;
}

/// The same when it means to play `own`: the move slips as the machine's own do.
double worth(const Side& side, std::size_t s, Move own, const std::array<double, 4>& payoffs, double weight,
             double continuation, const std::vector<double>& values) {
  const double played = worth_of_playing(side, s, own, payoffs, weight, continuation, values);
  if (side.noise() == 0) return played;
  const double slipped = worth_of_playing(side, s, other(own), payoffs, weight, continuation, values);
  return (1 - side.noise()) * played + side.noise() * slipped;
}

/// By how much the machine's moves are better than the others, where they are least so; negative where they are worse,
/// 0 where it mixes. Beyond all rounding it proves under noise what doubles else could only not refute.
class Strictness {
public:
  explicit Strictness(Noise noise)
      : asked_(noise > 0) {}

  void see(double own_cooperation, double c, double d) {
    least_ = std::min(least_, own_cooperation == 1 ? c - d : own_cooperation == 0 ? d - c : 0);
  }
  bool beyond(double rounding) const { return asked_ && least_ > rounding; }

private:
  bool asked_;
  double least_ = std::numeric_limits<double>::infinity();
};

/// The largest gain that is seen so far, and where.
struct Largest {
  double gain = 0;
  std::size_t state = 0;
  Move move = Move::C;
  std::uint64_t round = 0;

  void see(double candidate, std::size_t s, Move own, std::uint64_t t = 0) {
    if (candidate > gain) *this = {candidate, s, own, t};
  }
};

/// Machines that mix or slip, discounted, ending or mean.
Gap chance_gap(const Side& side, const Payoffs& payoffs, const Criterion& criterion) {
  const MarkovChain chain = chain_of(side);
  const auto numbers = payoffs.numbers();
  std::vector<double> rewards(side.size());
  for (std::size_t s = 0; s < side.size(); ++s)
    for (std::size_t o = 0; o < 4; ++o) rewards[s] += chain[s].probability[o] * numbers[o];
  Largest largest;
  double residual = 8 * rounding_of(payoffs, criterion);
  const char* then = as_before;
  if (criterion.kind() == Criterion::Kind::mean) {
    const auto values = solve_mean(chain, rewards);
    const StationaryReply reply = stationary_reply(reply_problem(side.theirs(), payoffs, side.noise()), criterion);
    residual += reply.residual;
    for (std::size_t s = 0; s < side.size(); ++s) {
      const auto t = side.their_state(s);
      largest.see(reply.values[t] - values.gain[s], s, reply.moves[t]);
    }
    then = "best reply from there on";
  } else {
    std::vector<double> values(side.size());
    solve_discounted(chain, rewards, criterion, values);
    const double weight = first_weight(criterion);
    Strictness strictness(side.noise());
    double off = 0;  // by how much the values miss their own equation
    for (std::size_t s = 0; s < side.size(); ++s) {
      const double p = side.own_cooperation(s);
      const double c = worth(side, s, Move::C, numbers, weight, criterion.continuation(), values);
      const double d = worth(side, s, Move::D, numbers, weight, criterion.continuation(), values);
      strictness.see(p, c, d);
      largest.see(c - values[s], s, Move::C);
      largest.see(d - values[s], s, Move::D);
      off = std::max(off, std::abs(p * c + (1 - p) * d - values[s]));
    }
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    residual += 2 * (off + 8 * 0x1p-53 * most) / criterion.stopping();
    if (strictness.beyond(residual)) return exact_gap(0, {});
  }
  return rounded_gap(largest.gain, residual, side.witness(largest.state, largest.move, then));
}

/// Joint states times rounds that dynamic programming may visit.
constexpr double most_visits = 4e8;

/// Which joint states some history of exactly t rounds reaches, for every t below T.
std::vector<std::vector<bool>> reached_after(const JointPlay& play, std::uint64_t rounds) {
  std::vector<std::vector<bool>> reached{std::vector<bool>(play.size())};
  reached[0][0] = true;
  while (reached.size() < rounds) {
    std::vector<bool> next(play.size());
    for (std::size_t s = 0; s < play.size(); ++s)
      if (reached.back()[s])
        for (const auto after : play.node(s).next) next[after] = true;
    reached.push_back(std::move(next));
  }
  return reached;
}

/// A history of exactly `rounds` rounds to a joint state, as the first machine sees it.
std::vector<Outcome> history_of(const JointPlay& play, const std::vector<std::vector<bool>>& reached, std::size_t state,
                                std::uint64_t rounds) {
  std::vector<Outcome> history(rounds);
  for (std::uint64_t t = rounds; t-- > 0;) {
    bool found = false;
    for (std::size_t before = 0; before < play.size() && !found; ++before) {
      if (!reached[t][before]) continue;
      const auto& next = play.node(before).next;
      const auto place = std::find(next.begin(), next.end(), state);
      if (place == next.end()) continue;
      history[t] = all_outcomes[static_cast<std::size_t>(place - next.begin())];
      state = before;
      found = true;
    }
  }
  return history;
}

Gap finite_gap(const JointPlay& play, Seat seat, const std::vector<std::vector<bool>>& reached,
               const MatchRules& rules) {
  const auto& [payoffs, criterion, noise] = rules;
  const Side side(play, seat, noise);
  const WholePayoffs whole = whole_payoffs(payoffs);
  const std::uint64_t rounds = criterion.rounds();
  const bool pure = is_pure(play, noise);
  std::vector<double> values(side.size());
  std::vector<double> earlier(side.size());
  Largest largest;
  Strictness strictness(noise);
  for (std::uint64_t t = rounds; t-- > 0;) {
    for (std::size_t s = 0; s < side.size(); ++s) {
      const double p = side.own_cooperation(s);
      const double c = worth(side, s, Move::C, whole.by_outcome, 1, 1, values);
      const double d = worth(side, s, Move::D, whole.by_outcome, 1, 1, values);
      earlier[s] = p == 1 ? c : p == 0 ? d : p * c + (1 - p) * d;
      if (!reached[t][s]) continue;
      strictness.see(p, c, d);
      // Of equal gains the earliest is told: rounds are seen from the last to the first.
      if (c - earlier[s] > 0 && c - earlier[s] >= largest.gain) largest = {c - earlier[s], s, Move::C, t};
      if (d - earlier[s] > 0 && d - earlier[s] >= largest.gain) largest = {d - earlier[s], s, Move::D, t};
    }
    values.swap(earlier);
  }
  Witness witness{history_of(play, reached, largest.state, largest.round), largest.move, as_before, {}};
  if (seat == Seat::second)
    for (Outcome& round : witness.history) round = round.exchanged();
  if (pure) return exact_gap(Rational(static_cast<std::int64_t>(largest.gain)) / whole.exact_scale, std::move(witness));
  const double rounding = rounding_of(payoffs, criterion);
  if (strictness.beyond(rounding * whole.scale)) return exact_gap(0, {});
  return rounded_gap(largest.gain / whole.scale, rounding, std::move(witness));
}

Gap gap_without_end(const JointPlay& play, Seat seat, const MatchRules& rules) {
  const auto& [payoffs, criterion, noise] = rules;
  const Side side(play, seat, noise);
  if (!is_pure(play, noise)) return chance_gap(side, payoffs, criterion);
  if (criterion.kind() == Criterion::Kind::mean) return mean_gap(side, payoffs);
  return one_shot_gap(side, payoffs, criterion);
}

}  // namespace

BothGaps subgame_perfect_gaps(const Automaton& first, const Automaton& second, const MatchRules& rules,
                              std::size_t most_joint_states) {
  const Criterion& criterion = rules.criterion;
  const JointPlay play(first, second, Sense::any_own_moves, most_joint_states);
  if (!criterion.is_finite())
    return {gap_without_end(play, Seat::first, rules), gap_without_end(play, Seat::second, rules)};
  if (static_cast<double>(play.size()) * static_cast<double>(criterion.rounds()) > most_visits)
    throw UsageError(fmt::format("{} joint states over {} rounds: too many for subgame perfection, play fewer rounds",
                                 play.size(), criterion.rounds()));
  // Twice: gains are differences of totals.
  if (!whole_payoffs(rules.payoffs).exact(2 * static_cast<double>(criterion.rounds())))
    throw UsageError(fmt::format("{} rounds at {} would score too much to count exactly: play fewer",
                                 criterion.rounds(), to_text(rules.payoffs)));
  const auto reached = reached_after(play, criterion.rounds());
  return {finite_gap(play, Seat::first, reached, rules), finite_gap(play, Seat::second, reached, rules)};
}

}  // namespace folk
