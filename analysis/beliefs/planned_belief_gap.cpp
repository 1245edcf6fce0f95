#include <folk/analysis/beliefs/believed_world.h>
#include <folk/analysis/beliefs/planned_belief_gap.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace folk {
namespace {

using Node = BelievedWorld::Node;

constexpr double belief_rounding = 1e-4;
constexpr std::size_t rounds_together = 8;

Strategy believer_of(const Strategy& player) {
  Strategy believer = player;
  if (player.make_believer) believer.make_player = player.make_believer;
  return believer;
}

class Outlook {
public:
  Outlook(const Strategy& believer, const std::vector<BeliefMatch>& paths, const PlannedSearch& options)
      : options_(options),
        paths_(paths),
        rounds_(paths.front().size()),
        payoffs_(options.payoffs.numbers()),
        world_(believer, options.payoffs, Criterion::finite(rounds_), options.threads),
        gaps_(paths.size()) {
    for (OwnBeliefGap& gap : gaps_) gap.gains.resize(rounds_);
  }

  /// False when the player holds no beliefs.
  bool walk(const Progress& progress) {
    auto nodes = world_.walk(paths_, progress);
    if (nodes) nodes_ = std::move(*nodes);
    return nodes.has_value();
  }

  void run(const std::vector<std::size_t>& rounds, const Progress& progress) {
    for (std::size_t first = 0; first < rounds.size(); first += rounds_together) {
      const std::size_t last = std::min(first + rounds_together, rounds.size());
      look_ahead(
          {rounds.begin() + static_cast<std::ptrdiff_t>(first), rounds.begin() + static_cast<std::ptrdiff_t>(last)},
          progress);
      for (std::size_t k = first; k < last; ++k)
        for (std::size_t i = 0; i < paths_.size(); ++i) judge(i, rounds[k]);
      world_.dismiss();
      progress(static_cast<double>(last) / static_cast<double>(rounds.size()));
    }
  }

  void finish() { world_.finish(); }
  const OwnBeliefGap& result(std::size_t path) const { return gaps_[path]; }

private:
  /// Lays out what may follow the paths' histories before these rounds, level by level.
  void look_ahead(const std::vector<std::size_t>& rounds, const Progress& progress) {
    std::vector<Node> level;
    for (const std::size_t t : rounds)
      for (const auto& path : nodes_) level.push_back(path[t]);
    for (std::size_t depth = 1; depth < options_.depth; ++depth) {
      progress.check();
      std::vector<Node> next;
      for (const Node node : level) {
        if (world_.round(node) + 1 >= rounds_) continue;
        for (const Outcome outcome : all_outcomes)
          if (probability(node, outcome.theirs) >= options_.least_probability)
            next.push_back(world_.after(node, outcome.own, outcome.theirs));
      }
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      world_.think(next);
      level = std::move(next);
    }
  }

  double probability(Node node, Move theirs) const {
    return theirs == Move::C ? world_.belief(node) : 1 - world_.belief(node);
  }

  /// The expected payoff of the next `depth` rounds, of which at least one is left, by the first own move.
  std::array<double, 2> values(Node node, std::size_t depth) {
    std::array<double, 2> found{};
    const bool goes_on = depth > 1 && world_.round(node) + 1 < rounds_;
    for (const Move own : {Move::C, Move::D}) {
      double followed = 0, later = 0;
      for (const Move theirs : {Move::C, Move::D}) {
        const double p = probability(node, theirs);
        found[bit(own)] += p * payoffs_[Outcome{own, theirs}.index()];
        if (!goes_on || p < options_.least_probability) continue;
        const auto after = values(world_.after(node, own, theirs), depth - 1);
        followed += p;
        later += p * std::max(after[0], after[1]);
      }
      if (followed > 0) found[bit(own)] += later / followed;
    }
    return found;
  }

  void judge(std::size_t path, std::size_t round) {
    OwnBeliefGap& gap = gaps_[path];
    ++gap.searched_rounds;
    const Node node = nodes_[path][round];
    const auto worth = values(node, options_.depth);
    const Move made = paths_[path][round].own;
    const double gain = worth[bit(other(made))] - worth[bit(made)];
    if (gain <= belief_rounding * std::abs(worth[bit(made)])) return;
    gap.gains[round] = gain;
    if (gain <= gap.gain) return;
    gap.gain = gain;
    gap.round = round + 1;
    gap.own_moves = {other(made)};
    gap.believed = {world_.believed(node)};
    gap.own_value = worth[bit(made)];
    gap.best_value = worth[bit(other(made))];
  }

  const PlannedSearch& options_;
  const std::vector<BeliefMatch>& paths_;
  std::uint64_t rounds_;
  std::array<double, 4> payoffs_;
  BelievedWorld world_;
  std::vector<std::vector<Node>> nodes_;  // of each path, by rounds past
  std::vector<OwnBeliefGap> gaps_;
};

}  // namespace

std::vector<std::optional<OwnBeliefGap>> planned_belief_gaps(const Strategy& player,
                                                             const std::vector<BeliefMatch>& paths,
                                                             const PlannedSearch& search, const Progress& progress) {
  std::vector<std::optional<OwnBeliefGap>> gaps(paths.size());
  if (paths.empty() || player.machine || !player.deterministic) return gaps;
  if (search.depth < 1 || search.depth > most_planned_depth)
    throw UsageError(fmt::format("a search of depth {}: expected 1 to {}", search.depth, most_planned_depth));
  const auto rounds = asked_rounds(paths, search.rounds);
  const Strategy believer = believer_of(player);
  Outlook searched(believer, paths, search);
  const bool believes = searched.walk(progress);
  if (believes) searched.run(rounds, progress);
  searched.finish();
  for (std::size_t i = 0; believes && i < paths.size(); ++i) gaps[i] = searched.result(i);
  return gaps;
}

}  // namespace folk
