#include <folk/strategies/machine.h>
#include <folk/strategies/player.h>

#include <utility>

namespace folk {
namespace {

class MachinePlayer final : public Player {
public:
  explicit MachinePlayer(std::shared_ptr<const Machine> machine)
      : machine_(std::move(machine)) {}

  void start(const MatchStart& match) override {
    state_ = machine_->start();
    random_ = RandomStream(match.random);
  }

  Move move() override {
    const double cooperation = machine_->cooperation(state_);
    // A pure state draws nothing, so that deterministic machines cost no random numbers.
    if (cooperation >= 1) return Move::C;
    if (cooperation <= 0) return Move::D;
    return random_.chance(cooperation) ? Move::C : Move::D;
  }

  void observe(Move own, Move theirs) override { state_ = machine_->next(state_, own, theirs); }

  std::unique_ptr<Player> clone() const override { return std::make_unique<MachinePlayer>(*this); }

private:
  std::shared_ptr<const Machine> machine_;
  State state_ = 0;
  RandomStream random_;
};

}  // namespace

std::unique_ptr<Player> play(std::shared_ptr<const Machine> machine) {
  return std::make_unique<MachinePlayer>(std::move(machine));
}

}  // namespace folk
