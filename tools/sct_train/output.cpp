#include <folk/tools/sct_train/output.h>

#include <folk/tools/program/table.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.2f} %", 100 * *share) : std::string("-");
}

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json score_json(const sct::TargetScore& score) {
  return {{"target", score.target}, {"total", score.total}, {"belief_accuracy", number(score.accuracy)}};
}

}  // namespace

void write_text(std::ostream& out, const TrainReport& report) {
  const auto& config = report.config;
  const auto& architecture = config.training.architecture;
  out << visible_line(fmt::format("{} on {} matches: {}, {} ({}, {} rounds)", config.loss, report.lessons, config.data,
                                  config.roster, to_text(config.payoffs), config.rounds));
  if (report.added > 0) out << fmt::format("and {} of its own on the way, labelled by the teacher\n", report.added);
  out << fmt::format("network: hidden {}, layers {}, heads {}, context {}; {} steps of {} windows, seed {}\n",
                     architecture.hidden, architecture.layers, architecture.heads, config.training.windows.context,
                     config.steps, config.training.windows.windows, config.training.seed);
  out << fmt::format("evaluations: targets {}, noise {}, repetitions {}, seed {}\n\n", config.targets,
                     config.validation_noise, config.validation_repetitions, config.validation_seed);
  Table evaluations({"step", "belief loss", "action loss", "target", "total", "beliefs right", "kept"});
  for (std::size_t i = 0; i < report.history.size(); ++i) {
    const auto& evaluation = report.history[i];
    const auto& best = sct::best_target(evaluation);
    evaluations.add({fmt::to_string(evaluation.steps), fmt::format("{:.4f}", evaluation.belief_loss),
                     fmt::format("{:.4f}", evaluation.action_loss), fmt::format("{}", best.target),
                     fmt::format("{:.2f}", best.total), percent(best.accuracy), i == report.kept ? "kept" : ""});
  }
  out << evaluations.text() << "\n";
  const auto& kept = report.history[report.kept];
  out << fmt::format("kept: step {} with target {}, the highest total of all evaluations\n", kept.steps,
                     sct::best_target(kept).target);
  out << fmt::format("without noise it earns {}, {} of its beliefs right:\n\n", report.clean.total,
                     percent(report.clean.belief_accuracy));
  Table opponents({"opponent", "score"});
  for (std::size_t i = 0; i < report.roster.size(); ++i)
    opponents.add({report.roster[i].name, fmt::format("{}", report.clean.scores[i])});
  out << opponents.text();
  out << fmt::format("\nits belief token forced to C changes {} of its {} moves, forced to D {}\n",
                     report.effect.changed_by_c, report.effect.rounds, report.effect.changed_by_d);
  out << visible_line(fmt::format("written to {}", report.output));
}

void write_csv(std::ostream& out, const TrainReport& report) {
  out << "step,belief_loss,action_loss,target,total,belief_accuracy,kept\n";
  for (std::size_t i = 0; i < report.history.size(); ++i) {
    const auto& evaluation = report.history[i];
    const auto& best = sct::best_target(evaluation);
    out << fmt::format("{},{},{},{},{},{},{}\n", evaluation.steps, evaluation.belief_loss, evaluation.action_loss,
                       best.target, best.total, best.accuracy ? fmt::format("{}", *best.accuracy) : "",
                       i == report.kept ? "yes" : "no");
  }
}

void write_json(std::ostream& out, const TrainReport& report) {
  Json json;
  for (const auto& [key, value] : key_values(report.config)) json["config"][key] = value;
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
  const auto& kept = report.history[report.kept];
  const auto& best = sct::best_target(kept);
  json["kept"] = {{"step", kept.steps},
                  {"target", best.target},
                  {"validation_total", best.total},
                  {"validation_belief_accuracy", number(best.accuracy)},
                  {"total", report.clean.total},
                  {"belief_accuracy", number(report.clean.belief_accuracy)}};
  for (std::size_t i = 0; i < report.roster.size(); ++i)
    json["kept"]["opponents"].push_back({{"name", report.roster[i].name}, {"score", report.clean.scores[i]}});
  json["belief_effect"] = {{"moves", report.effect.rounds},
                           {"changed_by_c", report.effect.changed_by_c},
                           {"changed_by_d", report.effect.changed_by_d}};
  json["output"] = report.output;
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace folk::tools
