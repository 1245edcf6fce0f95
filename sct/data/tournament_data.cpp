#include <folk/analysis/play/side_by_side.h>
#include <folk/sct/data/tournament_data.h>
#include <folk/sct/data/trajectory_sheet.h>

#include <array>

namespace folk::sct {
namespace {

/// Keeps each match as both seats saw it, once where these are the same.
struct BothViews {
  struct Sheet {
    TrajectorySheet first;
    TrajectorySheet second;

    void round(const SeatedMatch& match, const PlayedRound& round) {
      first.round(match, round);
      second.round(match, round);
    }
  };

  std::array<double, 4> payoffs;
  std::vector<Trajectory> data{};

  Sheet begin(const SeatedMatch& match) const {
    return {{match, Seat::first, payoffs}, {match, Seat::second, payoffs}};
  }

  void end(const SeatedMatch& match, Sheet sheet) {
    data.push_back(sheet.first.take());
    Trajectory theirs = sheet.second.take();
    const bool self_play = match.contest().first == match.contest().second;
    if (!self_play || theirs.own != data.back().own) data.push_back(std::move(theirs));
  }
};

}  // namespace

std::vector<Trajectory> tournament_data(const std::vector<Strategy>& roster, const Payoffs& payoffs,
                                        std::uint64_t rounds, Repetitions repetitions, std::uint64_t seed) {
  std::vector<Contest> contests;
  for (std::size_t i = 0; i < roster.size(); ++i)
    for (std::size_t j = i; j < roster.size(); ++j) contests.push_back({&roster[i], &roster[j], i * roster.size() + j});
  BothViews views{payoffs.numbers()};
  play_side_by_side(contests, {{payoffs, Criterion::finite(rounds)}, repetitions, seed}, views);
  return std::move(views.data);
}

}  // namespace folk::sct
