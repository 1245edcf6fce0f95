#include <folk/tools/choices/game_option.h>

#include <folk/tools/program/standard_input.h>

#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/games/stage_games/nfg.h>
#include <folk/games/utf8.h>

#include <typeinfo>

namespace folk::tools {

void add_game_options(po::options_description& options) {
  auto add = options.add_options();
  add("payoffs", po::value<std::string>(), "a prisoner's dilemma (default T=5,R=3,P=1,S=0)");
  add("game", po::value<std::string>(),
      "a symmetric 2x2 game from a .nfg file, its first action taken as C; - is the standard input");
}

StageGame read_game(const std::string& file) {
  return file == "-" ? read_nfg(read_standard_input("--game -"), "standard input") : read_nfg_file(file);
}

StageGame named_game(const po::variables_map& values) {
  const auto& value = values["game"].value();
  return value.type() == typeid(StageGame) ? boost::any_cast<StageGame>(value) : read_game(text_option(values, "game"));
}

ChosenGame chosen_game(const po::variables_map& values) {
  ChosenGame chosen;
  chosen.from_file = values.count("game") != 0;
  const bool by_letters = values.count("payoffs") != 0;
  if (chosen.from_file && by_letters) throw UsageError("--game and --payoffs contradict: give one of them");
  if (by_letters) chosen.payoffs = parse_payoffs(text_option(values, "payoffs"));
  if (chosen.from_file) {
    const auto game = named_game(values);
    chosen.payoffs = symmetric_payoffs(game);
    chosen.title = game.title().empty() ? "without a title" : game.title();
    chosen.actions = {game.actions(Seat::first)[0], game.actions(Seat::first)[1]};
  }
  return chosen;
}

std::string action_words(const ChosenGame& game) {
  if (game.actions == ChosenGame{}.actions) return "";
  return fmt::format("C is {}, D is {}", visible_text(game.actions[0], 100), visible_text(game.actions[1], 100));
}

std::string shown_title(const std::string& title) { return visible_text(title, 200); }

std::string game_words(const std::string& title, const Payoffs& payoffs) {
  return fmt::format("{} ({})", shown_title(title), to_text(payoffs));
}

void note_unusual_payoffs(const ChosenGame& game, const Common& common) {
  if (game.from_file) return;
  if (const auto warning = dilemma_warning(game.payoffs)) common.note("note: " + *warning);
}

}  // namespace folk::tools
