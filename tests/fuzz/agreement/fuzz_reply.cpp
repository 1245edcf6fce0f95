// Best replies to a small machine, found twice. Without chance policy iteration in rationals and in doubles give the
// same values, to the residual and 1e-9 of the criterion's weight. And FiniteBestReply's optimum over T rounds is T
// times the best mean in the game that begins anew after every T rounds: exactly without chance, else to that
// tolerance.

#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/analysis/replies/markov_reply.h>
#include <folk/analysis/replies/stationary_reply.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz.h"
#include "machine_bytes.h"

namespace {

using folk::Criterion;
using folk::Rational;
using folk::ReplyProblem;
using folk::fuzz::require;

Criterion endless(folk::fuzz::Bytes& bytes) {
  const std::uint32_t kind = bytes.below(3);
  const std::uint32_t number = bytes.next();
  switch (kind) {
    case 0: return Criterion::mean();
    case 1: return Criterion::discounted(Rational(1 + number, 257));
    default: return Criterion::ending(Rational(1, 1 + number));
  }
}

/// T, R, P, S with ties now and then, in halves.
folk::Payoffs payoffs(folk::fuzz::Bytes& bytes) {
  const auto number = [&] { return Rational(static_cast<int>(bytes.below(12)) - 4, 2); };
  folk::Payoffs payoffs;
  payoffs.temptation = number();
  payoffs.reward = number();
  payoffs.punishment = number();
  payoffs.sucker = number();
  return payoffs;
}

/// The same problem with the rounds played so far in its state; after the last one it begins anew.
ReplyProblem repeated(const ReplyProblem& problem, std::uint32_t rounds) {
  const auto size = static_cast<std::uint32_t>(problem.size());
  ReplyProblem again = problem;
  again.states.clear();
  for (std::uint32_t round = 0; round < rounds; ++round)
    for (ReplyProblem::State state : problem.states) {
      for (auto& next : state.next) next = round + 1 < rounds ? (round + 1) * size + next : problem.start;
      again.states.push_back(state);
    }
  return again;
}

void same_values(const ReplyProblem& problem, const Criterion& criterion) {
  const auto exact = folk::stationary_reply(problem, criterion);
  const auto rounded = folk::markov_reply(problem, criterion);
  const double tolerance = rounded.residual + 1e-9 * criterion.total_weight();
  require(rounded.residual <= 1e-6 * criterion.total_weight());
  require(exact.optimum && std::abs(folk::to_double(*exact.optimum) - exact.values[problem.start]) <= tolerance);
  for (std::size_t s = 0; s < problem.size(); ++s) require(std::abs(exact.values[s] - rounded.values[s]) <= tolerance);
}

void same_optimum(const ReplyProblem& problem, std::uint32_t rounds) {
  const folk::FiniteBestReply reply(problem, rounds);
  const ReplyProblem anew = repeated(problem, rounds);
  if (const auto exact = reply.exact_optimum()) {
    require(*folk::stationary_reply(anew, Criterion::mean()).optimum * rounds == *exact);
    return;
  }
  const auto mean = folk::markov_reply(anew, Criterion::mean());
  require(std::abs(mean.values[anew.start] * rounds - reply.optimum()) <= rounds * (mean.residual + 1e-9));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  folk::fuzz::Bytes bytes(data, size);
  constexpr std::array noises{0.0, 0.0, 0.0625, 0.5};
  const bool mixes = bytes.below(4) == 0;
  const double noise = noises[bytes.below(noises.size())];
  const std::uint32_t rounds = 1 + bytes.below(4);
  const Criterion criterion = endless(bytes);
  const folk::Payoffs game = payoffs(bytes);
  const folk::Automaton opponent = folk::fuzz::machine(bytes, 5, mixes);
  const ReplyProblem problem = folk::reply_problem(opponent, game, noise);
  if (problem.deterministic()) same_values(problem, criterion);
  same_optimum(problem, rounds);
  return 0;
}
