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

/// A share at each of some radii.
template <std::size_t size>
Json json_of(const std::array<double, size>& radii, const std::array<Mean, size>& shares) {
  Json json = Json::array();
  for (std::size_t r = 0; r < size; ++r)
    json.push_back({{"radius", radii[r]}, {"mean", shares[r].mean}, {"ci95", shares[r].ci95}});
  return json;
}

Json json_of(const RightBeliefs& beliefs) {
  return {{"right", json_of(belief_radii, beliefs.right)},
          {"within", json_of(absolute_radii, beliefs.within)},
          {"distance", json_of(beliefs.distance)}};
}

Json json_of(const PreyRecord& prey) {
  Json json{{"prey", prey.prey}, {"return", json_of(prey.predators)}, {"batches", prey.batches}};
  if (prey.target) json["target"] = *prey.target;
  if (prey.data_target) json["data_target"] = *prey.data_target;
  if (prey.data_target_predators) json["data_target_return"] = json_of(*prey.data_target_predators);
  if (prey.own_target) json["own_target"] = *prey.own_target;
  if (prey.own_target_predators) json["own_target_return"] = json_of(*prey.own_target_predators);
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

/// A JSON library would make something of -1 and 1e300.
std::uint64_t whole(const Json& json) {
  if (!json.is_number_unsigned()) throw std::invalid_argument("a number that is not whole");
  return json.get<std::uint64_t>();
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

template <std::size_t size>
void read_shares(const Json& json, const std::array<double, size>& radii, std::array<Mean, size>& shares) {
  if (!json.is_array() || json.size() != size) throw std::invalid_argument("other radii");
  for (std::size_t r = 0; r < size; ++r) {
    if (number(json[r].at("radius")) != radii[r]) throw std::invalid_argument("other radii");
    shares[r] = mean_from(json[r]);
  }
}

RightBeliefs beliefs_from(const Json& json) {
  RightBeliefs beliefs;
  read_shares(json.at("right"), belief_radii, beliefs.right);
  read_shares(json.at("within"), absolute_radii, beliefs.within);
  beliefs.distance = mean_from(json.at("distance"));
  return beliefs;
}

PreyRecord prey_from(const Json& json) {
  PreyRecord prey;
  prey.prey = json.at("prey").get<std::string>();
  prey.predators = mean_from(json.at("return"));
  if (!json.at("batches").is_array()) throw std::invalid_argument("no batches");
  for (const Json& mean : json["batches"]) prey.batches.push_back(number(mean));
  if (!prey.batches.empty() && prey.batches.size() != report_batches) throw std::invalid_argument("other batches");
  if (json.contains("target")) prey.target = number(json["target"]);
  if (json.contains("data_target")) prey.data_target = number(json["data_target"]);
  if (json.contains("data_target_return")) prey.data_target_predators = mean_from(json["data_target_return"]);
  if (json.contains("own_target")) prey.own_target = number(json["own_target"]);
  if (json.contains("own_target_return")) prey.own_target_predators = mean_from(json["own_target_return"]);
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
                json.at("level").get<std::string>(), json.at("learner").get<std::string>(), whole(json.at("seed"))};
  record.budget = json.at("budget").get<std::string>();
  record.identity = json.at("identity").get<std::string>();
  record.folk = json.at("folk").get<std::string>();
  record.diverged = json.at("diverged").get<std::string>();
  record.training = json.at("training").get<std::string>();
  record.steps = whole(json.at("steps"));
  record.episodes = whole(json.at("episodes"));
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
            {"identity", record.identity},
            {"folk", record.folk},
            {"diverged", record.diverged},
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
