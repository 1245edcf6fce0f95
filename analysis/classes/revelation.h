#pragma once
// All matches of one machine with the members of a class, whose genes are revealed one by one as play asks for them.

#include <folk/analysis/classes/class_score_settings.h>
#include <folk/analysis/crew/packing.h>
#include <folk/analysis/play/cycle_table.h>
#include <folk/analysis/play/whole_payoffs.h>
#include <folk/games/int128.h>
#include <folk/games/progress.h>
#include <folk/strategies/standard/memory_class.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace folk {

/// Genes of a member, 1 for D.
using Genotype = std::vector<unsigned char>;

/// What paths bring to the entrant, and what its opponents earn.
struct RevealedValues {
  double own = 0;
  double theirs = 0;
  double cooperations = 0;

  friend RevealedValues operator+(const RevealedValues& a, const RevealedValues& b) {
    return {a.own + b.own, a.theirs + b.theirs, a.cooperations + b.cooperations};
  }
  friend RevealedValues operator-(const RevealedValues& a, const RevealedValues& b) {
    return {a.own - b.own, a.theirs - b.theirs, a.cooperations - b.cooperations};
  }
  friend RevealedValues operator*(double factor, const RevealedValues& a) {
    return {factor * a.own, factor * a.theirs, factor * a.cooperations};
  }
};

/// Sums over the leaves for which equally many genes were asked.
struct RevealedSums {
  // For finite whole numbers in the first place; for mean the sums over cycles, by their length; else rounded numbers.
  std::vector<Int128> own;
  std::vector<Int128> cooperations;
  long double rounded_own = 0;
  long double rounded_cooperations = 0;
  std::uint64_t beats = 0;
  std::uint64_t draws = 0;
  std::uint64_t leaves = 0;

  void add(std::size_t length, Int128 more_own, Int128 more_cooperations);
  RevealedSums& operator+=(const RevealedSums& more);

  void pack_into(std::string& bytes) const;
  void unpack(Unpacker& bytes);
};

/// The leaf that stands out so far; genes that were not asked are C.
struct ExtremeLeaf {
  bool any = false;
  double value = 0;
  Genotype genes;

  void offer(double offered, const Genotype& moves, bool less) {
    if (any && (less ? offered > value : offered < value)) return;
    if (any && offered == value && genes <= moves) return;
    any = true;
    value = offered;
    genes = moves;
  }

  void pack_into(std::string& bytes) const;
  void unpack(Unpacker& bytes);
};

/// What one piece of work, or all of them, found.
struct Revealed {
  std::vector<RevealedSums> by_asked;
  ExtremeLeaf best;
  ExtremeLeaf worst;
  bool given_up = false;  ///< there are more leaves in all than may be

  Revealed& operator+=(const Revealed& more);

  std::string packed() const;
  void unpack(std::string_view packed);
};

/// Walks the matches. Where play returns to a joint state, or finite:T is over, the rest is known: a leaf.
class Revelation {
public:
  Revelation(const MemoryClass& members, const CycleTable& entrant, const ClassScoreSettings& settings,
             const WholePayoffs& payoffs);

  /// Everything that begins with these answers to the first questions, the first answer in the highest of `ahead` bits.
  /// `leaves` counts those of all pieces; where they are more than `most_leaves` the piece is given up. Throws
  /// Cancelled.
  Revealed run(std::size_t answers, unsigned ahead, const Progress& progress, std::atomic<std::uint64_t>& leaves,
               std::uint64_t most_leaves);

private:
  /// From round t on; `own` and `theirs` are the member's histories, `asked` its genes that are known.
  void walk(std::size_t t, std::uint32_t entrant, unsigned own, unsigned theirs, unsigned asked);

  /// The states after round t in which the member plays `move`.
  std::tuple<std::uint32_t, unsigned, unsigned> after(std::size_t t, std::uint32_t entrant, unsigned own,
                                                      unsigned theirs, unsigned move);
  void leaf(std::size_t begin, std::size_t end, unsigned asked);
  void report();
  void forget();

  MemoryClass members_;
  const CycleTable* entrant_;
  Criterion criterion_;
  bool finite_;
  bool exact_;  // sums of whole numbers
  double tolerance_;
  std::uint64_t last_;
  std::array<RevealedValues, 4> rounds_{};
  std::vector<std::uint32_t> marks_;  // of a joint state: one more than the round in which play stood there
  std::vector<std::uint32_t*> marked_;
  Genotype moves_;  // C where it is not known
  std::vector<unsigned char> known_;
  std::vector<RevealedValues> sums_;  // prefix sums
  std::vector<double> weights_;
  Revealed found_;
  std::size_t answers_ = 0;
  unsigned ahead_ = 0;
  const Progress* progress_ = nullptr;
  std::atomic<std::uint64_t>* all_leaves_ = nullptr;
  std::uint64_t most_leaves_ = 0;
  std::uint64_t unreported_ = 0;
};

}  // namespace folk
