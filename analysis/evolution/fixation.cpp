#include <folk/analysis/evolution/finite_population.h>
#include <folk/analysis/evolution/fixation.h>
#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace folk {
namespace {

constexpr std::uint64_t most_computed = 10'000'000;

/// Fewer mutants always become more, and more become fewer.
constexpr const char* neither =
    "neither type ever takes over: each has no fitness where the other is to grow; choose a smaller intensity";

void check(std::uint64_t population, std::uint64_t mutants) {
  if (population < 2 || population > most_computed)
    throw UsageError(fmt::format("fixation in a population of {}: expected 2 to {}", population, most_computed));
  if (mutants > population)
    throw UsageError(
        fmt::format("{} mutants in a population of {}: expected at most all of them", mutants, population));
}

/// What a mutant (first) and a resident earn on average where there are j mutants.
template <class Number>
std::array<Number, 2> mean_payoffs(const TwoTypes<Number>& u, const Number& j, const Number& n, bool meets_itself) {
  const Number one(1);
  if (meets_itself) return {(u.aa * j + u.ab * (n - j)) / n, (u.ba * j + u.bb * (n - j)) / n};
  return {(u.aa * (j - one) + u.ab * (n - j)) / (n - one), (u.ba * j + u.bb * (n - j - one)) / (n - one)};
}

/// log(e^a + e^b)
long double log_sum(long double a, long double b) {
  if (a < b) std::swap(a, b);
  return std::isinf(b) && b < 0 ? a : a + std::log1p(std::exp(b - a));
}

/// The logarithm of g_j.
class LogRatio {
public:
  LogRatio(const TwoTypes<double>& payoffs, std::uint64_t population, const SelectionRules& rules)
      : u_{payoffs.aa, payoffs.ab, payoffs.ba, payoffs.bb},
        n_(static_cast<long double>(population)),
        w_(static_cast<long double>(to_double(rules.intensity))),
        rules_(rules) {}

  /// g_j itself, where it fits.
  long double plain(std::uint64_t j) const {
    const auto [f, g] = success(j);
    return exponential() ? std::exp(g - f) : g / f;
  }

  long double operator()(std::uint64_t j) const {
    const auto [f, g] = success(j);
    return exponential() ? g - f : std::log(g) - std::log(f);
  }

private:
  bool exponential() const {
    return rules_.process == Process::pairwise_comparison || rules_.fitness == Fitness::exponential;
  }

  /// Of a mutant and a resident: fitness, or its logarithm where it is exponential.
  std::array<long double, 2> success(std::uint64_t j) const {
    const auto [mutant, resident] = mean_payoffs(u_, static_cast<long double>(j), n_, rules_.meets_itself);
    if (exponential()) return {w_ * mutant, w_ * resident};
    const long double f = 1 - w_ + w_ * mutant;
    const long double g = 1 - w_ + w_ * resident;
    if (f < 0 || g < 0 || (f == 0 && g == 0))
      throw UsageError(
          fmt::format("fitness 1 - w + w payoff is {} for mutants and {} for residents where there are {} "
                      "mutants: choose a smaller intensity or exponential fitness",
                      static_cast<double>(f), static_cast<double>(g), j));
    return {f, g};
  }

  TwoTypes<long double> u_;
  long double n_;
  long double w_;
  const SelectionRules& rules_;
};

TwoTypes<double> payoffs_of(const ScoreMatrix& scores, std::size_t mutant, std::size_t resident) {
  return {scores.payoff(mutant, mutant), scores.payoff(mutant, resident), scores.payoff(resident, mutant),
          scores.payoff(resident, resident)};
}

TwoTypes<Rational> exact_payoffs_of(const ScoreMatrix& scores, std::size_t mutant, std::size_t resident) {
  return {scores.exact_payoff(mutant, mutant), scores.exact_payoff(mutant, resident),
          scores.exact_payoff(resident, mutant), scores.exact_payoff(resident, resident)};
}

}  // namespace

long double log_fixation_probability(const TwoTypes<double>& payoffs, std::uint64_t population, std::uint64_t mutants,
                                     const SelectionRules& rules) {
  check(rules);
  check(population, mutants);
  constexpr long double never = -std::numeric_limits<long double>::infinity();
  if (mutants == 0) return never;
  if (mutants == population) return 0;
  const LogRatio ratio(payoffs, population, rules);
  if (mutants == 1) {  // without logarithms as long as that fits
    long double sum = 1;
    for (std::uint64_t j = population - 1; j > 0; --j) sum = 1 + ratio.plain(j) * sum;
    if (std::isfinite(sum)) return -std::log(sum);
  }
  // 1 + g_1 (1 + g_2 (1 + ...)) from within, once up to i - 1 and once from i on, as logarithms; log of
  // a + p b, p = g_1 ... g_{i-1}: a is what stands above.
  long double beyond = 0;
  for (std::uint64_t j = population - 1; j > mutants; --j) beyond = log_sum(0, ratio(j) + beyond);
  beyond += ratio(mutants);  // g_i (1 + g_{i+1} (...))
  long double above = 0;
  long double product = 0;
  for (std::uint64_t j = mutants - 1; j > 0; --j) {
    const long double g = ratio(j);
    if (std::isinf(g) && g > 0) break;  // so few mutants have no offspring: they are as good as none
    above = log_sum(0, g + above);
    product += g;
  }
  const long double rest = product + beyond - above;  // above / (above + product beyond)
  if (std::isnan(rest)) throw UsageError(neither);
  if (std::isinf(rest)) return rest > 0 ? never : 0;
  return -log_sum(0, rest);
}

double fixation_probability(const TwoTypes<double>& payoffs, std::uint64_t population, std::uint64_t mutants,
                            const SelectionRules& rules) {
  return static_cast<double>(std::exp(log_fixation_probability(payoffs, population, mutants, rules)));
}

Rational exact_fixation_probability(const TwoTypes<Rational>& payoffs, std::uint64_t population, std::uint64_t mutants,
                                    const SelectionRules& rules) {
  check(rules);
  check(population, mutants);
  if (rules.process != Process::birth_death || rules.fitness != Fitness::linear)
    throw UsageError(
        "exact fixation probabilities are fractions in birth-death with linear fitness alone: others hold "
        "exponentials");
  if (population > most_exact)
    throw UsageError(
        fmt::format("exact fixation probabilities: expected at most {} individuals, not {}", most_exact, population));
  if (mutants == 0) return 0;
  if (mutants == population) return 1;
  // Fitness of mutants f_j and residents g_j as whole numbers, of the same scale; 1 + (g_1/f_1) (1 + ...) from within
  // as above / below, without a common divisor being looked for.
  const Rational n(population);
  Integer scale = 1;
  std::vector<std::array<Rational, 2>> fitness;
  for (std::uint64_t j = 1; j < population; ++j) {
    const auto earned = mean_payoffs<Rational>(payoffs, Rational(j), n, rules.meets_itself);
    auto& both = fitness.emplace_back();
    for (std::size_t k = 0; k < 2; ++k) {
      both[k] = Rational(1) - rules.intensity + rules.intensity * earned[k];
      if (both[k] < 0)
        throw UsageError(fmt::format("fitness 1 - w + w payoff is {}: choose a smaller intensity", to_text(both[k])));
      scale = lcm(scale, both[k].denominator());
    }
    if (both[0].is_zero() && both[1].is_zero())
      throw UsageError(fmt::format("nobody has any fitness where there are {} mutants: choose a smaller intensity", j));
  }
  const auto whole = [&](const Rational& value) { return value.numerator() * (scale / value.denominator()); };
  // sum_{k=0}^{i-1} g_1 ... g_k f_{k+1} ... f_{N-1} over the same sum up to N - 1.
  Integer all = 1;     // the sum from within, times f_j ... f_{N-1}
  Integer births = 1;  // f_j ... f_{N-1}
  Integer above = 0;
  for (std::uint64_t j = population - 1; j > 0; --j) {
    const Integer f = whole(fitness[j - 1][0]);
    const Integer g = whole(fitness[j - 1][1]);
    births *= f;
    all = births + g * all;
    above = j < mutants ? births + g * above : births;
  }
  if (all.is_zero()) throw UsageError(neither);
  return {above, all};
}

double FixationProbabilities::probability(std::size_t mutant, std::size_t resident) const {
  return static_cast<double>(std::exp(logarithms[resident * strategies + mutant]));
}

double FixationProbabilities::ratio(std::size_t mutant, std::size_t resident) const {
  return static_cast<double>(
      std::exp(logarithms[resident * strategies + mutant] + std::log(static_cast<long double>(population))));
}

FixationProbabilities fixation_probabilities(const ScoreMatrix& scores, std::uint64_t population,
                                             const SelectionRules& rules, bool exact, unsigned threads,
                                             const Progress& progress) {
  require_fitness(scores, rules);
  check(population, 1);
  if (exact && !scores.exact())
    throw UsageError(
        "exact fixation probabilities need exact scores: deterministic strategies over a number of rounds");
  const std::size_t n = scores.size();
  FixationProbabilities found{n, population, std::vector<long double>(n * n, 0), {}};
  if (exact) found.exact.assign(n * n, 1);
  // Entrants that behave alike have the same probabilities: one of each behaviour is asked.
  const std::size_t kinds = scores.behaviours();
  std::vector<std::size_t> member(kinds, 0);
  for (std::size_t i = 0; i < n; ++i) member[scores.behaviour(i)] = i;
  std::vector<long double> logarithms(kinds * kinds);
  std::vector<Rational> fractions(exact ? kinds * kinds : 0);
  parallel_for(
      kinds, threads,
      [&](std::size_t a, unsigned) {
        for (std::size_t b = 0; b < kinds; ++b) {
          progress.check();
          const std::size_t resident = member[a];
          const std::size_t mutant = member[b];
          logarithms[a * kinds + b] =
              log_fixation_probability(payoffs_of(scores, mutant, resident), population, 1, rules);
          if (exact)
            fractions[a * kinds + b] =
                exact_fixation_probability(exact_payoffs_of(scores, mutant, resident), population, 1, rules);
        }
      },
      progress);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const std::size_t at = scores.behaviour(i) * kinds + scores.behaviour(j);
      found.logarithms[i * n + j] = logarithms[at];
      if (exact) found.exact[i * n + j] = fractions[at];
    }
  return found;
}

}  // namespace folk
