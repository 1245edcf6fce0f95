#include <folk/analysis/beliefs/belief_record.h>
#include <folk/analysis/equilibria/continuation.h>
#include <folk/analysis/play/play_path.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <utility>

namespace folk {
namespace {

/// The same machine, begun in another of its states.
class ContinuedMachine final : public Machine {
public:
  ContinuedMachine(std::shared_ptr<const Machine> machine, State start)
      : machine_(std::move(machine)),
        start_(start) {}

  State start() const override { return start_; }
  double cooperation(State state) const override { return machine_->cooperation(state); }
  State next(State state, Move own, Move theirs) const override { return machine_->next(state, own, theirs); }
  bool deterministic() const override { return machine_->deterministic(); }
  bool finite() const override { return machine_->finite(); }
  CounterView view(State state) const override { return machine_->view(state); }
  State state_of(const CounterView& counters) const override { return machine_->state_of(counters); }

private:
  std::shared_ptr<const Machine> machine_;
  State start_;
};

std::vector<Outcome> exchanged(std::vector<Outcome> history) {
  for (Outcome& round : history) round = round.exchanged();
  return history;
}

std::vector<Strategy> told(std::vector<Strategy> strategies, const std::vector<Outcome>& history) {
  for (Strategy& strategy : strategies)
    if (strategy.machine) strategy.machine = machine_after(strategy.machine, history);
  return strategies;
}

}  // namespace

std::shared_ptr<const Machine> machine_after(const std::shared_ptr<const Machine>& machine,
                                             const std::vector<Outcome>& history) {
  if (history.empty()) return machine;
  State state = machine->start();
  for (const Outcome& round : history) state = machine->next(state, round.own, round.theirs);
  return std::make_shared<ContinuedMachine>(machine, state);
}

Continuation::Continuation(const ExaminationQuestion& asked, const Strategy& against,
                           const std::vector<Outcome>& before)
    : question(asked),
      opponent(told({against}, exchanged(before)).front()),
      their_beliefs(told(asked.beliefs, before)) {
  question.from = 1;
  question.policy = told({asked.policy}, before).front();
  question.beliefs = told(asked.beliefs, exchanged(before));
  if (asked.criterion.is_finite()) question.criterion = Criterion::finite(asked.criterion.rounds() - before.size());
}

EquilibriumQuestion Continuation::their_question() const {
  EquilibriumQuestion theirs = question;
  theirs.beliefs = their_beliefs;
  return theirs;
}

void check_one_path(const ExaminationQuestion& question) {
  if (question.noise > 0)
    throw UsageError(
        "what is played before a later round is random under noise: ask from round 1 on, or without noise");
  const auto check = [](const Strategy& strategy) {
    if (!is_deterministic(strategy))
      throw UsageError(fmt::format(
          "{} may draw its moves, and what is played before a later round is random then: ask from round 1 on",
          strategy.name));
  };
  check(question.policy);
  for (const Strategy& opponent : question.opponents) check(opponent);
}

void check_from(const ExaminationQuestion& question) {
  if (question.from == 1) return;
  const bool ends = question.criterion.is_finite() && question.criterion.rounds() < most_path_rounds;
  const std::uint64_t last = ends ? question.criterion.rounds() : most_path_rounds;
  if (question.from == 0 || question.from > last)
    throw UsageError(fmt::format("from round {} on, under {}: expected round 1 to {}", question.from,
                                 question.criterion.to_string(), last));
  check_one_path(question);
}

std::vector<Outcome> first_rounds_of(const Machine& policy, const Machine& opponent, std::uint64_t rounds) {
  if (rounds == 0) return {};
  return play_path(policy, opponent, Criterion::finite(rounds)).rounds;
}

}  // namespace folk
