#include <folk/tools/mpe_train/online_output.h>

#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/mpe/pictures/learning_curve.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string title_of(const mpe::OnlineTraining& training) {
  const auto& settings = training.settings();
  return fmt::format("{}, {}, {} critics, seed {}{}", training.scenario().name, to_string(settings.algorithm),
                     to_string(settings.critic), settings.seed, settings.prey_learns ? ", the prey learns too" : "");
}

Json evaluation_json(const mpe::OnlineEvaluation& evaluation) {
  return {{"episodes", evaluation.episodes}, {"updates", evaluation.updates},
          {"return", evaluation.predators},  {"standard_error", evaluation.error},
          {"prey_return", evaluation.prey},  {"critic_loss", evaluation.critic_loss},
          {"value", evaluation.value}};
}

void write_text(std::ostream& out, const OnlineReport& report) {
  const auto& history = report.training.history();
  out << title_of(report.training) << "\n\n";
  Table table({"episodes", "updates", "return", "error", "prey", "critic loss", ""});
  const std::size_t every = std::max<std::size_t>(1, (history.size() + 19) / 20);  // some twenty rows
  for (std::size_t i = 0; i < history.size(); ++i) {
    const bool named = i == report.kept || report.medium == i;
    if (i % every != 0 && i + 1 != history.size() && !named) continue;
    const auto& row = history[i];
    table.add({fmt::to_string(row.episodes), fmt::to_string(row.updates), fmt::format("{:.2f}", row.predators),
               fmt::format("{:.2f}", row.error), fmt::format("{:.2f}", row.prey),
               fmt::format("{:.2f}", row.critic_loss),
               i == report.kept     ? "kept"
               : report.medium == i ? "medium"
                                    : ""});
  }
  out << table.text() << "\n";
  const auto write = [&](const std::filesystem::path& file, const char* what) {
    if (!file.empty()) out << visible_line(fmt::format("{} in {}", what, file.string()));
  };
  write(report.output, "predators");
  write(report.medium_file, "medium predators");
  write(report.prey_file, "prey");
  write(report.curve, fmt::format("{} evaluations", history.size()).c_str());
  write(report.picture, "picture");
}

void write_json(std::ostream& out, const OnlineReport& report) {
  Json json;
  std::istringstream lines(report.description);
  for (std::string line; std::getline(lines, line);)
    if (const auto sign = line.find(" = "); sign != std::string::npos)
      json["settings"][line.substr(0, sign)] = line.substr(sign + 3);
  json["settings"]["episodes"] = report.training.settings().episodes;
  json["evaluations"] = Json::array();
  for (const auto& evaluation : report.training.history()) json["evaluations"].push_back(evaluation_json(evaluation));
  json["kept"] = evaluation_json(report.training.history()[report.kept]);
  if (report.medium) json["medium"] = evaluation_json(report.training.history()[*report.medium]);
  for (const auto& [key, file] : {std::pair{"output", report.output},
                                  {"medium", report.medium_file},
                                  {"prey", report.prey_file},
                                  {"curve", report.curve},
                                  {"picture", report.picture}})
    if (!file.empty()) json["files"][key] = file.string();
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace

std::size_t kept_evaluation(const mpe::OnlineTraining& training) {
  const auto& history = training.history();
  if (training.settings().prey_learns) return history.size() - 1;
  std::size_t best = 0;
  for (std::size_t i = 0; i < history.size(); ++i)
    if (history[i].predators >= history[best].predators) best = i;
  return best;
}

std::size_t nearest_evaluation(const mpe::OnlineTraining& training, double predators) {
  const auto& history = training.history();
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < history.size(); ++i)
    if (std::abs(history[i].predators - predators) < std::abs(history[nearest].predators - predators)) nearest = i;
  return nearest;
}

void write_evaluations(std::ostream& out, const std::vector<mpe::OnlineEvaluation>& history) {
  out << "episodes,updates,return,standard_error,prey_return,critic_loss,value\n";
  for (const auto& row : history)
    out << fmt::format("{},{},{},{},{},{},{}\n", row.episodes, row.updates, row.predators, row.error, row.prey,
                       row.critic_loss, row.value);
}

void draw_evaluations(const mpe::OnlineTraining& training, std::size_t kept, const std::filesystem::path& picture) {
  mpe::LearningCurvePlot plot;
  plot.title = title_of(training);
  plot.caption = {training.scenario().name,
                  fmt::format("means of {} episodes of {} steps", training.settings().evaluation_episodes,
                              training.scenario().episode_steps)};
  mpe::LearningCurve predators{"predators", {}, {}};
  mpe::LearningCurve prey{"prey", {}, {}};
  for (const auto& evaluation : training.history()) {
    predators.episodes.push_back(static_cast<double>(evaluation.episodes));
    predators.returns.push_back(evaluation.predators);
    prey.returns.push_back(evaluation.prey);
  }
  prey.episodes = predators.episodes;
  plot.curves = {predators};
  if (training.settings().prey_learns) {
    plot.unit = "return";
    plot.curves.push_back(prey);
  } else {
    plot.marks = {{"kept", training.history()[kept].predators}};
  }
  draw(plot, picture);
}

void write_report(std::ostream& out, const OnlineReport& report, Format format) {
  switch (format) {
    case Format::text: return write_text(out, report);
    case Format::csv: return write_evaluations(out, report.training.history());
    case Format::json: return write_json(out, report);
  }
}

}  // namespace folk::tools
