#include <folk/mpe/world/block.h>

#include <algorithm>
#include <array>
#include <utility>

namespace folk::mpe {
namespace {

/// Forty margins beyond touching, log(1 + exp(-40)) is 4e-18.
constexpr double near_in_margins = 40;

/// Eight episodes while they are stepped.
struct Lanes {
  std::array<Vector, most_entities> px, py;  // of all entities
  std::array<Vector, most_entities> vx, vy;  // of agents
};

class Group {
public:
  /// Lanes [first, first + 8) of the block.
  Group(const Layout& layout, const Block& block, std::size_t first)
      : layout_(layout),
        block_(block),
        first_(first) {
    for (std::size_t i = 0; i < layout.agents() + layout.landmarks(); ++i) {
      const double* row = block.state + layout.position_row(i) * block_lanes + first;
      lanes_.px[i] = load(row);
      lanes_.py[i] = load(row + block_lanes);
      if (i < layout.agents()) {
        lanes_.vx[i] = load(row + 2 * block_lanes);
        lanes_.vy[i] = load(row + 3 * block_lanes);
      }
    }
  }

  void move() {
    std::array<Vector, most_entities> fx, fy;
    for (std::size_t i = 0; i < layout_.agents(); ++i) {
      const double acceleration = layout_.scenario().entities[i].acceleration;
      const double* action = block_.actions + 2 * i * block_lanes + first_;
      fx[i] = (load(action) * acceleration) * acceleration;
      fy[i] = (load(action + block_lanes) * acceleration) * acceleration;
    }
    for (const auto& pair : layout_.pairs()) add_contact(pair, fx, fy);
    for (std::size_t i = 0; i < layout_.agents(); ++i) integrate(i, fx[i], fy[i]);
  }

  template <Stores stores>
  void observe() const {
    const std::size_t agents = layout_.agents();
    const std::size_t prey = agents - 1;
    for (std::size_t i = 0; i < agents; ++i) {
      double* row = block_.observations + layout_.observation_begin(i) * block_lanes + first_;
      const auto next = [&](const Vector& v) {
        put<stores>(row, v);
        row += block_lanes;
      };
      next(lanes_.vx[i]);
      next(lanes_.vy[i]);
      next(lanes_.px[i]);
      next(lanes_.py[i]);
      const auto put_from_here = [&](std::size_t other) {
        next(lanes_.px[other] - lanes_.px[i]);
        next(lanes_.py[other] - lanes_.py[i]);
      };
      for (std::size_t k = agents; k < agents + layout_.landmarks(); ++k) put_from_here(k);
      for (std::size_t k = 0; k < agents; ++k)
        if (k != i) put_from_here(k);
      if (i != prey) {
        next(lanes_.vx[prey]);
        next(lanes_.vy[prey]);
      }
      for (const std::size_t forest : layout_.forests()) next(touch(i, forest) ? all_lanes(1.0) : all_lanes(-1.0));
    }
  }

  template <Stores stores>
  void reward() const {
    const auto& weights = layout_.scenario().rewards;
    const std::size_t prey = layout_.agents() - 1;
    Vector distances = all_lanes(0);
    Vector hits = all_lanes(0);
    for (std::size_t i = 0; i < prey; ++i) {
      const Vector distance = square_root(square_distance(i, prey));
      distances += distance;
      hits += distance < reach(i, prey) ? all_lanes(1.0) : all_lanes(0.0);
    }
    const Vector far = weights.distance * distances;
    const Vector caught = weights.catching * hits;
    const bool both = weights.rule == RewardRule::program;
    const Vector gain = both ? caught - far : (hits > 0 ? caught : -far);
    Vector prey_gain = far - caught;
    prey_gain -= weights.boundary * penalty(absolute(lanes_.px[prey]));
    prey_gain -= weights.boundary * penalty(absolute(lanes_.py[prey]));
    if (!layout_.food().empty()) {
      Vector nearest = square_distance(layout_.food().front(), prey);
      for (const std::size_t food : layout_.food()) {
        const Vector square = square_distance(food, prey);
        prey_gain += square_root(square) < reach(food, prey) ? all_lanes(weights.eating) : all_lanes(0.0);
        nearest = minimum(nearest, square);
      }
      prey_gain += weights.food_distance * square_root(nearest);
    }
    for (std::size_t i = 0; i < prey; ++i) put<stores>(block_.rewards + i * block_lanes + first_, gain);
    put<stores>(block_.rewards + prey * block_lanes + first_, prey_gain);
  }

  void store_state() const {
    for (std::size_t i = 0; i < layout_.agents(); ++i) {
      double* row = block_.state + layout_.position_row(i) * block_lanes + first_;
      store(row, lanes_.px[i]);
      store(row + block_lanes, lanes_.py[i]);
      store(row + 2 * block_lanes, lanes_.vx[i]);
      store(row + 3 * block_lanes, lanes_.vy[i]);
    }
  }

private:
  template <Stores stores>
  static void put(double* to, const Vector& v) {
    if constexpr (stores == Stores::past_caches)
      store_past_caches(to, v);
    else
      store(to, v);
  }

  double reach(std::size_t a, std::size_t b) const {
    return layout_.scenario().entities[a].radius + layout_.scenario().entities[b].radius;
  }

  Vector square_distance(std::size_t a, std::size_t b) const {
    const Vector dx = lanes_.px[a] - lanes_.px[b];
    const Vector dy = lanes_.py[a] - lanes_.py[b];
    return dx * dx + dy * dy;
  }

  Mask touch(std::size_t a, std::size_t b) const { return square_root(square_distance(a, b)) < reach(a, b); }

  /// Contact is a soft wall: 100 times the softplus of how deep the two are in each other, along the line between them.
  /// Where they stand in one point there is no such line, and no force (the published program yields NaN there).
  void add_contact(const Layout::Pair& pair, std::array<Vector, most_entities>& fx,
                   std::array<Vector, most_entities>& fy) const {
    const auto& physics = layout_.scenario().physics;
    const Vector dx = lanes_.px[pair.a] - lanes_.px[pair.b];
    const Vector dy = lanes_.py[pair.a] - lanes_.py[pair.b];
    const Vector square = dx * dx + dy * dy;
    const Mask acts = square < pair.near_square && square > 0;
    if (!any(acts)) return;
    const Vector r = acts ? square_root(square) : all_lanes(pair.touching);
    const Vector depth = -(r - pair.touching) / physics.contact_margin;
    const Vector rest = log_of_one_plus(exponential(-minimum(absolute(depth), all_lanes(700))));
    const Vector penetration = ((depth > 0 ? depth : all_lanes(0)) + rest) * physics.contact_margin;
    const Vector force_x = acts ? physics.contact_force * dx / r * penetration : all_lanes(0);
    const Vector force_y = acts ? physics.contact_force * dy / r * penetration : all_lanes(0);
    fx[pair.a] += force_x;
    fy[pair.a] += force_y;
    if (pair.b_moves) {
      fx[pair.b] -= force_x;
      fy[pair.b] -= force_y;
    }
  }

  /// Velocity first, cut to the top speed, then position (semi-implicit Euler); all masses are 1.
  void integrate(std::size_t i, const Vector& fx, const Vector& fy) {
    const auto& physics = layout_.scenario().physics;
    const double top = layout_.scenario().entities[i].max_speed;
    Vector vx = lanes_.vx[i] * (1 - physics.damping) + fx * physics.time_step;
    Vector vy = lanes_.vy[i] * (1 - physics.damping) + fy * physics.time_step;
    const Vector speed = square_root(vx * vx + vy * vy);
    const Mask fast = speed > top;
    if (any(fast)) {
      vx = fast ? vx / speed * top : vx;
      vy = fast ? vy / speed * top : vy;
    }
    lanes_.vx[i] = vx;
    lanes_.vy[i] = vy;
    lanes_.px[i] += vx * physics.time_step;
    lanes_.py[i] += vy * physics.time_step;
  }

  /// boundary_penalty of scenario.h.
  static Vector penalty(const Vector& x) {
    if (!any(x >= 0.9)) return all_lanes(0);
    const Vector slope = x < 0.9 ? all_lanes(0) : 10.0 * (x - 0.9);
    if (!any(x >= 1.0)) return slope;
    const Vector beyond = minimum(exponential(minimum(2.0 * x - 2.0, all_lanes(4))), all_lanes(10));
    return x < 1.0 ? slope : beyond;
  }

  const Layout& layout_;
  const Block& block_;
  std::size_t first_;
  Lanes lanes_;
};

template <Stores stores>
void step_groups(const Layout& layout, const Block& block) {
  for (std::size_t first = 0; first < block.lanes; first += vector_lanes) {
    Group group(layout, block, first);
    group.move();
    group.observe<stores>();
    group.reward<stores>();
    group.store_state();
  }
}

}  // namespace

Layout::Layout(Scenario scenario)
    : scenario_(std::move(scenario)) {
  require_sound(scenario_);
  agents_ = scenario_.agents();
  landmarks_ = scenario_.landmarks();
  observation_begin_.push_back(0);
  for (std::size_t agent = 0; agent < agents_; ++agent)
    observation_begin_.push_back(observation_begin_.back() + scenario_.observation_size(agent));
  const auto& entities = scenario_.entities;
  for (std::size_t a = 0; a < entities.size(); ++a) {
    if (entities[a].role == Role::food) food_.push_back(a);
    if (entities[a].role == Role::forest) forests_.push_back(a);
    for (std::size_t b = a + 1; b < entities.size(); ++b) {
      if (!entities[a].collides() || !entities[b].collides() || !entities[a].moves()) continue;
      const double touching = entities[a].radius + entities[b].radius;
      const double near = touching + near_in_margins * scenario_.physics.contact_margin;
      pairs_.push_back({a, b, touching, near * near, entities[b].moves()});
    }
  }
}

std::optional<BadAction> find_bad_action(const Layout& layout, const Block& block) {
  for (std::size_t row = 0; row < layout.action_rows(); ++row)
    for (std::size_t first = 0; first < block.lanes; first += vector_lanes) {
      const double* actions = block.actions + row * block_lanes + first;
      const Mask fits = absolute(load(actions)) <= largest_action;  // false for NaN
      if (!any(~fits)) continue;
      for (std::size_t lane = 0; lane < std::min(vector_lanes, block.lanes - first); ++lane)
        if (fits[lane] == 0) return BadAction{row / 2, first + lane};
    }
  return std::nullopt;
}

void step(const Layout& layout, const Block& block, Stores stores) {
  if (stores == Stores::past_caches) {
    step_groups<Stores::past_caches>(layout, block);
    fence_stores();
  } else {
    step_groups<Stores::cached>(layout, block);
  }
}

void observe(const Layout& layout, const Block& block) {
  for (std::size_t first = 0; first < block.lanes; first += vector_lanes) {
    const Group group(layout, block, first);
    group.observe<Stores::cached>();
    for (std::size_t row = 0; row < layout.reward_rows(); ++row)
      store(block.rewards + row * block_lanes + first, all_lanes(0));
  }
}

}  // namespace folk::mpe
