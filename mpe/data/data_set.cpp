#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>
#include <folk/mpe/data/data_set.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace folk::mpe {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t all_agents = 4;  // in either scenario
constexpr std::size_t largest_metadata = std::size_t{1} << 20U;

std::vector<std::size_t> observation_widths(const Scenario& scenario) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < scenario.agents(); ++i) widths.push_back(scenario.observation_size(i));
  return widths;
}

std::string shape_text(const std::vector<std::size_t>& shape) { return fmt::format("({})", fmt::join(shape, ", ")); }

/// All of them that the folder lacks, in one message.
void require_all_there(const DataSet::Files& file, const std::string& source) {
  std::vector<std::string> missing;
  const auto files = data_files(all_agents);
  for (const DataFile& one : files)
    if (!file(one.name())) missing.push_back(one.name());
  if (missing.empty()) return;
  throw InputFileError(fmt::format(
      "{}: {} of the {} files of a data set {} missing: {}; it needs obs_i, acs_i, rews_i, next_obs_i and dones_i.npy "
      "for agents 0 to 3",
      excerpt(source, 1000), missing.size(), files.size(), missing.size() == 1 ? "is" : "are",
      fmt::join(missing, ", ")));
}

}  // namespace

DataSet DataSet::open(const fs::path& folder, const DataSetRules& rules) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw InputFileError(fmt::format("{}: no such folder; name one that holds obs_0.npy and the rest of a data set",
                                     excerpt(folder.string(), 1000)));
  std::vector<std::pair<std::string, MappedFile>> mapped;
  std::vector<std::string> names{metadata_name};
  for (const DataFile& file : data_files(all_agents)) names.push_back(file.name());
  for (const auto& name : names)
    if (fs::exists(folder / name, ignored)) mapped.emplace_back(name, MappedFile(folder / name));
  DataSet data = parse(
      [&](const std::string& name) -> std::optional<std::string_view> {
        const auto found =
            std::find_if(mapped.begin(), mapped.end(), [&](const auto& one) { return one.first == name; });
        if (found == mapped.end()) return std::nullopt;
        return found->second.bytes();
      },
      folder.string(), rules);
  for (auto& [name, file] : mapped) data.mapped_.push_back(std::move(file));
  return data;
}

DataSet DataSet::parse(const Files& file, const std::string& source, const DataSetRules& rules) {
  require_all_there(file, source);
  DataSet data;
  data.source_ = source;
  data.read_tables(file);
  data.require_shapes(rules);
  data.read_record(file, rules);
  if (data.transitions_ % data.episode_steps() != 0)
    data.refuse("obs_0.npy", fmt::format("{} rows make no whole episodes of {}; store all steps of each",
                                         data.transitions_, data.episode_steps()));
  data.require_numbers(rules.threads);
  return data;
}

void DataSet::refuse(const std::string& file, const std::string& why) const {
  const fs::path path = file.empty() ? fs::path(source_) : fs::path(source_) / file;
  refuse_file(path.string(), why);
}

void DataSet::read_tables(const Files& file) {
  for (const DataFile& one : data_files(all_agents)) {
    tables_.emplace_back(*file(one.name()), (fs::path(source_) / one.name()).string());
    const NumberTable& table = tables_.back();
    if (!table.holds_reals() && one.field != DataField::done)
      refuse(one.name(), fmt::format("numbers of type {}: expected <f4 or <f8; convert with astype('float32')",
                                     to_string(table.type())));
  }
}

void DataSet::require_shapes(const DataSetRules& rules) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < all_agents; ++i) widths.push_back(table(DataField::observation, i).width());
  std::vector<std::string> known;
  for (const char* name : {"simple_tag", "simple_world"}) {
    const Scenario scenario = Scenario::named(name);
    if (widths == observation_widths(scenario)) scenario_ = scenario;
    known.push_back(fmt::format("{} ({})", name, fmt::join(observation_widths(scenario), ", ")));
  }
  if (scenario_.entities.empty())
    refuse("obs_i.npy", fmt::format("rows of ({}) numbers are of no scenario: expected {}", fmt::join(widths, ", "),
                                    fmt::join(known, " or ")));
  if (rules.scenario && scenario_.name != *rules.scenario)
    refuse("", fmt::format("a data set of {}: expected one of {}", scenario_.name, *rules.scenario));

  transitions_ = table(DataField::observation, 0).rows();
  if (transitions_ == 0) refuse("obs_0.npy", "no rows; a data set has at least one episode");
  for (const DataFile& file : data_files(all_agents)) {
    const NumberTable& one = table(file.field, file.agent);
    const auto expected = file.shape(scenario_, transitions_);
    if (one.rows() != transitions_ || one.width() != file.width(scenario_))
      refuse(file.name(), fmt::format("shape {}: expected {}, as obs_0.npy has {} rows of {}", shape_text(one.shape()),
                                      shape_text(expected), transitions_, scenario_.name));
  }
}

void DataSet::read_record(const Files& file, const DataSetRules& rules) {
  const auto text = file(metadata_name);
  if (!text) return;
  if (text->size() > largest_metadata) refuse(metadata_name, "larger than 1 MiB; leave this file out");
  record_ = parse_metadata(*text, (fs::path(source_) / metadata_name).string());
  if (!record_) return;
  const DataDescription& told = record_->description;
  if (told.scenario != scenario_.name)
    refuse(metadata_name, fmt::format("the scenario is said to be '{}', but the files are of {}; take a fresh copy",
                                      excerpt(told.scenario), scenario_.name));
  if (told.episode_steps != scenario_.episode_steps && !rules.any_episode_length)
    refuse(metadata_name,
           fmt::format("episodes of {} steps: expected {}", told.episode_steps, scenario_.episode_steps));
  if (told.transitions() != transitions_)
    refuse(metadata_name,
           fmt::format("{} transitions are said to be here, but the files have {} rows; take a fresh copy",
                       told.transitions(), transitions_));
  scenario_ = Scenario::named(scenario_.name, told.reward_rule);
  scenario_.episode_steps = told.episode_steps;
}

void DataSet::require_numbers(unsigned threads) const {
  const std::size_t piece_rows = episodes_in_piece * episode_steps();
  parallel_for((transitions_ + piece_rows - 1) / piece_rows, threads, [&](std::size_t piece, unsigned) {
    require_numbers_in(piece * piece_rows, std::min((piece + 1) * piece_rows, transitions_));
  });
}

void DataSet::require_numbers_in(std::size_t begin, std::size_t end) const {
  for (const DataFile& file : data_files(all_agents)) {
    const NumberTable& one = table(file.field, file.agent);
    if (const auto bad = one.find_unfit(begin, end))
      refuse(file.name(), fmt::format("{} at [{}]: expected a finite number that a float holds", one.exact(*bad),
                                      sct::npy_place(one.shape(), *bad)));
    if (file.field != DataField::done) continue;
    for (std::size_t row = begin; row < end; ++row)
      if (const float done = one.at(row); done != 0 && done != 1)
        refuse(file.name(), fmt::format("{} at [{}]: expected 0 or 1", done, sct::npy_place(one.shape(), row)));
  }
  for (std::size_t agent = 0; agent < all_agents; ++agent) require_succession(agent, begin, end);
}

void DataSet::require_succession(std::size_t agent, std::size_t begin, std::size_t end) const {
  const NumberTable& now = table(DataField::observation, agent);
  const NumberTable& next = table(DataField::next_observation, agent);
  const auto name = [&](DataField field) { return DataFile{field, agent}.name(); };
  for (std::size_t row = begin; row < end && row + 1 < transitions_; ++row) {
    const bool last = (row + 1) % episode_steps() == 0;
    const bool goes_on = next.same_row(row, now, row + 1);
    if (!last && !goes_on)
      refuse(
          name(DataField::next_observation),
          fmt::format("row {} is not row {} of {}, though both are of one episode of {} steps; store episodes of this "
                      "length one after the other",
                      row, row + 1, name(DataField::observation), episode_steps()));
    // A new episode that begins exactly where the last one ended is none, unless nothing ever moves here.
    if (last && goes_on && !next.same_row(row, now, row))
      refuse(name(DataField::next_observation),
             fmt::format("row {} is row {} of {}: an episode goes on beyond {} steps; store episodes of this length",
                         row, row + 1, name(DataField::observation), episode_steps()));
  }
}

std::vector<std::string_view> DataSet::episode_bytes(std::size_t episode) const {
  std::vector<std::string_view> rows;
  rows.reserve(tables_.size());
  for (const NumberTable& one : tables_)
    rows.push_back(one.bytes(episode * episode_steps(), (episode + 1) * episode_steps()));
  return rows;
}

}  // namespace folk::mpe
