#include <folk/analysis/play/side_by_side.h>
#include <folk/analysis/replies/finite_best_reply.h>
#include <folk/games/criterion.h>
#include <folk/sct/data/recorded_play.h>
#include <folk/sct/data/trajectory_sheet.h>

#include <array>
#include <memory>
#include <utility>

namespace folk::sct {
namespace {

/// Keeps each match as the first player saw it.
struct FirstViews {
  using Sheet = TrajectorySheet;

  std::array<double, 4> payoffs;
  std::vector<Trajectory> data{};

  Sheet begin(const SeatedMatch& match) const { return {match, Seat::first, payoffs}; }
  void end(const SeatedMatch&, Sheet sheet) { data.push_back(sheet.take()); }
};

/// Plays moves that are known in advance, whatever the other does.
class Reciter final : public Player {
public:
  explicit Reciter(std::vector<Move> moves)
      : moves_(std::move(moves)) {}

  void start(const MatchStart&) override { next_ = 0; }
  Move move() override { return moves_[next_]; }
  void observe(Move, Move) override { ++next_; }

private:
  std::vector<Move> moves_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<Trajectory> play_and_record(const Strategy& player, const std::vector<Strategy>& roster,
                                        const Payoffs& payoffs, std::uint64_t rounds, Noise slip,
                                        Repetitions repetitions, std::uint64_t seed, unsigned threads) {
  std::vector<Contest> contests;
  for (const auto& member : roster) contests.push_back({&player, &member, contests.size()});
  FirstViews views{payoffs.numbers()};
  play_side_by_side(contests, {{payoffs, Criterion::finite(rounds), slip}, repetitions, seed, threads}, views, nullptr,
                    Slipping::first);
  return std::move(views.data);
}

std::vector<Trajectory> best_reply_data(const std::vector<Strategy>& roster, const Payoffs& payoffs,
                                        std::uint64_t rounds) {
  std::vector<Strategy> replies;
  std::vector<Contest> contests;
  replies.reserve(roster.size());
  for (const auto& member : roster) {
    const auto moves = FiniteBestReply(*member.machine, payoffs, rounds).moves();
    replies.push_back({"best_reply", nullptr, [moves] { return std::make_unique<Reciter>(moves); }});
    contests.push_back({&replies.back(), &member, contests.size(), true});
  }
  FirstViews views{payoffs.numbers()};
  play_side_by_side(contests, {{payoffs, Criterion::finite(rounds)}}, views);
  return std::move(views.data);
}

}  // namespace folk::sct
