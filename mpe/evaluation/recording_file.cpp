#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/evaluation/recording_columns.h>
#include <folk/mpe/evaluation/recording_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <system_error>

namespace folk::mpe {
namespace {

constexpr std::string_view mend = "recordings have the columns that mpe-evaluate --record writes";

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// Reads all of a field; nothing when it is no such number.
template <class Number>
std::optional<Number> number_of(std::string_view field) {
  Number number{};
  const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  if (error != std::errc() || stop != field.data() + field.size()) return std::nullopt;
  return number;
}

class Reader {
public:
  Reader(std::string_view text, const std::string& source, RewardRule rule)
      : text_(text),
        source_(excerpt(source, 1000)),
        rule_(rule) {}

  std::vector<EpisodeRecord> read() {
    read_header();
    while (next_line()) read_row();
    if (episodes_.empty()) refuse("no rows: expected those of an episode, t = 0, 1, ...");
    require_steps();
    return std::move(episodes_);
  }

private:
  using Places = std::map<std::string_view, std::size_t>;

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputFileError(fmt::format("{}:{}: {}", source_, std::max<std::size_t>(line_number_, 1), why));
  }

  bool next_line() {
    if (text_.empty()) return false;
    const std::size_t end = text_.find('\n');
    line_ = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    ++line_number_;
    return true;
  }

  void read_header() {
    if (!next_line()) refuse("empty; name a file of recorded episodes");
    Places places;
    const auto names = fields_of(line_);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!places.emplace(names[i], i).second) refuse(fmt::format("column '{}' twice", excerpt(names[i])));
    choose_scenario(places);
    fields_ = names.size();
    episode_place_ = places.at("episode");
    t_place_ = places.at("t");
    for (const auto& column : columns_) places_.push_back(places.at(column.name));
  }

  /// The scenario whose columns these are; otherwise says what is wrong with the nearest one's.
  void choose_scenario(const Places& places) {
    std::size_t fewest = ~std::size_t{0};
    std::vector<std::string> missing;
    for (const char* name : {"simple_tag", "simple_world"}) {
      Scenario scenario = Scenario::named(name, rule_);
      auto columns = recording_columns(scenario);
      auto absent = absent_columns(columns, places);
      const std::size_t known = columns.size() + 2 - absent.size();
      const std::size_t faults = absent.size() + places.size() - known;
      if (faults >= fewest) continue;
      fewest = faults;
      scenario_ = std::move(scenario);
      columns_ = std::move(columns);
      missing = std::move(absent);
    }
    if (2 * missing.size() > columns_.size())
      refuse(fmt::format("expected the names of columns: episode,t,agent0.px,...; {}", mend));
    if (!missing.empty())
      refuse(fmt::format("no column '{}', as a recorded {} has; {}", missing.front(), scenario_.name, mend));
    if (fewest > 0) refuse_unknown();
  }

  static std::vector<std::string> absent_columns(const std::vector<RecordingColumn>& columns, const Places& places) {
    std::vector<std::string> absent;
    for (const char* name : {"episode", "t"})
      if (!places.contains(name)) absent.emplace_back(name);
    for (const auto& column : columns)
      if (!places.contains(column.name)) absent.push_back(column.name);
    return absent;
  }

  [[noreturn]] void refuse_unknown() const {
    std::set<std::string_view> known{"episode", "t"};
    for (const auto& column : columns_) known.insert(column.name);
    const auto names = fields_of(line_);
    const auto unknown =
        std::find_if(names.begin(), names.end(), [&](std::string_view name) { return !known.contains(name); });
    refuse(fmt::format("column '{}' is none of a recorded {}; take it out", excerpt(*unknown), scenario_.name));
  }

  void read_row() {
    const auto fields = fields_of(line_);
    if (fields.size() != fields_)
      refuse(fmt::format("{} fields, line 1 has {}; was the file cut off?", fields.size(), fields_));
    const std::uint64_t episode = whole(fields[episode_place_], "episode");
    begin_row(episode, whole(fields[t_place_], "t"));
    std::vector<double> numbers;
    for (std::size_t c = 0; c < columns_.size(); ++c) numbers.push_back(number(fields[places_[c]], columns_[c].name));
    auto row = row_of_numbers(scenario_, numbers);
    const auto kept = to_numbers(scenario_, row);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (kept[c] != numbers[c])
        refuse(fmt::format("{} {}: expected 0, landmarks stand still", columns_[c].name, numbers[c]));
      if (episodes_.back().rows.empty() && columns_[c].quantity == Quantity::action && numbers[c] != 0)
        refuse(fmt::format("{} {}: expected 0, no action leads to the reset at t = 0", columns_[c].name, numbers[c]));
    }
    auto& rows = episodes_.back().rows;
    for (std::size_t i = scenario_.agents(); i < row.state.positions.size() && !rows.empty(); ++i)
      if (row.state.positions[i] != rows.front().state.positions[i])
        refuse(fmt::format("{} is not where it was at t = 0: landmarks stand still", scenario_.entities[i].name));
    rows.push_back(std::move(row));
  }

  /// Goes on with the episode or begins the next.
  void begin_row(std::uint64_t episode, std::uint64_t t) {
    if (episodes_.empty() || episodes_.back().number != episode) {
      require_steps();
      if (!numbers_.insert(episode).second)
        refuse(fmt::format("episode {} again, after another; the rows of an episode must follow each other", episode));
      EpisodeRecord next;
      next.scenario = scenario_;
      next.number = episode;
      episodes_.push_back(std::move(next));
    }
    if (const std::size_t expected = episodes_.back().rows.size(); t != expected)
      refuse(
          fmt::format("t {} of episode {}: expected {}; the rows of an episode count up from 0", t, episode, expected));
    if (t > 0) episodes_.back().scenario.episode_steps = t;
  }

  void require_steps() const {
    if (!episodes_.empty() && episodes_.back().rows.size() < 2)
      refuse(fmt::format("episode {} ends before its first step: expected a row of t = 1", episodes_.back().number));
  }

  std::uint64_t whole(std::string_view field, std::string_view name) const {
    const auto number = number_of<std::uint64_t>(field);
    if (!number) refuse(fmt::format("{} '{}': expected a whole number from 0 on", name, excerpt(field)));
    return *number;
  }

  double number(std::string_view field, const std::string& name) const {
    const auto number = number_of<double>(field);
    if (!number || !std::isfinite(*number))
      refuse(fmt::format("{} '{}': expected a finite number", name, excerpt(field)));
    if (std::abs(*number) > largest_action)
      refuse(fmt::format("{} {}: expected a number up to {} in size", name, *number, largest_action));
    return *number;
  }

  std::string_view text_;
  std::string source_;
  RewardRule rule_;
  std::string_view line_;
  std::size_t line_number_ = 0;

  Scenario scenario_;
  std::vector<RecordingColumn> columns_;
  std::vector<std::size_t> places_;  // of the columns among a line's fields
  std::size_t episode_place_ = 0;
  std::size_t t_place_ = 0;
  std::size_t fields_ = 0;

  std::vector<EpisodeRecord> episodes_;
  std::set<std::uint64_t> numbers_;
};

}  // namespace

std::vector<EpisodeRecord> parse_recording(std::string_view text, const std::string& source, RewardRule rule) {
  return Reader(text, source, rule).read();
}

std::vector<EpisodeRecord> read_recording(const std::filesystem::path& path, RewardRule rule) {
  return parse_recording(read_text_file(path), path.string(), rule);
}

std::string recording_text(std::span<const EpisodeRecord> episodes) {
  if (episodes.empty()) throw UsageError("no episode to write down");
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "episode,t");
  for (const auto& column : recording_columns(episodes.front().scenario)) fmt::format_to(out, ",{}", column.name);
  fmt::format_to(out, "\n");
  for (const auto& episode : episodes) {
    if (episode.scenario.name != episodes.front().scenario.name)
      throw UsageError(fmt::format("episodes of {} and of {}: write a file for each", episodes.front().scenario.name,
                                   episode.scenario.name));
    for (std::size_t t = 0; t < episode.rows.size(); ++t)
      fmt::format_to(out, "{},{},{}\n", episode.number, t,
                     fmt::join(to_numbers(episode.scenario, episode.rows[t]), ","));
  }
  return fmt::to_string(text);
}

void write_recording(const std::filesystem::path& path, std::span<const EpisodeRecord> episodes) {
  write_file(path, recording_text(episodes));
}

}  // namespace folk::mpe
