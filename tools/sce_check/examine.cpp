// Answers the question of sce-check, opponent by opponent.

#include <folk/analysis/play/criterion_table.h>
#include <folk/games/outcome.h>
#include <folk/tools/sce_check/report.h>

#include <fmt/format.h>
#include <folk/analysis/play/joint_play.h>
#include <folk/analysis/play/pair_player.h>
#include <folk/analysis/replies/best_reply.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace folk::tools {
namespace {

using Stage = std::function<std::function<void(double)>(const std::string&)>;

/// Situations of machines that mix are listed up to this many.
constexpr std::size_t most_listed_states = 1000;

Sampling sampling_of(const SceQuestion& question) {
  return {{question.game.payoffs, question.criterion}, question.repetitions, question.seed, question.threads};
}

EquilibriumQuestion equilibrium_question(const SceQuestion& question) {
  return {question.game.payoffs, question.criterion, question.beliefs, question.horizon};
}

double payoff_of(const OutcomeWeights& weights, const Payoffs& payoffs, bool exchanged) {
  const auto numbers = payoffs.numbers();
  double sum = 0;
  for (const Outcome outcome : all_outcomes)
    sum += weights[outcome.index()] * numbers[(exchanged ? outcome.exchanged() : outcome).index()];
  return sum;
}

/// Every situation that two machines that mix come into with positive probability; the first of them are listed.
void list_states(const Machine& own, const Machine& theirs, const Criterion& criterion, OpponentReport& report) {
  const Automaton a = table_for(own, criterion, Sense::own_moves_its_own, 0);
  const Automaton b = table_for(theirs, criterion, Sense::own_moves_its_own, 0);
  const JointPlay play(a, b, Sense::own_moves_its_own);
  report.all_states = play.size();
  for (std::size_t s = 0; s < std::min(play.size(), most_listed_states); ++s)
    report.states.push_back({play.history_to(s), play.first_cooperation(s), play.second_cooperation(s)});
}

OpponentReport examine_machines(const SceQuestion& question, const Strategy& opponent, const EquilibriumQuestion& asked,
                                ClassReplies& beliefs) {
  const Machine& own = *question.policy.machine;
  const Machine& theirs = *opponent.machine;
  OpponentReport report;
  report.opponent = opponent.name;
  report.gaps = pair_gaps(own, theirs, asked, beliefs);
  const PairResult pair = play_pair(question.policy, opponent, sampling_of(question));
  report.own_score = payoff_of(pair.weights, question.game.payoffs, false);
  report.their_score = payoff_of(pair.weights, question.game.payoffs, true);
  report.method = pair.method;
  if (own.deterministic() && theirs.deterministic()) {
    report.path = play_path(own, theirs, question.criterion, question.horizon);
    if (own.finite() && theirs.finite()) {
      const auto first = tabulate(own, Sense::any_own_moves);
      const auto second = tabulate(theirs, Sense::any_own_moves);
      if (first && second)
        report.thresholds = thresholds(minimise(*first, Sense::any_own_moves), minimise(*second, Sense::any_own_moves),
                                       question.game.payoffs, question.sides);
    }
  } else {
    list_states(own, theirs, question.criterion, report);
  }
  return report;
}

/// Mean scores of both sides, and how far the first may lie from its expectation.
struct Scores {
  double own = 0;
  double theirs = 0;
  double error = 0;
};

/// Empirical Bernstein bound (Maurer & Pontil 2009) that fails once in a million times: standard errors alone are 0
/// where all samples happen to be equal. `range`: how far apart two scores can be.
double sampling_error(double variance, double range, double samples) {
  const double log = std::log(2 / 1e-6);
  return samples > 1 ? std::sqrt(2 * variance * log / samples) + 7 * range * log / (3 * (samples - 1)) : range;
}

Scores scores_of(const BeliefRecord& record, const Payoffs& payoffs) {
  const auto numbers = payoffs.numbers();
  Scores scores;
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
  scores.error = sampling_error(variance, (*most - *least) * static_cast<double>(record.matches.front().size()), n);
  return scores;
}

/// What a path that was played says, and what must be sampled else.
OpponentReport examine_record(const SceQuestion& question, const Strategy& opponent, BeliefRecord record,
                              const EquilibriumQuestion& asked, ClassReplies& beliefs) {
  OpponentReport report;
  report.opponent = opponent.name;
  const Scores scores = scores_of(record, question.game.payoffs);
  report.own_score = scores.own;
  report.their_score = scores.theirs;
  report.method = record.once ? Method::played : Method::sampled;
  if (record.once) {
    PlayPath path;
    for (const auto& round : record.matches.front()) path.rounds.push_back({round.own, round.theirs});
    report.gaps = match_gaps(path, question.policy.machine.get(), opponent.machine.get(), asked, beliefs);
    report.path = std::move(path);
  } else if (opponent.machine) {
    const BestReply reply = best_reply(*opponent.machine, {question.game.payoffs, question.criterion});
    Gap gap =
        rounded_gap(reply.payoff - scores.own, reply.residual + scores.error, {{}, std::nullopt, "best reply", {}});
    gap.tried = fmt::format("{} sampled matches", record.matches.size());
    report.gaps.first.nash = std::move(gap);
  }
  auto belief = belief_consistency(record);
  if (belief.rounds > 0) report.belief = std::move(belief);
  report.record = std::move(record);
  return report;
}

/// Nobody can enumerate the policy, but what others earn against it is known: a reply that each could copy. The
/// classics are asked too.
void add_known_replies(const SceQuestion& question, std::vector<OpponentReport>& reports) {
  struct Known {
    std::string name;
    double score;
  };
  std::vector<Known> known;
  for (const auto& report : reports)
    if (report.record->once) known.push_back({report.opponent, report.their_score});
  if (known.empty()) return;
  std::vector<Strategy> others = Registry::standard().roster("classics", question.game.payoffs);
  std::erase_if(others, [&](const Strategy& strategy) {
    return std::any_of(known.begin(), known.end(), [&](const Known& one) { return one.name == strategy.name; });
  });
  for (const auto& record : record_beliefs(question.policy, others, sampling_of(question)))
    if (record.once) known.push_back({record.opponent, scores_of(record, question.game.payoffs).theirs});
  const Known& best =
      *std::max_element(known.begin(), known.end(), [](const Known& a, const Known& b) { return a.score < b.score; });
  for (auto& report : reports) {
    if (!report.record->once || report.gaps.second.nash) continue;
    Gap gap = rounded_gap(best.score - report.their_score, 0,
                          {{}, std::nullopt, "plays like " + best.name + ", who earns more against it", {}});
    gap.tried = fmt::format("the replies of {} strategies", known.size());
    report.gaps.second.nash = std::move(gap);
  }
}

/// Notion (c), for all opponents with one path.
void add_own_search(const SceQuestion& question, std::vector<OpponentReport>& reports, const Stage& stage) {
  std::vector<BeliefMatch> paths;
  std::vector<OpponentReport*> searched;
  for (auto& report : reports)
    if (report.record && report.record->once && report.belief) {
      paths.push_back(report.record->matches.front());
      searched.push_back(&report);
    }
  if (paths.empty()) return;
  OwnBeliefSearch search;
  search.payoffs = question.game.payoffs;
  search.threads = question.threads;
  search.depth = std::min<std::size_t>(question.depth, paths.front().size());
  auto found = own_belief_gaps(question.policy, paths, search, stage("searching on its own beliefs"));
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) continue;
    const OwnBeliefGap& own = *found[i];
    Gap gap = rounded_gap(own.gain, 0, {});
    if (own.gain > 0) {
      const auto& rounds = searched[i]->path->rounds;
      gap.witness.history.assign(rounds.begin(), rounds.begin() + static_cast<std::ptrdiff_t>(own.round - 1));
      gap.witness.deviation = own.own_moves.front();
      std::string moves;
      std::string believed;
      for (const Move move : own.own_moves) moves += to_char(move);
      for (const Move move : own.believed) believed += to_char(move);
      gap.witness.then = fmt::format("plays on as it does ({} against the {} it expects)", moves, believed);
    }
    gap.depth = search.depth;
    if (own.searched_rounds < paths[i].size())
      gap.tried = fmt::format("depth {}, {} of {} rounds", search.depth, own.searched_rounds, paths[i].size());
    searched[i]->gaps.first.self_confirming_own = std::move(gap);
    searched[i]->own_search = own;
  }
}

void add_belief_effects(const SceQuestion& question, std::vector<OpponentReport>& reports) {
  if (!question.mind || !question.mind->believes()) return;
  const auto& training = question.mind->policy.training;
  // The intervention is made in the matches that the policy was trained for.
  if (!(question.criterion == Criterion::finite(training.rounds)) || !(question.game.payoffs == training.payoffs))
    return;
  const auto effects = sct::belief_effects(question.mind, question.opponents, question.threads);
  for (std::size_t i = 0; i < reports.size(); ++i) reports[i].effect = effects[i];
}

void judge_all(const SceQuestion& question, OpponentReport& report) {
  for (const Notion notion : all_notions)
    report.verdicts[static_cast<std::size_t>(notion)] =
        notion == Notion::beliefs
            ? (report.belief ? judge_beliefs(*report.belief, question.epsilon_belief, report.record->once)
                             : std::nullopt)
            : judge(report.gaps, notion, question.sides, question.epsilon_payoff);
}

/// Worse comes later.
int badness(const Certificate& certificate) {
  return certificate.verdict == Verdict::certified ? 0 : certificate.verdict == Verdict::not_refuted ? 1 : 2;
}

void sum_up(SceReport& report) {
  for (const auto& opponent : report.opponents) {
    if (opponent.belief) report.belief = report.belief ? * report.belief += *opponent.belief : *opponent.belief;
    if (opponent.effect) report.effect = report.effect ? * report.effect += *opponent.effect : *opponent.effect;
  }
  for (std::size_t n = 0; n < all_notions.size(); ++n) {
    std::size_t undecided = 0;
    for (const auto& opponent : report.opponents) {
      const auto& verdict = opponent.verdicts[n];
      if (!verdict) {
        ++undecided;
        continue;
      }
      auto& worst = report.verdicts[n];
      const bool worse = !worst || badness(*verdict) > badness(*worst) ||
                         (badness(*verdict) == badness(*worst) && verdict->margin > worst->margin);
      if (!worse) continue;
      worst = verdict;
      report.worst[n] = opponent.opponent;
    }
    if (report.verdicts[n] && report.verdicts[n]->verdict == Verdict::certified && undecided > 0) {
      report.verdicts[n]->verdict = Verdict::not_refuted;
      report.verdicts[n]->scope = fmt::format("undecided for {} opponents", undecided);
    }
  }
}

ExtractedMachine extract(const SceQuestion& question, const std::vector<OpponentReport>& reports, const Stage& stage) {
  std::vector<BeliefRecord> records;
  for (const auto& report : reports) records.push_back(*report.record);
  ExtractionOptions options;
  options.payoffs = question.game.payoffs;
  options.threads = question.threads;
  options.depth = static_cast<unsigned>(std::min<std::uint64_t>(options.depth, question.criterion.rounds() - 1));
  ExtractedMachine extracted;
  extracted.tried =
      extract_machines(question.policy, question.opponents, records, options, stage("extracting an automaton"));
  const auto chosen = readable_machine(extracted.tried);
  // None is small: the smallest is shown.
  const auto smaller = [](const Extraction& a, const Extraction& b) { return a.machine.size() < b.machine.size(); };
  extracted.chosen =
      chosen ? *chosen
             : static_cast<std::size_t>(std::min_element(extracted.tried.begin(), extracted.tried.end(), smaller) -
                                        extracted.tried.begin());
  extracted.unseen_name = "memory(1,1)";
  const auto unseen = Registry::standard().roster(extracted.unseen_name, question.game.payoffs);
  const auto unseen_records =
      record_beliefs(question.policy, unseen, sampling_of(question), stage("testing it on unseen opponents"));
  extracted.unseen = fidelity(extracted.tried[extracted.chosen].machine, unseen, unseen_records, question.game.payoffs);
  return extracted;
}

/// Names the pair in what the library refuses.
template <class Work>
auto against(const SceQuestion& question, const Strategy& opponent, Work work) {
  try {
    return work();
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{} against {}: {}", question.policy.name, opponent.name, error.what()));
  }
}

}  // namespace

SceReport examine(const SceQuestion& question, const Stage& stage) {
  SceReport report;
  const EquilibriumQuestion asked = equilibrium_question(question);
  ClassReplies beliefs = class_replies(asked);
  if (question.policy.machine) {
    const auto progress = stage("checking pairs");
    for (std::size_t i = 0; i < question.opponents.size(); ++i) {
      const Strategy& opponent = question.opponents[i];
      report.opponents.push_back(against(question, opponent, [&] {
        if (opponent.machine) return examine_machines(question, opponent, asked, beliefs);
        auto records = record_beliefs(question.policy, {opponent}, sampling_of(question));
        return examine_record(question, opponent, std::move(records.front()), asked, beliefs);
      }));
      progress(static_cast<double>(i + 1) / static_cast<double>(question.opponents.size()));
    }
  } else {
    auto records = record_beliefs(question.policy, question.opponents, sampling_of(question), stage("playing"));
    for (std::size_t i = 0; i < records.size(); ++i)
      report.opponents.push_back(against(question, question.opponents[i], [&] {
        return examine_record(question, question.opponents[i], std::move(records[i]), asked, beliefs);
      }));
    add_known_replies(question, report.opponents);
    add_own_search(question, report.opponents, stage);
    add_belief_effects(question, report.opponents);
  }
  for (auto& opponent : report.opponents) judge_all(question, opponent);
  sum_up(report);
  if (question.extract) report.extracted = extract(question, report.opponents, stage);
  return report;
}

bool holds(const SceReport& report, const std::string& required) {
  const Notion notion = required == "nash"              ? Notion::nash
                        : required == "subgame-perfect" ? Notion::subgame_perfect
                        : required == "beliefs"         ? Notion::beliefs
                                                        : Notion::self_confirming_unrestricted;
  const auto& verdict = report.verdicts[static_cast<std::size_t>(notion)];
  if (!verdict) throw UsageError(fmt::format("--require {}: it does not apply here, nothing is known of it", required));
  return verdict->verdict != Verdict::refuted;
}

}  // namespace folk::tools
