#include <folk/analysis/equilibria/confidence_bound.h>
#include <folk/analysis/equilibria/played_examination.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace folk {
namespace {

/// How often a sampled claim may be wrong.
constexpr double failure = 1e-6;

struct KnownReply {
  std::string name;
  double score;
};

/// What everybody earns against the policy who has one path with it.
std::vector<KnownReply> known_replies(const ExaminationQuestion& question, const std::vector<PairExamination>& pairs) {
  std::vector<KnownReply> known;
  for (const auto& pair : pairs)
    if (pair.record->once) known.push_back({pair.opponent, pair.their_score});
  if (known.empty()) return known;
  std::vector<Strategy> others = question.imitated;
  std::erase_if(others, [&](const Strategy& strategy) {
    return std::any_of(known.begin(), known.end(), [&](const KnownReply& one) { return one.name == strategy.name; });
  });
  for (const auto& record : record_beliefs(question.policy, others, question.sampling()))
    if (record.once) known.push_back({record.opponent, match_scores(record, question.payoffs).theirs});
  return known;
}

Gap gap_of_search(const OwnBeliefGap& found, const PlayPath& path, std::size_t depth) {
  Gap gap = rounded_gap(found.gain, 0, {});
  gap.depth = depth;
  if (found.searched_rounds < path.rounds.size())
    gap.tried = fmt::format("depth {}, {} of {} rounds", depth, found.searched_rounds, path.rounds.size());
  if (found.gain <= 0) return gap;
  gap.witness.history.assign(path.rounds.begin(), path.rounds.begin() + static_cast<std::ptrdiff_t>(found.round - 1));
  gap.witness.deviation = found.own_moves.front();
  std::string moves;
  std::string believed;
  for (const Move move : found.own_moves) moves += to_char(move);
  for (const Move move : found.believed) believed += to_char(move);
  gap.witness.then = fmt::format("plays on as it does ({} against the {} it expects)", moves, believed);
  return gap;
}

}  // namespace

MatchScores match_scores(const BeliefRecord& record, const Payoffs& payoffs) {
  if (record.matches.empty()) throw std::logic_error("no match was played");
  const auto numbers = payoffs.numbers();
  MatchScores scores;
  double squares = 0;
  for (const auto& match : record.matches) {
    double own = 0;
    double theirs = 0;
    for (const auto& round : match) {
      own += numbers[round.index()];
      theirs += numbers[round.exchanged().index()];
    }
    scores.own += own;
    scores.theirs += theirs;
    squares += own * own;
  }
  const auto n = static_cast<double>(record.matches.size());
  scores.own /= n;
  scores.theirs /= n;
  const double variance = n > 1 ? std::max(0.0, squares / n - scores.own * scores.own) * n / (n - 1) : 0;
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  const double range = (*most - *least) * static_cast<double>(record.matches.front().size());
  scores.error = bernstein_bound(variance, range, record.matches.size(), failure);
  return scores;
}

PairExamination examine_record(const ExaminationQuestion& question, const Strategy& opponent, BeliefRecord record,
                               ClassReplies& beliefs) {
  const auto prepared = [&](const Strategy& strategy) {
    return strategy.machine ? &beliefs.machines().of(strategy.machine) : nullptr;
  };
  const MatchScores scores = match_scores(record, question.payoffs);
  PairExamination found;
  found.opponent = opponent.name;
  found.own_score = scores.own;
  found.their_score = scores.theirs;
  found.method = record.once ? Method::played : Method::sampled;
  if (record.once) {
    PlayPath path;
    for (const auto& round : record.matches.front()) path.rounds.push_back({round.own, round.theirs});
    found.gaps = match_gaps(path, prepared(question.policy), prepared(opponent), beliefs);
    found.path = std::move(path);
  } else if (opponent.machine) {
    const BestReply& reply = prepared(opponent)->reply();
    Gap gap =
        rounded_gap(reply.payoff - scores.own, reply.residual + scores.error, {{}, std::nullopt, "best reply", {}});
    gap.tried = fmt::format("{} sampled matches", record.matches.size());
    found.gaps.first.nash = std::move(gap);
  }
  auto belief = belief_consistency(record);
  if (belief.rounds > 0) found.belief = std::move(belief);
  found.record = std::move(record);
  return found;
}

void add_known_replies(const ExaminationQuestion& question, std::vector<PairExamination>& pairs) {
  const auto known = known_replies(question, pairs);
  if (known.empty()) return;
  const KnownReply& best = *std::max_element(
      known.begin(), known.end(), [](const KnownReply& a, const KnownReply& b) { return a.score < b.score; });
  for (auto& pair : pairs) {
    if (!pair.record->once || pair.gaps.second.nash) continue;
    Gap gap = rounded_gap(best.score - pair.their_score, 0,
                          {{}, std::nullopt, "plays like " + best.name + ", who earns more against it", {}});
    gap.tried = fmt::format("the replies of {} strategies", known.size());
    pair.gaps.second.nash = std::move(gap);
  }
}

void add_own_beliefs(const ExaminationQuestion& question, std::vector<PairExamination>& pairs,
                     const Progress& progress) {
  std::vector<BeliefMatch> paths;
  std::vector<PairExamination*> searched;
  for (auto& pair : pairs)
    if (pair.record && pair.record->once && pair.belief) {
      paths.push_back(pair.record->matches.front());
      searched.push_back(&pair);
    }
  if (paths.empty()) return;
  OwnBeliefSearch search;
  search.payoffs = question.payoffs;
  search.threads = question.threads;
  search.depth = std::min<std::size_t>(question.depth, paths.front().size());
  const auto found = own_belief_gaps(question.policy, paths, search, progress);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) continue;
    searched[i]->gaps.first.self_confirming_own = gap_of_search(*found[i], *searched[i]->path, search.depth);
    searched[i]->own_search = found[i];
  }
}

void judge_record(const ExaminationQuestion& question, PairExamination& pair) {
  pair.verdicts = judge_all(pair.gaps, question.sides, question.epsilon_payoff);
  if (pair.belief)
    pair.verdicts[place_of(Notion::beliefs)] = judge_beliefs(*pair.belief, question.epsilon_belief, pair.record->once);
}

}  // namespace folk
