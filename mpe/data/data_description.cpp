#include <folk/games/error.h>
#include <folk/mpe/data/data_description.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace folk::mpe {
namespace {

using Json = nlohmann::ordered_json;

std::string dtype_name(sct::NpyType type) { return type == sct::NpyType::float64 ? "float64" : "float32"; }

/// In this order it is told in what two descriptions differ.
Json to_json(const DataDescription& description) {
  return {{"format", data_format},
          {"format_version", data_format_version},
          {"folk_version", description.folk_version},
          {"scenario", description.scenario},
          {"reward_rule", to_string(description.reward_rule)},
          {"level", description.level.empty() ? Json(nullptr) : Json(description.level)},
          {"predators", description.predators},
          {"prey", description.prey},
          {"noise", description.noise},
          {"seed", description.seed},
          {"first_episode", description.first_episode},
          {"episodes", description.episodes},
          {"episode_steps", description.episode_steps},
          {"transitions", description.transitions()},
          {"dtype", dtype_name(description.type)}};
}

Json to_json(const MeanReturn& value) {
  return {{"mean", value.mean}, {"standard_error", value.standard_error ? Json(*value.standard_error) : Json(nullptr)}};
}

std::string text_of(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string one_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

constexpr const char* layout_text =
    "obs_i [N, width], acs_i [N, 2], rews_i [N], next_obs_i [N, width], dones_i [N] for agents i: the predators, then "
    "the prey; rows are transitions in time order, episode after episode; an episode ends with its last row, dones are "
    "0 because the world never ends";

/// Takes values out of a metadata object, each of its own type.
class Reader {
public:
  Reader(const Json& json, const std::string& source)
      : json_(json),
        source_(source) {}

  std::string text(const char* key) const {
    const Json& value = at(key);
    if (!value.is_string()) wrong(key, "a text");
    return value.get<std::string>();
  }

  std::uint64_t whole(const char* key) const {
    const Json& value = at(key);
    if (!value.is_number_unsigned()) wrong(key, "a whole number");
    return value.get<std::uint64_t>();
  }

  double real(const char* key) const {
    const Json& value = at(key);
    if (!value.is_number()) wrong(key, "a number");
    return value.get<double>();
  }

  bool is_null(const char* key) const { return at(key).is_null(); }

  Reader object(const char* key) const {
    const Json& value = at(key);
    if (!value.is_object()) wrong(key, "an object");
    return {value, source_};
  }

  [[noreturn]] void wrong(const char* key, const std::string& expected) const {
    refuse(fmt::format("'{}': expected {}; take a fresh copy, or leave this file out", key, expected));
  }

  [[noreturn]] void refuse(const std::string& why) const { refuse_file(source_, why); }

private:
  const Json& at(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) refuse(fmt::format("'{}' is missing; take a fresh copy, or leave this file out", key));
    return *found;
  }

  const Json& json_;
  const std::string& source_;
};

RewardRule reward_rule(const Reader& reader) {
  const std::string name = reader.text("reward_rule");
  for (const RewardRule rule : {RewardRule::program, RewardRule::paper})
    if (name == to_string(rule)) return rule;
  reader.wrong("reward_rule", "program or paper");
}

std::uint64_t signature(const Reader& reader) {
  const std::string text = reader.text("signature");
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.size() != 16 || error != std::errc() || stop != text.data() + text.size())
    reader.wrong("signature", "16 hexadecimal digits");
  return value;
}

MeanReturn mean_return(const Reader& reader) {
  MeanReturn value{reader.real("mean"), std::nullopt};
  if (!reader.is_null("standard_error")) value.standard_error = reader.real("standard_error");
  return value;
}

DataDescription description_of(const Reader& reader) {
  DataDescription description;
  description.folk_version = reader.text("folk_version");
  description.scenario = reader.text("scenario");
  description.reward_rule = reward_rule(reader);
  if (!reader.is_null("level")) description.level = reader.text("level");
  description.predators = reader.text("predators");
  description.prey = reader.text("prey");
  description.noise = reader.real("noise");
  description.seed = reader.whole("seed");
  description.first_episode = reader.whole("first_episode");
  description.episodes = reader.whole("episodes");
  description.episode_steps = reader.whole("episode_steps");
  if (description.episode_steps == 0 ||
      reader.whole("transitions") / description.episode_steps != description.episodes ||
      reader.whole("transitions") % description.episode_steps != 0)
    reader.wrong("transitions", "episodes times episode_steps");
  const std::string dtype = reader.text("dtype");
  if (dtype != "float32" && dtype != "float64") reader.wrong("dtype", "float32 or float64");
  description.type = dtype == "float64" ? sct::NpyType::float64 : sct::NpyType::float32;
  return description;
}

Json parse(std::string_view text) {
  const auto shallow = [](int depth, Json::parse_event_t, Json&) { return depth <= 3; };
  return Json::parse(text, shallow, false);
}

}  // namespace

std::string metadata_text(const DataRecord& record) {
  Json json = to_json(record.description);
  json["signature"] = fmt::format("{:016x}", record.figures.signature);
  json["predator_return"] = to_json(record.figures.predator);
  json["prey_return"] = to_json(record.figures.prey);
  json["layout"] = layout_text;
  return text_of(json);
}

std::optional<DataRecord> parse_metadata(std::string_view text, const std::string& source) {
  const Json json = parse(text);
  const Reader reader(json, source);
  if (!json.is_object()) reader.refuse("no JSON object; take a fresh copy, or leave this file out");
  const auto format = json.find("format");
  if (format == json.end() || *format != data_format) return std::nullopt;
  if (const auto version = reader.whole("format_version"); version != data_format_version)
    reader.refuse(fmt::format("a data set of format version {}, but this Folk reads {}; use the Folk that wrote it",
                              version, data_format_version));
  DataRecord record;
  record.description = description_of(reader);
  record.figures = {signature(reader), mean_return(reader.object("predator_return")),
                    mean_return(reader.object("prey_return"))};
  return record;
}

std::string description_text(const DataDescription& description) { return text_of(to_json(description)); }

std::optional<std::string> difference(std::string_view there, const DataDescription& here) {
  const Json found = parse(there);
  if (!found.is_object()) return "no description of a data set is there";
  const Json asked = to_json(here);
  for (const auto& [key, value] : asked.items()) {
    const auto other = found.find(key);
    if (other == found.end()) return fmt::format("no '{}' is there", key);
    // As text: names that are no UTF-8 stand there as what replaced them.
    const std::string theirs = one_line(*other);
    const std::string ours = one_line(value);
    if (theirs != ours) return fmt::format("{} = {} there, {} here", key, excerpt(theirs, 100), excerpt(ours, 100));
  }
  return std::nullopt;
}

}  // namespace folk::mpe
