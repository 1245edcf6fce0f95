#include <folk/analysis/best_reply.h>
#include <folk/analysis/whole_payoffs.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

Automaton table_of(const Machine& machine, std::uint64_t rounds) {
  if (rounds == 0) throw UsageError("a best reply over 0 rounds is no play: give 1 or more");
  // No machine stays within the limit of states for more rounds than `unsigned` holds unless it closes.
  const auto horizon = static_cast<unsigned>(std::min<std::uint64_t>(rounds, std::numeric_limits<unsigned>::max() - 1));
  return unroll(machine, Sense::own_moves_its_own, horizon);
}

/// What a move m earns against a machine that cooperates with probability p: mean of what follows its C and its D.
double expected(double p, double after_c, double after_d) { return p * after_c + (1 - p) * after_d; }

}  // namespace

FiniteBestReply::FiniteBestReply(const Machine& opponent, const Payoffs& payoffs, std::uint64_t rounds)
    : opponent_(table_of(opponent, rounds)),
      rounds_(rounds) {
  if (rounds > most_decisions / opponent_.size())
    throw UsageError(fmt::format("a best reply to {} states over {} rounds: more than {} decisions, play fewer rounds",
                                 opponent_.size(), rounds, most_decisions));
  solve(payoffs);
}

void FiniteBestReply::solve(const Payoffs& payoffs) {
  const WholePayoffs whole = whole_payoffs(payoffs);
  if (!whole.exact(static_cast<double>(rounds_)))
    throw UsageError(
        fmt::format("{} rounds at {} would score too much to count exactly: play fewer", rounds_, to_text(payoffs)));
  const auto& nodes = opponent_.nodes();
  defects_.resize(rounds_ * nodes.size());
  // What the best and the worst play earn from each state on in the rounds that are left.
  std::vector<double> most(nodes.size(), 0);
  std::vector<double> least(nodes.size(), 0);
  std::vector<double> next_most(nodes.size());
  std::vector<double> next_least(nodes.size());
  for (std::uint64_t round = rounds_; round-- > 0;) {
    for (std::size_t s = 0; s < nodes.size(); ++s) {
      std::array<double, 2> best{};
      std::array<double, 2> worst{};
      for (const Move own : {Move::C, Move::D}) {
        const double p = nodes[s].cooperation;
        const double at_c = whole.by_outcome[outcome(own, Move::C)];
        const double at_d = whole.by_outcome[outcome(own, Move::D)];
        const std::uint32_t after_c = nodes[s].next[outcome(Move::C, own)];
        const std::uint32_t after_d = nodes[s].next[outcome(Move::D, own)];
        best[bit(own)] = expected(p, at_c + most[after_c], at_d + most[after_d]);
        worst[bit(own)] = expected(p, at_c + least[after_c], at_d + least[after_d]);
      }
      next_most[s] = std::max(best[0], best[1]);
      next_least[s] = std::min(worst[0], worst[1]);
      defects_[round * nodes.size() + s] = best[1] > best[0];
    }
    most.swap(next_most);
    least.swap(next_least);
  }
  optimum_ = most[opponent_.start()] / whole.scale;
  minimum_ = least[opponent_.start()] / whole.scale;
}

Move FiniteBestReply::best(std::uint64_t round, std::uint32_t state) const {
  return defects_[round * opponent_.size() + state] ? Move::D : Move::C;
}

std::vector<Move> FiniteBestReply::moves() const {
  if (!opponent_.deterministic())
    throw std::logic_error("no sequence of moves is a best reply to a machine that mixes");
  std::vector<Move> moves;
  State state = opponent_.start();
  for (std::uint64_t round = 0; round < rounds_; ++round) {
    moves.push_back(best(round, static_cast<std::uint32_t>(state)));
    state = opponent_.next(state, move_of(opponent_, state), moves.back());
  }
  return moves;
}

}  // namespace folk
