#include <folk/tools/mpe_train/data_output.h>

#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <numeric>

#include <nlohmann/json.hpp>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

std::size_t numbers_in(const DataReport::File& file) {
  return std::accumulate(file.shape.begin(), file.shape.end(), std::size_t{1}, std::multiplies<>());
}

double megabytes(const DataReport& report) {
  double bytes = 0;
  for (const auto& file : report.files) bytes += static_cast<double>(numbers_in(file) * bytes_of(file.type));
  return bytes / 1e6;
}

std::string type_name(sct::NpyType type) {
  if (type == sct::NpyType::float32) return "float32";
  if (type == sct::NpyType::float64) return "float64";
  return std::string(to_string(type));
}

/// The type of all files, or that they have several.
std::string type_name(const DataReport& report) {
  for (const auto& file : report.files)
    if (file.type != report.files.front().type) return "several types of number";
  return type_name(report.files.front().type);
}

std::string made_by(const mpe::DataDescription& description) {
  std::string text = fmt::format("{} against {}", excerpt(description.predators, 200), excerpt(description.prey, 200));
  if (!description.level.empty()) text += fmt::format(" (level {})", excerpt(description.level));
  if (description.noise > 0) text += fmt::format(", noise {}", to_short_text(description.noise));
  return text;
}

Json to_json(const mpe::MeanReturn& value) {
  return {{"mean", value.mean}, {"standard_error", value.standard_error ? Json(*value.standard_error) : Json(nullptr)}};
}

}  // namespace

DataReport data_report(const mpe::DataSet& data, const mpe::DataFigures& figures) {
  DataReport report{data.source(), data.scenario(), data.transitions(), {}, figures, std::nullopt};
  for (const auto& file : mpe::data_files(data.agents())) {
    const auto& table = data.table(file.field, file.agent);
    report.files.push_back({file.name(), table.shape(), table.type()});
  }
  if (data.record()) report.description = data.record()->description;
  return report;
}

DataReport data_report(const std::string& folder, const mpe::Scenario& scenario, const mpe::DataRecord& record) {
  const std::size_t rows = record.description.transitions();
  DataReport report{folder, scenario, rows, {}, record.figures, record.description};
  for (const auto& file : mpe::data_files(scenario.agents()))
    report.files.push_back({file.name(), file.shape(scenario, rows), record.description.type});
  return report;
}

void write_text(std::ostream& out, const DataReport& report) {
  const std::size_t steps = report.scenario.episode_steps;
  out << fmt::format("{}: {}, {} transitions, {} episodes of {} steps\n", excerpt(report.folder, 1000),
                     report.scenario.name, report.transitions, report.transitions / steps, steps);
  out << fmt::format("{} files of {}, {:.1f} MB\n", report.files.size(), type_name(report), megabytes(report));
  if (const auto& told = report.description) {
    out << fmt::format("played by {}\n", made_by(*told));
    out << fmt::format("seed {}, episodes from {} on, rewards as the {}'s, Folk {}\n", told->seed, told->first_episode,
                       to_string(told->reward_rule), excerpt(told->folk_version));
  } else {
    out << "it does not say who played\n";
  }
  Table returns({"return of an episode", "mean", "standard error"});
  const auto add = [&](const char* who, const mpe::MeanReturn& value) {
    returns.add({who, fmt::format("{:.2f}", value.mean),
                 value.standard_error ? fmt::format("{:.2f}", *value.standard_error) : "-"});
  };
  add("predator 0", report.figures.predator);
  add("prey", report.figures.prey);
  out << "\n" << returns.text() << "\n";
  out << fmt::format("signature {:016x}\n", report.figures.signature);
}

void write_json(std::ostream& out, const DataReport& report) {
  Json json{{"folder", report.folder},
            {"scenario", report.scenario.name},
            {"transitions", report.transitions},
            {"episodes", report.transitions / report.scenario.episode_steps},
            {"episode_steps", report.scenario.episode_steps}};
  for (const auto& file : report.files)
    json["files"].push_back({{"name", file.name}, {"shape", file.shape}, {"dtype", type_name(file.type)}});
  json["predator_return"] = to_json(report.figures.predator);
  json["prey_return"] = to_json(report.figures.prey);
  json["signature"] = fmt::format("{:016x}", report.figures.signature);
  json["made"] = report.description ? Json::parse(description_text(*report.description)) : Json(nullptr);
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace folk::tools
