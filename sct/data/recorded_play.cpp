#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/games/criterion.h>
#include <folk/games/match_key.h>
#include <folk/games/outcome.h>
#include <folk/sct/data/recorded_play.h>

#include <memory>
#include <utility>

namespace folk::sct {
namespace {

/// A match that is being recorded.
struct Table {
  std::unique_ptr<Player> player;
  std::unique_ptr<Player> opponent;
  RandomStream slips;
};

}  // namespace

std::vector<Trajectory> play_and_record(const Strategy& player, const std::vector<Strategy>& roster,
                                        const Payoffs& payoffs, std::uint64_t rounds, Noise slip,
                                        Repetitions repetitions, std::uint64_t seed, unsigned threads) {
  const auto rewards = payoffs.numbers();
  std::vector<Table> tables;
  std::vector<Trajectory> data;
  std::vector<Player*> players;
  for (std::size_t i = 0; i < roster.size(); ++i)
    for (std::uint64_t r = 0; r < repetitions; ++r) {
      const auto key = [&](MatchRole role) { return match_key(seed, i, r, role); };
      tables.push_back({player.new_player(), roster[i].new_player(), RandomStream(key(MatchRole::noise))});
      tables.back().player->start({payoffs, Criterion::finite(rounds), key(MatchRole::first)});
      tables.back().opponent->start({payoffs, Criterion::finite(rounds), key(MatchRole::second)});
      players.push_back(tables.back().player.get());
      data.push_back({player.name, roster[i].name, {}, {}, {}});
    }
  for (std::uint64_t t = 0; t < rounds; ++t) {
    if (player.thinks_together) players.front()->think_together(players, threads);
    for (std::size_t m = 0; m < tables.size(); ++m) {
      Move own = tables[m].player->move();
      const Move theirs = tables[m].opponent->move();
      if (slip > 0 && tables[m].slips.chance(slip)) own = other(own);
      data[m].add(own, theirs, rewards[Outcome{own, theirs}.index()]);
      tables[m].player->observe(own, theirs);
      tables[m].opponent->observe(theirs, own);
    }
  }
  return data;
}

std::vector<Trajectory> best_reply_data(const std::vector<Strategy>& roster, const Payoffs& payoffs,
                                        std::uint64_t rounds) {
  const auto rewards = payoffs.numbers();
  std::vector<Trajectory> data;
  for (const auto& member : roster) {
    const auto moves = FiniteBestReply(*member.machine, payoffs, rounds).moves();
    const auto opponent = member.new_player();
    opponent->start({payoffs, Criterion::finite(rounds), {}});
    Trajectory trajectory{"best_reply", member.name, {}, {}, {}};
    for (const Move own : moves) {
      const Move theirs = opponent->move();
      trajectory.add(own, theirs, rewards[Outcome{own, theirs}.index()]);
      opponent->observe(theirs, own);
    }
    data.push_back(std::move(trajectory));
  }
  return data;
}

}  // namespace folk::sct
