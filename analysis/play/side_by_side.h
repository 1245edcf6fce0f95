#pragma once
// The one engine that plays matches round by round: many side by side where their players think expensively, so that
// these can think together. What is kept of the matches is up to a sink.

#include <folk/analysis/play/sampling.h>
#include <folk/games/match.h>
#include <folk/games/outcome.h>
#include <folk/games/progress.h>
#include <folk/games/random.h>
#include <folk/games/seat.h>
#include <folk/strategies/strategy.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace folk {

/// Two strategies that meet again and again.
struct Contest {
  const Strategy* first = nullptr;
  const Strategy* second = nullptr;
  std::uint64_t pair = 0;  ///< the number of the pair in the random keys
  bool once = false;       ///< both are deterministic and nothing slips: one match says all

  const Strategy& strategy(Seat seat) const { return seat == Seat::first ? *first : *second; }

  bool operator==(const Contest&) const = default;
};

/// The number of matches that are played of a contest.
std::uint64_t matches_of(const Contest& contest, const Sampling& sampling);

/// Throws UsageError when the contest takes more than 10^8 rounds.
void check_length(const Contest& contest, const Sampling& sampling);

/// Matches that are on at the same time.
inline constexpr std::size_t most_matches_at_once = 256;

/// Whose moves flip with the noise of the rules: those of both players, or of the first alone.
enum class Slipping : std::uint8_t { both, first };

/// What the first player and the second (`theirs`) really played in a round.
struct PlayedRound : Outcome {
  std::array<bool, 2> slipped{};  ///< by seat
};

/// A table at which matches are played, one after the other.
class SeatedMatch {
public:
  const Contest& contest() const { return contest_; }

  /// The place of the contest among those that are played, and which of its matches this is.
  std::size_t contest_number() const { return contest_number_; }
  std::uint64_t repetition() const { return repetition_; }

  /// The length of the match.
  std::uint64_t rounds() const { return rounds_; }

  Player& player(Seat seat) const { return *players_[index(seat)]; }

  // For the engine.

  /// Who meets the same opponent again stays seated: a program need not be started anew.
  void start(const Contest& contest, std::size_t contest_number, std::uint64_t repetition, const Sampling& sampling,
             Slipping slipping);

  /// The players need not stay for what follows. Throws what Player::finish does.
  void leave();

  std::uint64_t rounds_left() const { return rounds_left_; }

  template <class Sheet>
  void play(std::uint64_t rounds, Sheet& sheet) {
    PlayedRound played;
    Seat seat = Seat::second;
    const auto slips = [&] {
      seat = other(seat);
      const double probability = noise_[index(seat)];
      return played.slipped[index(seat)] = probability > 0 && slips_.chance(probability);
    };
    play_match(player(Seat::first), player(Seat::second), rounds, slips, [&](Move first, Move second) {
      played.own = first;
      played.theirs = second;
      sheet.round(*this, std::as_const(played));
    });
    rounds_left_ -= rounds;
  }

private:
  Contest contest_;
  std::size_t contest_number_ = 0;
  std::uint64_t repetition_ = 0;
  std::uint64_t rounds_ = 0;
  std::uint64_t rounds_left_ = 0;
  std::array<std::unique_ptr<Player>, 2> players_;
  std::array<double, 2> noise_{};  // by seat
  RandomStream slips_;
};

/// Keeps of matches what somebody wants to know. `begin` hands out the sheet on which a match is written down, which is
/// told each round before the players are (so that they still hold the belief they moved by), and `end` takes it back.
/// Several matches may be on; they end in the order in which they began: contest by contest, by repetition.
template <class S>
concept MatchSink = requires(S sink, typename S::Sheet sheet, const SeatedMatch match, const PlayedRound round) {
  { sink.begin(match) } -> std::same_as<typename S::Sheet>;
  sheet.round(match, round);
  sink.end(match, std::move(sheet));
};

/// All tables of the engine.
class MatchTables {
public:
  /// Neither may go before this.
  MatchTables(const std::vector<Contest>& contests, const Sampling& sampling, Slipping slipping);

  /// Starts the next matches that are played side by side; none when all have been played.
  std::span<SeatedMatch> seat_next();

  /// Before each turn: who thinks together does. False when all matches that were seated have ended.
  bool next_turn();

  /// What a match goes on in a turn: a round, or many of machines, whose rounds take nanoseconds.
  std::uint64_t rounds_of_turn() const { return rounds_of_turn_; }

  /// The finished share of all that is played, 0 to 1.
  double finished_share() const;

private:
  std::vector<std::vector<Player*>> thinking_players() const;

  const std::vector<Contest>& contests_;
  const Sampling& sampling_;
  Slipping slipping_;
  std::vector<SeatedMatch> seated_;
  bool somebody_thinks_ = false;
  std::uint64_t rounds_of_turn_ = 1;
  std::size_t next_contest_ = 0;
  std::uint64_t next_repetition_ = 0;
  double matches_in_all_ = 0;
  double matches_ended_ = 0;  // in earlier batches
};

/// Plays each contest `sampling.repetitions` times, or once, and hands `sink` the matches. finite: T rounds. ending:
/// the length of each match is drawn. discounted: until what is left weighs less than 1e-12. mean: long_run_rounds
/// rounds. Whatever is drawn in match r of a contest has its match_key(seed, pair, r, role).
///
/// Contests in which somebody thinks together, against machines or others who do, are played side by side, up to
/// most_matches_at_once matches of them: before each round all players of one strategy (both seats of self-play among
/// them) are told to think together, with sampling.threads threads. Any other contest is played one match at a time, by
/// the same two players. What is played depends on neither.
///
/// `progress` is told the finished share, 0 to 1, after each round where an opaque player takes part, after each match
/// or 4096 rounds of two machines. Throws Cancelled, and what players and sink throw.
template <MatchSink Sink>
void play_side_by_side(const std::vector<Contest>& contests, const Sampling& sampling, Sink& sink,
                       const Progress& progress = nullptr, Slipping slipping = Slipping::both) {
  MatchTables tables(contests, sampling, slipping);
  std::vector<typename Sink::Sheet> sheets;
  for (auto matches = tables.seat_next(); !matches.empty(); matches = tables.seat_next()) {
    sheets.clear();
    for (const SeatedMatch& match : matches) sheets.push_back(sink.begin(match));
    while (tables.next_turn()) {
      for (std::size_t m = 0; m < matches.size(); ++m)
        if (const std::uint64_t left = matches[m].rounds_left(); left > 0)
          matches[m].play(std::min(left, tables.rounds_of_turn()), sheets[m]);
      progress(tables.finished_share());
    }
    for (std::size_t m = 0; m < matches.size(); ++m) sink.end(matches[m], std::move(sheets[m]));
  }
}

}  // namespace folk
