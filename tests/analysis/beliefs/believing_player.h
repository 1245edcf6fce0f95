#pragma once
// Hand-made players with beliefs: they move as one machine does and believe that the opponent is another.

#include <folk/analysis/beliefs/belief_record.h>
#include <folk/strategies/registry.h>
#include <folk/strategies/strategy.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace folk::test {

class BelievingPlayer : public Player {
public:
  BelievingPlayer(std::shared_ptr<const Machine> own, std::shared_ptr<const Machine> model, bool clones)
      : own_(std::move(own)),
        model_(std::move(model)),
        clones_(clones) {}

  void start(const MatchStart&) override {
    own_state_ = own_->start();
    model_state_ = model_->start();
  }
  Move move() override { return move_of(*own_, own_state_); }
  std::optional<double> belief() const override { return model_->cooperation(model_state_); }
  void observe(Move own, Move theirs) override {
    own_state_ = own_->next(own_state_, own, theirs);
    model_state_ = model_->next(model_state_, theirs, own);
  }
  std::unique_ptr<Player> clone() const override {
    return clones_ ? std::make_unique<BelievingPlayer>(*this) : nullptr;
  }

private:
  std::shared_ptr<const Machine> own_;
  std::shared_ptr<const Machine> model_;
  bool clones_;
  State own_state_ = 0;
  State model_state_ = 0;
};

/// Plays `own` and believes to meet `model`, both names of the registry.
inline Strategy believer(const std::string& own, const std::string& model, bool clones = true) {
  static const Registry registry = Registry::standard();
  const auto plays = registry.make(own).machine;
  const auto believes = registry.make(model).machine;
  Strategy strategy;
  strategy.name = own + " believing in " + model;
  strategy.deterministic = true;
  strategy.make_player = [=] { return std::make_unique<BelievingPlayer>(plays, believes, clones); };
  return strategy;
}

/// The matches of a player with each of a roster.
inline std::vector<BeliefMatch> paths(const Strategy& player, const std::string& spec, std::uint64_t rounds) {
  Sampling sampling;
  sampling.criterion = Criterion::finite(rounds);
  std::vector<BeliefMatch> result;
  for (const auto& record : record_beliefs(player, Registry::standard().roster(spec), sampling))
    result.push_back(record.matches.front());
  return result;
}

}  // namespace folk::test
