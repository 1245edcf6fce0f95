#include <folk/analysis/play/whole_payoffs.h>
#include <folk/analysis/replies/bayes_reply.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/strategies/automaton.h>

#include <fmt/format.h>

#include <algorithm>
#include <boost/container_hash/hash.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

namespace folk {
namespace {

constexpr Sense sense = Sense::own_moves_its_own;

/// A member with more states within the horizon has too many information states all by itself.
constexpr std::size_t largest_member = 1U << 17U;

/// "the roster all_c,all_d,...", for messages.
std::string named(const std::vector<Strategy>& roster) {
  std::string names;
  for (const auto& strategy : roster) {
    if (names.size() > 80) break;
    names += (names.empty() ? "" : ",") + strategy.name;
  }
  return "the roster " + excerpt(names, 80);
}

/// A whole roster as one automaton of deterministic states, and where each member starts in it.
struct Behaviours {
  Automaton automaton;
  std::vector<std::uint32_t> starts;
};

/// One member as it plays within `rounds`. What it does later does not matter: the state beyond the horizon may stay.
Automaton table_of(const Strategy& strategy, std::uint64_t rounds) {
  if (!strategy.machine)
    throw UsageError(fmt::format("{} is an opaque player: only machines can be learnt about", strategy.name));
  try {
    const auto horizon =
        static_cast<unsigned>(std::min<std::uint64_t>(rounds, std::numeric_limits<unsigned>::max() - 1));
    return unroll(*strategy.machine, sense, horizon, largest_member);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: {}", strategy.name, error.what()));
  }
}

Behaviours behaviours_of(const std::vector<Strategy>& roster, std::uint64_t rounds) {
  // One automaton for all, to be minimised at once: it opens with a row of states of which state i leads to the start
  // of member i after a C, and along the row after a D.
  const auto members = static_cast<std::uint32_t>(roster.size());
  std::vector<Automaton::Node> nodes(members);
  for (std::uint32_t i = 0; i < members; ++i) {
    const Automaton table = table_of(roster[i], rounds);
    if (!table.deterministic())
      throw UsageError(fmt::format("{} mixes: exact Bayesian play takes deterministic machines", roster[i].name));
    const auto offset = static_cast<std::uint32_t>(nodes.size());
    for (Automaton::Node node : table.nodes()) {
      for (auto& successor : node.next) successor += offset;
      nodes.push_back(node);
    }
    const auto start = offset + static_cast<std::uint32_t>(table.start());
    const std::uint32_t along = std::min(i + 1, members - 1);
    nodes[i] = {1, {start, along, start, along}};
  }
  Behaviours found{minimise(Automaton(std::move(nodes), 0), sense), {}};
  State at = found.automaton.start();
  for (std::uint32_t i = 0; i < members; ++i) {
    found.starts.push_back(static_cast<std::uint32_t>(found.automaton.next(at, Move::C, Move::C)));
    at = found.automaton.next(at, Move::C, Move::D);
  }
  return found;
}

/// A behaviour that is still consistent with the play, and how much of the prior it holds.
struct Member {
  std::uint32_t state;
  double weight;

  bool operator==(const Member&) const = default;
};

/// Ordered by state, each state once.
using Members = std::vector<Member>;

/// Brings members into their order.
void put_in_order(Members& members) {
  std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
    return std::pair(a.state, a.weight) < std::pair(b.state, b.weight);
  });
  std::size_t last = 0;
  for (std::size_t i = 1; i < members.size(); ++i) {
    if (members[i].state == members[last].state)
      members[last].weight += members[i].weight;
    else
      members[++last] = members[i];
  }
  members.resize(std::min(members.size(), last + 1));
}

/// Who is left after an outcome, as the player sees it, and where they stand then.
void find_consistent(std::span<const Member> members, Outcome outcome, const Automaton& automaton, Members& left) {
  const auto [own, theirs] = outcome;
  left.clear();
  for (const Member& member : members)
    if (move_of(automaton, member.state) == theirs)
      left.push_back({static_cast<std::uint32_t>(automaton.next(member.state, theirs, own)), member.weight});
  put_in_order(left);
}

/// The information states of one round, numbered from `first` on. Their members stand one after the other, and an open
/// addressing table finds them: there are millions, most of them of one member.
class Layer {
public:
  /// Empty again, its room kept.
  void restart(std::size_t first) {
    first_ = first;
    members_.clear();
    ends_.assign(1, 0);
    slots_.assign(slots_.size(), empty);
  }

  /// The number of the state of these members; a new one gets the next number.
  BayesReply::Node number(const Members& members) {
    if (2 * ends_.size() > slots_.size()) grow();
    std::uint32_t& slot = slots_[place(members)];
    if (slot == empty) {
      slot = static_cast<std::uint32_t>(size());
      members_.insert(members_.end(), members.begin(), members.end());
      ends_.push_back(members_.size());
    }
    return static_cast<BayesReply::Node>(first_ + slot);
  }

  std::size_t size() const { return ends_.size() - 1; }
  std::size_t end() const { return first_ + size(); }
  std::span<const Member> members(std::size_t i) const {
    return std::span(members_).subspan(ends_[i], ends_[i + 1] - ends_[i]);
  }

private:
  static constexpr std::uint32_t empty = 0xFFFFFFFFU;

  std::size_t place(std::span<const Member> wanted) const {
    std::size_t seed = 0;
    for (const auto& member : wanted) {
      boost::hash_combine(seed, member.state);
      boost::hash_combine(seed, member.weight);
    }
    std::size_t slot = seed & (slots_.size() - 1);
    while (slots_[slot] != empty && !std::ranges::equal(members(slots_[slot]), wanted))
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  void grow() {
    slots_.assign(slots_.size() * 2, empty);
    for (std::size_t i = 0; i < size(); ++i) slots_[place(members(i))] = static_cast<std::uint32_t>(i);
  }

  std::size_t first_ = 0;
  std::vector<Member> members_;
  std::vector<std::size_t> ends_{0};  // of state i: ends_[i + 1]
  std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(64, empty);
};

/// Equal weights are counted, so that sums are whole numbers.
std::vector<double> weights_of(std::vector<double> prior, const std::vector<Strategy>& roster) {
  if (prior.empty()) return std::vector<double>(roster.size(), 1);
  if (prior.size() != roster.size())
    throw UsageError(
        fmt::format("{} has {} members, but the prior has {} weights", named(roster), roster.size(), prior.size()));
  for (const double weight : prior)
    if (!(weight >= 0 && std::isfinite(weight)))
      throw UsageError(fmt::format("prior weight {}: expected a number of at least 0", weight));
  const double largest = *std::max_element(prior.begin(), prior.end());
  if (largest == 0) throw UsageError("all weights of the prior are 0: give some member a chance");
  if (std::all_of(prior.begin(), prior.end(), [&](double weight) { return weight == largest; }))
    std::fill(prior.begin(), prior.end(), 1);
  return prior;
}

/// Throws UsageError where totals could not be counted exactly.
void refuse_large_totals(const WholePayoffs& whole, const std::vector<double>& weights, std::uint64_t rounds,
                         const std::string& roster) {
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!whole.exact(all * static_cast<double>(rounds)))
    throw UsageError(
        fmt::format("{} over {} rounds would score too much to count exactly: play fewer rounds, or give payoffs of "
                    "fewer digits",
                    roster, rounds));
}

}  // namespace

BayesReply::BayesReply(const std::vector<Strategy>& roster, const Payoffs& payoffs, std::uint64_t rounds,
                       std::vector<double> prior, std::size_t most)
    : members_(roster.size()) {
  if (roster.empty()) throw UsageError("Bayesian play needs a roster of at least one strategy");
  if (rounds == 0) throw UsageError("Bayesian play over 0 rounds is no play: give 1 or more");
  const std::vector<double> weights = weights_of(std::move(prior), roster);
  const WholePayoffs whole = whole_payoffs(payoffs);
  refuse_large_totals(whole, weights, rounds, named(roster));
  scale_ = whole.scale;
  const auto [automaton, starts] = behaviours_of(roster, rounds);
  const std::size_t limit = std::min<std::size_t>(most, nowhere);

  Members everyone;
  for (std::size_t i = 0; i < roster.size(); ++i)
    if (weights[i] > 0) everyone.push_back({starts[i], weights[i]});
  put_in_order(everyone);
  Layer layer;
  Layer following;
  Members consistent;
  layer.number(everyone);
  for (std::uint64_t left = rounds; left-- > 0;) {
    following.restart(layer.end());
    for (std::size_t i = 0; i < layer.size(); ++i) {
      const auto members = layer.members(i);
      Information information;
      for (const Member& member : members) {
        information.weight += member.weight;
        if (move_of(automaton, member.state) == Move::C) information.cooperating += member.weight;
      }
      for (const Outcome outcome : all_outcomes) {
        if (left == 0) break;
        find_consistent(members, outcome, automaton, consistent);
        if (!consistent.empty()) information.next[outcome.index()] = following.number(consistent);
      }
      nodes_.push_back(information);
      if (following.end() > limit)
        throw UsageError(
            fmt::format("{} has more than {} information states within {} rounds: play fewer rounds or leave "
                        "strategies out",
                        named(roster), limit, rounds));
    }
    std::swap(layer, following);
  }
  solve(whole.by_outcome);
}

void BayesReply::solve(const std::array<double, 4>& payoffs) {
  // Successors stand behind their predecessors.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Information& here = nodes_[i];
    const std::array<double, 2> playing{here.cooperating, here.weight - here.cooperating};
    for (const Outcome outcome : all_outcomes) {
      const std::size_t o = outcome.index();
      double& total = here.totals[bit(outcome.own)];
      total += playing[bit(outcome.theirs)] * payoffs[o];
      if (here.next[o] != nowhere) total += std::max(nodes_[here.next[o]].totals[0], nodes_[here.next[o]].totals[1]);
    }
  }
}

double BayesReply::value() const {
  const Information& start = nodes_[root()];
  return std::max(start.totals[0], start.totals[1]) * (static_cast<double>(members_) / start.weight) / scale_;
}

std::array<double, 2> BayesReply::action_values(Node node) const {
  const Information& here = nodes_[node];
  return {here.totals[0] / here.weight / scale_, here.totals[1] / here.weight / scale_};
}

}  // namespace folk
