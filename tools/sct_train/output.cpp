#include <folk/tools/sct_train/output.h>

#include <folk/tools/program/table.h>
#include <folk/tools/sct_train/evaluation_csv.h>
#include <folk/tools/sct_train/report_json.h>

#include <fmt/format.h>

#include <optional>

namespace folk::tools {
namespace {

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.2f} %", 100 * *share) : std::string("-");
}

std::string opponents_table(const std::vector<Strategy>& roster, const sct::RosterScore& score) {
  Table opponents({"opponent", "score"});
  for (std::size_t i = 0; i < roster.size(); ++i) opponents.add({roster[i].name, fmt::format("{}", score.scores[i])});
  return opponents.text();
}

std::string evaluations_table(const TrainReport& report) {
  const bool held_out = report.config.holds_out();
  std::vector<std::string> header{"step", "belief loss", "action loss", "target", "total", "beliefs right"};
  if (held_out) header.insert(header.end(), {"held out", "beliefs right"});
  header.push_back("kept");
  Table evaluations(header);
  for (std::size_t i = 0; i < report.history.size(); ++i) {
    const auto& evaluation = report.history[i];
    const auto& best = sct::best_target(evaluation);
    std::vector<std::string> row{fmt::to_string(evaluation.steps),
                                 fmt::format("{:.4f}", evaluation.belief_loss),
                                 fmt::format("{:.4f}", evaluation.action_loss),
                                 fmt::format("{}", best.target),
                                 fmt::format("{:.2f}", best.total),
                                 percent(best.accuracy)};
    if (best.held_out)
      row.insert(row.end(), {fmt::format("{:.2f}", best.held_out->total), percent(best.held_out->accuracy)});
    row.push_back(i == report.kept ? "kept" : "");
    evaluations.add(row);
  }
  return evaluations.text();
}

}  // namespace

std::string game_line(const TrainConfig& config) {
  if (!config.has_game()) return "";
  return visible_line(fmt::format("game: {}, its actions {} (C) and {} (D)", usual_name(config.payoffs),
                                  config.actions[0], config.actions[1]));
}

void write_text(std::ostream& out, const TrainReport& report) {
  const auto& config = report.config;
  const auto& architecture = config.training.architecture;
  out << visible_line(fmt::format("{} on {} matches: {}, {} ({}, {} rounds)", config.loss, report.lessons, config.data,
                                  config.roster, to_text(config.payoffs), config.rounds));
  out << game_line(config);
  if (report.added > 0) out << fmt::format("and {} of its own on the way, labelled by the teacher\n", report.added);
  out << fmt::format("network: hidden {}, layers {}, heads {}, context {}; {} steps of {} windows, seed {}\n",
                     architecture.hidden, architecture.layers, architecture.heads, config.training.windows.context,
                     config.steps, config.training.windows.windows, config.training.seed);
  out << fmt::format("evaluations: targets {}, noise {}, repetitions {}, seed {}\n\n", config.targets,
                     to_short_text(config.validation_noise), config.validation_repetitions, config.validation_seed);
  out << evaluations_table(report) << "\n";
  if (report.stopped_early)
    out << fmt::format("stopped at step {}: {} evaluations without a higher total\n", report.history.back().steps,
                       config.patience);
  const auto& kept = report.history[report.kept];
  out << fmt::format("kept: step {} with target {}, the highest {}total of all evaluations\n", kept.steps,
                     sct::best_target(kept).target, config.holds_out() ? "held-out " : "");
  out << fmt::format("without noise it earns {}, {} of its beliefs right:\n\n", report.clean.total,
                     percent(report.clean.belief_accuracy));
  out << opponents_table(report.roster, report.clean);
  if (report.clean_held_out)
    out << fmt::format("\nagainst those held out it earns {}, {} of its beliefs right:\n\n",
                       report.clean_held_out->total, percent(report.clean_held_out->belief_accuracy))
        << opponents_table(report.held_out, *report.clean_held_out);
  out << "\n"
      << visible_line(fmt::format("its {} forced to {} changes {} of its {} moves, forced to {} {}",
                                  config.plan_depth > 0 ? "belief" : "belief token", config.actions[0],
                                  report.effect.changed_by_c, report.effect.rounds, config.actions[1],
                                  report.effect.changed_by_d));
  if (config.plan_depth > 0)
    out << fmt::format("that of the present round alone, those of the rounds after it as they are: {} and {}\n",
                       report.effect.present_by_c, report.effect.present_by_d);
  out << visible_line(fmt::format("written to {}", report.output));
}

void write_csv(std::ostream& out, const TrainReport& report) {
  out << evaluation_table(report.history, report.kept, report.config.holds_out());
}

void write_json(std::ostream& out, const TrainReport& report) {
  Json json;
  json["config"] = config_json(report.config);
  json.update(report_json(report));
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace folk::tools
