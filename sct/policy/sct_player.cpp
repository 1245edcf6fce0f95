#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/sct/policy/planner.h>
#include <folk/sct/policy/sct_player.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace folk::sct {
namespace {

class TransformerPlayer final : public Player {
public:
  TransformerPlayer(std::string name, std::shared_ptr<const Mind> mind, const PlayOptions& options)
      : name_(std::move(name)),
        mind_(std::move(mind)),
        options_(options),
        plan_depth_(options.plan_depth.value_or(mind_->policy.training.plan_depth)) {}

  void start(const MatchStart& match) override {
    const auto& training = mind_->policy.training;
    if (!options_.extrapolate) refuse_unknown(match);
    rewards_ = match.payoffs.numbers();
    rounds_ = match.criterion.is_finite() ? std::optional(match.criterion.rounds()) : std::nullopt;
    continuation_ = match.criterion.continuation();
    double target = options_.target.value_or(training.return_target);
    if (match.criterion.is_finite() && match.criterion.rounds() < training.rounds)
      target *= static_cast<double>(match.criterion.rounds()) / static_cast<double>(training.rounds);
    so_far_ = begin_match(mind_->return_token(target));
    random_ = RandomStream(match.random);
    thought_.reset();
    thinker_.emplace(*mind_);
    planner_.reset();
  }

  Move move() override {
    if (!thought_) think();
    if (options_.sample) return random_.chance(thought_->cooperation) ? Move::C : Move::D;
    return likelier_move(thought_->cooperation);
  }

  void observe(Move own, Move theirs) override {
    add_round(so_far_, own, theirs, likelier_move(thought_ ? thought_->belief : 0.5),
              mind_->return_token(rewards_[Outcome{own, theirs}.index()]));
    thought_.reset();
  }

  std::optional<double> belief() const override {
    if (!thought_ || !mind_->believes()) return std::nullopt;
    return thought_->belief;
  }

  /// What was thought of a window is copied only where the next round's window begins with the same rounds.
  std::unique_ptr<Player> clone() const override {
    auto copy = std::make_unique<TransformerPlayer>(name_, mind_, options_);
    copy->so_far_ = so_far_;
    copy->rewards_ = rewards_;
    copy->rounds_ = rounds_;
    copy->continuation_ = continuation_;
    copy->random_ = random_;
    copy->thought_ = thought_;
    if (so_far_.own.size() + (thought_ ? 1 : 0) < mind_->policy.architecture.context && thinker_)
      copy->thinker_.emplace(*thinker_);
    return copy;
  }

  /// Equal histories are thought through once.
  void think_together(std::span<Player* const> peers, unsigned threads) override {
    std::vector<TransformerPlayer*> players;
    for (Player* peer : peers)
      if (auto* player = dynamic_cast<TransformerPlayer*>(peer)) players.push_back(player);
    std::vector<TransformerPlayer*> distinct;
    std::vector<std::size_t> like(players.size());
    for (std::size_t i = 0; i < players.size(); ++i) {
      const auto same = [&](const TransformerPlayer* other) {
        return other->mind_ == players[i]->mind_ && other->so_far_ == players[i]->so_far_;
      };
      const auto found = std::find_if(distinct.begin(), distinct.end(), same);
      like[i] = static_cast<std::size_t>(found - distinct.begin());
      if (found == distinct.end()) distinct.push_back(players[i]);
    }
    parallel_for(distinct.size(), threads, [&](std::size_t i, unsigned) { distinct[i]->think(); });
    for (std::size_t i = 0; i < players.size(); ++i)
      if (distinct[like[i]] != players[i]) players[i]->think_like(*distinct[like[i]]);
  }

private:
  void think() {
    if (!thinker_) thinker_.emplace(*mind_);
    thought_ = plan_depth_ > 0 ? plan() : thinker_->think(so_far_, options_.forced_belief);
  }

  Thought plan() {
    if (!planner_) planner_.emplace(*mind_, PlanSettings{.depth = plan_depth_, .continuation = continuation_});
    std::optional<ForcedBelief> forced;
    if (options_.forced_belief) forced = {*options_.forced_belief};
    const std::uint64_t left = rounds_ ? *rounds_ - so_far_.own.size() : most_plan_depth;
    const Plan plan = planner_->plan(*thinker_, so_far_, rewards_,
                                     static_cast<unsigned>(std::min<std::uint64_t>(left, most_plan_depth)), forced);
    return {plan.belief, plan.better() == Move::D ? 0.0 : 1.0};
  }

  /// Takes over what the other keeps for its next thoughts too: the same rounds thought through in other portions would
  /// differ in their last bits.
  void think_like(const TransformerPlayer& other) {
    thinker_.emplace(*other.thinker_);
    thought_ = other.thought_;
  }

  void refuse_unknown(const MatchStart& match) const {
    const auto& training = mind_->policy.training;
    const auto refuse = [&](const std::string& what) {
      throw UsageError(fmt::format("{} was trained on {}, {} rounds of {}: give --extrapolate to let it play {}", name_,
                                   training.data, training.rounds, to_text(training.payoffs), what));
    };
    if (!(match.payoffs == training.payoffs)) refuse(to_text(match.payoffs));
    if (!match.criterion.is_finite()) refuse(match.criterion.to_string());
    if (match.criterion.rounds() > training.rounds) refuse(fmt::format("{} rounds", match.criterion.rounds()));
  }

  std::string name_;
  std::shared_ptr<const Mind> mind_;
  PlayOptions options_;
  unsigned plan_depth_;
  std::optional<Thinker> thinker_;
  std::optional<Planner> planner_;
  MatchSoFar so_far_;
  std::array<double, 4> rewards_{};
  std::optional<std::uint64_t> rounds_;  // of the match, where it has an end
  double continuation_ = 1;
  RandomStream random_;
  std::optional<Thought> thought_;
};

}  // namespace

Strategy transformer(std::string name, std::shared_ptr<const Mind> mind, const PlayOptions& options) {
  Strategy strategy;
  strategy.name = name;
  strategy.deterministic = !options.sample;
  strategy.thinks_together = true;
  if (options.extrapolate)
    strategy.caveat =
        fmt::format("{} extrapolates: it was trained on {} rounds of {}, its last time row stands for later ones", name,
                    mind->policy.training.rounds, to_text(mind->policy.training.payoffs));
  strategy.plans_ahead = options.sample ? 0 : options.plan_depth.value_or(mind->policy.training.plan_depth);
  if (strategy.plans_ahead > 0) {
    PlayOptions believing = options;
    believing.plan_depth = 0;
    strategy.make_believer = [name, mind, believing] {
      return std::make_unique<TransformerPlayer>(name, mind, believing);
    };
  }
  strategy.make_player = [name = std::move(name), mind = std::move(mind), options] {
    return std::make_unique<TransformerPlayer>(name, mind, options);
  };
  return strategy;
}

}  // namespace folk::sct
