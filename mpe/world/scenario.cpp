#include <folk/games/error.h>
#include <folk/mpe/world/scenario.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace folk::mpe {
namespace {

Scenario empty(std::string name, double prey_radius) {
  Scenario scenario;
  scenario.name = std::move(name);
  for (int i = 0; i < 3; ++i) scenario.entities.push_back({fmt::format("agent{}", i), Role::predator, 0.075, 3.0, 1.0});
  scenario.entities.push_back({"agent3", Role::prey, prey_radius, 4.0, 1.3});
  return scenario;
}

void add_landmarks(Scenario& scenario, std::initializer_list<Role> roles) {
  for (const Role role : roles) {
    const char* kind = role == Role::obstacle ? "landmark" : role == Role::food ? "food" : "forest";
    const double radius = role == Role::obstacle ? 0.2 : role == Role::food ? 0.03 : 0.3;
    scenario.entities.push_back({fmt::format("{}{}", kind, scenario.count(role)), role, radius, 0, 0});
  }
}

Scenario simple_tag() {
  Scenario scenario = empty("simple_tag", 0.05);
  add_landmarks(scenario, {Role::obstacle, Role::obstacle});
  scenario.rewards.catching = 10;
  scenario.rewards.boundary = 1;
  return scenario;
}

Scenario simple_world() {
  Scenario scenario = empty("simple_world", 0.045);
  add_landmarks(scenario, {Role::obstacle, Role::food, Role::food, Role::forest, Role::forest});
  scenario.rewards.catching = 5;
  scenario.rewards.boundary = 2;
  scenario.rewards.eating = 2;
  scenario.rewards.food_distance = 0.05;
  return scenario;
}

}  // namespace

std::size_t Scenario::count(Role role) const {
  return static_cast<std::size_t>(
      std::count_if(entities.begin(), entities.end(), [&](const Entity& entity) { return entity.role == role; }));
}

std::size_t Scenario::predators() const { return count(Role::predator); }

std::size_t Scenario::agents() const { return predators() + count(Role::prey); }

std::size_t Scenario::observation_size(std::size_t agent) const {
  const std::size_t prey_velocity = agent == prey() ? 0 : 2;
  return 4 + 2 * landmarks() + 2 * (agents() - 1) + prey_velocity + count(Role::forest);
}

std::size_t Scenario::observation_sizes() const {
  std::size_t sum = 0;
  for (std::size_t agent = 0; agent < agents(); ++agent) sum += observation_size(agent);
  return sum;
}

Scenario Scenario::named(std::string_view name, RewardRule rule) {
  Scenario scenario;
  if (name == "simple_tag")
    scenario = simple_tag();
  else if (name == "simple_world")
    scenario = simple_world();
  else
    throw UsageError(fmt::format("scenario '{}': expected simple_tag or simple_world", excerpt(name)));
  scenario.rewards.rule = rule;
  return scenario;
}

void require_sound(const Scenario& scenario) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("scenario '{}': {}", excerpt(scenario.name), why));
  };
  const auto& entities = scenario.entities;
  if (entities.size() > most_entities) refuse(fmt::format("more than {} entities", most_entities));
  const auto place = [](const Entity& entity) { return entity.role == Role::predator ? 0 : entity.moves() ? 1 : 2; };
  if (scenario.predators() == 0 || scenario.count(Role::prey) != 1 ||
      !std::is_sorted(entities.begin(), entities.end(),
                      [&](const Entity& a, const Entity& b) { return place(a) < place(b); }))
    refuse("expected at least one predator, then one prey, then the landmarks");
  const auto positive = [](double x) { return x > 0 && x < 1e6; };
  for (const auto& entity : entities)
    if (!positive(entity.radius) || (entity.moves() && !(positive(entity.acceleration) && positive(entity.max_speed))))
      refuse(fmt::format("{}: radius, acceleration and top speed must be above 0, below 1e6", excerpt(entity.name)));
  const auto& physics = scenario.physics;
  if (!positive(physics.time_step) || !(physics.damping >= 0 && physics.damping <= 1) ||
      !positive(physics.contact_force) || !positive(physics.contact_margin))
    refuse("time step, contact force and margin must be above 0, below 1e6, the damping in [0, 1]");
  const auto& rewards = scenario.rewards;
  for (const double weight :
       {rewards.distance, rewards.catching, rewards.boundary, rewards.eating, rewards.food_distance})
    if (!(std::abs(weight) < 1e6)) refuse("weights of rewards must be finite, below 1e6");
  if (scenario.episode_steps == 0 || scenario.episode_steps > 1'000'000) refuse("an episode has 1 to 1000000 steps");
}

double boundary_penalty(double x) {
  if (x < 0.9) return 0;
  if (x < 1) return 10 * (x - 0.9);
  return std::min(std::exp(2 * x - 2), 10.0);
}

std::string_view to_string(RewardRule rule) { return rule == RewardRule::program ? "program" : "paper"; }

}  // namespace folk::mpe
