#include <folk/analysis/beliefs/believed_world.h>
#include <folk/analysis/beliefs/extraction.h>
#include <folk/analysis/beliefs/state_merging.h>
#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace folk {
namespace {

constexpr unsigned most_depth = 16;

/// Histories that are thought about at once: players that stand in many of them would fill the memory.
constexpr std::size_t histories_at_once = 16;

/// Lays all moves of an opponent in the first rounds out in a prefix tree.
class AllPlay {
public:
  AllPlay(const Strategy& policy, const ExtractionOptions& options, std::uint64_t rounds, PrefixTree& tree,
          const Progress& progress)
      : progress_(progress),
        world_(policy, options.payoffs, Criterion::finite(rounds), options.threads),
        depth_(options.depth),
        tree_(tree) {}

  void lay_out() {
    explore({{BelievedWorld::start, 0}});
    world_.finish();
  }

private:
  using Places = std::vector<std::pair<BelievedWorld::Node, std::uint32_t>>;  // the same history in both

  void explore(const Places& places) {
    std::vector<BelievedWorld::Node> nodes;
    for (const auto& [node, place] : places) nodes.push_back(node);
    world_.think(nodes);
    for (const auto& [node, place] : places) tree_.see(place, world_.own(node));
    seen_ += nodes.size();
    progress_(static_cast<double>(seen_) / (std::exp2(depth_ + 1) - 1));
    if (world_.round(nodes.front()) < depth_) {
      Places next;
      for (const auto& [node, place] : places) {
        for (const Move theirs : {Move::C, Move::D})
          next.emplace_back(world_.after(node, world_.own(node), theirs), tree_.after(place, theirs));
        if (next.size() == histories_at_once) explore(std::exchange(next, {}));
      }
      if (!next.empty()) explore(next);
    }
    world_.dismiss(nodes);
  }

  Progress progress_;
  BelievedWorld world_;
  unsigned depth_;
  PrefixTree& tree_;
  std::size_t seen_ = 0;
};

void add_matches(const std::vector<BeliefRecord>& records, std::uint64_t ignored_last, PrefixTree& tree) {
  for (const auto& record : records)
    for (const auto& match : record.matches) {
      std::vector<Move> own;
      std::vector<Move> theirs;
      for (const auto& round : match) {
        own.push_back(round.own);
        theirs.push_back(round.theirs);
      }
      own.resize(own.size() - std::min<std::size_t>(ignored_last, own.size()));
      tree.add(own, theirs);
    }
}

void check_records(const std::vector<Strategy>& opponents, const std::vector<BeliefRecord>& records) {
  if (opponents.size() != records.size())
    throw UsageError(fmt::format("{} records of matches against {} opponents: give the records of these opponents",
                                 records.size(), opponents.size()));
}

/// The length of the matches. Throws UsageError when there is nothing to build from.
std::uint64_t check(const Strategy& policy, const std::vector<BeliefRecord>& records,
                    const ExtractionOptions& options) {
  if (!is_deterministic(policy))
    throw UsageError(fmt::format(
        "{} {}: an automaton is extracted from a deterministic policy", policy.name,
        policy.machine ? "draws random numbers"
                       : "is not known to be deterministic (of a program exec(\"CMD\";deterministic) says so)"));
  std::uint64_t rounds = 0;
  for (const auto& record : records)
    for (const auto& match : record.matches) rounds = std::max<std::uint64_t>(rounds, match.size());
  if (rounds <= options.ignored_last)
    throw UsageError(fmt::format("matches of {} rounds of which the last {} are ignored leave nothing to extract from",
                                 rounds, options.ignored_last));
  if (options.depth > most_depth || options.depth >= rounds)
    throw UsageError(fmt::format("all play up to a depth of {} rounds: expected 0 to {}", options.depth,
                                 std::min<std::uint64_t>(most_depth, rounds - 1)));
  return rounds;
}

std::uint64_t told(const Automaton& automaton, const BeliefMatch& match, std::optional<std::uint64_t>& first) {
  State state = automaton.start();
  std::uint64_t equal = 0;
  for (std::size_t t = 0; t < match.size(); ++t) {
    if (move_of(automaton, state) == match[t].own)
      ++equal;
    else
      first = std::min<std::uint64_t>(first.value_or(t + 1), t + 1);
    state = automaton.next(state, match[t].own, match[t].theirs);
  }
  return equal;
}

std::uint64_t played(const Automaton& automaton, const Strategy& opponent, const BeliefMatch& match,
                     const Payoffs& payoffs) {
  const auto player = opponent.new_player();
  player->start({payoffs, Criterion::finite(match.size()), {}});
  State state = automaton.start();
  std::uint64_t equal = 0;
  for (const auto& round : match) {
    const Move own = move_of(automaton, state);
    const Move theirs = player->move();
    if (own == round.own) ++equal;
    player->observe(theirs, own);
    state = automaton.next(state, own, theirs);
  }
  player->finish();
  return equal;
}

double share(std::uint64_t equal, std::uint64_t moves) {
  return moves > 0 ? static_cast<double>(equal) / static_cast<double>(moves) : 1;
}

}  // namespace

std::uint64_t Fidelity::moves() const {
  std::uint64_t sum = 0;
  for (const auto& match : matches) sum += match.moves;
  return sum;
}

double Fidelity::told() const {
  std::uint64_t equal = 0;
  for (const auto& match : matches) equal += match.equal_told;
  return share(equal, moves());
}

std::optional<double> Fidelity::played() const {
  std::uint64_t equal = 0;
  std::uint64_t all = 0;
  for (const auto& match : matches) {
    if (!match.equal_played) continue;
    equal += *match.equal_played;
    all += match.moves;
  }
  return all > 0 ? std::optional(share(equal, all)) : std::nullopt;
}

Fidelity fidelity(const Automaton& automaton, const std::vector<Strategy>& opponents,
                  const std::vector<BeliefRecord>& records, const Payoffs& payoffs) {
  check_records(opponents, records);
  Fidelity result;
  for (std::size_t i = 0; i < records.size(); ++i) {
    MatchFidelity& of_record = result.matches.emplace_back();
    of_record.opponent = records[i].opponent;
    if (is_deterministic(opponents[i])) of_record.equal_played = 0;
    for (const auto& match : records[i].matches) {
      if (match.empty()) continue;
      of_record.moves += match.size();
      of_record.equal_told += told(automaton, match, of_record.first_difference);
      if (of_record.equal_played) *of_record.equal_played += played(automaton, opponents[i], match, payoffs);
    }
  }
  return result;
}

std::vector<Extraction> extract_machines(const Strategy& policy, const std::vector<Strategy>& opponents,
                                         const std::vector<BeliefRecord>& records, const ExtractionOptions& options,
                                         const Progress& progress) {
  check_records(opponents, records);
  const std::uint64_t rounds = check(policy, records, options);
  PrefixTree tree;
  add_matches(records, options.ignored_last, tree);
  if (options.depth > 0) AllPlay(policy, options, rounds, tree, progress.part(0, 0.5)).lay_out();

  std::vector<MergedMachine> merged(options.state_prices.size(), {Automaton({{1, {0, 0, 0, 0}}}, 0)});
  const auto merge = [&](std::size_t i, unsigned) { merged[i] = merge_states(tree, options.state_prices[i]); };
  parallel_for(merged.size(), options.threads, merge, progress.part(0.5, 1));

  std::vector<Extraction> extractions;
  for (std::size_t i = 0; i < merged.size(); ++i) {
    auto matches = fidelity(merged[i].machine, opponents, records, options.payoffs);
    extractions.push_back({std::move(merged[i].machine), options.state_prices[i],
                           static_cast<std::uint64_t>(std::llround(merged[i].weight)),
                           static_cast<std::uint64_t>(std::llround(merged[i].wrong)), merged[i].unseen_moves,
                           std::move(matches)});
  }
  return extractions;
}

std::optional<std::size_t> readable_machine(const std::vector<Extraction>& extractions, std::size_t most_states,
                                            double aim) {
  const auto faithful = [](const Extraction& e) { return e.matches.played().value_or(e.matches.told()); };
  const auto key = [&](const Extraction& e) { return std::tuple(-faithful(e), e.wrong, e.machine.size()); };
  std::optional<std::size_t> best;
  for (const std::size_t limit : {most_states, 2 * most_states}) {
    for (std::size_t i = 0; i < extractions.size(); ++i)
      if (extractions[i].machine.size() <= limit && (!best || key(extractions[i]) < key(extractions[*best]))) best = i;
    if (best && faithful(extractions[*best]) >= aim) break;
  }
  return best;
}

}  // namespace folk
