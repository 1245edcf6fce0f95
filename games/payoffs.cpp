#include <folk/games/error.h>
#include <folk/games/payoffs.h>

#include <map>

namespace folk {

Payoffs prisoners_dilemma(const Rational& temptation, const Rational& reward, const Rational& punishment,
                          const Rational& sucker) {
  const Payoffs payoffs{temptation, reward, punishment, sucker};
  if (!(temptation > reward && reward > punishment && punishment > sucker))
    throw UsageError("payoffs " + to_text(payoffs) +
                     " are no prisoner's dilemma: it needs T > R > P > S (another symmetric 2x2 game can come from a "
                     ".nfg file)");
  return payoffs;
}

std::optional<std::string> dilemma_warning(const Payoffs& payoffs) {
  if (2 * payoffs.reward > payoffs.temptation + payoffs.sucker) return std::nullopt;
  return "2R <= T + S at " + to_text(payoffs) + ": taking turns to defect pays at least as much as mutual cooperation";
}

Payoffs parse_payoffs(std::string_view text) {
  const auto [t, r, p, s] = parse_symmetric_payoffs(text);
  return prisoners_dilemma(t, r, p, s);
}

std::string usual_name(const Payoffs& payoffs) {
  const auto& [t, r, p, s] = payoffs;
  if (t > r && r > p && p > s) return "prisoner's dilemma";
  if (r > t && t >= p && p > s) return "stag hunt";
  if (t > r && r > s && s > p) return "chicken";
  return "symmetric 2x2 game";
}

Payoffs parse_symmetric_payoffs(std::string_view text) {
  const auto refuse = [&](const std::string& why) -> UsageError {
    return UsageError("payoffs '" + excerpt(text, 60) + "': " + why + "; write T=5,R=3,P=1,S=0");
  };
  std::map<char, Rational> found;
  std::string_view rest = text;
  while (!rest.empty()) {
    const auto comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    if (item.size() < 3 || item[1] != '=' || std::string_view("TRPS").find(item[0]) == std::string_view::npos)
      throw refuse("'" + excerpt(item, 20) + "' is not a letter of T, R, P, S with a value");
    const std::string letter(1, item[0]);
    if (found.count(item[0]) != 0) throw refuse(letter + " is given twice");
    try {
      found[item[0]] = parse_rational(item.substr(2));
    } catch (const UsageError& error) {
      throw refuse(letter + ": " + error.what());
    }
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
    if (rest.empty()) throw refuse("it ends with a comma");
  }
  for (const char letter : {'T', 'R', 'P', 'S'})
    if (found.count(letter) == 0) throw refuse(std::string(1, letter) + " is missing");
  return {found['T'], found['R'], found['P'], found['S']};
}

std::string to_text(const Payoffs& payoffs) {
  return "T=" + to_text(payoffs.temptation) + ",R=" + to_text(payoffs.reward) + ",P=" + to_text(payoffs.punishment) +
         ",S=" + to_text(payoffs.sucker);
}

StageGame stage_game(const Payoffs& payoffs, const std::string& title) {
  const auto& [t, r, p, s] = payoffs;
  return StageGame(title, {"Row", "Column"}, {{{"C", "D"}, {"C", "D"}}}, {{r, r}, {s, t}, {t, s}, {p, p}});
}

Payoffs symmetric_payoffs(const StageGame& game) {
  if (game.rows() != 2 || game.columns() != 2)
    throw UsageError("game '" + excerpt(game.title()) + "' is " + std::to_string(game.rows()) + "x" +
                     std::to_string(game.columns()) + ": expected a symmetric 2x2 game");
  if (!game.is_symmetric())
    throw UsageError("game '" + excerpt(game.title()) + "' is not symmetric: expected a symmetric 2x2 game");
  return {game.payoff(Seat::first, 1, 0), game.payoff(Seat::first, 0, 0), game.payoff(Seat::first, 1, 1),
          game.payoff(Seat::first, 0, 1)};
}

}  // namespace folk
