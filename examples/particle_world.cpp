// A predator of one's own in the particle world: a hundred episodes, reset and stepped together, and what it earns.

#include <folk/mpe/world/batch.h>

#include <algorithm>
#include <cstdio>

int main() {
  folk::mpe::Batch batch(folk::mpe::Scenario::named("simple_tag"), 100);
  batch.reset(1);  // the first hundred episodes of seed 1
  const auto towards = [](double distance) { return std::clamp(3 * distance, -1.0, 1.0); };
  double sum = 0;
  for (std::size_t step = 0; step < batch.scenario().episode_steps; ++step) {
    for (std::size_t episode = 0; episode < batch.size(); ++episode) {
      for (std::size_t predator = 0; predator < batch.scenario().predators(); ++predator) {
        // Its velocity and position, then two obstacles, two predators and the prey from where it is, 2 numbers each.
        const auto seen = batch.observation(episode, predator);
        batch.set_action(episode, predator, {towards(seen[12]), towards(seen[13])});
      }
    }
    batch.step();  // nobody moves the prey: its action stays (0, 0)
    for (std::size_t episode = 0; episode < batch.size(); ++episode) sum += batch.reward(episode, 0);
  }
  std::printf("mean return of a predator: %.2f\n", sum / static_cast<double>(batch.size()));
}
