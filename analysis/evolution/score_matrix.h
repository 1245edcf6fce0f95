#pragma once
// What each strategy of a population earns against each other, in whole numbers, so that the evolution of populations
// can be computed exactly.

#include <folk/analysis/tournament/tournament.h>
#include <folk/games/rational.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace folk {

/// Scores of a match, row against column, as whole numbers times one unit: S_ij = whole x unit.
///
/// They are exact where the scores are (finite play of deterministic machines, tables of numbers). Scores that were
/// rounded are taken to 2^-40 of the largest: as equal totals are told from rounding, those that differ by less are
/// one. Entrants that behave alike share a row and a column.
class ScoreMatrix {
public:
  /// Of a finished tournament. Throws UsageError without self-play, which a population of copies has, and where a score
  /// was cut off without a limit (Method::bounded).
  explicit ScoreMatrix(const Tournament& tournament);

  /// A table of numbers, a row a strategy, whose matches last `weight` rounds. `cooperations`, where known, counts the
  /// C of row against column. `rounded`: the numbers are not exact, whatever they look like. Throws UsageError where
  /// the table is not square or names repeat.
  ScoreMatrix(std::vector<std::string> names, const std::vector<std::vector<Rational>>& scores, const Rational& weight,
              std::vector<double> cooperations = {}, bool rounded = false);

  std::size_t size() const { return names_.size(); }
  const std::vector<std::string>& names() const { return names_; }

  /// Which behaviour each entrant has, below behaviours().
  std::size_t behaviour(std::size_t entrant) const { return behaviour_of_[entrant]; }
  std::size_t behaviours() const { return behaviours_; }

  /// Scores in units, by behaviour.
  std::int64_t whole(std::size_t a, std::size_t b) const { return whole_[a * behaviours_ + b]; }
  const Rational& unit() const { return unit_; }
  bool exact() const { return exact_; }

  /// Score of entrant i against entrant j.
  double score(std::size_t i, std::size_t j) const {
    return static_cast<double>(whole(behaviour_of_[i], behaviour_of_[j])) * unit_number_;
  }

  /// Payoff a round: score over the weight of all rounds (T, 1/p, 1, 1).
  double payoff(std::size_t i, std::size_t j) const { return score(i, j) / weight_number_; }
  Rational exact_payoff(std::size_t i, std::size_t j) const;

  /// Throws UsageError where some score is negative: populations that grow in proportion to scores cannot have them.
  void require_no_negative_score() const;

  /// Share of C in the moves of entrant i against entrant j; nothing where that is not known.
  std::optional<double> cooperation(std::size_t i, std::size_t j) const;
  bool has_cooperation() const { return !cooperations_.empty(); }

  /// 64 bits of names and scores.
  std::uint64_t signature() const;

private:
  void take_whole(const std::vector<double>& scores);
  void finish();

  std::vector<std::string> names_;
  std::vector<std::size_t> behaviour_of_;
  std::size_t behaviours_ = 0;
  std::vector<std::int64_t> whole_;   // behaviours x behaviours
  std::vector<double> cooperations_;  // the same, counts; empty where not known
  Rational unit_ = 1;
  Rational weight_ = 1;
  double unit_number_ = 1;
  double weight_number_ = 1;
  bool exact_ = true;
};

}  // namespace folk
