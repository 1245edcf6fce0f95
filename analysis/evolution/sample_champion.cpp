#include <folk/analysis/evolution/integer_selection.h>
#include <folk/analysis/evolution/sample_champion.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/games/random.h>

#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>
#include <utility>

namespace folk {
namespace {

/// What draws, after those who deal sub-rosters.
constexpr std::uint64_t sampling_role = 7;

/// Different members, each gene of each a fair coin; one that was drawn before is drawn again.
std::vector<Strategy> drawn(const MemoryClass& members, const SampleChampionSettings& settings) {
  RandomStream random({settings.seed, 0, 0, sampling_role});
  std::set<std::vector<bool>> known;
  std::vector<Strategy> sample;
  while (sample.size() < settings.sample) {
    std::vector<bool> genes(members.genes());
    for (std::size_t gene = 0; gene < genes.size(); ++gene) genes[gene] = (random() >> 63U) != 0;
    if (!known.insert(genes).second) continue;
    auto machine = std::make_shared<MemoryMachine>(members.member(genes));
    Strategy strategy;
    strategy.name = machine->name();
    strategy.machine = std::move(machine);
    sample.push_back(std::move(strategy));
  }
  return sample;
}

}  // namespace

SampleChampions sample_champions(const MemoryClass& members, const SampleChampionSettings& settings,
                                 const Progress& progress) {
  if (settings.sample == 0 || settings.sample > MemoryClass::most_listed || members.size() < Integer(settings.sample))
    throw UsageError(fmt::format("a sample of {} of the {} members of {}: expected from 1 to all, and to {}",
                                 settings.sample, members.size_text(), members.name(), MemoryClass::most_listed));
  const auto sample = drawn(members, settings);
  TournamentSettings rules;
  rules.payoffs = settings.payoffs;
  rules.criterion = settings.criterion;
  rules.threads = settings.threads;
  const auto scores = std::make_shared<ScoreMatrix>(play_tournament(sample, rules, progress.part(0, 0.4)));
  const Population start(sample.size(), settings.population);
  Evolution evolution(std::make_shared<IntegerSelection>(scores, start), start);
  evolution.run(settings.generations, progress.part(0.4, 0.8));

  SampleChampions found;
  found.generations = evolution.state().generation;
  found.end = evolution.state().end;
  const auto last = summary_of(found.generations, evolution.state().population);
  found.survivors = last.living;
  found.individuals = last.individuals;
  std::map<std::size_t, std::optional<ClassScore>> scored;  // by behaviour
  for (const PopulationRank& entry : evolution.ranking()) {
    if (entry.rank > 1) break;
    const std::size_t behaviour = scores->behaviour(entry.entrant);
    if (scored.count(behaviour) == 0) {
      try {
        scored[behaviour] = score_against(members, *sample[entry.entrant].machine, settings);
      } catch (const TooManyKinds&) {
        scored[behaviour] = std::nullopt;
      }
    }
    progress.check();
    found.winners.push_back({sample[entry.entrant].name, entry.population, scored[behaviour]});
  }
  progress(1);
  return found;
}

}  // namespace folk
