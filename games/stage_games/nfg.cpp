#include <folk/games/error.h>
#include <folk/games/stage_games/nfg.h>
#include <folk/games/stage_games/nfg_lexer.h>
#include <folk/games/text_file.h>

#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace folk {
namespace {

using Kind = NfgToken::Kind;
using Pair = std::array<Rational, 2>;

/// Numbers the actions that share a name, as Gambit does: "leave", "leave" are "leave_1", "leave_2"; a number that
/// makes another action's name is passed over.
void number_repeated(std::vector<std::string>& names) {
  std::unordered_map<std::string, std::size_t> times;
  for (const auto& name : names) ++times[name];
  std::unordered_set<std::string> taken(names.begin(), names.end());
  std::unordered_map<std::string, std::size_t> last;
  for (auto& name : names) {
    if (times.at(name) == 1) continue;
    std::string numbered;
    do numbered = name + "_" + std::to_string(++last[name]);
    while (!taken.insert(numbered).second);
    name = std::move(numbered);
  }
}

/// Reads one file from front to back, one word ahead.
class Reader {
public:
  Reader(std::string_view text, const std::string& source)
      : lexer_(text, source),
        token_(lexer_.next()) {}

  StageGame game() {
    header();
    std::string title = text("the game's title in double quotes");
    auto names = players();
    auto actions = action_names();
    std::string comment;
    if (token_.kind == Kind::text) comment = take().value;
    auto payoffs = body(actions[0].size(), actions[1].size());
    if (token_.kind != Kind::end)
      refuse("'" + excerpt(token_.value) + "' after the last of the game's payoffs",
             fmt::format("a {}x{} game needs no more, remove it", actions[0].size(), actions[1].size()));
    return StageGame(std::move(title), std::move(names), std::move(actions), std::move(payoffs), std::move(comment));
  }

private:
  NfgToken take() { return std::exchange(token_, lexer_.next()); }

  [[noreturn]] void refuse(const std::string& what, const std::string& mend) const {
    lexer_.refuse(token_.line, what + "; " + mend);
  }

  [[noreturn]] void expected(const std::string& what) const {
    refuse(token_.kind == Kind::end ? "the file ends too soon" : "'" + excerpt(token_.value) + "' does not belong here",
           "expected " + what);
  }

  NfgToken take(Kind kind, const std::string& what) {
    if (token_.kind != kind) expected(what);
    return take();
  }

  std::string text(const std::string& what) { return take(Kind::text, what).value; }

  void header() {
    if (token_.value == "EFG") refuse("an extensive game (EFG)", "save it from Gambit as a strategic game (.nfg)");
    if (token_.kind != Kind::word || token_.value != "NFG")
      refuse("this is no .nfg file", "it must begin with: NFG 1 R \"title\" { \"player 1\" \"player 2\" }");
    take();
    if (token_.kind != Kind::number || token_.value != "1") expected("the version 1 after NFG");
    take();
    if (token_.kind != Kind::word || (token_.value != "R" && token_.value != "D")) expected("R or D after NFG 1");
    take();
  }

  std::array<std::string, 2> players() {
    take(Kind::open, "{ and the two players' names");
    std::vector<std::string> names;
    while (token_.kind == Kind::text) names.push_back(take().value);
    if (token_.kind == Kind::close && names.size() != 2)
      refuse(fmt::format("a game of {} player{}", names.size(), names.size() == 1 ? "" : "s"),
             "Folk plays games of two players");
    take(Kind::close, "} after the players' names in double quotes");
    return {std::move(names[0]), std::move(names[1])};
  }

  /// { { "C" "D" } { "C" "D" } } or { 2 2 }.
  std::array<std::vector<std::string>, 2> action_names() {
    take(Kind::open, "{ and the players' actions");
    std::array<std::vector<std::string>, 2> actions;
    for (auto& names : actions) names = token_.kind == Kind::open ? listed_actions() : numbered_actions();
    take(Kind::close, "} after the actions of the two players");
    const std::size_t profiles = actions[0].size() * actions[1].size();
    if (actions[0].size() > most_nfg_profiles / actions[1].size())
      refuse(fmt::format("a game of {} x {} actions", actions[0].size(), actions[1].size()),
             fmt::format("Folk reads games of up to {} profiles", most_nfg_profiles));
    // A profile takes at least a digit and a blank: do not set memory aside for what cannot come.
    if (2 * profiles > lexer_.left() + token_.value.size() + 2)
      refuse(fmt::format("the rest of the file is too short for the payoffs of {} x {} actions", actions[0].size(),
                         actions[1].size()),
             "complete it or correct the number of actions");
    return actions;
  }

  std::vector<std::string> listed_actions() {
    take(Kind::open, "{ and the names of a player's actions");
    std::vector<std::string> names;
    while (token_.kind == Kind::text) {
      names.push_back(token_.value.empty() ? std::to_string(names.size() + 1) : token_.value);
      take();
    }
    if (token_.kind == Kind::close && names.empty()) refuse("a player without actions", "name at least one");
    take(Kind::close, "} after the names of a player's actions in double quotes");
    number_repeated(names);
    return names;
  }

  std::vector<std::string> numbered_actions() {
    const std::size_t count = index("the number of a player's actions", 1, most_nfg_profiles);
    std::vector<std::string> names;
    names.reserve(count);
    for (std::size_t i = 1; i <= count; ++i) names.push_back(std::to_string(i));
    return names;
  }

  std::size_t index(const std::string& what, std::size_t low, std::size_t high) {
    if (token_.kind != Kind::number) expected(what);
    std::size_t value = 0;
    const char* end = token_.value.data() + token_.value.size();
    const auto [stop, error] = std::from_chars(token_.value.data(), end, value);
    if (error != std::errc() || stop != end || value < low || value > high)
      refuse("'" + excerpt(token_.value) + "' cannot be " + what,
             fmt::format("expected a whole number from {} to {}", low, high));
    take();
    return value;
  }

  Rational number(const std::string& what) {
    if (token_.kind != Kind::number) expected(what);
    try {
      Rational value = parse_rational(token_.value);
      take();
      return value;
    } catch (const UsageError& error) {
      lexer_.refuse(token_.line, error.what());
    }
  }

  Pair pair() {
    Rational row = number("a payoff of the first player");
    if (token_.kind == Kind::comma) refuse("a comma between payoffs", "separate them by blanks as Gambit does");
    return {std::move(row), number("a payoff of the second player")};
  }

  std::vector<Pair> body(std::size_t rows, std::size_t columns) {
    if (token_.kind != Kind::open && token_.kind != Kind::number)
      expected("the payoffs, or { and the list of outcomes");
    const bool by_outcome = token_.kind == Kind::open;
    const std::vector<Pair> outcomes = by_outcome ? outcome_list() : std::vector<Pair>{};
    std::vector<Pair> payoffs(rows * columns);
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t i = 0; i < rows; ++i) payoffs[i * columns + j] = by_outcome ? chosen(outcomes) : pair();
    return payoffs;
  }

  Pair chosen(const std::vector<Pair>& outcomes) {
    const std::size_t which = index("the number of a profile's outcome", 0, outcomes.size());
    return which == 0 ? Pair{} : outcomes[which - 1];
  }

  /// { { "name" 3, 3 } { "" 0 5 } }: a comma after a payoff is as good as none.
  std::vector<Pair> outcome_list() {
    take(Kind::open, "{ and the list of outcomes");
    std::vector<Pair> outcomes;
    while (token_.kind == Kind::open) {
      take();
      text("an outcome's name in double quotes");
      Pair& payoffs = outcomes.emplace_back();
      for (auto& payoff : payoffs) {
        payoff = number("an outcome's two payoffs");
        if (token_.kind == Kind::comma) take();
      }
      take(Kind::close, "} after an outcome's two payoffs");
    }
    take(Kind::close, "} after the list of outcomes");
    return outcomes;
  }

  NfgLexer lexer_;
  NfgToken token_;
};

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

template <class Names>
std::string quoted_list(const Names& names) {
  std::string result = "{ ";
  for (const std::string& name : names) result += quoted(name) + ' ';
  return result + '}';
}

}  // namespace

StageGame read_nfg(std::string_view text, const std::string& source) { return Reader(text, source).game(); }

StageGame read_nfg_file(const std::filesystem::path& path) { return read_nfg(read_text_file(path), path.string()); }

std::string write_nfg(const StageGame& game, NfgForm form) {
  std::string text = "NFG 1 R " + quoted(game.title()) + ' ' + quoted_list(game.players()) + "\n\n{ " +
                     quoted_list(game.actions(Seat::first)) + '\n' + quoted_list(game.actions(Seat::second)) + "\n}\n" +
                     quoted(game.comment()) + "\n\n";
  const bool by_outcome = form == NfgForm::outcome;
  std::string indices;
  if (by_outcome) text += "{\n";
  std::size_t outcomes = 0;
  for (std::size_t j = 0; j < game.columns(); ++j) {
    for (std::size_t i = 0; i < game.rows(); ++i) {
      const std::string row = to_text(game.payoff(Seat::first, i, j));
      const std::string column = to_text(game.payoff(Seat::second, i, j));
      auto out = std::back_inserter(text);
      if (by_outcome)
        fmt::format_to(out, "{{ \"\" {}, {} }}\n", row, column);
      else
        fmt::format_to(out, "{} {}\n", row, column);
      indices += std::to_string(++outcomes) + ' ';
    }
  }
  return by_outcome ? text + "}\n" + indices + '\n' : text;
}

}  // namespace folk
