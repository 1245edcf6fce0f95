#include <folk/tools/mpe_train/online_options.h>

#include <fmt/format.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>

#include <vector>

namespace folk::tools {
namespace {

using mpe::OnlineSettings;

struct WholeOption {
  const char* name;
  std::size_t OnlineSettings::*place;
  const char* help;
};
struct RealOption {
  const char* name;
  double OnlineSettings::*place;
  const char* help;
};

const std::vector<WholeOption>& whole_options() {
  static const std::vector<WholeOption> options{
      {"episodes", &OnlineSettings::episodes, "episodes that are played, in rounds of 64"},
      {"hidden", &OnlineSettings::hidden, "units in each of two hidden layers"},
      {"batch", &OnlineSettings::batch, "transitions in an update"},
      {"memory", &OnlineSettings::memory, "transitions that are kept"},
      {"first-update", &OnlineSettings::first_update, "transitions before learning begins"},
      {"update-every", &OnlineSettings::update_every, "transitions between updates"},
      {"evaluate-every", &OnlineSettings::evaluate_every, "episodes between evaluations"},
      {"evaluation-episodes", &OnlineSettings::evaluation_episodes, "episodes of an evaluation, without noise"}};
  return options;
}

const std::vector<RealOption>& real_options() {
  static const std::vector<RealOption> options{
      {"learning-rate", &OnlineSettings::learning_rate, "of Adam, for actors and critics"},
      {"final-learning-rate", &OnlineSettings::final_learning_rate, "reached along a half cosine at the end"},
      {"discount", &OnlineSettings::discount, "gamma"},
      {"averaging", &OnlineSettings::averaging, "tau, a step of the target networks"},
      {"clip", &OnlineSettings::clip, "largest norm of a network's gradient"},
      {"action-penalty", &OnlineSettings::action_penalty, "on the square of an action before tanh"},
      {"exploration", &OnlineSettings::exploration, "deviation of the noise on actions"},
      {"final-exploration", &OnlineSettings::final_exploration, "reached along a line at the end"},
      {"target-noise", &OnlineSettings::target_noise, "deviation of the noise on the targets' actions; TD3: 0.2"},
      {"target-noise-clip", &OnlineSettings::target_noise_clip, "where that noise is cut"}};
  return options;
}

}  // namespace

void add_online_options(po::options_description& options) {
  const OnlineSettings defaults;
  auto add = options.add_options();
  const auto with_default = [](const char* help, const std::string& value) {
    return fmt::format("{} (default {})", help, value);
  };
  add("algorithm", po::value<std::string>(), "matd3 (default) or maddpg");
  add("critic", po::value<std::string>(),
      "centralised (default): critics see all agents; independent: their own alone");
  for (const auto& option : whole_options())
    add(option.name, po::value<std::string>(),
        with_default(option.help, fmt::to_string(defaults.*option.place)).c_str());
  for (const auto& option : real_options())
    add(option.name, po::value<std::string>(),
        with_default(option.help, fmt::format("{}", defaults.*option.place)).c_str());
  add("seed", po::value<std::string>(), "of everything random (default 1)");
}

mpe::OnlineSettings online_settings(const po::variables_map& values) {
  OnlineSettings settings;
  const std::string algorithm = text_option(values, "algorithm", "matd3");
  if (algorithm != "matd3" && algorithm != "maddpg")
    throw UsageError(fmt::format("--algorithm '{}': expected matd3 or maddpg", excerpt(algorithm)));
  settings.algorithm = algorithm == "matd3" ? mpe::Algorithm::matd3 : mpe::Algorithm::maddpg;
  const std::string critic = text_option(values, "critic", "centralised");
  if (critic != "centralised" && critic != "independent")
    throw UsageError(fmt::format("--critic '{}': expected centralised or independent", excerpt(critic)));
  settings.critic = critic == "centralised" ? mpe::Critic::centralised : mpe::Critic::independent;
  for (const auto& option : whole_options())
    settings.*option.place =
        static_cast<std::size_t>(whole_option(values, option.name, settings.*option.place, 0, 1'000'000'000));
  for (const auto& option : real_options())
    if (values.count(option.name) != 0)
      settings.*option.place = parse_number(text_option(values, option.name), fmt::format("--{}", option.name), 0, 1e9);
  if (values.count("final-learning-rate") == 0) settings.final_learning_rate = settings.learning_rate;
  if (values.count("final-exploration") == 0) settings.final_exploration = settings.exploration;
  settings.seed = whole_option(values, "seed", 1, 0, UINT64_MAX);
  try {
    require_sound(settings);
  } catch (const UsageError& error) {
    throw UsageError(std::string("--") + error.what());
  }
  return settings;
}

}  // namespace folk::tools
