#include <folk/tools/program/csv.h>
#include <folk/tools/program/table.h>
#include <folk/tools/sct_train/output.h>
#include <folk/tools/sct_train/report_json.h>
#include <folk/tools/sct_train/seeds_output.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <string>

namespace folk::tools {
namespace {

/// One result of a run. Shares are shown in per cent.
struct Column {
  std::string key;      ///< in CSV and JSON
  std::string heading;  ///< for people
  bool share = false;
  std::function<std::optional<double>(const TrainReport&)> value;

  std::string shown(const std::optional<double>& number) const {
    if (!number) return "-";
    return share ? fmt::format("{:.2f} %", 100 * *number) : fmt::format("{:.2f}", *number);
  }
};

const sct::TargetScore& kept_score(const TrainReport& report) { return sct::best_target(report.history[report.kept]); }

std::vector<Column> columns_of(const TrainReport& report) {
  std::vector<Column> columns{
      {"validation_total", "validation", false, [](const TrainReport& r) { return kept_score(r).total; }},
      {"validation_belief_accuracy", "beliefs right", true,
       [](const TrainReport& r) { return kept_score(r).accuracy; }},
      {"total", "without noise", false, [](const TrainReport& r) { return r.clean.total; }},
      {"belief_accuracy", "beliefs right", true, [](const TrainReport& r) { return r.clean.belief_accuracy; }}};
  if (report.config.holds_out()) {
    columns.push_back(
        {"held_out_total", "held out", false, [](const TrainReport& r) { return r.clean_held_out->total; }});
    columns.push_back({"held_out_belief_accuracy", "beliefs right", true,
                       [](const TrainReport& r) { return r.clean_held_out->belief_accuracy; }});
  }
  return columns;
}

/// Of one result over the seeds; nothing where a run has none.
struct Spread {
  std::optional<double> mean;
  std::optional<double> deviation;  ///< of the sample: by one less than the seeds, of which there must be two
  std::optional<double> lowest;
  std::optional<double> highest;
};

Spread spread_of(const Column& column, const std::vector<TrainReport>& reports) {
  std::vector<double> values;
  for (const auto& report : reports) {
    const auto value = column.value(report);
    if (!value) return {};
    values.push_back(*value);
  }
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, values.size() < 2 ? std::nullopt : std::optional(std::sqrt(squares / (count - 1))),
          *std::min_element(values.begin(), values.end()), *std::max_element(values.begin(), values.end())};
}

std::vector<std::uint64_t> seeds_of(const std::vector<TrainReport>& reports) {
  std::vector<std::uint64_t> seeds;
  for (const auto& report : reports) seeds.push_back(report.config.training.seed);
  return seeds;
}

}  // namespace

void write_seeds_text(std::ostream& out, const std::vector<TrainReport>& reports) {
  const auto& first = reports.front();
  const auto& config = first.config;
  const auto& architecture = config.training.architecture;
  const auto columns = columns_of(first);
  out << fmt::format("{}: {}, {} ({}, {} rounds)\n", config.loss, config.data, config.roster, to_text(config.payoffs),
                     config.rounds);
  out << game_line(config);
  out << fmt::format("network: hidden {}, layers {}, heads {}, context {}; {} steps of {} windows, seeds {}\n",
                     architecture.hidden, architecture.layers, architecture.heads, config.training.windows.context,
                     config.steps, config.training.windows.windows, fmt::join(seeds_of(reports), ", "));
  out << fmt::format("evaluations: targets {}, noise {}, repetitions {}, seed {}{}\n\n", config.targets,
                     to_short_text(config.validation_noise), config.validation_repetitions, config.validation_seed,
                     config.holds_out() ? fmt::format("; held out {}", config.held_out) : "");
  std::vector<std::string> header{"seed", "last step", "kept step", "target"};
  for (const auto& column : columns) header.push_back(column.heading);
  header.push_back("policy");
  Table runs(header);
  for (const auto& report : reports) {
    std::vector<std::string> row{
        fmt::to_string(report.config.training.seed), fmt::to_string(report.history.back().steps),
        fmt::to_string(report.history[report.kept].steps), fmt::format("{}", kept_score(report).target)};
    for (const auto& column : columns) row.push_back(column.shown(column.value(report)));
    row.push_back(report.output);
    runs.add(row);
  }
  out << runs.text() << "\n";
  Table summary({"", "mean", "deviation", "lowest", "highest"});
  for (const auto& column : columns) {
    const auto spread = spread_of(column, reports);
    summary.add({column.heading, column.shown(spread.mean), column.shown(spread.deviation), column.shown(spread.lowest),
                 column.shown(spread.highest)});
  }
  out << summary.text();
}

void write_seeds_csv(std::ostream& out, const std::vector<TrainReport>& reports) {
  const auto columns = columns_of(reports.front());
  out << "seed,step,target";
  for (const auto& column : columns) out << "," << column.key;
  out << ",output\n";
  for (const auto& report : reports) {
    out << fmt::format("{},{},{}", report.config.training.seed, report.history[report.kept].steps,
                       kept_score(report).target);
    for (const auto& column : columns) {
      const auto value = column.value(report);
      out << "," << (value ? fmt::format("{}", *value) : "");
    }
    out << "," << csv_field(report.output) << "\n";
  }
}

void write_seeds_json(std::ostream& out, const std::vector<TrainReport>& reports) {
  Json json;
  json["config"] = config_json(reports.front().config);
  json["config"].erase("seed");
  json["seeds"] = seeds_of(reports);
  for (const auto& report : reports) {
    Json run{{"seed", report.config.training.seed}};
    run.update(report_json(report));
    json["runs"].push_back(std::move(run));
  }
  for (const auto& column : columns_of(reports.front())) {
    const auto spread = spread_of(column, reports);
    json["summary"][column.key] = {{"mean", number_json(spread.mean)},
                                   {"deviation", number_json(spread.deviation)},
                                   {"lowest", number_json(spread.lowest)},
                                   {"highest", number_json(spread.highest)}};
  }
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace folk::tools
