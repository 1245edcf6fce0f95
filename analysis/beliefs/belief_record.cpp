#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/play/side_by_side.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <utility>

namespace folk {
namespace {

/// A match that is being recorded.
class BeliefSheet {
public:
  explicit BeliefSheet(const SeatedMatch& match)
      : machine_(match.contest().second->machine.get()) {
    if (machine_ != nullptr) state_ = machine_->start();
    rounds_.reserve(match.rounds());
  }

  void round(const SeatedMatch& match, const PlayedRound& played) {
    BeliefRound round{played, match.player(Seat::first).belief()};
    if (machine_ != nullptr) {
      round.truth = machine_->cooperation(state_);
      state_ = machine_->next(state_, round.theirs, round.own);
    } else {
      round.truth = round.theirs == Move::C ? 1 : 0;
    }
    rounds_.push_back(round);
  }

  BeliefMatch take() { return std::move(rounds_); }

private:
  const Machine* machine_;
  State state_ = 0;
  BeliefMatch rounds_;
};

/// Adds each match to the record of its opponent.
struct Recorder {
  using Sheet = BeliefSheet;

  std::vector<BeliefRecord>& records;

  Sheet begin(const SeatedMatch& match) const { return Sheet(match); }
  void end(const SeatedMatch& match, Sheet sheet) { records[match.contest_number()].matches.push_back(sheet.take()); }
};

void check(const Strategy& policy, const Sampling& sampling, std::uint64_t matches) {
  if (!sampling.criterion.is_finite())
    throw UsageError(
        fmt::format("beliefs of {} are recorded over finite:T, not over {}: give finite:100 or another "
                    "number of rounds",
                    policy.name, sampling.criterion.to_string()));
  if (sampling.noise > 0)
    throw UsageError(fmt::format("beliefs of {} are recorded without noise, not with {}: give noise 0", policy.name,
                                 sampling.noise.probability()));
  const std::uint64_t rounds = sampling.criterion.rounds();
  if (rounds > most_recorded_rounds || matches > most_recorded_rounds / rounds)
    throw UsageError(
        fmt::format("{} matches of {} rounds are more than {} rounds to record: give fewer rounds or repetitions",
                    matches, rounds, most_recorded_rounds));
}

}  // namespace

bool is_deterministic(const Strategy& strategy) {
  return strategy.machine ? strategy.machine->deterministic() : strategy.deterministic;
}

std::vector<BeliefRecord> record_beliefs(const Strategy& policy, const std::vector<Strategy>& opponents,
                                         const Sampling& sampling, const Progress& progress) {
  std::vector<BeliefRecord> records;
  std::vector<Contest> contests;
  std::uint64_t matches = 0;
  for (const auto& opponent : opponents) {
    const bool once = is_deterministic(policy) && is_deterministic(opponent);
    records.push_back({opponent.name, once, {}});
    contests.push_back({&policy, &opponent, contests.size(), once});
    matches += matches_of(contests.back(), sampling);
  }
  check(policy, sampling, matches);
  Recorder recorder{records};
  play_side_by_side(contests, sampling, recorder, progress);
  return records;
}

}  // namespace folk
