#include <folk/tools/ipd_judge/words.h>

#include <folk/tools/program/number_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <folk/games/rational.h>

#include <algorithm>
#include <cmath>

namespace folk::tools {
namespace {

/// Names of opponents that are shown in a row.
constexpr std::size_t most_named = 3;

/// What differs by less is the same but for rounding.
constexpr double as_likely = 1 - 1e-9;

/// The regrets of a match: to each opponent that agrees, else to the likeliest.
std::vector<const Regret*> regrets_of(const MatchJudgement& match) {
  std::vector<const Regret*> regrets;
  for (const auto& opponent : match.consistent)
    if (opponent.regret) regrets.push_back(&*opponent.regret);
  if (match.consistent.empty() && match.likeliest && match.likeliest->regret)
    regrets.push_back(&*match.likeliest->regret);
  return regrets;
}

}  // namespace

std::string counted(std::uint64_t number, const std::string& one, const std::string& several) {
  return fmt::format("{} {}", number, number == 1 ? one : several);
}

std::string prior_words(const JudgeQuestion& question) {
  return fmt::format("{}, each of the {} slip rates is as likely as another",
                     question.weighted ? "strategies weigh what their SPEC says (1 where it says nothing)"
                                       : "every strategy, each member of a class too, weighs 1",
                     question.slips.size());
}

std::string slip_words(const JudgeQuestion& question, const Judgement& found) {
  constexpr double worth_a_word = 0.01;
  const auto& posterior = found.own.posterior.slips;
  std::string text;
  for (std::size_t s = 0; s < posterior.size(); ++s)
    if (posterior[s] >= worth_a_word)
      text += fmt::format("{}{} ({:.0f} %)", text.empty() ? "" : ", ", to_short_text(question.slips[s]),
                          100 * posterior[s]);
  return text.empty() ? "none makes this play possible" : text;
}

std::string name_of(const Candidates& candidates, std::size_t candidate) {
  const std::size_t behaviours = candidates.behaviours.size();
  return candidate < behaviours ? candidates.behaviours[candidate].names()
                                : candidates.classes[candidate - behaviours].members.name();
}

std::string members_text(const Integer& members) {
  unsigned power = 0;
  while (pow(Integer(2), power) < members) ++power;
  return power > 30 && pow(Integer(2), power) == members ? fmt::format("2^{}", power) : members.str();
}

std::string place_text(const std::vector<MatchJudgement>& matches, const std::optional<RecordedPlace>& place) {
  return place ? fmt::format("match {}, round {}", matches[place->match].name, place->round + 1) : "-";
}

std::string class_words(const ClassAgreement& agreement) {
  const auto& members = agreement.members();
  const std::string asked = fmt::format("{} of {} genes were asked for", agreement.asked(), members.genes());
  if (agreement.fewest_slips() == 0)
    return fmt::format("{} of {} members agree with every move: {}, {}", members_text(agreement.consistent()),
                       members.size_text(), asked, agreement.nearest_text());
  return fmt::format("none of {} members agrees: {}; nearest, by {}: {}, {}", members.size_text(), asked,
                     counted(agreement.fewest_slips(), "slip", "slips"), members_text(agreement.nearest()),
                     agreement.nearest_text());
}

std::vector<std::string> names_that_agree(const Judgement& found) {
  std::vector<std::string> names;
  for (const std::size_t behaviour : found.own.consistent())
    for (const auto& strategy : found.players.behaviours[behaviour].strategies) names.push_back(strategy.name);
  return names;
}

std::string agreement_words(const Judgement& found, std::size_t most) {
  const auto names = names_that_agree(found);
  if (names.empty()) return "no strategy agrees with every move";
  const auto shown = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), most));
  return fmt::format("{} with every move: {}{}", counted(names.size(), "strategy agrees", "strategies agree"),
                     fmt::join(names.begin(), shown, ", "),
                     names.size() > most ? fmt::format(" and {} more", names.size() - most) : "");
}

std::string met_words(const Judgement& found, const MatchJudgement& match) {
  std::string text;
  for (std::size_t i = 0; i < std::min(match.consistent.size(), most_named); ++i)
    text += (i == 0 ? "" : ", ") + found.opponents.behaviours[match.consistent[i].behaviour].first().name;
  if (match.consistent.size() > most_named) text += fmt::format(" and {} more", match.consistent.size() - most_named);
  for (std::size_t c = 0; c < match.consistent_members.size(); ++c)
    if (!match.consistent_members[c].is_zero())
      text += fmt::format("{}{} of {}", text.empty() ? "" : "; ", members_text(match.consistent_members[c]),
                          found.opponents.classes[c].members.name());
  return text.empty() ? "-" : text;
}

std::string likeliest_words(const Judgement& found, const MatchJudgement& match) {
  if (!match.likeliest) return "-";
  const auto& [candidate, probability, slip, regret] = *match.likeliest;
  const std::size_t behaviours = found.opponents.behaviours.size();
  return fmt::format("{} ({:.2f} %, slip {})",
                     candidate < behaviours ? found.opponents.behaviours[candidate].first().name
                                            : found.opponents.classes[candidate - behaviours].members.name(),
                     100 * probability, to_short_text(slip));
}

std::string regret_text(const MatchJudgement& match) {
  const auto regrets = regrets_of(match);
  if (regrets.empty()) return "-";
  const auto less = [](const Regret* a, const Regret* b) { return a->regret < b->regret; };
  const auto [least, largest] = std::minmax_element(regrets.begin(), regrets.end(), less);
  const auto text = [](const Regret* regret) { return (regret->exact ? "" : "about ") + payoff_text(regret->regret); };
  return (*least)->regret == (*largest)->regret ? text(*least) : text(*least) + " to " + text(*largest);
}

RegretSum regret_sum(const Judgement& found) {
  RegretSum sum;
  for (const auto& match : found.matches) {
    const auto regrets = regrets_of(match);
    if (regrets.empty()) continue;
    const auto less = [](const Regret* a, const Regret* b) { return a->regret < b->regret; };
    const auto [least, largest] = std::minmax_element(regrets.begin(), regrets.end(), less);
    sum.least += (*least)->regret;
    sum.largest += (*largest)->regret;
    ++sum.matches;
  }
  return sum;
}

std::string regret_words(const Judgement& found) {
  const RegretSum sum = regret_sum(found);
  if (sum.matches == 0) return "not known, as nobody is that could have been met";
  const std::string amount =
      sum.least == sum.largest ? payoff_text(sum.least) : payoff_text(sum.least) + " to " + payoff_text(sum.largest);
  return fmt::format("{} over {} of {}", amount, sum.matches, counted(found.matches.size(), "match", "matches"));
}

std::string belief_words(const BeliefConsistency& beliefs) {
  return fmt::format("{} of {} right ({}), log loss {}, Brier score {}, {}", beliefs.right,
                     counted(beliefs.rounds, "round", "rounds"), share_text(beliefs.accuracy()),
                     measure_text(beliefs.log_loss()), measure_text(beliefs.brier()),
                     counted(beliefs.surprises, "surprise", "surprises"));
}

std::string stage_words(const StageReplies& stage) {
  return fmt::format("{} of {} best replies to the belief of their round, {} lost by the others", stage.best,
                     stage.rounds, payoff_text(stage.loss_sum));
}

std::string bin_text(std::size_t bin) { return fmt::format("{} to {} %", 10 * bin, 10 * bin + 10); }

std::vector<CandidateRow> candidate_rows(const JudgeQuestion& question, const Judgement& found) {
  const auto& posterior = found.own.posterior;
  const auto weights = found.players.weights();
  const std::size_t behaviours = found.players.behaviours.size();
  std::vector<CandidateRow> rows;
  for (const std::size_t candidate : found.own.ranking()) {
    CandidateRow row{candidate,
                     rows.size() + 1,
                     name_of(found.players, candidate),
                     weights[candidate],
                     posterior.candidates[candidate],
                     question.slips[posterior.likeliest_slip[candidate]],
                     0,
                     "-"};
    if (!rows.empty() && row.posterior >= rows.back().posterior * as_likely) row.rank = rows.back().rank;
    if (candidate < behaviours) {
      const Agreement& agreement = found.own.agreements[candidate];
      row.otherwise = agreement.impossible();
      row.first_otherwise = place_text(found.matches, agreement.first_impossible());
    } else {
      row.otherwise = found.own.class_agreements[candidate - behaviours].fewest_slips();
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Need> needs_of(const Judgement& found) {
  const auto& reading = found.reading;
  const std::size_t all = found.matches.size();
  std::vector<Need> needs;
  const MatchJudgement& worst = found.matches[reading.worst];
  std::string of_free = fmt::format("{} of {}", reading.free, counted(all, "match", "matches"));
  if (reading.free < all)
    of_free += fmt::format("; most is gained in match {}: {}, by {} in round {}, then {}", worst.name,
                           to_text(*worst.free_beliefs.exact), to_char(*worst.free_beliefs.witness.deviation),
                           worst.free_beliefs.witness.history.size() + 1, worst.free_beliefs.witness.then);
  needs.push_back({"a best reply to some belief that agrees with the match", reading.free == all, of_free});
  needs.push_back({"a best reply to a machine of the opponents that agrees with the match", reading.of_class == all,
                   fmt::format("{} of {}; with {} some machine agrees for certain", reading.of_class,
                               counted(all, "match", "matches"), reading.agreed)});
  if (reading.stated == 0) return needs;
  needs.push_back({"every stated belief held likelier what was played", reading.right == reading.stated,
                   fmt::format("{} of {} with beliefs", reading.right, counted(reading.stated, "match", "matches"))});
  needs.push_back({"both the first and the last", reading.all == reading.stated,
                   fmt::format("{} of {} with beliefs", reading.all, counted(reading.stated, "match", "matches"))});
  return needs;
}

}  // namespace folk::tools
