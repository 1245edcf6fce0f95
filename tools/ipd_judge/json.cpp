// What ipd-judge found, as JSON.

#include <folk/tools/ipd_judge/output.h>
#include <folk/tools/ipd_judge/words.h>
#include <folk/tools/program/json_values.h>

namespace folk::tools {
namespace {

Json names_of(const Candidates::Behaviour& behaviour) {
  Json names = Json::array();
  for (const auto& strategy : behaviour.strategies) names.push_back(strategy.name);
  return names;
}

Json place_of(const Judgement& found, const std::optional<RecordedPlace>& place) {
  if (!place) return nullptr;
  return {{"match", found.matches[place->match].name}, {"round", place->round + 1}};
}

Json candidate_json(const JudgeQuestion& question, const Judgement& found, const CandidateRow& row) {
  Json object{{"rank", row.rank}};
  const std::size_t behaviours = found.players.behaviours.size();
  if (row.candidate < behaviours) {
    const Agreement& agreement = found.own.agreements[row.candidate];
    object["strategies"] = names_of(found.players.behaviours[row.candidate]);
    object["consistent"] = agreement.consistent();
    object["otherwise"] = agreement.impossible();
    object["first_otherwise"] = place_of(found, agreement.first_impossible());
  } else {
    const ClassAgreement& agreement = found.own.class_agreements[row.candidate - behaviours];
    object["class"] = agreement.members().name();
    object["members"] = agreement.members().size().str();
    object["consistent_members"] = agreement.consistent().str();
    object["genes"] = agreement.members().genes();
    object["genes_asked"] = agreement.asked();
    object["fewest_slips"] = agreement.fewest_slips();
    object["nearest_members"] = agreement.nearest().str();
    object["nearest"] = agreement.nearest_text();
  }
  object["weight"] = row.weight;
  object["posterior"] = row.posterior;
  object["slip"] = question.slips[found.own.posterior.likeliest_slip[row.candidate]];
  return object;
}

Json regret_json(const std::optional<Regret>& regret) {
  if (!regret) return nullptr;
  return {{"best", regret->best},
          {"regret", regret->regret},
          {"exact", regret->exact ? Json(to_text(*regret->exact)) : Json(nullptr)}};
}

Json likeliest_json(const Judgement& found, const MatchJudgement& match) {
  if (!match.likeliest) return nullptr;
  return {{"name", name_of(found.opponents, match.likeliest->candidate)},
          {"posterior", match.likeliest->probability},
          {"slip", match.likeliest->slip},
          {"regret", regret_json(match.likeliest->regret)}};
}

/// The deviation is one from the record, which needs no telling again.
Json gain_json(const std::optional<Gap>& gap) {
  if (!gap) return nullptr;
  Json object{{"gain", gap->gain}, {"exact", gap->exact ? Json(to_text(*gap->exact)) : Json(nullptr)}};
  const Witness& witness = gap->witness;
  if (!witness.belief.empty()) object["belief"] = witness.belief;
  if (gap->gain > 0 && witness.deviation) {
    object["round"] = witness.history.size() + 1;
    object["move"] = std::string(1, to_char(*witness.deviation));
  }
  return object;
}

Json match_json(const Judgement& found, const MatchJudgement& match) {
  Json consistent = Json::array();
  for (const auto& opponent : match.consistent)
    consistent.push_back({{"strategies", names_of(found.opponents.behaviours[opponent.behaviour])},
                          {"certain", opponent.certain},
                          {"regret", regret_json(opponent.regret)}});
  Json classes = Json::object();
  for (std::size_t c = 0; c < match.consistent_members.size(); ++c)
    classes[found.opponents.classes[c].members.name()] = match.consistent_members[c].str();
  return {{"match", match.name},
          {"rounds", match.rounds},
          {"own_total", to_double(match.own_total)},
          {"their_total", to_double(match.their_total)},
          {"consistent", consistent},
          {"consistent_members", classes},
          {"likeliest", likeliest_json(found, match)},
          {"gains",
           {{"free_beliefs", gain_json(match.free_beliefs)}, {"class_of_beliefs", gain_json(match.class_beliefs)}}},
          {"beliefs_stated", match.stated},
          {"beliefs_right", match.right}};
}

Json stage_json(const std::optional<StageReplies>& stage) {
  if (!stage) return nullptr;
  return {{"rounds", stage->rounds},
          {"best", stage->best},
          {"loss", stage->loss_sum},
          {"largest_loss", stage->largest_loss}};
}

Json reading_json(const SelfConfirmingReading& reading, const Judgement& found) {
  return {{"matches", found.matches.size()},       {"free_beliefs", reading.free},
          {"class_of_beliefs", reading.of_class},  {"agreed_for_certain", reading.agreed},
          {"with_beliefs", reading.stated},        {"beliefs_right", reading.right},
          {"beliefs_right_and_free", reading.all}, {"worst_match", found.matches[reading.worst].name}};
}

}  // namespace

void write_json(std::ostream& out, const JudgeQuestion& question, const Judgement& found) {
  const Payoffs& payoffs = question.payoffs;
  Json candidates = Json::array();
  for (const auto& row : candidate_rows(question, found)) candidates.push_back(candidate_json(question, found, row));
  Json matches = Json::array();
  for (const auto& match : found.matches) matches.push_back(match_json(found, match));
  const RegretSum regret = regret_sum(found);
  const auto& posterior = found.own.posterior;
  const Json report{{"file", question.file},
                    {"game", question.game.title},
                    {"payoffs",
                     {{"T", to_double(payoffs.temptation)},
                      {"R", to_double(payoffs.reward)},
                      {"P", to_double(payoffs.punishment)},
                      {"S", to_double(payoffs.sucker)}}},
                    {"strategies", question.players_spec},
                    {"opponents", question.opponents_spec},
                    {"left_out", question.left_out},
                    {"ignored_columns", question.play.ignored_columns},
                    {"rounds", question.play.rounds()},
                    {"slips", question.slips},
                    {"slip_posterior", posterior.slips},
                    {"log_evidence", posterior.possible() ? Json(posterior.log_evidence) : Json(nullptr)},
                    {"consistent", names_that_agree(found)},
                    {"candidates", candidates},
                    {"matches", matches},
                    {"regret", {{"least", regret.least}, {"largest", regret.largest}, {"matches", regret.matches}}},
                    {"beliefs", belief_json(found.beliefs)},
                    {"stage_replies", stage_json(found.stage)},
                    {"self_confirming", reading_json(found.reading, found)}};
  out << report.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace folk::tools
