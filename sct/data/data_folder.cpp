#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/games/text_file.h>
#include <folk/sct/data/data_folder.h>
#include <folk/sct/data/windows.h>
#include <folk/sct/files/npy_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

namespace folk::sct {

namespace fs = std::filesystem;

namespace {

constexpr const char* observation_names[observation_size] = {"start", "CC", "CD", "DC", "DD"};

/// Which of the five numbers is 1 before this round.
std::size_t observation(const Trajectory& trajectory, std::size_t round) {
  return round == 0 ? 0 : 1 + Outcome{trajectory.own[round - 1], trajectory.theirs[round - 1]}.index();
}

/// Reads an array that must have this shape, the one that actions.npy asks for.
NpyArray read_array(const fs::path& path, const std::vector<std::size_t>& shape) {
  NpyArray array = read_npy(path);
  if (array.shape != shape)
    refuse_file(path.string(),
                fmt::format("shape ({}), but actions.npy asks for ({}); store the arrays of the same matches",
                            fmt::join(array.shape, ", "), fmt::join(shape, ", ")));
  return array;
}

/// Row `n` of an array of moves.
std::vector<Move> moves(const NpyArray& array, std::size_t n, const fs::path& path) {
  const std::size_t rounds = array.shape[1];
  std::vector<Move> row;
  row.reserve(rounds);
  for (std::size_t i = n * rounds; i < (n + 1) * rounds; ++i) {
    const double value = array.values[i];
    if (value != 0 && value != 1)
      refuse_file(path.string(), fmt::format("{} at [{}]: expected 0 (C) or 1 (D)", value, npy_place(array, i)));
    row.push_back(value == 0 ? Move::C : Move::D);
  }
  return row;
}

void check_observations(const fs::path& path, const std::vector<Trajectory>& trajectories) {
  const std::size_t rounds = trajectories[0].own.size();
  const NpyArray array = read_array(path, {trajectories.size(), rounds, observation_size});
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    const std::size_t round = i / observation_size % rounds;
    const std::size_t expected = observation(trajectories[i / observation_size / rounds], round);
    const double wanted = i % observation_size == expected ? 1 : 0;
    if (array.values[i] != wanted)
      refuse_file(path.string(),
                  fmt::format("{} at [{}]: expected {}, the observation being {}; make it from the actions, or leave "
                              "this file out",
                              array.values[i], npy_place(array, i), wanted,
                              round == 0 ? "'start' in the first round"
                                         : fmt::format("{} after round {}", observation_names[expected], round - 1)));
  }
}

void read_names(const fs::path& path, std::vector<Trajectory>& trajectories) {
  const auto shallow = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) { return depth <= 2; };
  const auto json = nlohmann::json::parse(read_text_file(path), shallow, false);
  if (!json.is_object()) refuse_file(path.string(), R"(expected {"players": [...], "opponents": [...]})");
  const auto name = [&](const char* key, std::size_t n) {
    const auto list = json.find(key);
    if (list == json.end() || !list->is_array() || list->size() != trajectories.size())
      refuse_file(path.string(), fmt::format("'{}': expected a list of {} names", key, trajectories.size()));
    if (!(*list)[n].is_string())
      refuse_file(path.string(), fmt::format("'{}' at [{}]: expected a name in quotes", key, n));
    return (*list)[n].get<std::string>();
  };
  for (std::size_t n = 0; n < trajectories.size(); ++n) {
    trajectories[n].player = name("players", n);
    trajectories[n].opponent = name("opponents", n);
  }
}

}  // namespace

std::vector<Trajectory> read_data_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    refuse_file(folder.string(), "no such folder; name one that holds actions.npy");
  const NpyArray own = read_npy(folder / "actions.npy");
  if (own.shape.size() != 2 || own.values.empty())
    refuse_file(
        (folder / "actions.npy").string(),
        fmt::format("shape ({}): expected (trajectories, rounds), at least one of each", fmt::join(own.shape, ", ")));
  const NpyArray theirs = read_array(folder / "opponent_actions.npy", own.shape);
  const NpyArray rewards = read_array(folder / "rewards.npy", own.shape);
  for (std::size_t i = 0; i < rewards.values.size(); ++i)
    if (!std::isfinite(rewards.values[i]))
      refuse_file((folder / "rewards.npy").string(),
                  fmt::format("{} at [{}]: expected a finite payoff", rewards.values[i], npy_place(rewards, i)));

  std::vector<Trajectory> trajectories(own.shape[0]);
  const std::size_t rounds = own.shape[1];
  for (std::size_t n = 0; n < trajectories.size(); ++n) {
    trajectories[n].own = moves(own, n, folder / "actions.npy");
    trajectories[n].theirs = moves(theirs, n, folder / "opponent_actions.npy");
    const auto first = rewards.values.begin() + static_cast<std::ptrdiff_t>(n * rounds);
    trajectories[n].rewards.assign(first, first + static_cast<std::ptrdiff_t>(rounds));
  }
  if (fs::exists(folder / "observations.npy", ignored)) check_observations(folder / "observations.npy", trajectories);
  if (fs::exists(folder / "names.json", ignored)) read_names(folder / "names.json", trajectories);
  return trajectories;
}

void write_data_folder(const fs::path& folder, const std::vector<Trajectory>& trajectories) {
  if (trajectories.empty() || trajectories[0].own.empty())
    throw UsageError("no rounds to write: expected at least one trajectory of one round");
  const std::size_t rounds = trajectories[0].own.size();
  const std::vector<std::size_t> shape{trajectories.size(), rounds};
  NpyArray own{shape, {}};
  NpyArray theirs{shape, {}};
  NpyArray rewards{shape, {}};
  NpyArray observations{{trajectories.size(), rounds, observation_size}, {}};
  nlohmann::ordered_json names{{"players", nlohmann::json::array()}, {"opponents", nlohmann::json::array()}};
  for (const Trajectory& trajectory : trajectories) {
    if (trajectory.own.size() != rounds || trajectory.theirs.size() != rounds || trajectory.rewards.size() != rounds)
      throw UsageError(
          fmt::format("trajectories of different lengths, {} and another: write each length to a folder of "
                      "its own",
                      rounds));
    names["players"].push_back(trajectory.player);
    names["opponents"].push_back(trajectory.opponent);
    rewards.values.insert(rewards.values.end(), trajectory.rewards.begin(), trajectory.rewards.end());
    for (std::size_t round = 0; round < rounds; ++round) {
      if (!std::isfinite(trajectory.rewards[round]))
        throw UsageError(fmt::format("a reward of {} in round {} of '{}': expected a finite payoff",
                                     trajectory.rewards[round], round, excerpt(trajectory.player)));
      own.values.push_back(bit(trajectory.own[round]));
      theirs.values.push_back(bit(trajectory.theirs[round]));
      for (std::size_t k = 0; k < observation_size; ++k)
        observations.values.push_back(k == observation(trajectory, round) ? 1 : 0);
    }
  }

  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw EnvironmentError(
        fmt::format("{}: the folder cannot be made: {}", excerpt(folder.string(), 1000), error.message()));
  write_npy(folder / "actions.npy", own, NpyType::int32);
  write_npy(folder / "opponent_actions.npy", theirs, NpyType::int32);
  write_npy(folder / "rewards.npy", rewards, NpyType::float64);
  write_npy(folder / "observations.npy", observations, NpyType::float32);
  write_file(folder / "names.json", names.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace folk::sct
