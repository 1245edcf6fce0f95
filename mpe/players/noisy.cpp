#include <folk/games/error.h>
#include <folk/mpe/players/noisy.h>
#include <folk/mpe/world/random_stream.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace folk::mpe {
namespace {

class Noisy final : public Player {
public:
  Noisy(std::unique_ptr<Player> player, double sigma)
      : player_(std::move(player)),
        sigma_(sigma) {}

  void start(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    player_->start(layout, block, agent, moment);
  }

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    player_->act(layout, block, agent, moment);
    const auto [x, y] = action_rows(block, agent);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      RandomStream random = random_stream(moment.seed, RandomUse::data_noise, moment.first + lane, moment.step, agent);
      for (double* u : {x + lane, y + lane}) *u = std::clamp(*u + sigma_ * random.normal(), -1.0, 1.0);
    }
  }

  void finish() override { player_->finish(); }

private:
  std::unique_ptr<Player> player_;
  double sigma_;
};

}  // namespace

Controller noisy(Controller controller, double sigma) {
  if (!(sigma >= 0 && sigma <= 100))
    throw UsageError(fmt::format("noise {}: expected a standard deviation from 0 to 100", sigma));
  if (sigma == 0) return controller;
  std::string name = fmt::format("{} with noise {}", controller.name, sigma);
  const bool one_by_one = controller.one_by_one;
  return {std::move(name),
          [sigma, inner = std::move(controller)](const Layout& layout, Side side) {
            Team team = inner.team(layout, side);
            for (auto& player : team) player = std::make_unique<Noisy>(std::move(player), sigma);
            return team;
          },
          one_by_one};
}

}  // namespace folk::mpe
