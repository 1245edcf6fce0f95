#pragma once
// The particle world once more, one episode at a time and as slowly as it reads: written from the description of the
// published program's environment, for the fast one to be held against.

#include <folk/mpe/world/batch.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace folk::mpe::testing {

/// A body with its numbers as the description lists them.
struct NaiveBody {
  enum class Kind { predator, prey, obstacle, food, forest };
  Kind kind;
  double radius;
  double acceleration;
  double top_speed;
  double x = 0, y = 0, vx = 0, vy = 0;

  bool moves() const { return kind == Kind::predator || kind == Kind::prey; }
  bool collides() const { return kind != Kind::food && kind != Kind::forest; }
};

struct NaiveWorld {
  std::vector<NaiveBody> bodies;
  double catching = 0;       // for each touching predator
  double boundary = 0;       // times B(|x|) + B(|y|)
  double eating = 0;         // for each food that the prey is on
  double food_distance = 0;  // times the distance to the nearest food
  bool paper = false;        // catches instead of distances, not on top of them
  double margin = 1e-3;      // of contact

  static NaiveWorld simple_tag() {
    using enum NaiveBody::Kind;
    NaiveWorld world;
    for (int i = 0; i < 3; ++i) world.bodies.push_back({predator, 0.075, 3, 1});
    world.bodies.push_back({prey, 0.05, 4, 1.3});
    for (int i = 0; i < 2; ++i) world.bodies.push_back({obstacle, 0.2, 0, 0});
    world.catching = 10;
    world.boundary = 1;
    return world;
  }

  static NaiveWorld simple_world() {
    using enum NaiveBody::Kind;
    NaiveWorld world;
    for (int i = 0; i < 3; ++i) world.bodies.push_back({predator, 0.075, 3, 1});
    world.bodies.push_back({prey, 0.045, 4, 1.3});
    world.bodies.push_back({obstacle, 0.2, 0, 0});
    for (int i = 0; i < 2; ++i) world.bodies.push_back({food, 0.03, 0, 0});
    for (int i = 0; i < 2; ++i) world.bodies.push_back({forest, 0.3, 0, 0});
    world.catching = 5;
    world.boundary = 2;
    world.eating = 2;
    world.food_distance = 0.05;
    return world;
  }

  std::size_t agents() const {
    return static_cast<std::size_t>(std::count_if(bodies.begin(), bodies.end(), [](auto& b) { return b.moves(); }));
  }
  const NaiveBody& prey() const { return bodies[agents() - 1]; }

  void place(const EpisodeState& state) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i].x = state.positions[i].x;
      bodies[i].y = state.positions[i].y;
      if (!bodies[i].moves()) continue;
      bodies[i].vx = state.velocities[i].x;
      bodies[i].vy = state.velocities[i].y;
    }
  }

  static double distance(const NaiveBody& a, const NaiveBody& b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
  }
  static bool hit(const NaiveBody& a, const NaiveBody& b) { return distance(a, b) < a.radius + b.radius; }

  void step(const std::vector<Point>& actions) {
    std::vector<Point> forces(bodies.size());
    for (std::size_t i = 0; i < agents(); ++i) {
      forces[i].x = actions[i].x * bodies[i].acceleration * bodies[i].acceleration;
      forces[i].y = actions[i].y * bodies[i].acceleration * bodies[i].acceleration;
    }
    for (std::size_t a = 0; a < bodies.size(); ++a)
      for (std::size_t b = a + 1; b < bodies.size(); ++b) push_apart(a, b, forces);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (bodies[i].moves()) move(bodies[i], forces[i]);
  }

  void push_apart(std::size_t a, std::size_t b, std::vector<Point>& forces) const {
    const NaiveBody& one = bodies[a];
    const NaiveBody& other = bodies[b];
    if (!one.collides() || !other.collides() || !(one.moves() || other.moves())) return;
    const double r = distance(one, other);
    if (r == 0) return;  // no direction, no force
    const double x = -(r - (one.radius + other.radius)) / margin;
    const double penetration = margin * (std::max(0.0, x) + std::log1p(std::exp(-std::abs(x))));
    const double fx = 100 * (one.x - other.x) / r * penetration;
    const double fy = 100 * (one.y - other.y) / r * penetration;
    forces[a].x += fx;
    forces[a].y += fy;
    forces[b].x -= fx;
    forces[b].y -= fy;
  }

  static void move(NaiveBody& body, const Point& force) {
    body.vx = 0.75 * body.vx + force.x * 0.1;
    body.vy = 0.75 * body.vy + force.y * 0.1;
    const double speed = std::sqrt(body.vx * body.vx + body.vy * body.vy);
    if (speed > body.top_speed) {
      body.vx = body.vx / speed * body.top_speed;
      body.vy = body.vy / speed * body.top_speed;
    }
    body.x += 0.1 * body.vx;
    body.y += 0.1 * body.vy;
  }

  std::vector<double> observation(std::size_t agent) const {
    const NaiveBody& self = bodies[agent];
    std::vector<double> seen{self.vx, self.vy, self.x, self.y};
    const auto from_here = [&](const NaiveBody& other) {
      seen.push_back(other.x - self.x);
      seen.push_back(other.y - self.y);
    };
    for (std::size_t i = agents(); i < bodies.size(); ++i) from_here(bodies[i]);
    for (std::size_t i = 0; i < agents(); ++i)
      if (i != agent) from_here(bodies[i]);
    if (self.kind == NaiveBody::Kind::predator) {
      seen.push_back(prey().vx);
      seen.push_back(prey().vy);
    }
    for (const NaiveBody& body : bodies)
      if (body.kind == NaiveBody::Kind::forest) seen.push_back(hit(self, body) ? 1 : -1);
    return seen;
  }

  static double outside(double x) {
    if (x < 0.9) return 0;
    if (x < 1) return (x - 0.9) * 10;
    return std::min(std::exp(2 * x - 2), 10.0);
  }

  double reward(std::size_t agent) const {
    double distances = 0;
    int hits = 0;
    for (const NaiveBody& body : bodies) {
      if (body.kind != NaiveBody::Kind::predator) continue;
      distances += distance(body, prey());
      if (hit(body, prey())) ++hits;
    }
    const double both = catching * hits - 0.1 * distances;
    if (agent + 1 != agents()) return !paper ? both : hits > 0 ? catching * hits : -0.1 * distances;
    double sum = -both - boundary * outside(std::abs(prey().x)) - boundary * outside(std::abs(prey().y));
    double nearest = -1;
    for (const NaiveBody& body : bodies) {
      if (body.kind != NaiveBody::Kind::food) continue;
      if (hit(body, prey())) sum += eating;
      const double here = distance(body, prey());
      nearest = nearest < 0 ? here : std::min(nearest, here);
    }
    return nearest < 0 ? sum : sum + food_distance * nearest;
  }
};

}  // namespace folk::mpe::testing
