#pragma once
// Continuous search for the maximum of a function on a box, global and local, by NLopt.

#include <cstddef>
#include <functional>
#include <vector>

namespace folk {

/// A function of a point of the box.
using BoxFunction = std::function<double(const std::vector<double>&)>;

/// low[i] < high[i] in each coordinate, of which there is at least one.
struct Box {
  std::vector<double> low;
  std::vector<double> high;
};

/// The best point that was found; nothing says that there is no better one.
struct BoxOptimum {
  std::vector<double> point;
  double value = 0;
  std::size_t points = 0;  ///< how many were tried
  bool settled = false;    ///< climb: it ended by its tolerance and not by its number of points
};

// Both searches are deterministic and keep no state between calls: the same search gives the same answer on any thread.
// What `function` throws is passed on. They throw EnvironmentError when NLopt cannot search.

/// Global: DIRECT-L (Gablonsky & Kelley 2001) divides the box until about `points` points have been tried.
BoxOptimum explore(const BoxFunction& function, const Box& box, std::size_t points);

/// Local: BOBYQA (Powell 2009), on an interval Subplex (Rowan 1990), from `start` until its steps are smaller than
/// `tolerance` or `points` points have been tried.
BoxOptimum climb(const BoxFunction& function, const Box& box, const std::vector<double>& start, std::size_t points,
                 double tolerance);

}  // namespace folk
