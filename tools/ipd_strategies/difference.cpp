#include <folk/games/outcome.h>
#include <folk/tools/ipd_strategies/difference.h>

#include <fmt/format.h>

#include <vector>

#include <folk/tools/program/csv.h>

namespace folk::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string moves_of(const std::vector<Outcome>& play, Move Outcome::*whose, const char* between) {
  std::string text;
  for (const Outcome& round : play) text += (text.empty() ? "" : between) + std::string(1, to_char(round.*whose));
  return text;
}

std::string plays(const std::string& name, double cooperation) {
  if (cooperation == 0 || cooperation == 1) return fmt::format("{} plays {}", name, cooperation == 1 ? 'C' : 'D');
  return fmt::format("{} plays C with probability {:.6g}", name, cooperation);
}

}  // namespace

const char* sense_text(Sense sense) { return sense == Sense::any_own_moves ? "any own moves" : "own moves its own"; }

const char* sense_key(Sense sense) { return sense == Sense::any_own_moves ? "any_own_moves" : "own_moves_its_own"; }

Comparison compared(const Machine& first, const Machine& second, bool same_name, Sense sense, std::size_t most_pairs) {
  if (first.finite() || second.finite() || !same_name) return compare(first, second, sense, most_pairs);
  Comparison found;
  found.equivalence = Equivalence::equivalent;
  return found;
}

std::string difference_text(const Difference& difference) {
  const Comparison& found = difference.found;
  switch (found.equivalence) {
    case Equivalence::equivalent:
      if (found.pairs == 0) return fmt::format("equivalent: both are {}", difference.first);
      return fmt::format("equivalent: proved over {} joint states ({})", found.pairs, sense_text(difference.sense));
    case Equivalence::undecided:
      return fmt::format("not refuted (depth {0}): no play of up to {0} rounds separates {1} and {2} ({3})",
                         found.depth, difference.first, difference.second, sense_text(difference.sense));
    case Equivalence::different: break;
  }
  const std::string answers = plays(difference.first, found.first) + ", " + plays(difference.second, found.second);
  if (found.play.empty()) return fmt::format("different: in the first round {}", answers);
  return fmt::format("different: after their moves {} (own {}): {}", moves_of(found.play, &Outcome::theirs, " "),
                     moves_of(found.play, &Outcome::own, " "), answers);
}

Json difference_json(const Difference& difference) {
  const Comparison& found = difference.found;
  const bool different = found.equivalence == Equivalence::different;
  Json json;
  json["result"] = different ? "different" : found.equivalence == Equivalence::equivalent ? "equivalent" : "undecided";
  json["sense"] = sense_key(difference.sense);
  json["strategies"] = {difference.first, difference.second};
  json["pairs"] = found.pairs;
  json["depth"] = found.depth;
  json["play"] = nullptr;
  json["answers"] = nullptr;
  if (different) {
    json["play"] = {{"own", moves_of(found.play, &Outcome::own, "")},
                    {"theirs", moves_of(found.play, &Outcome::theirs, "")}};
    json["answers"] = {{"first", found.first}, {"second", found.second}};
  }
  return json;
}

std::string difference_csv(const Difference& difference) {
  const Json json = difference_json(difference);
  const bool different = difference.found.equivalence == Equivalence::different;
  return fmt::format(
      "result,sense,first,second,pairs,depth,own,theirs,first_cooperation,second_cooperation\n"
      "{},{},{},{},{},{},{},{},{},{}\n",
      json["result"].get<std::string>(), json["sense"].get<std::string>(), csv_field(difference.first),
      csv_field(difference.second), difference.found.pairs, difference.found.depth,
      moves_of(difference.found.play, &Outcome::own, ""), moves_of(difference.found.play, &Outcome::theirs, ""),
      different ? fmt::format("{}", difference.found.first) : "",
      different ? fmt::format("{}", difference.found.second) : "");
}

}  // namespace folk::tools
