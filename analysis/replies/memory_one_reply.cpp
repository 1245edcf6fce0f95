#include <folk/analysis/play/parallel.h>
#include <folk/analysis/replies/best_reply.h>
#include <folk/analysis/replies/box_search.h>
#include <folk/analysis/replies/memory_one_reply.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace folk {
namespace {

/// The search's share of the work; the rest compares what it found with all strategies.
constexpr double searching = 0.99;

/// A face of the cube with an opening: which probabilities are free, and where the others stand.
struct Face {
  MemoryOne fixed;
  std::vector<std::size_t> free;  // coordinates

  MemoryOne at(const std::vector<double>& point) const {
    MemoryOne strategy = fixed;
    for (std::size_t k = 0; k < free.size(); ++k) strategy.after[free[k]] = point[k];
    return strategy;
  }
};

/// All faces, those of the fewest dimensions first: vertices, edges, ..., the inside.
std::vector<Face> faces() {
  std::vector<Face> all;
  for (const Move opening : {Move::C, Move::D})
    for (unsigned code = 0; code < 81; ++code) {
      Face face{{opening, {}}, {}};
      for (std::size_t k = 0, left = code; k < 4; ++k, left /= 3) {
        if (left % 3 == 2)
          face.free.push_back(k);
        else
          face.fixed.after[k] = left % 3 == 0 ? 1 : 0;
      }
      all.push_back(std::move(face));
    }
  std::stable_sort(all.begin(), all.end(), [](const Face& a, const Face& b) { return a.free.size() < b.free.size(); });
  return all;
}

/// A box whose sides are all the same.
Box cube(std::size_t size, double low, double high) {
  return {std::vector<double>(size, low), std::vector<double>(size, high)};
}

double probability(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }
double log_odds(double probability) { return std::log(probability / (1 - probability)); }

std::vector<double> each(std::vector<double> point, double (*change)(double)) {
  std::transform(point.begin(), point.end(), point.begin(), change);
  return point;
}

/// The better of two, and the points of both.
BoxOptimum better(BoxOptimum first, BoxOptimum second) {
  const std::size_t points = first.points + second.points;
  BoxOptimum best = second.value > first.value ? std::move(second) : std::move(first);
  best.points = points;
  return best;
}

/// The best point inside a face. A vertex is its own.
BoxOptimum search_face(const WeightedOpponents& population, const Face& face, std::size_t points) {
  const std::size_t size = face.free.size();
  if (size == 0) return {{}, population.payoff(face.fixed), 1, true};
  const auto payoff = [&](const std::vector<double>& point) { return population.payoff(face.at(point)); };
  const double share = std::pow(static_cast<double>(points), static_cast<double>(size) / 4);
  const std::size_t steps = 300 * size;

  const Box inside = cube(size, open_end, 1 - open_end);
  const BoxOptimum begin = explore(payoff, inside, static_cast<std::size_t>(std::ceil(share)) + 10);
  BoxOptimum found = climb(payoff, inside, begin.point, steps, 1e-10);
  const bool settled = found.settled;
  found = better(begin, std::move(found));

  // Near an end that is open what counts is how small a probability is: log-odds show it.
  const auto from_odds = [&](const std::vector<double>& odds) { return payoff(each(odds, probability)); };
  const double end = log_odds(1 - open_end);
  BoxOptimum finer = climb(from_odds, cube(size, -end, end), each(found.point, log_odds), steps, 1e-9);
  finer.point = each(finer.point, probability);
  found = better(std::move(found), std::move(finer));
  found.settled = settled;
  return found;
}

/// By how much the payoff rises along one coordinate: along its log-odds, from 0 or 1 inwards as far as it does.
double ascent(const WeightedOpponents& population, const MemoryOne& at, std::size_t coordinate) {
  const double here = at.after[coordinate];
  const auto payoff = [&](double there) {
    MemoryOne moved = at;
    moved.after[coordinate] = there;
    return population.payoff(moved);
  };
  constexpr double step = 1e-5;
  if (here > 0 && here < 1) {
    const double near = std::min({step, here / 1000, (1 - here) / 1000});
    return here * (1 - here) * std::abs(payoff(here + near) - payoff(here - near)) / (2 * near);
  }
  const double inwards = here == 0 ? step : -step;
  return std::max(0.0, (4 * payoff(here + inwards) - 3 * payoff(here) - payoff(here + 2 * inwards)) / (2 * step));
}

/// What best replies earn that know whom they meet.
void compare_with_all_strategies(const WeightedOpponents& population, SearchCertificate& certificate,
                                 const Progress& progress) {
  for (std::size_t i = 0; i < population.size(); ++i) {
    const WeightedOpponent& member = population.member(i);
    const BestReply reply = best_reply(member.machine, population.rules());
    certificate.unrestricted += member.weight * reply.payoff;
    certificate.residual += member.weight * reply.residual;
    progress(static_cast<double>(i + 1) / static_cast<double>(population.size()));
  }
}

/// The best of the faces from `begin` to `end`; a later one must earn more than rounding explains.
std::size_t best_of(const std::vector<BoxOptimum>& found, std::size_t begin, std::size_t end) {
  std::size_t best = begin;
  for (std::size_t f = begin; f < end; ++f)
    if (found[f].value > found[best].value + 1e-9 * std::max(1e-3, std::abs(found[best].value))) best = f;
  return best;
}

}  // namespace

MemoryOneReply memory_one_reply(const WeightedOpponents& population, const MemoryOneSearch& search,
                                const Progress& progress) {
  const std::vector<Face> all = faces();
  constexpr std::size_t vertices = 32;
  std::vector<BoxOptimum> found(all.size());
  // The inside takes longest: it goes first.
  parallel_for(
      all.size(), search.threads,
      [&](std::size_t i, unsigned) {
        const std::size_t f = all.size() - 1 - i;
        found[f] = search_face(population, all[f], search.points);
      },
      progress.part(0, searching));

  const std::size_t best = best_of(found, 0, all.size());
  const std::size_t corner = best_of(found, 0, vertices);
  MemoryOneReply reply{all[best].at(found[best].point), found[best].value, {}};
  SearchCertificate& certificate = reply.certificate;
  certificate.faces = all.size();
  for (const BoxOptimum& optimum : found) {
    certificate.points += optimum.points;
    certificate.unsettled += optimum.settled ? 0 : 1;
  }
  certificate.corner = all[corner].fixed;
  certificate.corner_payoff = found[corner].value;
  for (std::size_t k = 0; k < 4; ++k)
    certificate.slope = std::max(certificate.slope, ascent(population, reply.strategy, k));
  certificate.at_open_end = std::any_of(found[best].point.begin(), found[best].point.end(),
                                        [](double p) { return std::min(p, 1 - p) < 1e-6; });
  compare_with_all_strategies(population, certificate, progress.part(searching, 1));
  return reply;
}

}  // namespace folk
