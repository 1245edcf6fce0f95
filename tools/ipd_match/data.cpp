#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <folk/games/outcome.h>
#include <folk/tools/ipd_match/output.h>

namespace folk::tools {
namespace {

/// Exact where a decimal can be, else the nearest double.
std::string number(const Rational& value) {
  const std::string text = to_text(value);
  return text.find('/') == std::string::npos ? text : fmt::format("{}", to_double(value));
}

/// The numbers are written as text, because a JSON library would round a long one to a double.
std::string array_of(const std::vector<std::string>& items) { return fmt::format("[{}]", fmt::join(items, ",")); }

std::string string_of(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string numbers_of(const std::vector<Rational>& values) {
  std::vector<std::string> items(values.size());
  std::transform(values.begin(), values.end(), items.begin(), number);
  return array_of(items);
}

/// The rounds, from 1, in which noise flipped the move.
std::string slips_of(const std::vector<bool>& slipped) {
  std::vector<std::string> rounds;
  for (std::size_t t = 0; t < slipped.size(); ++t)
    if (slipped[t]) rounds.push_back(std::to_string(t + 1));
  return array_of(rounds);
}

std::string beliefs_of(const std::vector<double>& beliefs) {
  if (beliefs.empty()) return "null";
  std::vector<std::string> items;
  for (const double belief : beliefs) items.push_back(std::isnan(belief) ? "null" : fmt::format("{}", belief));
  return array_of(items);
}

std::string notes_of(const std::vector<std::string>& caveats) {
  std::vector<std::string> notes(caveats.size());
  std::transform(caveats.begin(), caveats.end(), notes.begin(), string_of);
  return array_of(notes);
}

std::string payoffs_of(const Payoffs& payoffs) {
  return fmt::format("{{\"T\":{},\"R\":{},\"P\":{},\"S\":{}}}", number(payoffs.temptation), number(payoffs.reward),
                     number(payoffs.punishment), number(payoffs.sucker));
}

}  // namespace

void write_csv(std::ostream& out, const MatchSettings& settings, const MatchRecord& record) {
  const auto by_outcome = settings.game.payoffs.by_outcome();
  std::array<std::string, 4> texts;
  std::transform(by_outcome.begin(), by_outcome.end(), texts.begin(), number);
  const auto belief = [&](Seat seat, std::size_t round) {
    const auto& beliefs = record.beliefs[index(seat)];
    return beliefs.empty() || std::isnan(beliefs[round]) ? std::string() : fmt::format("{}", beliefs[round]);
  };
  out << "round,move1,move2,score1,score2,belief1,belief2\n";
  for (std::size_t t = 0; t < record.transcript.rounds(); ++t) {
    const Outcome outcome = record.transcript.outcome(t);
    out << fmt::format("{},{},{},{},{},{},{}\n", t + 1, to_char(outcome.own), to_char(outcome.theirs),
                       texts[outcome.index()], texts[outcome.exchanged().index()], belief(Seat::first, t),
                       belief(Seat::second, t));
  }
}

void write_json(std::ostream& out, const MatchSettings& settings, const MatchRecord& record) {
  std::string text = "{";
  const auto put = [&](std::string_view key, const std::string& value) {
    text += fmt::format("{}\n  \"{}\": {}", text.size() > 1 ? "," : "", key, value);
  };
  const auto put_both = [&](std::string_view key, const auto& value_of_seat) {
    put(key, fmt::format("[{}, {}]", value_of_seat(Seat::first), value_of_seat(Seat::second)));
  };
  const std::array<std::vector<Rational>, 2> scores{running_scores(settings, record, Seat::first),
                                                    running_scores(settings, record, Seat::second)};
  const auto at = [](const auto& pair, Seat seat) -> const auto& { return pair[index(seat)]; };
  put_both("players", [&](Seat seat) { return string_of(at(record.names, seat)); });
  put("game", string_of(settings.game.title));
  put("payoffs", payoffs_of(settings.game.payoffs));
  put("rounds", std::to_string(settings.rounds));
  put("noise", fmt::format("{}", settings.noise.probability()));
  put("seed", std::to_string(settings.seed));
  put_both("moves", [&](Seat seat) { return string_of(record.transcript.moves(seat)); });
  put_both("slips", [&](Seat seat) { return slips_of(at(record.slipped, seat)); });
  put_both("scores", [&](Seat seat) { return number(at(scores, seat).back()); });
  put_both("means", [&](Seat seat) { return number(at(scores, seat).back() / Rational(settings.rounds)); });
  put_both("cooperation_rates", [&](Seat seat) { return fmt::format("{}", cooperation_rate(record, seat)); });
  put_both("running_scores", [&](Seat seat) { return numbers_of(at(scores, seat)); });
  put("notes", notes_of(record.caveats));
  put_both("beliefs", [&](Seat seat) { return beliefs_of(at(record.beliefs, seat)); });
  put_both("belief_accuracy", [&](Seat seat) {
    const auto accuracy = belief_accuracy(record, seat);
    return accuracy ? fmt::format("{}", *accuracy) : std::string("null");
  });
  out << text << "\n}\n";
}

}  // namespace folk::tools
