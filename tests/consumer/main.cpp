// What a program outside Folk writes: a tournament of three strategies. Exits 0 when it comes out as it must.

#include <folk/analysis/tournament/tournament.h>
#include <folk/strategies/registry.h>

#include <cstdio>

int main() {
  folk::TournamentSettings settings;
  settings.criterion = folk::Criterion::finite(10);
  const auto tournament =
      folk::play_tournament(folk::Registry::standard().roster("tit_for_tat,all_d,pavlov"), settings);

  for (const folk::RankingEntry& entry : tournament.ranking()) {
    std::printf("%zu. %-12s %3.0Lf\n", entry.rank, tournament.name(entry.entrant).c_str(), entry.total);
  }
  const folk::RankingEntry& best = tournament.ranking().front();
  return tournament.name(best.entrant) == "tit_for_tat" && best.total == 69 ? 0 : 1;
}
