#include <folk/analysis/beliefs/planned_belief_gap.h>
#include <folk/analysis/equilibria/confidence_bound.h>
#include <folk/analysis/equilibria/continuation.h>
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

/// What somebody earns against the policy from the round on that is asked about, after what was played before it.
struct KnownReply {
  std::string name;
  std::vector<Outcome> before;
  double score;
};

std::vector<Outcome> first_rounds_of(const BeliefRecord& record, std::uint64_t rounds) {
  const BeliefMatch& match = record.matches.front();
  return {match.begin(), match.begin() + static_cast<std::ptrdiff_t>(rounds)};
}

/// The matches from a round on.
BeliefRecord record_from(BeliefRecord record, std::uint64_t from) {
  for (BeliefMatch& match : record.matches)
    match.erase(match.begin(), match.begin() + static_cast<std::ptrdiff_t>(from - 1));
  return record;
}

/// The whole matches, but without what was believed before a round.
BeliefRecord believed_from(BeliefRecord record, std::uint64_t from) {
  for (BeliefMatch& match : record.matches)
    for (std::size_t t = 0; t + 1 < from; ++t) match[t].belief.reset();
  return record;
}

/// What everybody earns who has one path with the policy.
std::vector<KnownReply> known_replies(const ExaminationQuestion& question, const std::vector<BeliefRecord>& records) {
  std::vector<KnownReply> known;
  for (const auto& record : records)
    if (record.once)
      known.push_back({record.opponent, first_rounds_of(record, question.from - 1),
                       match_scores(record_from(record, question.from), question.payoffs).theirs});
  return known;
}

Gap gap_of_search(const OwnBeliefGap& found, const PairExamination& pair, std::size_t depth, bool planned) {
  const std::size_t asked = pair.path->rounds.size();
  Gap gap = rounded_gap(found.gain, 0, {});
  gap.depth = depth;
  if (found.searched_rounds < asked)
    gap.tried = fmt::format("depth {}, {} of {} rounds", depth, found.searched_rounds, asked);
  if (found.gain <= 0) return gap;
  gap.witness.history = first_rounds_of(*pair.record, found.round - 1);
  gap.witness.deviation = found.own_moves.front();
  if (planned) {
    gap.witness.then =
        fmt::format("the best that it sees in {} rounds (worth {:.4g} on its beliefs, its own move {:.4g})", depth,
                    found.best_value, found.own_value);
    return gap;
  }
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

namespace {

/// From the first round on; not the beliefs.
PairExamination examine_whole_record(const ExaminationQuestion& question, const Strategy& opponent,
                                     const BeliefRecord& record, ClassReplies& beliefs, ClassReplies& their_beliefs) {
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
    found.gaps = match_gaps(path, prepared(question.policy), prepared(opponent), beliefs, their_beliefs);
    found.path = std::move(path);
  } else if (opponent.machine) {
    const BestReply& reply = prepared(opponent)->reply();
    Gap gap =
        rounded_gap(reply.payoff - scores.own, reply.residual + scores.error, {{}, std::nullopt, "best reply", {}});
    gap.tried = fmt::format("{} sampled matches", record.matches.size());
    found.gaps.first.nash = std::move(gap);
  }
  return found;
}

PairExamination examine_record_from(const ExaminationQuestion& question, const Strategy& opponent,
                                    const BeliefRecord& record) {
  const auto before = first_rounds_of(record, question.from - 1);
  const Continuation later(question, opponent, before);
  ClassReplies beliefs = class_replies(later.question);
  ClassReplies their_beliefs = class_replies(later.their_question());
  PairExamination found =
      examine_whole_record(later.question, later.opponent, record_from(record, question.from), beliefs, their_beliefs);
  put_before(before, found);
  return found;
}

}  // namespace

PairExamination examine_record(const ExaminationQuestion& question, const Strategy& opponent, BeliefRecord record,
                               ClassReplies& beliefs) {
  PairExamination found = question.from > 1 ? examine_record_from(question, opponent, record)
                                            : examine_whole_record(question, opponent, record, beliefs, beliefs);
  record = believed_from(std::move(record), question.from);
  auto belief = belief_consistency(record);
  if (belief.rounds > 0) found.belief = std::move(belief);
  found.record = std::move(record);
  return found;
}

std::vector<BeliefRecord> imitated_records(const ExaminationQuestion& question,
                                           const std::vector<BeliefRecord>& records) {
  const auto has_one_path = [](const BeliefRecord& record) { return record.once; };
  if (std::none_of(records.begin(), records.end(), has_one_path)) return {};
  std::vector<Strategy> others = question.imitated;
  std::erase_if(others, [&](const Strategy& strategy) {
    return std::any_of(records.begin(), records.end(),
                       [&](const BeliefRecord& record) { return record.once && record.opponent == strategy.name; });
  });
  return record_beliefs(question.policy, others, question.sampling());
}

void add_known_replies(const ExaminationQuestion& question, const std::vector<BeliefRecord>& records,
                       std::vector<PairExamination>& pairs) {
  const auto known = known_replies(question, records);
  for (auto& pair : pairs) {
    if (!pair.record->once || pair.gaps.second.nash) continue;
    const KnownReply* best = nullptr;
    std::size_t comparable = 0;  // what others earn after another beginning is no reply here
    for (const KnownReply& one : known) {
      if (one.before != pair.before) continue;
      ++comparable;
      if (best == nullptr || one.score > best->score) best = &one;
    }
    if (best == nullptr) continue;
    Gap gap = rounded_gap(best->score - pair.their_score, 0,
                          {{}, std::nullopt, "plays like " + best->name + ", who earns more against it", {}});
    gap.tried = fmt::format("the replies of {} strategies", comparable);
    pair.gaps.second.nash = std::move(gap);
  }
}

void add_known_replies(const ExaminationQuestion& question, std::vector<PairExamination>& pairs) {
  std::vector<BeliefRecord> records;
  for (const auto& pair : pairs) records.push_back(*pair.record);
  for (auto& record : imitated_records(question, records)) records.push_back(std::move(record));
  add_known_replies(question, records, pairs);
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
  const bool planned = question.policy.plans_ahead > 0;
  const std::size_t rounds = paths.front().size();
  const std::size_t depth = std::min<std::size_t>(question.belief_depth(), rounds);
  std::vector<std::uint64_t> asked;
  for (std::uint64_t t = question.from; question.from > 1 && t <= rounds; ++t) asked.push_back(t);
  const auto& payoffs = question.payoffs;
  const auto found =
      planned ? planned_belief_gaps(question.policy, paths, {payoffs, question.threads, depth, 0.01, asked}, progress)
              : own_belief_gaps(question.policy, paths, {payoffs, question.threads, depth, 1, 35'000, asked}, progress);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) continue;
    searched[i]->gaps.first.self_confirming_own = gap_of_search(*found[i], *searched[i], depth, planned);
    searched[i]->own_search = found[i];
  }
}

void judge_record(const ExaminationQuestion& question, PairExamination& pair) {
  pair.verdicts = judge_all(pair.gaps, question.sides, question.epsilon_payoff);
  if (pair.belief)
    pair.verdicts[place_of(Notion::beliefs)] = judge_beliefs(*pair.belief, question.epsilon_belief, pair.record->once);
}

}  // namespace folk
