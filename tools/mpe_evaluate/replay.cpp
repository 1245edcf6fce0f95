#include <folk/tools/mpe_evaluate/replay.h>

#include <folk/tools/program/csv.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/mpe/evaluation/recording_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;
using mpe::Deviation;
using mpe::ReplayResult;

/// The three things that are compared.
struct Kind {
  std::string_view name;
  Deviation ReplayResult::*deviation;
};
constexpr std::array kinds{Kind{"state", &ReplayResult::state}, Kind{"observation", &ReplayResult::observation},
                           Kind{"reward", &ReplayResult::reward}};

/// A file's largest deviation of one kind, and the episode it is in.
struct Worst {
  Deviation deviation;
  std::uint64_t episode = 0;
};

Worst worst(const ReplayedFile& file, Deviation ReplayResult::*kind) {
  Worst found{{}, file.episodes.front().number};
  for (const auto& [number, result] : file.episodes)
    if (less(found.deviation, result.*kind)) found = {result.*kind, number};
  return found;
}

Worst worst(const ReplayedFile& file) {
  Worst found = worst(file, kinds.front().deviation);
  for (const auto& kind : kinds)
    if (const Worst here = worst(file, kind.deviation); less(found.deviation, here.deviation)) found = here;
  return found;
}

bool within(const ReplayedFile& file, double tolerance) { return worst(file).deviation.within(tolerance); }

std::size_t steps(const ReplayedFile& file) {
  std::size_t sum = 0;
  for (const auto& episode : file.episodes) sum += episode.result.steps;
  return sum;
}

std::string_view mode_name(mpe::ReplayMode mode) { return mode == mpe::ReplayMode::one_step ? "one_step" : "free_run"; }

std::string place(const Worst& found) {
  return fmt::format("{} at t = {} of episode {}", found.deviation.column, found.deviation.step, found.episode);
}

void write_text(std::ostream& out, const ReplaySettings& settings, const std::vector<ReplayedFile>& files) {
  out << fmt::format("Replay {}; rewards of the {}; tolerance {}\n\n",
                     settings.mode == mpe::ReplayMode::one_step ? "step by step, each from the recorded state before it"
                                                                : "of whole episodes from their first states",
                     to_string(settings.rewards), settings.tolerance);
  Table table({"file", "scenario", "episodes", "steps", "state", "observation", "reward"});
  for (const auto& file : files) {
    std::vector<std::string> row{excerpt(file.file, 200), file.scenario, fmt::format("{}", file.episodes.size()),
                                 fmt::format("{}", steps(file))};
    for (const auto& kind : kinds) row.push_back(fmt::format("{:.3g}", worst(file, kind.deviation).deviation.size));
    table.add(std::move(row));
  }
  out << table.text() << "\nstate, observation, reward: the largest |replayed - recorded|";
  if (const Worst last = worst(files.back()); !last.deviation.column.empty())
    out << fmt::format("; of all {:.3g}, {}{}", last.deviation.size, place(last),
                       files.size() > 1 ? " in " + excerpt(files.back().file, 200) : std::string());
  const auto failed =
      std::count_if(files.begin(), files.end(), [&](const auto& file) { return !within(file, settings.tolerance); });
  out << (failed == 0 ? "\nall within the tolerance\n"
                      : fmt::format("\nbeyond the tolerance: {} of {} files\n", failed, files.size()));
}

void write_csv(std::ostream& out, const ReplaySettings& settings, const std::vector<ReplayedFile>& files) {
  out << "file,scenario,episode,steps";
  for (const auto& kind : kinds) out << fmt::format(",{0},{0}_t,{0}_column", kind.name);
  out << ",within\n";
  for (const auto& file : files)
    for (const auto& [number, result] : file.episodes) {
      out << fmt::format("{},{},{},{}", csv_field(file.file), file.scenario, number, result.steps);
      for (const auto& kind : kinds) {
        const Deviation& deviation = result.*kind.deviation;
        out << fmt::format(",{},{},{}", deviation.size, deviation.step, deviation.column);
      }
      out << fmt::format(",{}\n", result.within(settings.tolerance));
    }
}

Json json_of(const Worst& found) {
  if (found.deviation.column.empty())
    return {{"deviation", 0}, {"episode", nullptr}, {"t", nullptr}, {"column", nullptr}};
  return {{"deviation", found.deviation.size},
          {"episode", found.episode},
          {"t", found.deviation.step},
          {"column", found.deviation.column}};
}

void write_json(std::ostream& out, const ReplaySettings& settings, const std::vector<ReplayedFile>& files) {
  Json json{{"mode", mode_name(settings.mode)},
            {"reward_rule", to_string(settings.rewards)},
            {"tolerance", settings.tolerance},
            {"within", within(settings, files)},
            {"files", Json::array()}};
  for (const auto& file : files) {
    Json item{{"file", file.file},
              {"scenario", file.scenario},
              {"episodes", file.episodes.size()},
              {"steps", steps(file)},
              {"within", within(file, settings.tolerance)}};
    for (const auto& kind : kinds) item[std::string(kind.name)] = json_of(worst(file, kind.deviation));
    json["files"].push_back(std::move(item));
  }
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace

std::vector<ReplayedFile> replay_files(const ReplaySettings& settings, const Progress& progress) {
  std::vector<ReplayedFile> files;
  for (const auto& name : settings.files) {
    ReplayedFile file{name, {}, {}};
    const auto records = mpe::read_recording(name, settings.rewards);
    file.scenario = records.front().scenario.name;
    for (const auto& record : records) {
      file.episodes.push_back({record.number, mpe::replay(record, settings.mode)});
      progress((static_cast<double>(files.size()) +
                static_cast<double>(file.episodes.size()) / static_cast<double>(records.size())) /
               static_cast<double>(settings.files.size()));
    }
    files.push_back(std::move(file));
  }
  std::stable_sort(files.begin(), files.end(), [](const auto& one, const auto& other) {
    return less(worst(one).deviation, worst(other).deviation);
  });
  return files;
}

bool within(const ReplaySettings& settings, const std::vector<ReplayedFile>& files) {
  return std::all_of(files.begin(), files.end(), [&](const auto& file) { return within(file, settings.tolerance); });
}

void write_replay(std::ostream& out, Format format, const ReplaySettings& settings,
                  const std::vector<ReplayedFile>& files) {
  switch (format) {
    case Format::text: write_text(out, settings, files); break;
    case Format::csv: write_csv(out, settings, files); break;
    case Format::json: write_json(out, settings, files); break;
  }
}

}  // namespace folk::tools
