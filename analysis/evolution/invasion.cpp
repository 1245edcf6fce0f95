#include <folk/analysis/evolution/invasion.h>
#include <folk/games/error.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace folk {
namespace {

/// Compares scores of a tournament with regard to how they were obtained.
class Comparison {
public:
  explicit Comparison(const Tournament& tournament)
      : tournament_(tournament) {
    double largest = 0;
    for (const double payoff : tournament.settings().payoffs.numbers()) largest = std::max(largest, std::abs(payoff));
    tolerance_ = equal_within * largest * tournament.settings().criterion.total_weight();
  }

  /// The sign of V(a, b) - V(c, d); nothing where it cannot be told.
  std::optional<int> operator()(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    const Method first = tournament_.method(a, b);
    const Method second = tournament_.method(c, d);
    if (!decides(first) || !decides(second)) return std::nullopt;
    const double difference = tournament_.score(a, b) - tournament_.score(c, d);
    const auto& criterion = tournament_.settings().criterion;
    if (is_exact(first, criterion) && is_exact(second, criterion)) return sign(difference, 0);
    if (first != Method::sampled && second != Method::sampled) return sign(difference, tolerance_);
    const double error = std::hypot(tournament_.standard_error(a, b), tournament_.standard_error(c, d));
    const int found = sign(difference, tolerance_ + decisive_errors * error);
    return found == 0 ? std::nullopt : std::optional(found);
  }

private:
  bool decides(Method method) const {
    if (method == Method::bounded) return false;
    return method != Method::sampled || tournament_.settings().repetitions > 1;
  }

  static int sign(double difference, double tolerance) {
    return difference > tolerance ? 1 : difference < -tolerance ? -1 : 0;
  }

  const Tournament& tournament_;
  double tolerance_ = 0;
};

Invasion outcome_of(const Comparison& compare, std::size_t mutant, std::size_t resident) {
  if (mutant == resident) return Invasion::weakly;
  auto sign = compare(mutant, resident, resident, resident);
  if (sign == 0) {
    sign = compare(mutant, mutant, resident, mutant);
    if (sign == 0) return Invasion::weakly;
  }
  if (!sign) return Invasion::undecided;
  return *sign > 0 ? Invasion::strictly : Invasion::resists;
}

}  // namespace

Invasions::Invasions(const Tournament& tournament, const Progress& progress)
    : size_(tournament.size()) {
  if (!tournament.settings().self_play)
    throw UsageError("who invades whom depends on what each earns against its own copy: play with self-play");
  const Comparison compare(tournament);
  cells_.reserve(size_ * size_);
  for (std::size_t resident = 0; resident < size_; ++resident) {
    for (std::size_t mutant = 0; mutant < size_; ++mutant) cells_.push_back(outcome_of(compare, mutant, resident));
    progress(static_cast<double>(resident + 1) / static_cast<double>(size_));
  }
}

std::vector<std::size_t> Invasions::mutants(std::size_t resident, Invasion how) const {
  std::vector<std::size_t> found;
  for (std::size_t mutant = 0; mutant < size_; ++mutant)
    if (mutant != resident && invasion(mutant, resident) == how) found.push_back(mutant);
  return found;
}

Stability Invasions::stability(std::size_t resident) const {
  if (!mutants(resident, Invasion::strictly).empty()) return Stability::invaded;
  if (!mutants(resident, Invasion::undecided).empty()) return Stability::undecided;
  return mutants(resident, Invasion::weakly).empty() ? Stability::evolutionarily_stable : Stability::neutrally_stable;
}

}  // namespace folk
