#pragma once
// How a population becomes the next: the common face of all models of evolution.

#include <folk/games/random.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace folk {

/// How many there are of each strategy: whole numbers for the models of finite populations (exact: no model takes more
/// than 10^15 individuals), shares that add up to 1 for those of infinite ones.
using Population = std::vector<double>;

/// The most individuals of all strategies together.
inline constexpr double most_individuals = 1e15;

/// A model with its parameters and the scores that drive it.
class Dynamics {
public:
  virtual ~Dynamics() = default;

  /// Makes `now` the population of the next generation.
  virtual void advance(Population& now, RandomStream& random) const = 0;

  /// False where the next generation follows from this one.
  virtual bool is_random() const = 0;

  /// True for shares, false for individuals.
  virtual bool has_shares() const { return false; }

  /// True where a population of one strategy stays one of that strategy for ever.
  virtual bool stays_uniform() const = 0;

  /// Changes of no share by more than this count as none.
  virtual double tolerance() const { return 0; }

  /// Model and parameters, in one line.
  virtual std::string text() const = 0;
};

using DynamicsPtr = std::shared_ptr<const Dynamics>;

/// Whether a strategy earns in the company of its own kind (Mathieu & Delahaye's program, which calls them ind and
/// com): individuals do, families ("communities") earn `own` in its place, 0 as a rule.
enum class Income { individual, communal };

constexpr const char* to_string(Income income) { return income == Income::individual ? "ind" : "com"; }

/// How many strategies there are some of.
inline std::size_t living(const Population& population) {
  std::size_t count = 0;
  for (const double number : population) count += number > 0 ? 1U : 0U;
  return count;
}

/// An entrant drawn with probability in proportion to its weight, which is not negative; their sum is positive.
std::size_t drawn_by(const std::vector<double>& weights, RandomStream& random);

}  // namespace folk
