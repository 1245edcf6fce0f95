#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/equilibria/continuation.h>
#include <folk/analysis/equilibria/examination.h>
#include <folk/analysis/equilibria/played_examination.h>
#include <folk/analysis/equilibria/prepared_pair.h>
#include <folk/analysis/equilibria/settlement.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace folk {
namespace {

/// The verdicts of a pair, told backwards from the last round: each notion counts until it is refuted.
class BackwardScan {
public:
  explicit BackwardScan(std::uint64_t last)
      : last_(last) {}

  bool open() const { return std::find(open_.begin(), open_.end(), true) != open_.end(); }

  void tell(std::uint64_t round, const Certificates& verdicts) {
    for (std::size_t n = 0; n < open_.size(); ++n) {
      if (!open_[n]) continue;
      const auto& verdict = verdicts[n];
      if (verdict && round == last_) found_[n] = Settled{std::nullopt, verdict->verdict};
      open_[n] = verdict && verdict->verdict != Verdict::refuted;
      if (!open_[n]) continue;
      found_[n]->from = round;
      if (verdict->verdict == Verdict::not_refuted) found_[n]->verdict = Verdict::not_refuted;
    }
  }

  SettledNotions found() const { return found_; }

private:
  std::uint64_t last_;
  SettledNotions found_{};
  std::array<bool, all_notions.size()> open_{true, true, true, true, true, true};
};

ExaminationQuestion from_round(ExaminationQuestion question, std::uint64_t round) {
  question.from = round;
  return question;
}

// ---- two machines ----

/// The first round from which on nothing new comes, neither of the pair nor of the class that is told the play.
std::uint64_t last_new_round(const ExaminationQuestion& question, const Strategy& opponent) {
  const Machine& own = *question.policy.machine;
  const Machine& theirs = *opponent.machine;
  for (const Machine* machine : {&own, &theirs})
    if (!machine->finite())
      throw UsageError(fmt::format("a machine without end may settle after any round: take finite:T, not {}",
                                   question.criterion.to_string()));
  // Where everybody stands: the pair, and each of the class in either seat.
  std::vector<State> states{own.start(), theirs.start()};
  for (const Strategy& member : question.beliefs) states.insert(states.end(), 2, member.machine->start());
  std::set<std::vector<State>> seen;
  while (seen.insert(states).second) {
    if (seen.size() > most_settling_rounds)
      throw UsageError(
          fmt::format("the pair and the class of beliefs do not repeat within {} rounds: take a smaller "
                      "--class, or finite:T",
                      most_settling_rounds));
    const Outcome round{move_of(own, states[0]), move_of(theirs, states[1])};
    states[0] = own.next(states[0], round.own, round.theirs);
    states[1] = theirs.next(states[1], round.theirs, round.own);
    for (std::size_t i = 2; i < states.size(); i += 2) {
      const Machine& member = *question.beliefs[i / 2 - 1].machine;
      states[i] = member.next(states[i], round.own, round.theirs);
      states[i + 1] = member.next(states[i + 1], round.theirs, round.own);
    }
  }
  return seen.size();
}

Certificates judge_continuation(const ExaminationQuestion& question, const Strategy& opponent,
                                const std::vector<Outcome>& before) {
  const Continuation later(question, opponent, before);
  ClassReplies beliefs = class_replies(later.question);
  ClassReplies their_beliefs = class_replies(later.their_question());
  const PreparedPair pair(beliefs.machines().of(later.question.policy.machine),
                          beliefs.machines().of(later.opponent.machine), question.horizon);
  return judge_all(pair_gaps(pair, beliefs, their_beliefs), question.sides, question.epsilon_payoff);
}

SettledNotions settle_machines(const ExaminationQuestion& question, const Strategy& opponent,
                               const Progress& progress) {
  const std::uint64_t last =
      question.criterion.is_finite() ? question.criterion.rounds() : last_new_round(question, opponent);
  const auto path = first_rounds_of(*question.policy.machine, *opponent.machine, last);
  BackwardScan scan(last);
  for (std::uint64_t round = last; round > 0 && scan.open(); --round) {
    progress(static_cast<double>(last - round) / static_cast<double>(last));
    scan.tell(round, judge_continuation(question, opponent,
                                        {path.begin(), path.begin() + static_cast<std::ptrdiff_t>(round - 1)}));
  }
  return scan.found();
}

// ---- what is played ----

/// Beliefs are true from the round on that follows the last one that is too far from the truth.
std::optional<Settled> settled_beliefs(const BeliefMatch& match, double epsilon) {
  std::optional<Settled> settled;
  std::uint64_t from = 1;
  for (std::uint64_t t = 0; t < match.size(); ++t) {
    if (!match[t].belief) continue;
    settled = Settled{1, Verdict::certified};
    if (std::abs(*match[t].belief - match[t].truth) > epsilon) from = t + 2;
  }
  if (!settled) return std::nullopt;
  return from > match.size() ? Settled{} : Settled{from, Verdict::certified};
}

/// The least round from which on the search on own beliefs finds nothing.
std::optional<Settled> settled_own_beliefs(const ExaminationQuestion& question, PairExamination pair,
                                           std::uint64_t last) {
  std::uint64_t low = 1;
  std::uint64_t high = last + 1;  // from there on nothing is left to find
  // The last round first: where it is refuted nothing settles, and little is searched.
  for (std::uint64_t round = last; low < high; round = low + (high - low) / 2) {
    std::vector<PairExamination> one{pair};
    add_own_beliefs(from_round(question, round), one);
    const auto& gap = one.front().gaps.first.self_confirming_own;
    if (!gap) return std::nullopt;
    if (gap->gain <= to_double(question.epsilon_payoff))
      high = round;
    else
      low = std::max(round, one.front().own_search->round) + 1;  // it refutes all rounds up to its own
  }
  return low > last ? Settled{} : Settled{low, Verdict::not_refuted};
}

/// The rounds after the last one in which another move is worth more on a planner's own beliefs.
std::vector<std::optional<Settled>> settled_plans(const ExaminationQuestion& question,
                                                  std::vector<PairExamination> pairs, const Progress& progress) {
  add_own_beliefs(from_round(question, 1), pairs, progress);
  std::vector<std::optional<Settled>> settled(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!pairs[i].own_search) continue;
    const auto& gains = pairs[i].own_search->gains;
    const auto gainful = [&](double gain) { return gain > to_double(question.epsilon_payoff); };
    const auto last = std::find_if(gains.rbegin(), gains.rend(), gainful);
    const auto before = static_cast<std::uint64_t>(gains.rend() - last);
    settled[i] = before == gains.size() ? Settled{} : Settled{before + 1, Verdict::not_refuted};
  }
  return settled;
}

std::vector<SettledNotions> settle_records(const ExaminationQuestion& question, const Progress& progress) {
  const auto records = record_beliefs(question.policy, question.opponents, question.sampling());
  auto known = records;
  if (!question.policy.machine)
    for (auto& record : imitated_records(question, records)) known.push_back(std::move(record));
  ClassReplies unused = class_replies(question);
  const std::uint64_t last = question.criterion.rounds();
  const bool plans = question.policy.plans_ahead > 0;
  const Progress scanning = progress.part(0, plans ? 0.5 : 1);
  std::vector<SettledNotions> found;
  std::vector<PairExamination> from_the_first;
  for (std::size_t i = 0; i < records.size(); ++i) {
    scanning(static_cast<double>(i) / static_cast<double>(records.size()));
    BackwardScan scan(last);
    const Strategy& opponent = question.opponents[i];
    for (std::uint64_t round = last; round > 0 && scan.open(); --round) {
      const auto later = from_round(question, round);
      std::vector<PairExamination> pair{examine_record(later, opponent, records[i], unused)};
      if (!question.policy.machine) add_known_replies(later, known, pair);
      scan.tell(round, judge_all(pair.front().gaps, question.sides, question.epsilon_payoff));
    }
    found.push_back(scan.found());
    const BeliefMatch& match = records[i].matches.front();
    found.back()[place_of(Notion::beliefs)] = settled_beliefs(match, question.epsilon_belief);
    from_the_first.push_back(examine_record(from_round(question, 1), opponent, records[i], unused));
    if (found.back()[place_of(Notion::beliefs)] && !question.policy.machine && !plans)
      found.back()[place_of(Notion::self_confirming_own)] = settled_own_beliefs(question, from_the_first.back(), last);
  }
  if (!plans) return found;
  const auto own = settled_plans(question, from_the_first, progress.part(0.5, 1));
  for (std::size_t i = 0; i < found.size(); ++i) found[i][place_of(Notion::self_confirming_own)] = own[i];
  return found;
}

/// For all of them: the latest, and the worst word.
std::optional<Settled> settled_for_all(const std::vector<SettledNotions>& pairs, std::size_t notion) {
  std::optional<Settled> all;
  for (const auto& pair : pairs) {
    const auto& one = pair[notion];
    if (!one) continue;
    if (!all) {
      all = one;
      continue;
    }
    all->from = all->from && one->from ? std::optional(std::max(*all->from, *one->from)) : std::nullopt;
    if (!all->from)
      all->verdict = Verdict::refuted;
    else if (one->verdict == Verdict::not_refuted)
      all->verdict = Verdict::not_refuted;
  }
  return all;
}

}  // namespace

void check_settlement(const ExaminationQuestion& question) {
  check_noise(question);
  check_one_path(question);
  if (question.criterion.is_finite() && question.criterion.rounds() > most_settling_rounds)
    throw UsageError(fmt::format("{} has more rounds than the {} that can be looked through: ask from one round on",
                                 question.criterion.to_string(), most_settling_rounds));
}

Settlement settlement(ExaminationQuestion question, const Stages& stages) {
  check_settlement(question);
  if (!question.criterion.is_finite())
    std::erase_if(question.beliefs, [](const Strategy& member) { return !member.machine->finite(); });
  Settlement found;
  found.pairs.resize(question.opponents.size());
  ExaminationQuestion played = question;
  played.opponents.clear();
  std::vector<SettledNotions*> of_played;
  const Progress progress = begin_stage(stages, "asking from every round on");
  const double share = 1 / static_cast<double>(question.opponents.size());
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    const Strategy& opponent = question.opponents[i];
    if (question.policy.machine && opponent.machine) {
      const double done = static_cast<double>(i) * share;
      found.pairs[i] = settle_machines(question, opponent, progress.part(done, done + share));
    } else {
      played.opponents.push_back(opponent);
      of_played.push_back(&found.pairs[i]);
    }
  }
  if (!of_played.empty()) {
    const auto settled = settle_records(played, progress);
    for (std::size_t i = 0; i < settled.size(); ++i) *of_played[i] = settled[i];
  }
  for (std::size_t n = 0; n < all_notions.size(); ++n) found.all[n] = settled_for_all(found.pairs, n);
  return found;
}

}  // namespace folk
