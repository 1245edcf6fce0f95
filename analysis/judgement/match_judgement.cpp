#include <folk/analysis/equilibria/self_confirming_gap.h>
#include <folk/analysis/judgement/match_judgement.h>
#include <folk/analysis/judgement/own_judgement.h>
#include <folk/analysis/play/criterion_table.h>
#include <folk/analysis/play/parallel.h>
#include <folk/analysis/play/play_path.h>
#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/games/error.h>

#include <array>
#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace folk {
namespace {

/// A best reply that is asked for: to a behaviour, over so many rounds, its moves slipping at this rate.
using ReplyQuestion = std::tuple<std::size_t, std::uint64_t, double>;

std::array<Rational, 2> totals_of(const BeliefMatch& match, const Payoffs& payoffs) {
  std::array<std::int64_t, 4> counts{};
  for (const Outcome& round : match) ++counts[round.index()];
  std::array<Rational, 2> totals;
  const auto by_outcome = payoffs.by_outcome();
  for (const Outcome outcome : all_outcomes) {
    const Rational count(counts[outcome.index()]);
    totals[0] += count * by_outcome[outcome.index()];
    totals[1] += count * by_outcome[outcome.exchanged().index()];
  }
  return totals;
}

Gap gap_of_free_beliefs(const BeliefMatch& match, const Payoffs& payoffs) {
  const PlayPath path{{match.begin(), match.end()}, std::nullopt, false};
  return unrestricted_gap(path, payoffs, Criterion::finite(match.size()));
}

/// Judges one match, but for what best replies would have earned.
MatchJudgement judge(const Candidates& opponents, const RecordedMatch& match, const std::vector<double>& slips,
                     const Payoffs& payoffs) {
  MatchJudgement judgement;
  judgement.name = match.name;
  judgement.rounds = match.rounds.size();
  const auto totals = totals_of(match.rounds, payoffs);
  judgement.own_total = totals[0];
  judgement.their_total = totals[1];
  const std::span<const RecordedMatch> alone(&match, 1);
  std::vector<Agreement> agreements;
  for (std::size_t b = 0; b < opponents.behaviours.size(); ++b) {
    agreements.push_back(agreement_with(opponents.behaviours[b].first(), alone, Seat::second, payoffs));
    if (agreements.back().consistent()) judgement.consistent.push_back({b, agreements.back().certain()});
  }
  std::vector<ClassAgreement> class_agreements;
  for (const auto& [members, weight] : opponents.classes) {
    class_agreements.emplace_back(members, alone, Seat::second);
    judgement.consistent_members.push_back(class_agreements.back().consistent());
  }
  const SlipPosterior posterior = posterior_of(opponents, agreements, class_agreements, slips);
  if (posterior.possible()) {
    const std::size_t likeliest = posterior.likeliest();
    judgement.likeliest = {likeliest, posterior.candidates[likeliest], slips[posterior.likeliest_slip[likeliest]]};
  }
  judgement.free_beliefs = gap_of_free_beliefs(match.rounds, payoffs);
  for (const BeliefRound& round : match.rounds) {
    if (!round.belief) continue;
    ++judgement.stated;
    if (likelier_move(*round.belief) == round.theirs) ++judgement.right;
  }
  return judgement;
}

/// The questions about a match, in the order of those whom they are about: the consistent ones, else the likeliest.
std::vector<ReplyQuestion> questions_of(const Candidates& opponents, const MatchJudgement& match) {
  std::vector<ReplyQuestion> questions;
  for (const auto& opponent : match.consistent) questions.emplace_back(opponent.behaviour, match.rounds, 0.0);
  if (questions.empty() && match.likeliest && match.likeliest->candidate < opponents.behaviours.size())
    questions.emplace_back(match.likeliest->candidate, match.rounds, match.likeliest->slip);
  return questions;
}

std::optional<Regret> regret_of(const std::optional<BestTotal>& best, const Rational& earned) {
  if (!best) return std::nullopt;
  Regret regret{best->payoff, best->payoff - to_double(earned)};
  if (best->exact) {
    regret.exact = *best->exact - earned;
    regret.regret = to_double(*regret.exact);
  }
  return regret;
}

/// The least gain of a best reply over the opponents that could have played nothing else.
std::optional<Gap> gap_of_class_beliefs(const Candidates& opponents, const MatchJudgement& match) {
  std::optional<Gap> least;
  for (const auto& opponent : match.consistent) {
    if (!opponent.certain || !opponent.regret) continue;
    Witness witness;
    witness.then = "best reply";
    witness.belief = opponents.behaviours[opponent.behaviour].first().name;
    Gap gap = opponent.regret->exact ? exact_gap(*opponent.regret->exact, std::move(witness))
                                     : rounded_gap(opponent.regret->regret, 0, std::move(witness));
    if (!least || gap.gain < least->gain) least = std::move(gap);
  }
  return least;
}

}  // namespace

BestTotal best_total(const Machine& opponent, const Payoffs& payoffs, std::uint64_t rounds, double slip) {
  if (slip == 0) {
    const FiniteBestReply reply(opponent, payoffs, rounds);
    return {reply.optimum(), reply.exact_optimum()};
  }
  const Automaton table = table_for(opponent, Criterion::finite(rounds), Sense::any_own_moves, 0);
  ReplyProblem problem = reply_problem(table, payoffs, slip);
  problem.noise = 0;
  if (problem.outside) problem.outside->payoff = 0;  // never played: the match is over
  return {FiniteBestReply(std::move(problem), rounds).optimum(), std::nullopt};
}

std::vector<MatchJudgement> judge_matches(const Candidates& opponents, const std::vector<RecordedMatch>& matches,
                                          const std::vector<double>& slips, const Payoffs& payoffs, unsigned threads,
                                          const Progress& progress) {
  check_slips(slips);
  std::vector<MatchJudgement> judgements(matches.size());
  parallel_for(
      matches.size(), threads,
      [&](std::size_t m, unsigned) { judgements[m] = judge(opponents, matches[m], slips, payoffs); },
      progress.part(0, 0.5));

  // Matches of one length share their best replies.
  std::map<ReplyQuestion, std::optional<BestTotal>> answers;
  for (const auto& judgement : judgements)
    for (const auto& question : questions_of(opponents, judgement)) answers.try_emplace(question);
  std::vector<decltype(answers)::value_type*> open;
  for (auto& entry : answers)
    if (opponents.behaviours[std::get<0>(entry.first)].first().machine) open.push_back(&entry);
  parallel_for(
      open.size(), threads,
      [&](std::size_t i, unsigned) {
        const auto& [behaviour, rounds, slip] = open[i]->first;
        try {
          open[i]->second = best_total(*opponents.behaviours[behaviour].first().machine, payoffs, rounds, slip);
        } catch (const UsageError&) {
          // Too many states or rounds: this one's regret stays unknown.
        }
      },
      progress.part(0.5, 1));

  for (auto& judgement : judgements) {
    for (auto& opponent : judgement.consistent)
      opponent.regret = regret_of(answers.at({opponent.behaviour, judgement.rounds, 0.0}), judgement.own_total);
    if (judgement.consistent.empty())
      for (const auto& question : questions_of(opponents, judgement))
        judgement.likeliest->regret = regret_of(answers.at(question), judgement.own_total);
    judgement.class_beliefs = gap_of_class_beliefs(opponents, judgement);
  }
  return judgements;
}

}  // namespace folk
