#include <folk/tools/ipd_evolve/solved.h>

#include <folk/analysis/evolution/small_mutations.h>

namespace folk::tools {

FixationReport solved(const PlayedScores& played, const EvolveQuestion& question, std::uint64_t seed, unsigned threads,
                      const Progress& progress) {
  FixationReport report{played, question, {}};
  report.seed = seed;
  const bool stationary = question.question == Question::stationary;
  report.fixation = fixation_probabilities(*played.scores, question.individuals, question.rules, question.exact,
                                           threads, progress.part(0, stationary ? 0.5 : 1));
  if (!stationary) return report;
  const double exact = question.exact ? 0.51 : 1;
  report.distribution = small_mutation_distribution(report.fixation, progress.part(0.5, exact));
  if (question.exact)
    report.exact_distribution = exact_small_mutation_distribution(report.fixation, progress.part(exact, 1));
  return report;
}

}  // namespace folk::tools
