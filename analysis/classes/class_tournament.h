#pragma once
// The tournament of a complete class: every member against every member, without playing the pairs one by one.

#include <folk/analysis/classes/class_scale.h>
#include <folk/analysis/crew/crew.h>
#include <folk/games/match_rules.h>
#include <folk/games/progress.h>
#include <folk/strategies/standard/memory_class.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace folk {

/// How the round robin of a class is played.
struct ClassSettings {
  Payoffs payoffs;
  Criterion criterion = Criterion::finite(100);
  bool self_play = true;  ///< each member also meets its own copy, once
  unsigned threads = 1;   ///< of this process; the results do not depend on it
};

/// What a member earned from all others. Scores and cooperations are whole numbers in units of ClassScale.
struct alignas(32) MemberTotals {
  std::int64_t score = 0;
  std::int64_t cooperations = 0;
  std::int64_t wins = 0;   ///< opponents that scored less in their match than it did
  std::int64_t draws = 0;  ///< opponents that scored as much, its own copy among them

  bool operator==(const MemberTotals&) const = default;
};

/// One member's place.
struct MemberPlace {
  std::uint32_t rank = 0;    ///< 1 is best; equal totals share it
  std::uint32_t member = 0;  ///< its number in the class
};

/// A finished tournament of a class.
class ClassTournament {
public:
  ClassTournament(const MemoryClass& members, const ClassSettings& settings, ClassScale scale,
                  std::vector<MemberTotals> totals);

  const MemoryClass& members() const { return members_; }
  const ClassSettings& settings() const { return settings_; }
  std::size_t size() const { return totals_.size(); }
  std::size_t opponents() const { return size() - (settings_.self_play ? 0U : 1U); }

  /// False where each pair's score was rounded, to some fourteen digits (see ClassScale).
  bool exact() const { return scale_.exact; }

  const MemberTotals& totals(std::size_t member) const { return totals_[member]; }
  /// Sum of its scores: payoffs summed for finite and ending, (1-d)-weighted for discounted, a round for mean.
  long double total(std::size_t member) const;
  /// Payoff a round, its opponents weighing alike.
  double mean(std::size_t member) const;
  /// Its share of C, rounds weighing as the criterion weighs them.
  double cooperation_rate(std::size_t member) const;
  std::string name(std::size_t member) const { return members_.member(member).name(); }

  /// Best first; equal totals in the order of the class.
  const std::vector<MemberPlace>& ranking() const { return ranking_; }

  /// 64 bits of all that was computed: the settings, and each member's totals.
  std::uint64_t signature() const;

private:
  MemoryClass members_;
  ClassSettings settings_;
  ClassScale scale_;
  std::vector<MemberTotals> totals_;
  std::vector<MemberPlace> ranking_;
};

/// The largest class that can be ranked as a whole: so many table entries, 2^20 members.
inline constexpr unsigned most_ranked_entries = 16;

/// Ranks a class; `crew` shares the work. Throws UsageError for a class of more entries and for scores too large to add
/// up, Cancelled, and what the crew throws.
ClassTournament play_class(const MemoryClass& members, const ClassSettings& settings,
                           const Progress& progress = nullptr, const Crew& crew = one_process());

}  // namespace folk
