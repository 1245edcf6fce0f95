#include <folk/tools/payoff_region/output.h>

#include <folk/tools/choices/game_option.h>
#include <folk/tools/program/csv.h>
#include <folk/tools/program/table.h>

#include <fmt/format.h>
#include <folk/games/utf8.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

/// How many digits the payoffs of each seat are shown with.
using Digits = std::array<int, 2>;
constexpr int usual_digits = 9;
constexpr int most_digits = 17;

/// For the eye: exact unless that is long. -0 is 0.
std::string text_of(const std::string& exact, double value, int digits) {
  constexpr std::size_t longest = 15;
  return exact.size() <= longest ? exact : fmt::format("{:.{}g}", value, digits);
}

std::string text_of(const Rational& value, int digits) { return text_of(to_text(value), to_double(value), digits); }

std::string text_of(double value, int digits) {
  value += 0.0;
  return text_of(fmt::format("{}", value), value, digits);
}

template <class Number>
std::string text_of(const Point<Number>& point, const Digits& digits) {
  return fmt::format("({}, {})", text_of(point[0], digits[0]), text_of(point[1], digits[1]));
}

/// Nine digits of the payoffs' range: more where the payoffs are far from 0.
Digits digits_for(const StageGame& game) {
  Digits digits{};
  for (const Seat seat : both_seats) {
    double least = INFINITY;
    double most = -INFINITY;
    for (std::size_t i = 0; i < game.rows(); ++i)
      for (std::size_t j = 0; j < game.columns(); ++j) {
        const double payoff = to_double(game.payoff(seat, i, j));
        least = std::min(least, payoff);
        most = std::max(most, payoff);
      }
    const double distance = std::max(std::abs(least), std::abs(most)) / (most - least);
    const double more = distance > 1 && std::isfinite(distance) ? std::floor(std::log10(distance)) : 0;
    digits[index(seat)] = static_cast<int>(std::min<double>(usual_digits + more, most_digits));
  }
  return digits;
}

/// As many as tell corners that differ from each other.
template <class Number>
Digits separating(const Polygon<Number>& polygon, Digits digits) {
  const auto alike = [&] {
    std::set<std::string> texts;
    for (const auto& corner : polygon) texts.insert(text_of(corner, digits));
    return texts.size() < polygon.size();
  };
  while (std::max(digits[0], digits[1]) < most_digits && alike())
    for (int& of_seat : digits) of_seat = std::min(of_seat + 1, most_digits);
  return digits;
}

/// Corners in lines of a readable length.
template <class Number>
std::string text_of(const Polygon<Number>& polygon, const Digits& least_digits) {
  constexpr std::size_t width = 100;
  const Digits digits = separating(polygon, least_digits);
  std::string text;
  std::string line;
  for (const auto& corner : polygon) {
    const std::string item = text_of(corner, digits);
    if (!line.empty() && line.size() + item.size() + 1 > width) {
      text += "  " + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + item;
  }
  return text + "  " + (line.empty() ? "none" : line) + "\n";
}

bool blank(const std::string& name) { return name.find_first_not_of(" \t\r\n") == std::string::npos; }

/// An action's name; one of blanks alone would not be seen.
std::string shown_action(const std::string& name) {
  return blank(name) ? "\"" + visible_text(name) + "\"" : visible_text(name);
}

std::string corners(std::size_t count) {
  return count == 0 ? "empty" : count == 1 ? "a point" : count == 2 ? "a segment" : fmt::format("{} corners", count);
}

Point<Rational> payoffs_of(const StageGame& game, const MixedProfile& profile) {
  return {expected_payoff(game, Seat::first, profile), expected_payoff(game, Seat::second, profile)};
}

std::string equilibria_text(const RegionReport& report) {
  if (!report.equilibria)
    return fmt::format("stage equilibria: not listed, for games of at most {} actions in all only\n",
                       most_equilibrium_actions);
  const auto& [extreme, degenerate] = *report.equilibria;
  std::string text = fmt::format("stage equilibria: {}{}\n", extreme.size(), degenerate ? " extreme ones" : "");
  const auto players = shown_players(report.game);
  const Digits digits = digits_for(report.game);
  Table table({"", players[0], players[1], "payoffs"});
  for (const MixedProfile& profile : extreme)
    table.add({is_pure(profile) ? "  pure" : "  mixed", mixture_text(profile.row, report.game.actions(Seat::first)),
               mixture_text(profile.column, report.game.actions(Seat::second)),
               text_of(payoffs_of(report.game, profile), digits)});
  text += table.text();
  if (degenerate) text += "  the game is degenerate: mixtures of these may be equilibria too, whole segments or more\n";
  return text;
}

std::string set_text(const EquilibriumSet& set, const Digits& digits) {
  std::string text =
      fmt::format("payoffs of pure-strategy subgame-perfect equilibria at d = {}: ", to_short_text(set.discount));
  if (set.corners.empty())
    return text +
           "none\n  there is no such equilibrium, whatever the players' threats; mixed stage equilibria are above\n";
  return text + corners(set.corners.size()) + "\n" + text_of(set.corners, digits) +
         fmt::format(
             "  with public randomisation; worst {}; {} steps, of which the last moved it by {:.2g} of the range\n",
             text_of(set.worst, digits), set.steps, set.change);
}

std::string tournament_text(const RegionTournament& tournament) {
  std::set<Point<double>> distinct;
  for (const auto& pair : tournament.pairs) distinct.insert(pair.payoffs);
  std::string text = fmt::format(
      "tournament: {} strategies ({}{}), {}, noise {}, seed {}: {} pairs at {} points; --format csv lists them\n",
      tournament.strategies, tournament.roster, tournament.included.empty() ? "" : ", with " + tournament.included,
      tournament.criterion, to_short_text(tournament.noise), tournament.seed, tournament.pairs.size(), distinct.size());
  text = visible_line(text);
  for (const auto& note : tournament.notes) text += visible_line("note: " + note + "\n");
  return text;
}

Json number(const Rational& value) { return to_double(value); }

Json number(double value) { return value; }

template <class Number>
Json json_of(const Point<Number>& point) {
  return {number(point[0]), number(point[1])};
}

template <class Number>
Json json_of(const Polygon<Number>& polygon) {
  Json array = Json::array();
  for (const auto& corner : polygon) array.push_back(json_of(corner));
  return array;
}

Json fractions(const std::vector<Rational>& values) {
  Json array = Json::array();
  for (const Rational& value : values) array.push_back(value.str());  // "2/5"
  return array;
}

Json equilibria_json(const RegionReport& report) {
  if (!report.equilibria) return nullptr;
  Json list = Json::array();
  for (const MixedProfile& profile : report.equilibria->extreme)
    list.push_back({{"pure", is_pure(profile)},
                    {"row", fractions(profile.row)},
                    {"column", fractions(profile.column)},
                    {"payoffs", json_of(payoffs_of(report.game, profile))}});
  return {{"degenerate", report.equilibria->degenerate}, {"extreme", std::move(list)}};
}

Json minmax_json(const PayoffRegion& region) {
  Json punishments = Json::array();
  Json securities = Json::array();
  for (const Minmax& seat : region.minmax) {
    punishments.push_back(fractions(seat.punishment));
    securities.push_back(fractions(seat.security));
  }
  return {{"pure", json_of(region.pure_minmax())},
          {"mixed", json_of(region.mixed_minmax())},
          {"mixed_exact", fractions({region.minmax[0].mixed, region.minmax[1].mixed})},
          {"punishment", std::move(punishments)},
          {"security", std::move(securities)}};
}

Json set_json(const std::optional<EquilibriumSet>& set) {
  if (!set) return nullptr;
  const bool none = set->corners.empty();
  return {{"discount", set->discount},
          {"exists", !none},
          {"corners", json_of(set->corners)},
          {"worst", none ? Json(nullptr) : json_of(set->worst)},
          {"steps", set->steps},
          {"change", set->change}};
}

Json tournament_json(const std::optional<RegionTournament>& tournament) {
  if (!tournament) return nullptr;
  Json pairs = Json::array();
  for (const auto& pair : tournament->pairs)
    pairs.push_back({{"first", pair.first}, {"second", pair.second}, {"payoffs", json_of(pair.payoffs)}});
  return {{"roster", tournament->roster},       {"included", tournament->included},
          {"criterion", tournament->criterion}, {"noise", tournament->noise.probability()},
          {"seed", tournament->seed},           {"strategies", tournament->strategies},
          {"notes", tournament->notes},         {"pairs", std::move(pairs)}};
}

}  // namespace

std::array<std::string, 2> shown_players(const StageGame& game) {
  auto names = game.players();
  for (std::size_t seat = 0; seat < 2; ++seat)
    names[seat] = blank(names[seat]) ? (seat == 0 ? "the row player" : "the column player") : visible_text(names[seat]);
  return names;
}

std::string mixture_text(const MixedAction& mixture, const std::vector<std::string>& actions) {
  std::string text;
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    if (mixture[i] == 0) continue;
    if (!text.empty()) text += " + ";
    const std::string name = shown_action(actions[i]);
    text += mixture[i] == 1 ? name : mixture[i].str() + " " + name;
  }
  return text;
}

void write_text(std::ostream& out, const RegionReport& report) {
  const PayoffRegion& region = report.region;
  const auto players = shown_players(report.game);
  const Digits digits = digits_for(report.game);
  out << fmt::format("{}: {} x {}, payoffs of ({}, {})\n\n", shown_title(report.title), report.game.rows(),
                     report.game.columns(), players[0], players[1]);
  out << equilibria_text(report) << '\n';
  out << fmt::format("feasible payoffs: {}\n{}\n", corners(region.feasible.size()), text_of(region.feasible, digits));
  out << fmt::format("minmax point, pure:  {}\nminmax point, mixed: {}\n", text_of(region.pure_minmax(), digits),
                     text_of(region.mixed_minmax(), digits));
  for (const Seat seat : both_seats) {
    const std::size_t i = index(seat);
    out << fmt::format("  {} is held to {} by {}\n", players[i], text_of(region.minmax[i].mixed, digits[i]),
                       mixture_text(region.minmax[i].punishment, report.game.actions(other(seat))));
  }
  out << fmt::format("\nindividually rational payoffs (mixed minmax): {}\n{}",
                     corners(region.individually_rational.size()), text_of(region.individually_rational, digits));
  if (region.pure_individually_rational != region.individually_rational)
    out << fmt::format("individually rational payoffs (pure minmax): {}\n{}",
                       corners(region.pure_individually_rational.size()),
                       text_of(region.pure_individually_rational, digits));
  if (report.set) out << '\n' << set_text(*report.set, digits);
  if (report.tournament) out << '\n' << tournament_text(*report.tournament);
}

void write_csv(std::ostream& out, const RegionReport& report) {
  const auto line = [&](const char* kind, const std::string& first, const std::string& second, double row,
                        double column) {
    out << fmt::format("{},{},{},{},{}\n", kind, csv_field(first), csv_field(second), row, column);
  };
  const auto exact_line = [&](const char* kind, const std::string& first, const std::string& second,
                              const Point<Rational>& point) {
    line(kind, first, second, to_double(point[0]), to_double(point[1]));
  };
  const PayoffRegion& region = report.region;
  out << "kind,first,second,row,column\n";
  if (report.equilibria)
    for (const MixedProfile& profile : report.equilibria->extreme)
      exact_line("stage_equilibrium", mixture_text(profile.row, report.game.actions(Seat::first)),
                 mixture_text(profile.column, report.game.actions(Seat::second)), payoffs_of(report.game, profile));
  for (const auto& corner : region.feasible) exact_line("feasible", "", "", corner);
  exact_line("pure_minmax", "", "", region.pure_minmax());
  exact_line("mixed_minmax", "", "", region.mixed_minmax());
  for (const auto& corner : region.individually_rational) exact_line("individually_rational", "", "", corner);
  for (const auto& corner : region.pure_individually_rational) exact_line("pure_individually_rational", "", "", corner);
  if (report.set)
    for (const auto& corner : report.set->corners) line("equilibrium", "", "", corner[0], corner[1]);
  if (report.tournament)
    for (const auto& pair : report.tournament->pairs)
      line("pair", pair.first, pair.second, pair.payoffs[0], pair.payoffs[1]);
}

void write_json(std::ostream& out, const RegionReport& report) {
  const PayoffRegion& region = report.region;
  const Json object{{"game", report.title},
                    {"players", report.game.players()},
                    {"actions", Json::array({report.game.actions(Seat::first), report.game.actions(Seat::second)})},
                    {"stage_equilibria", equilibria_json(report)},
                    {"feasible", json_of(region.feasible)},
                    {"minmax", minmax_json(region)},
                    {"individually_rational", json_of(region.individually_rational)},
                    {"pure_individually_rational", json_of(region.pure_individually_rational)},
                    {"equilibria", set_json(report.set)},
                    {"tournament", tournament_json(report.tournament)}};
  // A line for each part, so that people can read it too.
  const char* separator = "{\n";
  for (const auto& [key, value] : object.items()) {
    out << separator << fmt::format("  \"{}\": {}", key, value.dump(-1, ' ', false, Json::error_handler_t::replace));
    separator = ",\n";
  }
  out << "\n}\n";
}

}  // namespace folk::tools
