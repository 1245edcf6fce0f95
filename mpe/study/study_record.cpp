#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/mpe/study/study_record.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace folk::mpe {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::string_view format = "folk-mpe-study-1";

Json json_of(const Mean& mean) { return {{"mean", mean.mean}, {"ci95", mean.ci95}}; }

Json json_of(const RightBeliefs& beliefs) {
  Json right = Json::array();
  for (std::size_t r = 0; r < belief_radii.size(); ++r)
    right.push_back({{"radius", belief_radii[r]}, {"mean", beliefs.right[r].mean}, {"ci95", beliefs.right[r].ci95}});
  return {{"right", right}, {"near", json_of(beliefs.near)}, {"distance", json_of(beliefs.distance)}};
}

Json json_of(const PreyRecord& prey) {
  Json json{{"prey", prey.prey}, {"return", json_of(prey.predators)}};
  if (prey.target) json["target"] = *prey.target;
  if (prey.data_target) json["data_target"] = *prey.data_target;
  if (prey.data_target_predators) json["data_target_return"] = json_of(*prey.data_target_predators);
  if (prey.beliefs) json["beliefs"] = json_of(*prey.beliefs);
  for (const auto& asked : prey.asked) {
    Json row{{"target", asked.target}, {"return", json_of(asked.predators)}};
    if (asked.beliefs) row["beliefs"] = json_of(*asked.beliefs);
    json["asked"].push_back(row);
  }
  for (const auto& forced : prey.forced)
    json["forced"].push_back({{"belief", forced.forcing},
                              {"return", json_of(forced.predators)},
                              {"difference", json_of(forced.difference)},
                              {"change", json_of(forced.change)}});
  return json;
}

/// Numbers that are finite; all else of a wrong kind is thrown by the parser itself.
double number(const Json& json) {
  const double value = json.get<double>();
  if (!std::isfinite(value)) throw std::invalid_argument("a number that is not finite");
  return value;
}

Mean mean_from(const Json& json) {
  const Mean mean{number(json.at("mean")), number(json.at("ci95"))};
  if (mean.ci95 < 0) throw std::invalid_argument("an interval below 0");
  return mean;
}

/// A list, empty where there is none.
const Json& list(const Json& json, const char* key) {
  static const Json none = Json::array();
  if (!json.contains(key)) return none;
  if (!json[key].is_array()) throw std::invalid_argument(fmt::format("'{}' is no list", key));
  return json[key];
}

RightBeliefs beliefs_from(const Json& json) {
  RightBeliefs beliefs;
  const Json& right = json.at("right");
  if (!right.is_array() || right.size() != belief_radii.size()) throw std::invalid_argument("other radii");
  for (std::size_t r = 0; r < belief_radii.size(); ++r) {
    if (number(right[r].at("radius")) != belief_radii[r]) throw std::invalid_argument("other radii");
    beliefs.right[r] = mean_from(right[r]);
  }
  beliefs.near = mean_from(json.at("near"));
  beliefs.distance = mean_from(json.at("distance"));
  return beliefs;
}

PreyRecord prey_from(const Json& json) {
  PreyRecord prey;
  prey.prey = json.at("prey").get<std::string>();
  prey.predators = mean_from(json.at("return"));
  if (json.contains("target")) prey.target = number(json["target"]);
  if (json.contains("data_target")) prey.data_target = number(json["data_target"]);
  if (json.contains("data_target_return")) prey.data_target_predators = mean_from(json["data_target_return"]);
  if (json.contains("beliefs")) prey.beliefs = beliefs_from(json["beliefs"]);
  for (const Json& row : list(json, "asked")) {
    AskedReturn asked{number(row.at("target")), mean_from(row.at("return")), std::nullopt};
    if (row.contains("beliefs")) asked.beliefs = beliefs_from(row["beliefs"]);
    prey.asked.push_back(asked);
  }
  for (const Json& row : list(json, "forced"))
    prey.forced.push_back({row.at("belief").get<std::string>(), mean_from(row.at("return")),
                           mean_from(row.at("difference")), mean_from(row.at("change"))});
  return prey;
}

StudyRecord record_from(const Json& json) {
  if (json.at("format").get<std::string>() != format) throw std::invalid_argument("another format");
  StudyRecord record;
  record.job = {json.at("data_prey").get<std::string>(), json.at("scenario").get<std::string>(),
                json.at("level").get<std::string>(), json.at("learner").get<std::string>(),
                json.at("seed").get<std::uint64_t>()};
  record.budget = json.at("budget").get<std::string>();
  record.training = json.at("training").get<std::string>();
  record.steps = json.at("steps").get<std::uint64_t>();
  record.episodes = json.at("episodes").get<std::size_t>();
  record.data_return = number(json.at("data_return"));
  record.policy = json.at("policy").get<std::string>();
  if (!json.at("preys").is_array()) throw std::invalid_argument("no preys");
  for (const Json& prey : json["preys"]) record.preys.push_back(prey_from(prey));
  return record;
}

}  // namespace

Mean mean_of(const Estimate& estimate) {
  // One episode has no interval; smoke studies alone are that short.
  return {estimate.mean, std::isfinite(estimate.ci95) ? estimate.ci95 : 0};
}

std::string record_text(const StudyRecord& record) {
  Json json{{"format", format},
            {"data_prey", record.job.data_prey},
            {"scenario", record.job.scenario},
            {"level", record.job.level},
            {"learner", record.job.learner},
            {"seed", record.job.seed},
            {"budget", record.budget},
            {"training", record.training},
            {"steps", record.steps},
            {"episodes", record.episodes},
            {"data_return", record.data_return},
            {"policy", record.policy},
            {"preys", Json::array()}};
  for (const auto& prey : record.preys) json["preys"].push_back(json_of(prey));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

StudyRecord parse_record(std::string_view text, const std::string& source) {
  std::string why;
  try {
    return record_from(Json::parse(text));
  } catch (const Json::parse_error& error) {  // its own words quote bytes that may be no text
    why = fmt::format("no JSON at its byte {}", error.byte);
  } catch (const std::exception& error) {
    why = error.what();
    if (const auto end = why.find("] "); why.starts_with("[json") && end != why.npos) why.erase(0, end + 2);
  }
  throw InputFileError(fmt::format("{}: no record of a study ({}); remove it, and its job is done again",
                                   excerpt(source, 1000), excerpt(why, 200)));
}

}  // namespace folk::mpe
