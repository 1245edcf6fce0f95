#include <folk/analysis/classes/class_incomes.h>
#include <folk/analysis/classes/class_score.h>
#include <folk/analysis/classes/class_tournament.h>
#include <folk/analysis/crew/packing.h>
#include <folk/analysis/crew/ranks.h>
#include <folk/analysis/replies/bayes_player.h>
#include <folk/analysis/tournament/tournament.h>
#include <folk/games/error.h>
#include <folk/strategies/registry.h>

#include <analysis/crew/mailboxes.h>
#include <analysis/play/mirror.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <string>
#include <vector>

namespace folk {
namespace {

using test::message_of;
using test::on_ranks;

/// Squares, each a piece. Counts what is done; `slow` may wait.
struct Squares {
  explicit Squares(std::size_t count)
      : places(count, 0) {}

  SharedWork work(unsigned threads, const std::function<void(std::size_t)>& slow = nullptr) {
    return {[] { return std::uint64_t{17}; },
            places.size(),
            threads,
            [this, slow](std::size_t piece, unsigned) {
              if (slow) slow(piece);
              ++done;
              places[piece] = piece * piece;
            },
            [this](std::size_t piece) {
              std::string bytes;
              pack(bytes, places[piece]);
              return bytes;
            },
            [this](std::size_t piece, std::string_view bytes) {
              Unpacker unpacker(bytes);
              places[piece] = unpacker.number<std::size_t>();
              unpacker.end();
            }};
  }

  bool right() const {
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i] != i * i) return false;
    return true;
  }

  std::vector<std::size_t> places;
  std::atomic<std::size_t> done{0};
};

class MapStore : public PieceStore {
public:
  void begin(std::uint64_t identity, std::size_t) override { begun = identity; }
  std::optional<std::string> find(std::size_t piece) override {
    const auto found = kept.find(piece);
    return found == kept.end() ? std::nullopt : std::optional(found->second);
  }
  void keep(std::size_t piece, std::string_view bytes) override { kept[piece] = bytes; }

  std::uint64_t begun = 0;
  std::map<std::size_t, std::string> kept;
};

TEST(RanksThreads, DoEachPieceOnceAndAllHaveAllResults) {
  for (const std::size_t count : {1U, 2U, 5U})
    for (const std::size_t pieces : {0U, 1U, 3U, 200U}) {
      std::atomic<std::size_t> done{0};
      const auto thrown = on_ranks(count, [&](Ranks& ranks) {
        for (int again = 0; again < 3; ++again) {
          Squares squares(pieces);
          double last = 0;
          ranks.run(squares.work(1 + static_cast<unsigned>(ranks.rank() % 3)), [&](double share) {
            EXPECT_TRUE(ranks.first());
            EXPECT_GT(share, last);
            last = share;
          });
          EXPECT_TRUE(squares.right()) << ranks.rank();
          EXPECT_EQ(last, ranks.first() && pieces > 0 ? 1.0 : 0.0);
          done += squares.done;
          EXPECT_EQ(ranks.tell(ranks.first() ? "told" : "not told"), "told");
        }
      });
      for (const auto& failure : thrown) EXPECT_EQ(message_of(failure), "");
      EXPECT_EQ(done, 3 * pieces) << count;
    }
}

// Rank 1 holds one piece until all others are done: who is free goes on.
TEST(RanksThreads, ASlowRankHoldsUpNobody) {
  std::atomic<std::size_t> done{0};
  const std::size_t pieces = 60;
  on_ranks(3, [&](Ranks& ranks) {
    Squares squares(pieces);
    std::atomic<bool> waited{false};
    ranks.run(squares.work(1, [&](std::size_t) {
      // The piece that waits beside it in rank 1's queue waits too.
      if (ranks.rank() == 1 && !waited.exchange(true))
        while (done < pieces - 2) std::this_thread::yield();
      ++done;
    }));
    EXPECT_TRUE(squares.right());
  });
  EXPECT_EQ(done, pieces);
}

TEST(RanksThreads, ThrowWhatTheEarliestPieceThrewOnEveryRank) {
  for (int again = 0; again < 10; ++again) {
    const auto thrown = on_ranks(4, [&](Ranks& ranks) {
      Squares squares(100);
      const auto work = squares.work(2, [](std::size_t piece) {
        if (piece >= 41 && piece % 2 == 1) throw UsageError("piece " + std::to_string(piece));
      });
      EXPECT_THROW(ranks.run(work), UsageError);
      try {
        ranks.run(work);
      } catch (const UsageError& error) {
        EXPECT_EQ(std::string(error.what()), "piece 41");
      }
      Squares more(5);
      ranks.run(more.work(1));  // it can be gone on with
      EXPECT_TRUE(more.right());
    });
    for (const auto& failure : thrown) EXPECT_EQ(message_of(failure), "");
  }
}

TEST(RanksThreads, EndTogether) {
  // Rank 0 is told to end; another rank is; another has thrown on its way; another has other work.
  for (const std::string how : {"first", "another", "on its way", "other work"}) {
    const auto thrown = on_ranks(3, [&](Ranks& ranks) {
      const bool another = ranks.rank() == 2;
      if (ranks.rank() == 1) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      ranks.agree(1);  // rank 2 may have thrown before rank 0 is done with this
      if (how == "on its way" && another) throw InputFileError("no file");
      const Progress progress;
      if ((how == "first" && ranks.first()) || (how == "another" && another)) progress.cancel();
      Squares squares(1000);
      auto work = squares.work(1, [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
      if (how == "other work" && another) work.identity = [] { return std::uint64_t{18}; };
      ranks.run(work, progress);
    });
    for (const std::size_t rank : {0U, 1U}) {
      const auto message = message_of(thrown[rank]);
      if (how == "on its way") {
        EXPECT_EQ(message, "rank 2: no file");
      } else if (how == "other work") {
        EXPECT_NE(message.find("rank 2 has other work than rank 0"), std::string::npos) << message;
      } else {
        EXPECT_THROW(std::rethrow_exception(thrown[rank]), Cancelled) << how;
      }
    }
  }
}

TEST(RanksThreads, AreDismissedWhereRank0EndsWithoutThem) {
  const auto thrown = on_ranks(3, [&](Ranks& ranks) {
    if (ranks.first()) throw EnvironmentError("no disk");
    Squares squares(10);
    ranks.run(squares.work(1));
  });
  EXPECT_EQ(message_of(thrown[0]), "no disk");
  for (const std::size_t rank : {1U, 2U}) EXPECT_THROW(std::rethrow_exception(thrown[rank]), Dismissed);
}

TEST(RanksThreads, AgreeOnTheCommand) {
  for (const auto& failure : on_ranks(3, [](Ranks& ranks) { ranks.agree(7); })) EXPECT_EQ(message_of(failure), "");
  const auto thrown = on_ranks(3, [](Ranks& ranks) {
    ranks.agree(ranks.rank() == 1 ? 8 : 7);
    Squares squares(10);
    ranks.run(squares.work(1));
  });
  EXPECT_NE(message_of(thrown[0]).find("rank 1 was given another command"), std::string::npos);
  EXPECT_THROW(std::rethrow_exception(thrown[2]), Dismissed);
}

TEST(RanksThreads, DoNotDoWhatIsKept) {
  for (const std::size_t count : {1U, 3U}) {
    MapStore store;
    std::atomic<std::size_t> done{0};
    const auto program = [&](Ranks& ranks) {
      if (ranks.first()) ranks.keep_in(&store);
      Squares squares(50);
      ranks.run(squares.work(2));
      EXPECT_TRUE(squares.right());
      done += squares.done;
    };
    on_ranks(count, program);
    EXPECT_EQ(store.begun, 17U);
    EXPECT_EQ(store.kept.size(), 50U);
    EXPECT_EQ(done, 50U);
    for (const std::size_t lost : {0U, 20U, 49U}) store.kept.erase(lost);
    on_ranks(count, program);
    EXPECT_EQ(store.kept.size(), 50U);
    EXPECT_EQ(done, 53U);
    // One process goes on from what ranks have left.
    store.kept.erase(7);
    OneProcess alone;
    alone.keep_in(&store);
    Squares squares(50);
    alone.run(squares.work(2));
    EXPECT_TRUE(squares.right());
    EXPECT_EQ(squares.done, 1U);
    EXPECT_EQ(store.kept.size(), 50U);
  }
}

/// A result as one process has it, and on each of three ranks.
template <class Result>
void expect_the_same_on_ranks(const std::function<Result(const Crew&)>& result) {
  const Result alone = result(one_process());
  for (const auto& failure : on_ranks(3, [&](Ranks& ranks) { EXPECT_EQ(result(ranks), alone) << ranks.rank(); }))
    EXPECT_EQ(message_of(failure), "");
}

TEST(RanksThreads, ChangeNoResult) {
  const MemoryClass members(1, 1);
  for (const char* criterion : {"finite:100", "discounted:0.9"}) {
    ClassSettings settings;
    settings.criterion = Criterion::parse(criterion);
    settings.self_play = false;
    expect_the_same_on_ranks<std::uint64_t>([&](const Crew& crew) {
      return play_class({1, 2}, settings, nullptr, crew).signature();
    });
    const std::vector<std::uint32_t> living{1, 4, 9, 30};
    const std::vector<std::int64_t> numbers{10, 1, 100, 7};
    expect_the_same_on_ranks<std::vector<std::int64_t>>([&](const Crew& crew) {
      return ClassIncomes(members, {}, settings.criterion, 1000, 2, crew)(living, numbers);
    });
    const auto machine = Registry::standard().make("winner12").machine;
    ClassScoreSettings score;
    score.criterion = settings.criterion;
    expect_the_same_on_ranks<std::string>([&](const Crew& crew) {
      const auto found = score_against({2, 2}, *machine, score, nullptr, crew);
      return std::to_string(found.mean) + found.best.member + found.worst.member + found.beats.str() +
             std::to_string(found.leaves);
    });
    score.most_leaves = 20;
    const auto refused = on_ranks(3, [&](Ranks& ranks) { score_against({2, 2}, *machine, score, nullptr, ranks); });
    for (const auto& failure : refused) EXPECT_THROW(std::rethrow_exception(failure), TooManyKinds);
  }
  // Sampled pairs, beliefs, and players that think together in more than one block.
  TournamentSettings settings;
  settings.noise = 0.01;
  settings.repetitions = 400;
  settings.criterion = Criterion::finite(20);
  expect_the_same_on_ranks<std::string>([&](const Crew& crew) {
    auto registry = Registry::standard();
    add_bayes(registry);
    auto roster = registry.roster("tit_for_tat,pavlov,random(0.3),bayes(tit_for_tat,all_d;depth=1)");
    roster.push_back(test::mirror(std::make_shared<test::Diary>(), true, true));
    const auto found = play_tournament(std::move(roster), 4, settings, nullptr, crew);
    std::string figures = std::to_string(found.signature());
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t j = 0; j < found.size(); ++j)
        figures += fmt::format(" {} {} {} {} {}", found.standard_error(i, j), found.outcomes(i, j)[0], found.wins(i, j),
                               found.guesses(i, j).right, found.guesses(i, j).log_loss);
    return figures;
  });
}

}  // namespace
}  // namespace folk
