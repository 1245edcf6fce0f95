#include <folk/tools/sct_train/report_json.h>

namespace folk::tools {
namespace {

Json score_json(const sct::TargetScore& score) {
  Json json{{"target", score.target}, {"total", score.total}, {"belief_accuracy", number_json(score.accuracy)}};
  if (score.held_out) {
    json["held_out_total"] = score.held_out->total;
    json["held_out_belief_accuracy"] = number_json(score.held_out->accuracy);
  }
  return json;
}

Json opponents_json(const std::vector<Strategy>& roster, const sct::RosterScore& score) {
  Json json = Json::array();
  for (std::size_t i = 0; i < roster.size(); ++i)
    json.push_back({{"name", roster[i].name}, {"score", score.scores[i]}});
  return json;
}

Json kept_json(const TrainReport& report) {
  const auto& kept = report.history[report.kept];
  const auto& best = sct::best_target(kept);
  Json json{{"step", kept.steps},
            {"target", best.target},
            {"validation_total", best.total},
            {"validation_belief_accuracy", number_json(best.accuracy)},
            {"total", report.clean.total},
            {"belief_accuracy", number_json(report.clean.belief_accuracy)},
            {"opponents", opponents_json(report.roster, report.clean)}};
  if (report.clean_held_out)
    json["held_out"] = {{"validation_total", best.held_out->total},
                        {"validation_belief_accuracy", number_json(best.held_out->accuracy)},
                        {"total", report.clean_held_out->total},
                        {"belief_accuracy", number_json(report.clean_held_out->belief_accuracy)},
                        {"opponents", opponents_json(report.held_out, *report.clean_held_out)}};
  return json;
}

}  // namespace

Json number_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json config_json(const TrainConfig& config) {
  Json json;
  for (const auto& [key, value] : key_values(config)) json[key] = value;
  return json;
}

Json report_json(const TrainReport& report) {
  Json json;
  json["matches"] = report.lessons;
  json["added_matches"] = report.added;
  json["evaluations"] = Json::array();
  for (const auto& evaluation : report.history) {
    Json entry{{"step", evaluation.steps},
               {"belief_loss", evaluation.belief_loss},
               {"action_loss", evaluation.action_loss},
               {"best", score_json(sct::best_target(evaluation))}};
    for (const auto& score : evaluation.scores) entry["targets"].push_back(score_json(score));
    json["evaluations"].push_back(std::move(entry));
  }
  json["stopped_early"] = report.stopped_early;
  json["kept"] = kept_json(report);
  json["belief_effect"] = {{"moves", report.effect.rounds},
                           {"changed_by_c", report.effect.changed_by_c},
                           {"changed_by_d", report.effect.changed_by_d},
                           {"present_by_c", report.effect.present_by_c},
                           {"present_by_d", report.effect.present_by_d}};
  json["output"] = report.output;
  return json;
}

}  // namespace folk::tools
