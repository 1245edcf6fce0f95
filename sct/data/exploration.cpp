#include <folk/analysis/play/parallel.h>
#include <folk/analysis/replies/better_move.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>
#include <folk/sct/data/exploration.h>
#include <folk/strategies/half.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace folk::sct {
namespace {

constexpr std::uint64_t exploration_role = 18;  // of the random key; windows have 17
constexpr double least_probability = 0.01;      // of what the planner looks into

/// Who sits in the learner's seat, and how he slips.
struct Habit {
  bool plans = false;
  unsigned depth = 2;  // rounds of the best reply; that of a label too
  double slip = 0;
  double relief = 0;  // probability that another strategy takes over
  double whim = 0;    // probability that some rounds of chance begin
};

constexpr unsigned longest_whim = 4;  // rounds

Habit draw_habit(RandomStream& random) {
  constexpr double most_slip = 0.3;
  Habit habit;
  habit.plans = random.chance(0.5);
  const double kind = random.uniform();
  const bool careful = habit.plans && kind < 0.25;
  const bool whimsical = habit.plans && kind >= 0.5;
  if (habit.plans) habit.depth = 2 + static_cast<unsigned>(random.uniform() * 3);
  if (whimsical)
    habit.whim = 0.03;
  else
    habit.slip = careful ? (random.chance(0.5) ? 0.03 : 0) : most_slip * random.uniform();
  if (!habit.plans && random.chance(0.5)) habit.relief = 0.05;
  return habit;
}

Move drawn(double cooperation, RandomStream& random) { return random.chance(cooperation) ? Move::C : Move::D; }

std::shared_ptr<const Machine> trained_member(const MemoryClass& members, RandomStream& random) {
  constexpr int most_tries = 1000;
  for (int i = 0; i < most_tries; ++i) {
    std::vector<bool> genes(members.genes());
    for (std::size_t g = 0; g < genes.size(); ++g) genes[g] = random.chance(0.5);
    auto member = std::make_shared<MemoryMachine>(members.member(genes));
    if (half_of(*member) == Half::trained) return member;
  }
  throw UsageError(fmt::format("{}: no member is in the half that may be trained on", members.name()));
}

}  // namespace

Exploration::Exploration(OpponentPrior prior, const Payoffs& payoffs, std::uint64_t rounds)
    : prior_(std::move(prior)),
      posterior_(prior_),
      payoffs_(payoffs.numbers()),
      rounds_(rounds) {
  for (const auto& known : prior_.known) weight_ += known.weight;
  for (const auto& one : prior_.classes) weight_ += one.weight;
}

std::shared_ptr<const Machine> Exploration::somebody(RandomStream& random) const {
  double left = random.uniform() * weight_;
  for (const auto& [strategy, weight] : prior_.known)
    if ((left -= weight) < 0) return strategy.machine;
  for (const auto& [members, weight] : prior_.classes) {
    if ((left -= weight) >= 0 && &members != &prior_.classes.back().members) continue;
    return trained_member(members, random);
  }
  return prior_.known.back().strategy.machine;  // the sum of the weights was rounded
}

Lesson Exploration::match(std::uint64_t seed, std::uint64_t number) const {
  RandomStream random({seed, number, 0, exploration_role});
  const auto opponent = somebody(random);
  const Habit habit = draw_habit(random);
  auto guest = somebody(random);  // in the learner's seat
  State theirs_state = opponent->start(), guest_state = guest->start();
  Posterior posterior = posterior_;
  Lesson lesson;
  std::uint8_t seen = start_observation;
  unsigned whim = 0;  // rounds of it that are left
  for (std::uint64_t t = 0; t < rounds_; ++t) {
    const auto depth = static_cast<unsigned>(std::min<std::uint64_t>(habit.depth, rounds_ - t));
    const Move best = better_move(posterior.action_values(payoffs_, depth, 1, least_probability));
    Move own = habit.plans ? best : drawn(guest->cooperation(guest_state), random);
    if (random.chance(habit.slip)) own = other(own);
    if (habit.whim > 0 && whim == 0 && random.chance(habit.whim))
      whim = 1 + static_cast<unsigned>(random.uniform() * longest_whim);
    if (whim > 0) {
      --whim;
      own = random.chance(0.5) ? Move::D : Move::C;
    }
    const Move theirs = drawn(opponent->cooperation(theirs_state), random);
    lesson.observations.push_back(seen);
    lesson.beliefs.push_back(static_cast<float>(posterior.cooperation()));
    lesson.opponent.push_back(static_cast<std::uint8_t>(bit(theirs)));
    lesson.own.push_back(static_cast<std::uint8_t>(bit(own)));
    lesson.wanted.push_back(static_cast<std::uint8_t>(bit(best)));
    lesson.weights.push_back(1);
    lesson.returns.push_back(0);
    posterior.observe(own, theirs);
    theirs_state = opponent->next(theirs_state, theirs, own);
    guest_state = guest->next(guest_state, own, theirs);
    seen = observation_of(own, theirs);
    if (random.chance(habit.relief)) {
      guest = somebody(random);
      guest_state = guest->start();
    }
  }
  return lesson;
}

std::vector<Lesson> Exploration::matches(std::uint64_t seed, std::uint64_t first, std::uint64_t count,
                                         unsigned threads) const {
  std::vector<Lesson> lessons(count);
  parallel_for(count, threads, [&](std::size_t i, unsigned) { lessons[i] = match(seed, first + i); });
  return lessons;
}

}  // namespace folk::sct
