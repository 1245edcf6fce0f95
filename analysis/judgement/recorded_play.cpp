#include <folk/analysis/judgement/recorded_play.h>
#include <folk/analysis/tournament/csv_lines.h>
#include <folk/games/error.h>
#include <folk/games/rational.h>
#include <folk/strategies/names.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

namespace folk {
namespace {

constexpr std::string_view columns_wanted = "a header with the columns match,round,own,theirs and perhaps belief";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // spreadsheets begin files with it

enum Column : std::size_t { match, round_number, own, theirs, belief };
constexpr std::array<std::string_view, 5> column_names{"match", "round", "own", "theirs", "belief"};

struct Row {
  std::uint64_t number;
  std::size_t line;
  BeliefRound round;
};

struct Rows {
  std::string name;
  std::vector<Row> rows;
};

class Reader {
public:
  Reader(std::string_view text, const std::string& source, const std::array<std::string, 2>& actions)
      : lines_(text.substr(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0), source),
        actions_(actions) {
    if (!lines_.next()) refuse_file(source, fmt::format("no recorded play: expected {}", columns_wanted));
    read_header();
    std::uint64_t rounds = 0;
    while (lines_.next()) {
      if (++rounds > most_judged_rounds)
        lines_.refuse(fmt::format("more than {} rounds: give fewer matches", most_judged_rounds));
      read_row();
    }
    if (rounds == 0) refuse_file(source, "no round after the header: expected a line a round");
  }

  RecordedPlay play() {
    std::uint64_t first = most_judged_rounds;
    for (const auto& [name, rows] : matches_)
      for (const Row& row : rows) first = std::min(first, row.number);
    if (first > 1) first = 1;
    RecordedPlay play;
    for (Rows& rows : matches_) play.matches.push_back({rows.name, in_order(rows, first)});
    play.ignored_columns = std::move(ignored_);
    return play;
  }

private:
  void read_header() {
    const auto& fields = lines_.fields();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto known = std::find(column_names.begin(), column_names.end(), name_key(fields[i]));
      if (known == column_names.end()) {
        ignored_.push_back(fields[i]);
        continue;
      }
      auto& place = places_[static_cast<std::size_t>(known - column_names.begin())];
      if (place) lines_.refuse(fmt::format("column '{}' is there twice", *known));
      place = i;
    }
    columns_ = fields.size();
    for (const Column column : {match, round_number, own, theirs})
      if (!places_[column])
        lines_.refuse(fmt::format("no column '{}': expected {}", column_names[column], columns_wanted));
  }

  void read_row() {
    if (lines_.fields().size() != columns_)
      lines_.refuse(fmt::format("{} fields: expected {} as in the header", lines_.fields().size(), columns_));
    const auto name = field(match);
    if (name.empty()) lines_.refuse("no match named: expected a name or a number in column 'match'");
    Row row{};
    row.line = lines_.number();
    row.number = number();
    row.round = {{move(own), move(theirs)}, stated_belief()};
    row.round.truth = row.round.theirs == Move::C ? 1 : 0;
    const auto [place, fresh] = known_.try_emplace(std::string(name), matches_.size());
    if (fresh) matches_.push_back({std::string(name), {}});
    matches_[place->second].rows.push_back(row);
  }

  std::string_view field(Column column) const { return trimmed(lines_.fields()[*places_[column]]); }

  std::uint64_t number() const {
    const auto found = whole_number(field(round_number));
    if (!found || *found > most_judged_rounds)
      lines_.refuse(fmt::format("round '{}': expected a whole number from 1 to {}", excerpt(field(round_number)),
                                most_judged_rounds));
    return *found;
  }

  Move move(Column column) const {
    const auto text = field(column);
    for (const Move move : {Move::C, Move::D})
      if (text == actions_[bit(move)]) return move;
    if (text == "C" || text == "c" || text == "0") return Move::C;
    if (text == "D" || text == "d" || text == "1") return Move::D;
    const bool named = actions_ != std::array<std::string, 2>{"C", "D"};
    lines_.refuse(fmt::format("{} '{}': expected {}C or D, or 0 for C and 1 for D", column_names[column], excerpt(text),
                              named ? fmt::format("{} or {}, ", excerpt(actions_[0]), excerpt(actions_[1])) : ""));
  }

  std::optional<double> stated_belief() const {
    if (!places_[belief] || field(belief).empty()) return std::nullopt;
    try {
      return parse_number(field(belief), "belief", 0, 1);
    } catch (const UsageError& error) {
      lines_.refuse(error.what());
    }
  }

  /// The rounds from `first` on, each of them there once.
  BeliefMatch in_order(Rows& match, std::uint64_t first) const {
    std::stable_sort(match.rows.begin(), match.rows.end(),
                     [](const Row& a, const Row& b) { return a.number < b.number; });
    BeliefMatch rounds;
    rounds.reserve(match.rows.size());
    for (const Row& row : match.rows) {
      const std::uint64_t expected = first + rounds.size();
      if (row.number < expected)
        lines_.refuse(row.line, fmt::format("round {} of match '{}' is there twice, also in line {}", row.number,
                                            excerpt(match.name), (&row - 1)->line));
      if (row.number > expected)
        lines_.refuse(row.line, fmt::format("round {} of match '{}': round {} is missing", row.number,
                                            excerpt(match.name), expected));
      rounds.push_back(row.round);
    }
    return rounds;
  }

  CsvLines lines_;
  const std::array<std::string, 2>& actions_;
  std::array<std::optional<std::size_t>, column_names.size()> places_{};
  std::size_t columns_ = 0;
  std::vector<std::string> ignored_;
  std::vector<Rows> matches_;
  std::unordered_map<std::string, std::size_t> known_;
};

}  // namespace

std::uint64_t RecordedPlay::rounds() const {
  std::uint64_t sum = 0;
  for (const auto& match : matches) sum += match.rounds.size();
  return sum;
}

std::uint64_t RecordedPlay::longest_match() const {
  std::size_t most = 0;
  for (const auto& match : matches) most = std::max(most, match.rounds.size());
  return most;
}

bool RecordedPlay::has_beliefs() const {
  for (const auto& match : matches)
    for (const auto& round : match.rounds)
      if (round.belief) return true;
  return false;
}

RecordedPlay read_recorded_play(std::string_view text, const std::string& source,
                                const std::array<std::string, 2>& actions) {
  return Reader(text, source, actions).play();
}

}  // namespace folk
