#include <folk/games/error.h>
#include <folk/mpe/players/scripted.h>
#include <folk/mpe/world/random_stream.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace folk::mpe {
namespace {

class Still final : public Player {
public:
  void act(const Layout&, const Block& block, std::size_t agent, const Moment&) override {
    const auto [x, y] = action_rows(block, agent);
    std::fill_n(x, block_lanes, 0.0);
    std::fill_n(y, block_lanes, 0.0);
  }
};

/// One coordinate of the program's rule: never outwards from beyond the arena.
double drawn(RandomStream& random, RandomRule rule, double position) {
  double u = uniform(random, -1, 1);
  while (rule == RandomRule::program && std::abs(position) > 1 && u * position > 0) u = uniform(random, -1, 1);
  return u;
}

class Random final : public Player {
public:
  explicit Random(RandomRule rule)
      : rule_(rule) {}

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    const auto [x, y] = action_rows(block, agent);
    const double* position = block.state + layout.position_row(agent) * block_lanes;
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      RandomStream random = random_stream(moment.seed, RandomUse::predators, moment.first + lane, moment.step, agent);
      x[lane] = drawn(random, rule_, position[lane]);
      y[lane] = drawn(random, rule_, position[block_lanes + lane]);
    }
  }

private:
  RandomRule rule_;
};

/// gain * (p_prey + lead * v_prey - p - brake * v), cut to [-1, 1].
class Pursuit final : public Player {
public:
  Pursuit(double gain, double lead, double brake)
      : gain_(gain),
        lead_(lead),
        brake_(brake) {}

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment&) override {
    const auto [x, y] = action_rows(block, agent);
    const std::size_t prey = layout.scenario().prey();
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
      const auto row = [&](std::size_t entity, std::size_t offset) {
        return block.state + (layout.position_row(entity) + axis + offset) * block_lanes;
      };
      const double* p = row(agent, 0);
      const double* v = row(agent, 2);
      const double* prey_p = row(prey, 0);
      const double* prey_v = row(prey, 2);
      double* u = axis == 0 ? x : y;
      for (std::size_t lane = 0; lane < block_lanes; ++lane)
        u[lane] = std::clamp(gain_ * (prey_p[lane] + lead_ * prey_v[lane] - p[lane] - brake_ * v[lane]), -1.0, 1.0);
    }
  }

private:
  double gain_;
  double lead_;
  double brake_;
};

Controller pursuit(std::string name, double gain, double lead, double brake) {
  return {std::move(name), each([=](const Layout& layout, std::size_t agent) -> std::unique_ptr<Player> {
            if (agent == layout.scenario().prey())
              throw UsageError("pursuit is for predators: the prey cannot chase itself");
            return std::make_unique<Pursuit>(gain, lead, brake);
          })};
}

class Blend final : public Player {
public:
  Blend(double p, std::unique_ptr<Player> one, Coin coin)
      : p_(p),
        one_(std::move(one)),
        coin_(coin) {}

  void start(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    one_->start(layout, block, agent, moment);
  }

  void act(const Layout& layout, const Block& block, std::size_t agent, const Moment& moment) override {
    const auto [x, y] = action_rows(block, agent);
    random_.act(layout, block, agent, moment);
    std::array<double, block_lanes> random_x, random_y;
    std::copy_n(x, block.lanes, random_x.begin());
    std::copy_n(y, block.lanes, random_y.begin());
    one_->act(layout, block, agent, moment);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
      RandomStream coin = coin_ == Coin::episode
                              ? random_stream(moment.seed, RandomUse::coin, moment.first + lane, moment.step, agent)
                              : random_stream(moment.seed, RandomUse::shared_coin, 0, moment.step, agent);
      if (coin.chance(p_)) continue;
      x[lane] = random_x[lane];
      y[lane] = random_y[lane];
    }
  }

  void finish() override { one_->finish(); }

private:
  double p_;
  std::unique_ptr<Player> one_;
  Coin coin_;
  Random random_{RandomRule::program};
};

[[noreturn]] void refuse_probability(const std::string& shown) {
  throw UsageError(fmt::format("blend({}): expected a probability from 0 to 1", shown));
}

}  // namespace

Controller still_player() {
  return {"still", each([](const Layout&, std::size_t) { return std::make_unique<Still>(); })};
}

Controller random_player(RandomRule rule) {
  return {rule == RandomRule::uniform ? "random" : "random(program)",
          each([rule](const Layout&, std::size_t) { return std::make_unique<Random>(rule); })};
}

Controller lead_pursuit() { return pursuit("lead_pursuit", 3, 0.2, 0.15); }

Controller greedy_pursuit() { return pursuit("greedy_pursuit", 3, 0, 0); }

Controller blend(double p, Controller one, Coin coin) {
  if (!(p >= 0 && p <= 1)) refuse_probability(fmt::format("{}", p));
  return blend(as_written(p), std::move(one), coin);
}

Controller blend(const Rational& exact, Controller one, Coin coin) {
  const std::string shown = to_short_text(exact);
  if (exact < 0 || exact > 1) refuse_probability(shown);
  if (one.name.starts_with("blend("))
    throw UsageError(fmt::format("blend({};{}): a blend of a blend; take one with the product of both probabilities",
                                 shown, excerpt(one.name)));
  std::string name = fmt::format("blend({};{}{})", shown, one.name, coin == Coin::batch ? ";shared" : "");
  const double p = to_double(exact);
  const bool one_by_one = one.one_by_one;
  return {std::move(name),
          [=, one = std::move(one)](const Layout& layout, Side side) {
            Team team = one.team(layout, side);
            for (auto& player : team) player = std::make_unique<Blend>(p, std::move(player), coin);
            return team;
          },
          one_by_one};
}

}  // namespace folk::mpe
