#include <folk/analysis/play/whole_payoffs.h>
#include <folk/analysis/replies/flow.h>
#include <folk/analysis/replies/markov_reply.h>
#include <folk/analysis/replies/stationary_reply.h>
#include <folk/games/outcome.h>

#include <algorithm>
#include <stdexcept>

namespace folk {
namespace {

/// A problem without chance: each move in each state has one reward and one successor.
class PureProblem {
public:
  explicit PureProblem(const ReplyProblem& problem)
      : problem_(problem),
        whole_(problem.outside ? whole_payoffs(problem.payoffs, {problem.outside->payoff})
                               : whole_payoffs(problem.payoffs)),
        outside_(problem.outside ? to_double(problem.outside->payoff * whole_.exact_scale) : 0) {}

  std::size_t size() const { return problem_.size(); }
  const Rational& scale() const { return whole_.exact_scale; }
  double reward(std::size_t s, Move own) const {
    return problem_.is_outside(s) ? outside_ : whole_.by_outcome[Outcome{own, theirs(s)}.index()];
  }
  std::uint32_t next(std::size_t s, Move own) const {
    return problem_.is_outside(s) ? static_cast<std::uint32_t>(s)
                                  : problem_.states[s].next[Outcome{own, theirs(s)}.index()];
  }

  Flow flow(const std::vector<Move>& moves, const Criterion& criterion) const {
    std::vector<std::uint32_t> successors(size());
    std::vector<double> rewards(size());
    for (std::size_t s = 0; s < size(); ++s) {
      successors[s] = next(s, moves[s]);
      rewards[s] = reward(s, moves[s]);
    }
    return {std::move(successors), std::move(rewards), scale(), criterion};
  }

private:
  Move theirs(std::size_t s) const { return problem_.states[s].chance(Move::C) > 0.5 ? Move::C : Move::D; }

  const ReplyProblem& problem_;
  WholePayoffs whole_;
  double outside_;
};

/// Takes every clear improvement; where there is none, those that only exact numbers show. False at the optimum.
bool improve(const PureProblem& problem, const Flow& flow, std::vector<Move>& moves) {
  bool clear = false;
  std::vector<std::uint32_t> doubtful;
  for (std::uint32_t s = 0; s < problem.size(); ++s) {
    const Move instead = other(moves[s]);
    const double gain = flow.rounded_gain(s, problem.reward(s, instead), problem.next(s, instead));
    if (gain > flow.doubt()) {
      moves[s] = instead;
      clear = true;
    } else if (gain >= -flow.doubt()) {
      doubtful.push_back(s);
    }
  }
  if (clear) return true;
  bool better = false;
  for (const auto s : doubtful) {
    const Move instead = other(moves[s]);
    if (flow.gain_sign(s, problem.reward(s, instead), problem.next(s, instead)) > 0) {
      moves[s] = instead;
      better = true;
    }
  }
  return better;
}

StationaryReply discounted_reply(const ReplyProblem& problem, const Criterion& criterion) {
  const PureProblem pure(problem);
  std::vector<Move> moves(pure.size(), Move::C);
  for (std::size_t s = 0; s < pure.size(); ++s)
    if (pure.reward(s, Move::D) > pure.reward(s, Move::C)) moves[s] = Move::D;
  Flow flow = pure.flow(moves, criterion);
  while (improve(pure, flow, moves)) flow = pure.flow(moves, criterion);
  return {std::move(moves), flow.values(), 0, flow.value(problem.start), {}};
}

/// The long-run mean of every state's cycle in lowest terms, and the bias times the mean's denominator: 0 in the first
/// state of each cycle.
struct ExactMeans {
  std::vector<Rational> gain;
  std::vector<Integer> bias;
};

ExactMeans evaluate(const PureProblem& problem, const std::vector<Move>& moves) {
  const std::size_t n = problem.size();
  ExactMeans means{std::vector<Rational>(n), std::vector<Integer>(n)};
  const auto next = [&](std::size_t s) { return problem.next(s, moves[s]); };
  const auto reward = [&](std::size_t s) { return static_cast<std::int64_t>(problem.reward(s, moves[s])); };
  enum class Mark : std::uint8_t { unseen, walked, known };
  std::vector<Mark> marks(n, Mark::unseen);
  std::vector<std::size_t> walk;
  for (std::size_t start = 0; start < n; ++start) {
    walk.clear();
    std::size_t s = start;
    for (; marks[s] == Mark::unseen; s = next(s)) {
      marks[s] = Mark::walked;
      walk.push_back(s);
    }
    if (marks[s] == Mark::walked) {  // a new cycle, s is on it
      Integer sum = 0;
      std::size_t length = 0;
      std::size_t first = s;
      for (std::size_t c = s; length == 0 || c != s; c = next(c), ++length) {
        sum += reward(c);
        first = std::min(first, c);
      }
      means.gain[first] = Rational(sum, length);
      means.bias[first] = 0;
      marks[first] = Mark::known;
      // The rest of the cycle is reached from `first` backwards, and then what leads to the cycle.
      const auto cycle = std::find(walk.begin(), walk.end(), s);
      std::rotate(cycle, std::find(cycle, walk.end(), first), walk.end());
      walk.erase(cycle);
    }
    while (!walk.empty()) {
      const std::size_t t = walk.back();
      walk.pop_back();
      const std::size_t after = next(t);
      means.gain[t] = means.gain[after];
      means.bias[t] = reward(t) * denominator(means.gain[t]) - numerator(means.gain[t]) + means.bias[after];
      marks[t] = Mark::known;
    }
  }
  return means;
}

/// Howard's step for several cycles: better cycles first, then better ways on equally good ones.
bool improve_mean(const PureProblem& problem, const ExactMeans& means, std::vector<Move>& moves) {
  bool better = false;
  for (std::size_t s = 0; s < problem.size(); ++s)
    if (means.gain[problem.next(s, other(moves[s]))] > means.gain[s]) {
      moves[s] = other(moves[s]);
      better = true;
    }
  if (better) return true;
  for (std::size_t s = 0; s < problem.size(); ++s) {
    const Move instead = other(moves[s]);
    const auto after = problem.next(s, instead);
    if (means.gain[after] != means.gain[s]) continue;
    const Integer bias = static_cast<std::int64_t>(problem.reward(s, instead)) * denominator(means.gain[s]) -
                         numerator(means.gain[s]) + means.bias[after];
    if (bias > means.bias[s]) {
      moves[s] = instead;
      better = true;
    }
  }
  return better;
}

StationaryReply mean_reply(const ReplyProblem& problem) {
  const PureProblem pure(problem);
  std::vector<Move> moves(pure.size(), Move::C);
  ExactMeans means = evaluate(pure, moves);
  while (improve_mean(pure, means, moves)) means = evaluate(pure, moves);
  StationaryReply reply;
  reply.moves = std::move(moves);
  for (Rational& gain : means.gain) {
    gain /= pure.scale();
    reply.values.push_back(to_double(gain));
  }
  reply.exact_means = std::move(means.gain);
  reply.optimum = reply.exact_means[problem.start];
  return reply;
}

}  // namespace

StationaryReply stationary_reply(const ReplyProblem& problem, const Criterion& criterion) {
  if (criterion.is_finite()) throw std::logic_error("a stationary reply is none to a match that ends");
  if (!problem.deterministic()) return markov_reply(problem, criterion);
  return criterion.kind() == Criterion::Kind::mean ? mean_reply(problem) : discounted_reply(problem, criterion);
}

}  // namespace folk
