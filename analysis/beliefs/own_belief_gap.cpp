#include <folk/analysis/beliefs/believed_world.h>
#include <folk/analysis/beliefs/own_belief_gap.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>
#include <utility>

namespace folk {
namespace {

using Node = BelievedWorld::Node;

constexpr std::size_t most_search_depth = 12;
constexpr std::size_t rounds_at_once = 4;

/// 0, n/2, n/4, 3n/4, ...: every index below n once, far ones first.
std::vector<std::size_t> spread(std::size_t n) {
  std::vector<std::size_t> order;
  for (std::size_t stride = std::bit_ceil(n); stride >= 1; stride /= 2)
    for (std::size_t i = 0; i < n; i += stride)
      if (order.empty() || (i / stride) % 2 == 1) order.push_back(i);
  return order;
}

/// A round of the paths that pass through one history.
struct Root {
  Node node = 0;
  bool deviates_at_once = true;  ///< sequences that begin with the own move are left to the next round's search
  std::vector<std::size_t> paths{};
  double own_value = 0;
};

/// Own moves from a root on, what they were believed to meet and what they earned.
struct Line {
  std::size_t root = 0;
  Node node = 0;
  double earned = 0;
  bool deviates = false;
  std::vector<Move> own{};
  std::vector<Move> believed{};
};

/// What has been found for one path, in whole payoffs.
struct Found {
  double gain = 0;
  Line line{};
  double own_value = 0;
  std::uint64_t round = 0;
};

class Search {
public:
  Search(const Strategy& player, const std::vector<BeliefMatch>& paths, const OwnBeliefSearch& options,
         const Progress& progress)
      : progress_(progress),
        options_(options),
        paths_(paths),
        rounds_(paths.front().size()),
        payoffs_(whole_payoffs(options.payoffs)),
        most_(*std::max_element(payoffs_.by_outcome.begin(), payoffs_.by_outcome.end())),
        world_(player, options.payoffs, Criterion::finite(rounds_), options.threads),
        found_(paths.size()),
        searched_(paths.size()) {}

  /// Follows the paths; false when the player holds no beliefs.
  bool walk() {
    auto nodes = world_.walk(paths_, progress_);
    if (nodes) nodes_ = std::move(*nodes);
    return nodes.has_value();
  }

  void run(const std::vector<std::size_t>& rounds) {
    const auto order = spread(rounds.size());
    for (std::size_t first = 0; first < order.size() && world_.thoughts() < options_.most_thoughts;
         first += rounds_at_once) {
      std::vector<Root> roots;
      for (std::size_t k = first; k < std::min(first + rounds_at_once, order.size()); ++k) {
        const std::size_t t = rounds[order[k]];
        const bool next_too = std::binary_search(rounds.begin(), rounds.end(), t + 1);
        add_roots(t, next_too, roots);
      }
      search(roots);
      world_.dismiss();
      progress_(share_done(std::min(first + rounds_at_once, order.size()), order.size()));
    }
  }

  void finish() { world_.finish(); }

  OwnBeliefGap result(std::size_t path) const {
    const Found& found = found_[path];
    OwnBeliefGap gap;
    gap.searched_rounds = searched_[path];
    if (found.gain <= 0) return gap;
    gap.gain = found.gain / payoffs_.scale;
    gap.round = found.round;
    gap.own_moves = found.line.own;
    gap.believed = found.line.believed;
    gap.own_value = found.own_value / payoffs_.scale;
    gap.best_value = (found.own_value + found.gain) / payoffs_.scale;
    return gap;
  }

private:
  double share_done(std::size_t rounds, std::size_t all) const {
    const double of_rounds = static_cast<double>(rounds) / static_cast<double>(all);
    const double of_thoughts = static_cast<double>(world_.thoughts()) / static_cast<double>(options_.most_thoughts);
    return std::min(1.0, std::max(of_rounds, of_thoughts));
  }

  void add_roots(std::size_t t, bool next_too, std::vector<Root>& roots) {
    std::map<Node, std::size_t> known;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      ++searched_[i];
      const Node node = nodes_[i][t];
      const auto [place, is_new] = known.try_emplace(node, roots.size());
      if (is_new) roots.push_back({node});
      Root& root = roots[place->second];
      root.paths.push_back(i);
      // A sequence that begins with the own move is one of the next round's, if that lies where it is believed to.
      const BeliefRound& round = paths_[i][t];
      const bool leads_on = world_.own(node) == round.own && world_.believed(node) == round.theirs;
      root.deviates_at_once = root.deviates_at_once && next_too && leads_on;
    }
  }

  std::uint64_t rounds_left(Node node) const { return rounds_ - world_.round(node); }

  /// The best that rounds after this history could earn.
  double bound(Node node) const { return static_cast<double>(rounds_left(node)) * most_; }

  void step(Line& line, Move own) {
    line.earned += payoffs_.by_outcome[Outcome{own, world_.believed(line.node)}.index()];
    line.node = world_.after(line.node, own);
  }

  /// What a line must earn at least for a path of its root.
  double wanted(const Root& root) const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t path : root.paths) least = std::min(least, found_[path].gain);
    return root.own_value + least;
  }

  void drop_hopeless(std::vector<Line>& lines, const std::vector<Root>& roots) const {
    std::erase_if(lines, [&](const Line& line) { return line.earned + bound(line.node) <= wanted(roots[line.root]); });
  }

  /// Own play for some rounds more, all lines side by side.
  void play_on(std::vector<Line>& lines, std::uint64_t rounds, const std::vector<Root>* prune_by) {
    for (std::uint64_t k = 0; k < rounds; ++k) {
      progress_.check();
      if (prune_by != nullptr) drop_hopeless(lines, *prune_by);
      std::vector<Node> now;
      for (const auto& line : lines)
        if (rounds_left(line.node) > 0) now.push_back(line.node);
      if (now.empty()) return;
      world_.think(now);
      for (auto& line : lines)
        if (rounds_left(line.node) > 0) step(line, world_.own(line.node));
    }
  }

  /// All sequences of up to `depth` rounds that deviate somewhere.
  std::vector<Line> windows(const std::vector<Root>& roots) {
    std::vector<Line> lines;
    for (std::size_t r = 0; r < roots.size(); ++r) lines.push_back({r, roots[r].node});
    drop_hopeless(lines, roots);
    for (std::size_t d = 0; d < options_.depth; ++d) {
      std::vector<Node> now;
      for (const auto& line : lines)
        if (rounds_left(line.node) > 0) now.push_back(line.node);
      world_.think(now);
      std::vector<Line> longer;
      for (const auto& line : lines) {
        if (rounds_left(line.node) == 0) {
          longer.push_back(line);
          continue;
        }
        for (const Move own : {Move::C, Move::D}) {
          const bool deviates = own != world_.own(line.node);
          if (d == 0 && !deviates && roots[line.root].deviates_at_once) continue;
          Line next = line;
          next.own.push_back(own);
          next.believed.push_back(world_.believed(line.node));
          next.deviates = line.deviates || deviates;
          step(next, own);
          longer.push_back(std::move(next));
        }
      }
      lines = std::move(longer);
    }
    std::erase_if(lines, [](const Line& line) { return !line.deviates; });
    return lines;
  }

  /// Of each root the `most` lines that earned most so far, the earlier one of equals.
  static void keep_best(std::vector<Line>& lines, std::size_t most) {
    std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
      return a.root != b.root ? a.root < b.root : a.earned > b.earned;
    });
    std::vector<Line> kept;
    std::size_t of_root = 0;
    for (auto& line : lines) {
      of_root = !kept.empty() && kept.back().root == line.root ? of_root + 1 : 1;
      if (of_root <= most) kept.push_back(std::move(line));
    }
    lines = std::move(kept);
  }

  void search(std::vector<Root>& roots) {
    std::vector<Line> own;
    for (std::size_t r = 0; r < roots.size(); ++r) own.push_back({r, roots[r].node});
    play_on(own, rounds_, nullptr);
    for (const auto& line : own) roots[line.root].own_value = line.earned;

    auto lines = windows(roots);
    drop_hopeless(lines, roots);
    // The last free move of a sequence is a defection that has not been answered yet: who is best shows a little later.
    keep_best(lines, 8 * options_.beam);
    play_on(lines, (options_.depth + 1) / 2, &roots);
    keep_best(lines, options_.beam);
    play_on(lines, rounds_, &roots);
    for (const auto& line : lines)
      for (const std::size_t path : roots[line.root].paths) note(path, roots[line.root], line);
  }

  void note(std::size_t path, const Root& root, const Line& line) {
    Found& found = found_[path];
    const double gain = line.earned - root.own_value;
    if (gain > found.gain) found = {gain, line, root.own_value, world_.round(root.node) + 1};
  }

  const Progress& progress_;
  const OwnBeliefSearch& options_;
  const std::vector<BeliefMatch>& paths_;
  std::uint64_t rounds_;
  WholePayoffs payoffs_;
  double most_;
  BelievedWorld world_;
  std::vector<std::vector<Node>> nodes_;  // of each path, by rounds past
  std::vector<Found> found_;
  std::vector<std::uint64_t> searched_;
};

void check(const OwnBeliefSearch& search) {
  if (search.depth < 1 || search.depth > most_search_depth)
    throw UsageError(fmt::format("a search of depth {}: expected 1 to {}", search.depth, most_search_depth));
  if (search.beam < 1) throw UsageError("a search with beam 0: expected 1 or more");
}

}  // namespace

std::vector<std::size_t> asked_rounds(const std::vector<BeliefMatch>& paths, const std::vector<std::uint64_t>& asked) {
  const std::size_t rounds = paths.front().size();
  for (const auto& path : paths)
    if (path.size() != rounds || path.empty())
      throw UsageError(
          fmt::format("paths of {} and {} rounds: give paths of one length, 1 or more", rounds, path.size()));
  std::vector<std::size_t> places;
  for (const std::uint64_t round : asked) {
    if (round < 1 || round > rounds)
      throw UsageError(fmt::format("round {} of a path of {}: expected 1 to {}", round, rounds, rounds));
    places.push_back(round - 1);
  }
  if (asked.empty())
    for (std::size_t t = 0; t < rounds; ++t) places.push_back(t);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

std::vector<std::optional<OwnBeliefGap>> own_belief_gaps(const Strategy& player, const std::vector<BeliefMatch>& paths,
                                                         const OwnBeliefSearch& search, const Progress& progress) {
  std::vector<std::optional<OwnBeliefGap>> gaps(paths.size());
  if (paths.empty() || player.machine || !player.deterministic) return gaps;
  const auto rounds = asked_rounds(paths, search.rounds);
  check(search);
  Search searched(player, paths, search, progress);
  const bool believes = searched.walk();
  if (believes) searched.run(rounds);
  searched.finish();
  if (!believes) return gaps;
  for (std::size_t i = 0; i < paths.size(); ++i) gaps[i] = searched.result(i);
  return gaps;
}

}  // namespace folk
