#include <folk/analysis/beliefs/state_merging.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace folk {
namespace {

/// Folding one node into another, tried out: what speaks for and against it.
struct Fold {
  double agreeing = 0;  ///< weight of moves that both saw alike
  double wrong = 0;     ///< weight of moves that become wrong
};

class Merging {
public:
  Merging(const PrefixTree& tree, double state_price)
      : nodes_(tree.nodes()),
        price_(state_price) {}

  /// Until all successors of red states are red.
  void run() {
    red_.push_back(0);
    is_red_.assign(nodes_.size(), false);
    is_red_[0] = true;
    for (auto edges = blue_edges(); !edges.empty(); edges = blue_edges()) {
      std::optional<Choice> best;
      bool promoted = false;
      for (const Edge& edge : edges) {
        const auto choice = best_red(edge);
        if (!choice) {
          promote(nodes_[edge.from].next[edge.symbol]);
          promoted = true;
          break;
        }
        if (!best || choice->score > best->score) best = choice;
      }
      if (!promoted) fold(best->edge, best->into);
    }
  }

  MergedMachine result() const {
    MergedMachine merged{Automaton({{1, {0, 0, 0, 0}}}, 0)};
    std::vector<std::uint32_t> number(nodes_.size());
    for (std::size_t i = 0; i < red_.size(); ++i) number[red_[i]] = static_cast<std::uint32_t>(i);
    std::vector<Automaton::Node> states;
    for (const auto node : red_) {
      const auto& seen = nodes_[node].seen;
      merged.weight += seen[0] + seen[1];
      merged.wrong += std::min(seen[0], seen[1]);
      std::array<std::uint32_t, 2> next{};
      for (unsigned symbol = 0; symbol < 2; ++symbol) {
        const auto successor = nodes_[node].next[symbol];
        const bool unseen = successor == none;
        if (unseen) ++merged.unseen_moves;
        next[symbol] = number[unseen ? node : successor];
      }
      states.push_back({seen[0] >= seen[1] ? 1.0 : 0.0, {next[0], next[1], next[0], next[1]}});
    }
    merged.machine = minimise(Automaton(std::move(states), 0), Sense::own_moves_its_own);
    return merged;
  }

private:
  static constexpr std::uint32_t none = PrefixTree::none;

  struct Edge {
    std::uint32_t from;
    unsigned symbol;
  };
  struct Choice {
    Edge edge;
    std::uint32_t into;
    double score;
  };

  /// Successors of red states that are not red, by the order of those states.
  std::vector<Edge> blue_edges() const {
    std::vector<Edge> edges;
    for (const auto node : red_)
      for (unsigned symbol = 0; symbol < 2; ++symbol)
        if (const auto successor = nodes_[node].next[symbol]; successor != none && !is_red_[successor])
          edges.push_back({node, symbol});
    return edges;
  }

  void promote(std::uint32_t node) {
    is_red_[node] = true;
    red_.push_back(node);
  }

  std::optional<Choice> best_red(const Edge& edge) {
    std::optional<Choice> best;
    for (const auto red : red_) {
      const Fold fold = tried(edge, red);
      if (fold.wrong > price_) continue;
      const double score = fold.agreeing - fold.wrong;
      if (!best || score > best->score) best = Choice{edge, red, score};
    }
    return best;
  }

  Fold tried(const Edge& edge, std::uint32_t into) {
    undo_.clear();
    const Fold result = fold(edge, into);
    for (auto change = undo_.rbegin(); change != undo_.rend(); ++change) nodes_[change->first] = change->second;
    return result;
  }

  Fold fold(const Edge& edge, std::uint32_t into) {
    const auto blue = nodes_[edge.from].next[edge.symbol];
    undo_.push_back({edge.from, nodes_[edge.from]});
    nodes_[edge.from].next[edge.symbol] = into;
    Fold result;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{into, blue}};
    while (!open.empty()) {
      const auto [target, source] = open.back();
      open.pop_back();
      undo_.push_back({target, nodes_[target]});
      auto& seen = nodes_[target].seen;
      const auto& more = nodes_[source].seen;
      const double before = std::min(seen[0], seen[1]) + std::min(more[0], more[1]);
      result.agreeing += std::min(seen[0], more[0]) + std::min(seen[1], more[1]);
      for (std::size_t m = 0; m < 2; ++m) seen[m] += more[m];
      result.wrong += std::min(seen[0], seen[1]) - before;
      for (unsigned symbol = 0; symbol < 2; ++symbol) {
        const auto from_source = nodes_[source].next[symbol];
        auto& from_target = nodes_[target].next[symbol];
        if (from_source == none) continue;
        if (from_target == none)
          from_target = from_source;
        else
          open.push_back({from_target, from_source});
      }
    }
    return result;
  }

  std::vector<PrefixTree::Node> nodes_;
  double price_;
  std::vector<std::uint32_t> red_;
  std::vector<bool> is_red_;
  std::vector<std::pair<std::uint32_t, PrefixTree::Node>> undo_;
};

}  // namespace

std::uint32_t PrefixTree::after(std::uint32_t node, Move theirs) {
  if (nodes_[node].next[bit(theirs)] == none) {
    nodes_[node].next[bit(theirs)] = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
  }
  return nodes_[node].next[bit(theirs)];
}

void PrefixTree::add(std::span<const Move> own, std::span<const Move> theirs, double weight) {
  if (theirs.size() + 1 < own.size()) throw std::logic_error("a match with fewer of their moves than of the own");
  std::uint32_t node = 0;
  for (std::size_t t = 0; t < own.size(); ++t) {
    if (t > 0) node = after(node, theirs[t - 1]);
    see(node, own[t], weight);
  }
}

MergedMachine merge_states(const PrefixTree& tree, double state_price) {
  Merging merging(tree, state_price);
  merging.run();
  return merging.result();
}

}  // namespace folk
