#include <folk/games/match.h>
#include <folk/games/match_key.h>
#include <folk/games/outcome.h>
#include <folk/sct/data/tournament_data.h>

namespace folk::sct {

std::vector<Trajectory> tournament_data(const std::vector<Strategy>& roster, const Payoffs& payoffs,
                                        std::uint64_t rounds, Repetitions repetitions, std::uint64_t seed) {
  const auto rewards = payoffs.numbers();
  std::vector<Trajectory> data;
  for (std::size_t i = 0; i < roster.size(); ++i)
    for (std::size_t j = i; j < roster.size(); ++j)
      for (std::uint64_t r = 0; r < repetitions; ++r) {
        const auto first = roster[i].new_player();
        const auto second = roster[j].new_player();
        const std::uint64_t pair = i * roster.size() + j;
        first->start({payoffs, Criterion::finite(rounds), match_key(seed, pair, r, MatchRole::first)});
        second->start({payoffs, Criterion::finite(rounds), match_key(seed, pair, r, MatchRole::second)});
        Trajectory mine{roster[i].name, roster[j].name, {}, {}, {}};
        Trajectory theirs{roster[j].name, roster[i].name, {}, {}, {}};
        play_match(*first, *second, rounds, NoNoise{}, [&](Move a, Move b) {
          mine.add(a, b, rewards[Outcome{a, b}.index()]);
          theirs.add(b, a, rewards[Outcome{b, a}.index()]);
        });
        data.push_back(std::move(mine));
        if (i != j || theirs.own != data.back().own) data.push_back(std::move(theirs));
      }
  return data;
}

}  // namespace folk::sct
