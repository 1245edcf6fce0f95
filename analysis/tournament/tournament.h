#pragma once
// The round-robin tournament: everyone against everyone, exact wherever it can be.

#include <folk/analysis/crew/crew.h>
#include <folk/analysis/play/pair_result.h>
#include <folk/analysis/play/sampling.h>
#include <folk/games/progress.h>
#include <folk/strategies/strategy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace folk {

class PairPlayer;
class Unpacker;

/// What is played, and how.
struct TournamentSettings : Sampling {
  bool self_play = true;  ///< each entrant also meets its own copy, once
};

/// One entrant's place.
struct RankingEntry {
  std::size_t rank = 0;     ///< 1 is best; equal totals share it
  std::size_t entrant = 0;  ///< place in the roster
  long double total = 0;    ///< sum of its scores; for exact finite play every digit is right
  double mean = 0;          ///< payoff a round
  double median = 0;        ///< median over its opponents of the payoff a round
  std::size_t wins = 0;     ///< opponents that scored less in their match than it did
  double cooperation_rate = 0;
  std::optional<double> normalised;      ///< mean of its row of normalised payoffs; nothing where one is undefined
  Method method = Method::cycle;         ///< the least exact of its pairs'
  std::size_t pairs_of_method = 0;       ///< how many of them were obtained so
  double error = 0;                      ///< standard error of the total, 0 where nothing was sampled
  Guesses guesses{};                     ///< of the others' moves, over all its matches; none without beliefs
  long double total_against_roster = 0;  ///< sum of its scores against the roster proper, its own copy left out
};

/// A finished tournament: what play_tournament returns. Scores are sums for finite and ending, (1-d)-weighted for
/// discounted, per round for mean.
///
/// Entrants that behave alike are played once: what is kept are figures for each pair of behaviours, and the N x N
/// matrices are read off them cell by cell.
class Tournament {
public:
  std::size_t size() const { return roster_.size(); }
  std::size_t core() const { return core_; }
  const std::string& name(std::size_t i) const { return roster_[i].name; }
  const TournamentSettings& settings() const { return settings_; }

  /// False on the diagonal of a tournament without self-play.
  bool played(std::size_t i, std::size_t j) const { return settings_.self_play || i != j; }

  /// Entrant i's score against j, number of C against j (weighted like the score), and 100 x score / mean score of the
  /// roster against j (nothing where that mean is not positive).
  double score(std::size_t i, std::size_t j) const;
  double cooperation(std::size_t i, std::size_t j) const;
  std::optional<double> normalised(std::size_t i, std::size_t j) const;

  /// True when i scored more than j, by more than rounding can.
  bool wins(std::size_t i, std::size_t j) const { return notes_[cell(i, j)].wins; }

  /// The weight of each outcome of the pair, i's move first (weighted like the score).
  OutcomeWeights outcomes(std::size_t i, std::size_t j) const;

  /// How the pair's figures were obtained, with the standard error of i's score.
  Method method(std::size_t i, std::size_t j) const;
  double standard_error(std::size_t i, std::size_t j) const;

  /// i's guesses of j's moves, rounds weighing as in the score; none without beliefs.
  Guesses guesses(std::size_t i, std::size_t j) const;

  /// True when some entrant told a belief.
  bool has_beliefs() const;

  /// What a reader must know of the figures, each said once, in roster order.
  std::vector<std::string> caveats() const;

  /// Opponents of each entrant: one less without self-play.
  std::size_t opponents() const { return size() - (settings_.self_play ? 0U : 1U); }

  /// How many behaviours there are among the entrants, and which of them, counted from 0, an entrant has.
  std::size_t behaviours() const { return behaviours_; }
  std::size_t behaviour(std::size_t i) const { return behaviour_of_[i]; }

  /// The same figures as they are kept: of behaviour a against b at a * behaviours() + b; scores times score_scale().
  std::span<const double> behaviour_scores() const { return scores_; }
  std::span<const double> behaviour_cooperations() const { return cooperations_; }
  double score_scale() const { return scale_; }

  /// score(i, j) times the least common denominator of the payoffs (analysis/play/whole_payoffs.h): a whole number
  /// where the score is exact.
  double scaled_score(std::size_t i, std::size_t j) const { return scores_[cell(i, j)]; }

  /// Best first; equal totals in roster order.
  const std::vector<RankingEntry>& ranking() const { return ranking_; }

  /// 64 bits of all that was computed: settings, names and results.
  std::uint64_t signature() const { return signature_; }

private:
  friend Tournament play_tournament(std::vector<Strategy>, std::size_t, const TournamentSettings&, const Progress&,
                                    const Crew&);

  Tournament(std::vector<Strategy> roster, std::size_t core, const TournamentSettings& settings,
             const Progress& progress, const Crew& crew);

  void scale_payoffs();
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

  void play_pairs(const Progress& progress, const Crew& crew);
  void play_row_by_row(PairPlayer& player, const Progress& progress, const Crew& crew);
  void play_together(const PairPlayer& player, const Pairs& pairs, const Progress& progress, const Crew& crew);
  std::uint64_t identity(const PairPlayer& player, std::size_t part) const;
  bool meet(std::size_t a, std::size_t b) const { return a != b || settings_.self_play || members_[b] > 1; }
  void pack_pair(std::string& bytes, std::size_t a, std::size_t b) const;
  void unpack_pair(Unpacker& bytes, std::size_t a, std::size_t b);
  void store(std::size_t a, std::size_t b, const PairResult& result);
  void store_row(std::size_t a, std::size_t b, const PairResult& result);
  void average_columns();
  void rank();
  void add_up_against_roster();
  RankingEntry entry(std::size_t i) const;
  void sign();

  /// Where what two behaviours have in common stands.
  static std::size_t common_cell(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax(a, b);
    return high * (high + 1) / 2 + low;
  }

  /// Where the figures of entrant i against entrant j stand.
  std::size_t cell(std::size_t i, std::size_t j) const { return behaviour_of_[i] * behaviours_ + behaviour_of_[j]; }

  std::vector<Strategy> roster_;
  std::size_t core_;
  TournamentSettings settings_;
  std::array<double, 4> scaled_payoffs_{};  // by outcome, whole numbers: payoffs times scale_
  double scale_ = 1;
  double largest_score_ = 0;               // of any pair, scaled
  std::vector<std::size_t> behaviour_of_;  // of each entrant
  std::size_t behaviours_ = 0;
  std::vector<std::size_t> members_;  // entrants that have a behaviour

  // Figures of behaviour a against behaviour b, at a * behaviours_ + b.
  std::vector<double> scores_;  // scaled
  std::vector<double> cooperations_;
  std::vector<double> mutual_cooperations_;  // of each unordered pair: weights of CC
  std::vector<double> errors_;               // standard errors of unscaled scores; empty where nothing can be sampled
  struct Note {
    Method method = Method::cycle;
    bool wins = false;  // a scored more than b
  };
  std::vector<Note> notes_;
  std::vector<std::vector<Guesses>> guesses_;  // a row for each opaque behaviour, none for machines

  std::vector<double> column_means_;  // of the core's scores against each entrant
  std::vector<RankingEntry> ranking_;
  std::uint64_t signature_ = 0;
};

/// Plays all pairs. The first `core` entrants are the roster proper, the rest are included entrants, who play like all
/// others but do not count in the means that payoffs are normalised by. `progress` is told the finished share.
/// `crew` shares the work; what is thought together goes in blocks, each to one of its ranks.
/// Throws UsageError on an empty or repeated roster, a noise outside [0, 1], no repetition, scores beyond 2^53 or
/// totals beyond 2^63 in units of the payoffs' last digit, and (with both names) a pair that neither closes nor ends
/// within 10^8 rounds; Cancelled; and what the players and the crew throw.
Tournament play_tournament(std::vector<Strategy> roster, std::size_t core, const TournamentSettings& settings,
                           const Progress& progress = nullptr, const Crew& crew = one_process());

/// The same, nobody being a guest.
Tournament play_tournament(std::vector<Strategy> roster, const TournamentSettings& settings = {},
                           const Progress& progress = nullptr);

}  // namespace folk
