// Names that other projects use play here as they do there, also when a move of their own slips; where one does not, it
// says so, and theirs is here under another name.

#include "strategies/named.h"

#include <folk/games/random.h>
#include <folk/strategies/equivalence.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

namespace folk {
namespace {

using test::named;

/// The next move after these own and their moves, as the other project defines it.
using Definition = std::function<char(const std::string& own, const std::string& theirs)>;

struct Peer {
  std::string name;
  Definition next;
};

bool has(const std::string& moves, char move) { return moves.find(move) != std::string::npos; }

/// A table by the own last and their last two moves, both openings before it.
Definition by_table(const std::string& openings, const std::string& table) {
  return [=](const std::string& own, const std::string& theirs) {
    if (own.size() < 2) return openings[own.size()];
    const auto bit = [](char move) { return move == 'D' ? 1U : 0U; };
    return table[4 * bit(own.back()) + 2 * bit(theirs[theirs.size() - 2]) + bit(theirs.back())];
  };
}

/// A punishment for each D it sees while it watches: of all D so far, or of those that were punished.
Definition gradual(bool all) {
  return [=](const std::string&, const std::string& theirs) {
    std::size_t punishments = 0;
    std::size_t busy = 0;  // rounds of punishing and calming that are left
    char move = 'C';
    for (std::size_t t = 1; t <= theirs.size(); ++t) {
      if (busy > 0) {
        move = --busy >= 2 ? 'D' : 'C';
        continue;
      }
      move = theirs[t - 1];
      if (move == 'C') continue;
      ++punishments;
      const auto defections = std::count(theirs.begin(), theirs.begin() + static_cast<std::ptrdiff_t>(t), 'D');
      busy = (all ? static_cast<std::size_t>(defections) : punishments) + 1;
    }
    return move;
  };
}

char mem2(const std::string& own, const std::string& theirs) {
  char plan = 'T';
  int defectors = 0;
  for (std::size_t t = 2; t <= own.size() && defectors < 2; t += 2) {
    const std::string before{own[t - 2], theirs[t - 2]};
    const std::string last{own[t - 1], theirs[t - 1]};
    if (before == "CC" && last == "CC")
      plan = 'T';
    else if ((before == "CD" && last == "DC") || (before == "DC" && last == "CD"))
      plan = '2';
    else
      plan = 'D', ++defectors;
  }
  if (plan == 'D') return 'D';
  return theirs.ends_with(plan == 'T' ? "D" : "DD") ? 'D' : 'C';
}

char majority(const std::string& theirs, char tie) {
  const auto defections = 2 * std::count(theirs.begin(), theirs.end(), 'D');
  const auto rounds = static_cast<std::ptrdiff_t>(theirs.size());
  return defections == rounds ? tie : defections > rounds ? 'D' : 'C';
}

/// Four rounds of each, then of the best since it was picked; spiteful goes by the last round that it played.
char badbet(const std::string& own, const std::string& theirs) {
  std::array<std::string, 4> mine;
  std::array<std::string, 4> others;
  std::array<int, 4> scores{};
  std::size_t bet = 0;
  for (std::size_t t = 0; t <= own.size(); ++t) {
    if (t % 4 == 0) {
      bet = t < 16 ? t / 4 : static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
      if (t >= 16) scores[bet] = 0;
    }
    if (t == own.size()) break;
    scores[bet] += own[t] == 'C' ? (theirs[t] == 'C' ? 3 : 0) : theirs[t] == 'C' ? 5 : 1;
    mine[bet] += own[t];
    others[bet] += theirs[t];
  }
  switch (bet) {
    case 0: return others[0].ends_with('D') ? 'D' : 'C';
    case 1: return 'C';
    case 2: return mine[2].ends_with('D') || others[2].ends_with('D') ? 'D' : 'C';
    default: return mine[3].size() % 3 == 2 ? 'D' : 'C';
  }
}

/// Axelrod-Python 4.13.0 by its class names, then cristal-smac/ipd at 40c86c7.
std::vector<Peer> peers() {
  using Text = const std::string&;
  return {
      {"Cooperator", [](Text, Text) { return 'C'; }},
      {"Defector", [](Text, Text) { return 'D'; }},
      {"TitForTat", [](Text, Text theirs) { return theirs.ends_with('D') ? 'D' : 'C'; }},
      {"Tit For 2 Tats", [](Text, Text theirs) { return theirs.ends_with("DD") ? 'D' : 'C'; }},
      {"SuspiciousTitForTat", [](Text, Text theirs) { return theirs.ends_with('C') ? 'C' : 'D'; }},
      {"WinStayLoseShift",
       [](Text own, Text theirs) { return own.empty() || own.back() == theirs.back() ? 'C' : 'D'; }},
      {"SlowTitForTwoTats2",
       [](Text own, Text theirs) {
         if (own.size() < 2) return 'C';
         return theirs.ends_with("CC") ? 'C' : theirs.ends_with("DD") ? 'D' : own.back();
       }},
      {"CyclerCCD", [](Text own, Text) { return "CCD"[own.size() % 3]; }},
      {"CyclerDDC", [](Text own, Text) { return "DDC"[own.size() % 3]; }},
      {"Alternator", [](Text own, Text) { return own.ends_with('C') ? 'D' : 'C'; }},
      {"GoByMajority", [](Text, Text theirs) { return majority(theirs, 'C'); }},
      {"HardGoByMajority", [](Text, Text theirs) { return majority(theirs, 'D'); }},
      {"Gradual", gradual(true)},
      {"OriginalGradual", gradual(false)},
      {"MEM2", mem2},
      {"Prober",
       [](Text, Text theirs) {
         if (theirs.size() < 3) return "DCC"[theirs.size()];
         return theirs.substr(1, 2) == "CC" ? 'D' : theirs.back();
       }},
      {"Grudger", [](Text, Text theirs) { return has(theirs, 'D') ? 'D' : 'C'; }},
      {"Winner12", by_table("CC", "CDCDDCDD")},
      {"axelrod_winner21", by_table("DC", "CDCDCDDD")},
      {"axelrod_spiteful_cc", [](Text own, Text theirs) { return own.size() >= 2 && has(theirs, 'D') ? 'D' : 'C'; }},
      {"mathieu_spiteful",
       [](Text own, Text theirs) { return own.ends_with('D') || theirs.ends_with('D') ? 'D' : 'C'; }},
      {"spiteful_cc",
       [](Text own, Text theirs) {
         return own.size() >= 2 && (own.ends_with('D') || theirs.ends_with('D')) ? 'D' : 'C';
       }},
      {"hard_tft",
       [](Text own, Text theirs) { return own.size() >= 2 && has(theirs.substr(own.size() - 2), 'D') ? 'D' : 'C'; }},
      {"tft_spiteful",
       [](Text own, Text theirs) {
         if (own.size() < 2) return 'C';
         return theirs.find("DD") != std::string::npos ? 'D' : theirs.back();
       }},
      {"mathieu_badbet", badbet},
  };
}

TEST(Peers, PlayAsTheyAreDefinedWhateverSlips) {
  for (const auto& [name, next] : peers()) {
    const Strategy strategy = named(name);
    const Machine& machine = *strategy.machine;
    for (std::uint64_t match = 0; match < 60; ++match) {
      RandomStream random({21, match, 0, 0});
      const double slips = match % 3 == 0 ? 0 : match % 3 == 1 ? 0.1 : 0.5;
      std::string own;
      std::string theirs;
      for (State state = machine.start(); own.size() < 40;) {
        const char move = next(own, theirs);
        ASSERT_EQ(to_char(move_of(machine, state)), move) << name << " after " << own << " against " << theirs;
        const bool slip = random.chance(slips);
        own += slip == (move == 'C') ? 'D' : 'C';
        theirs += random.chance(0.6) ? 'C' : 'D';
        const auto read = [](char c) { return c == 'C' ? Move::C : Move::D; };
        state = machine.next(state, read(own.back()), read(theirs.back()));
      }
    }
  }
}

/// Whether the strategy of this name is that of the other project in both senses, and where it is not, that it says so.
void expect_elsewhere(const std::string& ours, const std::string& theirs, bool same_without_slips) {
  const auto result = [&](Sense sense) {
    return compare(*named(ours).machine, *named(theirs).machine, sense, 100'000).equivalence;
  };
  EXPECT_EQ(result(Sense::own_moves_its_own) != Equivalence::different, same_without_slips) << ours;
  EXPECT_EQ(result(Sense::any_own_moves), Equivalence::different) << ours;
  const Registry registry = Registry::standard();
  EXPECT_NE(registry.describe(ours).elsewhere.find(theirs), std::string::npos) << ours;
  EXPECT_TRUE(registry.describe(theirs).elsewhere.empty()) << theirs;
}

TEST(Peers, AreNamedWhereTheyDiffer) {
  expect_elsewhere("per_cd", "axelrod_alternator", true);
  expect_elsewhere("spiteful_cc", "axelrod_spiteful_cc", false);
  expect_elsewhere("winner21", "axelrod_winner21", false);
  expect_elsewhere("spiteful", "mathieu_spiteful", true);
  EXPECT_EQ(compare(*named("Alternator").machine, *named("mem1(c;0,0,1,1)").machine, Sense::any_own_moves).equivalence,
            Equivalence::equivalent);
}

TEST(Peers, BadbetDiffersOnceAMoveSlips) { expect_elsewhere("badbet", "mathieu_badbet", true); }

}  // namespace
}  // namespace folk
