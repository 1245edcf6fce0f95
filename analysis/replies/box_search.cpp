#include <folk/analysis/replies/box_search.h>
#include <folk/games/error.h>

#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <type_traits>

namespace folk {
namespace {

using Optimiser = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)>;

/// What the two stages share: the best point so far, and what the function threw.
struct Search {
  const BoxFunction& function;
  BoxOptimum best;
  std::exception_ptr thrown;
  nlopt_opt running = nullptr;
};

/// NLopt is a C library, no exception may pass through it: it is kept and the search stopped.
double tried(unsigned size, const double* point, double*, void* data) {
  auto& search = *static_cast<Search*>(data);
  try {
    const std::vector<double> here(point, point + size);
    const double value = search.function(here);
    if (search.best.points++ == 0 || value > search.best.value) {
      search.best.point = here;
      search.best.value = value;
    }
    return value;
  } catch (...) {
    search.thrown = std::current_exception();
    nlopt_force_stop(search.running);
    return -std::numeric_limits<double>::infinity();
  }
}

/// Runs one algorithm from `start`; `search` holds what it finds.
nlopt_result run(nlopt_algorithm algorithm, const Box& box, const std::vector<double>& start, std::size_t points,
                 double tolerance, Search& search) {
  const auto size = static_cast<unsigned>(box.low.size());
  const Optimiser optimiser(nlopt_create(algorithm, size), &nlopt_destroy);
  if (!optimiser) throw EnvironmentError("NLopt cannot start a search: out of memory");
  search.running = optimiser.get();
  nlopt_set_max_objective(optimiser.get(), tried, &search);
  nlopt_set_lower_bounds(optimiser.get(), box.low.data());
  nlopt_set_upper_bounds(optimiser.get(), box.high.data());
  // By default the first steps depend on how near the ends are, down to nothing.
  std::vector<double> steps;
  for (std::size_t i = 0; i < size; ++i) steps.push_back((box.high[i] - box.low[i]) / 10);
  nlopt_set_initial_step(optimiser.get(), steps.data());
  nlopt_set_maxeval(optimiser.get(), static_cast<int>(points));
  if (tolerance > 0) nlopt_set_xtol_abs1(optimiser.get(), tolerance);
  std::vector<double> point = start;  // NLopt refuses one that rounding put outside
  for (std::size_t i = 0; i < size; ++i) point[i] = std::clamp(point[i], box.low[i], box.high[i]);
  double value = 0;
  const nlopt_result result = nlopt_optimize(optimiser.get(), point.data(), &value);
  if (search.thrown) std::rethrow_exception(search.thrown);
  if (result < 0 && search.best.points == 0)
    throw EnvironmentError(fmt::format("NLopt cannot search: {}", nlopt_result_to_string(result)));
  return result;
}

}  // namespace

BoxOptimum explore(const BoxFunction& function, const Box& box, std::size_t points) {
  Search search{function, {}, nullptr};
  std::vector<double> middle;
  for (std::size_t i = 0; i < box.low.size(); ++i) middle.push_back((box.low[i] + box.high[i]) / 2);
  run(NLOPT_GN_DIRECT_L, box, middle, points, 0, search);
  return search.best;
}

BoxOptimum climb(const BoxFunction& function, const Box& box, const std::vector<double>& start, std::size_t points,
                 double tolerance) {
  Search search{function, {}, nullptr};
  // BOBYQA's quadratic models need at least two coordinates.
  const nlopt_algorithm algorithm = box.low.size() == 1 ? NLOPT_LN_SBPLX : NLOPT_LN_BOBYQA;
  const nlopt_result result = run(algorithm, box, start, points, tolerance, search);
  search.best.settled = (result > 0 && result != NLOPT_MAXEVAL_REACHED) || result == NLOPT_ROUNDOFF_LIMITED;
  return search.best;
}

}  // namespace folk
