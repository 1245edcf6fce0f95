#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/players/any_policy.h>
#include <folk/mpe/players/exec_player.h>
#include <folk/mpe/players/names.h>
#include <folk/mpe/players/policy_file.h>
#include <folk/mpe/players/scripted.h>
#include <folk/strategies/nearest_names.h>
#include <folk/strategies/registry.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

namespace folk::mpe {
namespace {

namespace fs = std::filesystem;

/// The files of shipped policies: data/mpe/simple_tag_expert.safetensors.
const std::vector<std::string>& shipped_names(Side side) {
  static const std::vector<std::string> predators{"expert", "medium", "expert_maddpg"};
  static const std::vector<std::string> prey{"released", "maddpg"};
  return side == Side::prey ? prey : predators;
}

class Names {
public:
  Names(Side side, const Scenario& scenario, const fs::path& data)
      : side_(side),
        scenario_(scenario),
        data_(data) {}

  Controller make(std::string_view spec) const {
    if (spec.empty()) refuse(spec);
    if (names_a_program(spec)) return exec_controller(parse_program_call(spec.substr(4)));
    if (const auto open = spec.find('('); open != std::string_view::npos && spec.back() == ')')
      if (auto found = call(name_key(spec.substr(0, open)), spec.substr(open + 1, spec.size() - open - 2)))
        return *std::move(found);
    const std::string key = name_key(spec);
    if (key == "still") return still_player();
    if (key == "random") return random_player();
    if (key == "leadpursuit" && side_ == Side::predators) return lead_pursuit();
    if (key == "greedypursuit" && side_ == Side::predators) return greedy_pursuit();
    for (const auto& name : shipped_names(side_))
      if (name_key(name) == key) return shipped(name);
    std::error_code ignored;
    if (spec.find_first_of("/.") == std::string_view::npos && !fs::exists(fs::path(spec), ignored)) refuse(spec);
    return file(spec);
  }

private:
  [[noreturn]] void refuse(std::string_view spec) const {
    std::vector<NameCandidate> candidates;
    for (const auto& name : known_names(side_)) candidates.push_back({name_key(name.substr(0, name.find('('))), name});
    const auto near = nearest_names(spec, candidates);
    throw UsageError(fmt::format(
        "'{}': no player of the {} and no file has this name{} (known: {})", excerpt(spec), to_string(side_),
        near.empty() ? std::string() : fmt::format(": did you mean {}?", fmt::join(near, ", ")),
        fmt::join(known_names(side_), ", ")));
  }

  std::optional<Controller> call(const std::string& head, std::string_view arguments) const {
    if (head == "random") {
      if (name_key(arguments) == "program") return random_player(RandomRule::program);
      if (name_key(arguments) == "uniform") return random_player();
      throw UsageError(fmt::format("random({}): expected random or random(program)", excerpt(arguments)));
    }
    if (head == "untrained") {
      parse_exact_number(arguments, "untrained: seed", 0, 0x1p53);
      const auto seed = whole_number(arguments);
      if (!seed) throw UsageError(fmt::format("untrained: seed '{}': expected a whole number", excerpt(arguments)));
      return policy_controller(fmt::format("untrained({})", *seed), untrained_policy(scenario_, side_, *seed), side_,
                               scenario_);
    }
    if (head != "blend") return std::nullopt;
    const auto first = arguments.find(';');
    const Rational p = parse_exact_number(arguments.substr(0, first), "blend: probability", 0, 1);
    std::string_view rest = first == std::string_view::npos ? std::string_view() : arguments.substr(first + 1);
    Coin coin = Coin::episode;
    if (const auto last = rest.rfind(';'); name_key(rest.substr(last + 1)) == "shared") {  // npos + 1 is 0
      coin = Coin::batch;
      rest = rest.substr(0, last == std::string_view::npos ? 0 : last);
    }
    if (is_blend(rest))  // before it is made: names would nest as deep as an argument is long
      throw UsageError(fmt::format("blend({}): a blend of a blend; name one with the product of both probabilities",
                                   excerpt(arguments)));
    return blend(p, rest.empty() ? shipped(shipped_names(side_).front()) : make(rest), coin);
  }

  static bool is_blend(std::string_view spec) {
    const auto open = spec.find('(');
    return open != std::string_view::npos && name_key(spec.substr(0, open)) == "blend";
  }

  Controller shipped(const std::string& name) const {
    const fs::path path = data_ / fmt::format("{}_{}.safetensors", scenario_.name, name);
    std::error_code ignored;
    if (!fs::exists(path, ignored))
      throw InputFileError(
          fmt::format("{}: there is no {}; install Folk's data, say in FOLK_DATA where it is, or name a policy file",
                      name, excerpt(path.string(), 1000)));
    return policy_controller(name, read_policy(path), side_, scenario_);
  }

  Controller file(std::string_view path) const {
    const std::string bytes = read_file(fs::path(path), largest_policy_file);
    try {
      auto player = any_policy_controller(std::string(path), bytes, std::string(path), side_, scenario_);
      player.file = path;
      return player;
    } catch (const UsageError& error) {  // a sound file, but not for this
      throw InputFileError(error.what());
    }
  }

  Side side_;
  const Scenario& scenario_;
  const fs::path& data_;
};

}  // namespace

const std::vector<std::string>& known_names(Side side) {
  static const std::vector<std::string> predators{"still",         "random",         "random(program)", "blend(P)",
                                                  "lead_pursuit",  "greedy_pursuit", "expert",          "medium",
                                                  "expert_maddpg", "untrained(SEED)"};
  static const std::vector<std::string> prey{"still",    "random", "random(program)", "blend(P)",
                                             "released", "maddpg", "untrained(SEED)"};
  return side == Side::prey ? prey : predators;
}

Controller controller(std::string_view spec, Side side, const Scenario& scenario, const fs::path& data) {
  return Names(side, scenario, data).make(spec);
}

std::vector<std::string> split_names(std::string_view list) {
  auto names = split_list(list);
  if (names.empty()) throw UsageError("no player is named: give at least one");
  return names;
}

}  // namespace folk::mpe
