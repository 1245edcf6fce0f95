#pragma once
// Three strategies as a triangle: where selection leads from every mixture, and the way a population went; drawn by
// gnuplot.

#include <folk/analysis/pictures/caption.h>
#include <folk/analysis/pictures/render.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace folk {

/// Shares of three strategies, which add up to 1.
using Mixture = std::array<double, 3>;

struct SimplexPlot {
  std::array<std::string, 3> names;              ///< at the left, the right and the upper corner
  std::array<std::array<double, 3>, 3> payoffs;  ///< row against column
  std::vector<Mixture> way;                      ///< drawn as a line with a circle at its end, where there is one
  std::string title;
  Caption caption{};
};

/// The velocity of the replicator equation, p_i (f_i - phi) with f_i = sum_j a_ij p_j, phi = sum_i p_i f_i (Taylor &
/// Jonker 1978). Its entries add up to 0.
Mixture replicator_velocity(const std::array<std::array<double, 3>, 3>& payoffs, const Mixture& p);

/// Arrows of one length show the direction, their colour the speed, from slow (light) to fast (dark); a ring is a
/// mixture in which nothing changes. Throws UsageError on a payoff that is not finite.
std::string simplex_script(const SimplexPlot& plot, PictureFormat format);
void draw(const SimplexPlot& plot, const std::filesystem::path& path);

}  // namespace folk
