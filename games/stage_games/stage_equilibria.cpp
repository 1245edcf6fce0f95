#include <folk/games/error.h>
#include <folk/games/stage_games/reply_polytope.h>
#include <folk/games/stage_games/stage_equilibria.h>

#include <algorithm>
#include <bitset>
#include <numeric>
#include <stdexcept>

namespace folk {
namespace {

/// Row's actions first, then column's: which of them are not played, or are best replies.
using Labels = std::bitset<most_equilibrium_actions>;

/// A mixture of one seat that is a vertex of the polytope of the other seat's best replies.
struct Vertex {
  MixedAction mixture;
  Labels labels;
};

/// A safeguard that no game of so few actions reaches: by the upper bound theorem (McMullen 1970) ten actions against
/// ten have at most 4,004 vertices.
constexpr std::size_t most_bases = 1'000'000;

/// All vertices of the mixtures of `seat`, the origin (no mixture) left out.
std::vector<Vertex> vertices_of(const StageGame& game, Seat seat) {
  const Seat replier = other(seat);
  const RationalMatrix payoffs = own_payoffs(game, replier, raise_to_positive(game, replier));
  const std::size_t first_own = seat == Seat::first ? 0 : game.rows();
  const std::size_t first_reply = seat == Seat::first ? game.rows() : 0;
  std::vector<Vertex> found;
  for (auto& y : ReplyPolytope(payoffs).vertices(most_bases)) {
    const Rational sum = std::accumulate(y.begin(), y.end(), Rational(0));
    if (sum == 0) continue;
    Labels labels;
    for (std::size_t own = 0; own < y.size(); ++own) labels[first_own + own] = y[own] == 0;
    for (std::size_t reply = 0; reply < payoffs.size(); ++reply)
      labels[first_reply + reply] = std::inner_product(y.begin(), y.end(), payoffs[reply].begin(), Rational(0)) == 1;
    for (Rational& weight : y) weight /= sum;
    found.push_back({std::move(y), labels});
  }
  return found;
}

bool too_many_labels(const std::vector<Vertex>& vertices) {
  return std::any_of(vertices.begin(), vertices.end(),
                     [](const Vertex& vertex) { return vertex.labels.count() > vertex.mixture.size(); });
}

/// Pure before mixed; of pure ones the first row, then the first column, first.
bool comes_before(const MixedProfile& a, const MixedProfile& b) {
  if (is_pure(a) != is_pure(b)) return is_pure(a);
  return a.row != b.row ? a.row > b.row : a.column > b.column;
}

}  // namespace

bool is_pure(const MixedProfile& profile) {
  const auto one = [](const MixedAction& mix) { return std::find(mix.begin(), mix.end(), Rational(1)) != mix.end(); };
  return one(profile.row) && one(profile.column);
}

StageEquilibria stage_equilibria(const StageGame& game) {
  const std::size_t actions = game.rows() + game.columns();
  if (actions > most_equilibrium_actions)
    throw UsageError("all equilibria are found for games of at most " + std::to_string(most_equilibrium_actions) +
                     " actions, both players' together: this one has " + std::to_string(actions));
  const auto rows = vertices_of(game, Seat::first);
  const auto columns = vertices_of(game, Seat::second);
  StageEquilibria found;
  found.degenerate = too_many_labels(rows) || too_many_labels(columns);
  for (const Vertex& row : rows)
    for (const Vertex& column : columns) {
      if ((row.labels | column.labels).count() != actions) continue;
      MixedProfile profile{row.mixture, column.mixture};
      if (!is_equilibrium(game, profile)) throw std::logic_error("a completely labelled pair is no equilibrium");
      found.extreme.push_back(std::move(profile));
    }
  std::sort(found.extreme.begin(), found.extreme.end(), comes_before);
  return found;
}

}  // namespace folk
