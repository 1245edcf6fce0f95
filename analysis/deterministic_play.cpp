#include <folk/analysis/deterministic_play.h>
#include <folk/games/error.h>
#include <folk/strategies/gradual_machine.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace folk {
namespace {

constexpr std::uint64_t for_ever = std::numeric_limits<std::uint64_t>::max();

/// Adds up the weights of outcomes under a criterion while time passes.
class Sum {
public:
  explicit Sum(const Criterion& criterion)
      : criterion_(criterion),
        continuation_(criterion.continuation()),
        left_(criterion.is_finite() ? criterion.rounds() : for_ever) {}

  /// Rounds still to be weighed.
  std::uint64_t left() const { return left_; }

  /// True when nothing that follows can change the sum.
  bool over() const { return left_ == 0 || weight_ < 1e-18; }

  void add(std::size_t o) {
    weights_[o] += weight_;
    weight_ *= continuation_;
    ++played_;
    if (left_ != for_ever) --left_;
  }

  /// Adds `times` repetitions of these outcomes; `for_ever` ends the sum.
  void add_loop(const std::vector<std::uint8_t>& outcomes, std::uint64_t times) {
    OutcomeWeights once{};
    double within = 1;
    for (const auto o : outcomes) {
      once[o] += within;
      within *= continuation_;
    }
    const auto length = static_cast<double>(outcomes.size());
    if (times == for_ever && criterion_.kind() == Criterion::Kind::mean) {
      for (std::size_t o = 0; o < 4; ++o) weights_[o] = once[o] / length;
      settled_ = true;
      left_ = 0;
      return;
    }
    const auto count = static_cast<double>(times);
    // within = continuation^length; the sum of its powers from 0 to times - 1.
    double repeats = count;
    if (continuation_ < 1)
      repeats = times == for_ever ? 1 / (1 - within) : (1 - std::pow(within, count)) / (1 - within);
    for (std::size_t o = 0; o < 4; ++o) weights_[o] += weight_ * repeats * once[o];
    if (times == for_ever) {
      left_ = 0;
      return;
    }
    weight_ *= continuation_ < 1 ? std::pow(within, count) : 1;
    const std::uint64_t rounds = times * outcomes.size();
    played_ += rounds;
    if (left_ != for_ever) left_ -= rounds;
  }

  PairResult result() const {
    PairResult pair{weights_, 0, 0, Method::cycle};
    double scale = 1;
    if (criterion_.kind() == Criterion::Kind::discounted) scale = 1 - continuation_;
    if (criterion_.kind() == Criterion::Kind::mean && !settled_) {
      scale = 1 / static_cast<double>(played_);
      pair.method = Method::bounded;
    }
    for (double& weight : pair.weights) weight *= scale;
    return pair;
  }

private:
  Criterion criterion_;
  double continuation_;
  std::uint64_t left_;
  std::uint64_t played_ = 0;
  double weight_ = 1;
  bool settled_ = false;
  OutcomeWeights weights_{};
};

/// Both machines before a round.
struct Moment {
  CounterView first;
  CounterView second;
  std::uint8_t played = 0;  // the outcome of the round
};

bool same_controls(const Moment& a, const Moment& b) {
  return a.first.control == b.first.control && a.second.control == b.second.control;
}

/// How often counters that drift by `drift` a loop can go on before one leaves its range at this moment.
std::uint64_t room(const CounterView& at, const CounterView& loop_start, const CounterView& loop_end) {
  std::uint64_t times = for_ever;
  for (std::size_t c = 0; c < at.size; ++c) {
    const std::int64_t drift = loop_end.counters[c].value - loop_start.counters[c].value;
    const Counter& counter = at.counters[c];
    constexpr auto lowest = std::numeric_limits<std::int64_t>::min();
    constexpr auto highest = std::numeric_limits<std::int64_t>::max();
    if (drift > 0 && counter.high != highest)
      times = std::min(times, static_cast<std::uint64_t>((counter.high - counter.value) / drift));
    if (drift < 0 && counter.low != lowest)
      times = std::min(times, static_cast<std::uint64_t>((counter.value - counter.low) / -drift));
  }
  return times;
}

CounterView drifted(CounterView view, const CounterView& loop_start, std::uint64_t times) {
  for (std::size_t c = 0; c < view.size; ++c) {
    const std::int64_t drift = view.counters[c].value - loop_start.counters[c].value;
    view.counters[c].value += drift * static_cast<std::int64_t>(times);
  }
  return view;
}

/// The rounds since the last change in the number of counters, and where each pair of controls last stood among them.
class Past {
public:
  Past()
      : slots_(64, none) {}

  void clear() {
    std::fill(slots_.begin(), slots_.end(), none);
    moments_.clear();
  }

  /// Where these controls stood before, if they did; they now stand at the end.
  std::optional<std::size_t> enter(const Moment& now) {
    if (2 * (moments_.size() + 1) > slots_.size()) grow();
    const std::size_t slot = place(now);
    const std::uint32_t before = slots_[slot];
    slots_[slot] = static_cast<std::uint32_t>(moments_.size());
    moments_.push_back(now);
    return before == none ? std::nullopt : std::optional<std::size_t>(before);
  }

  std::vector<Moment>& moments() { return moments_; }

private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  std::size_t place(const Moment& moment) const {
    std::uint64_t mixed = (moment.first.control * 0x9E3779B97F4A7C15U) ^ (moment.second.control * 0xC2B2AE3D27D4EB4FU);
    mixed ^= mixed >> 31U;
    std::size_t slot = mixed & (slots_.size() - 1);
    while (slots_[slot] != none && !same_controls(moments_[slots_[slot]], moment))
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  void grow() {
    slots_.assign(slots_.size() * 2, none);
    for (std::size_t i = 0; i < moments_.size(); ++i) slots_[place(moments_[i])] = static_cast<std::uint32_t>(i);
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Moment> moments_;
};

}  // namespace

PairResult play_deterministic(const Machine& first, const Machine& second, const Criterion& criterion,
                              std::uint64_t steps) {
  // A past longer than this is dropped: its loops are not looked for.
  constexpr std::size_t longest_past = std::size_t{1} << 22U;
  Sum sum(criterion);
  Past past;
  std::vector<std::uint8_t> loop;
  State a = first.start();
  State b = second.start();
  for (std::uint64_t step = 0; !sum.over(); ++step) {
    if (step == steps) {
      if (!criterion.is_finite()) break;
      throw UsageError(fmt::format("no cycle within {} rounds, and {} asks for more", steps, criterion.to_string()));
    }
    Moment now{first.view(a), second.view(b), 0};
    if (!past.moments().empty() &&
        (past.moments().back().first.size != now.first.size || past.moments().back().second.size != now.second.size ||
         past.moments().size() >= longest_past))
      past.clear();
    if (const auto before = past.enter(now)) {
      // Controls repeat. The loop may go on as long as every counter on it stays in the range of its control.
      const auto& moments = past.moments();
      const Moment& start = moments[*before];
      std::uint64_t times = for_ever;
      for (std::size_t i = *before + 1; i < moments.size(); ++i)
        times = std::min(
            {times, room(moments[i].first, start.first, now.first), room(moments[i].second, start.second, now.second)});
      const std::size_t length = moments.size() - 1 - *before;
      if (sum.left() != for_ever) times = std::min(times, sum.left() / length);
      if (times > 0) {
        loop.clear();
        for (std::size_t i = *before; i + 1 < moments.size(); ++i) loop.push_back(moments[i].played);
        sum.add_loop(loop, times);
        if (sum.over()) break;
        a = first.state_of(drifted(now.first, start.first, times));
        b = second.state_of(drifted(now.second, start.second, times));
        past.clear();
        continue;
      }
    }
    const Move own = move_of(first, a);
    const Move theirs = move_of(second, b);
    now.played = static_cast<std::uint8_t>(outcome(own, theirs));
    past.moments().back().played = now.played;
    sum.add(now.played);
    try {
      a = first.next(a, own, theirs);
      b = second.next(b, theirs, own);
    } catch (const CounterOverflow&) {
      if (criterion.is_finite()) throw;
      break;
    }
  }
  return sum.result();
}

}  // namespace folk
