#include <folk/analysis/play/deterministic_play.h>
#include <folk/games/error.h>
#include <folk/games/outcome.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace folk {
namespace {

constexpr std::uint64_t for_ever = std::numeric_limits<std::uint64_t>::max();

/// Adds up the weights of outcomes under a criterion while time passes, and those of a stretch that may be a loop.
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

  void add(Outcome outcome) {
    weights_[outcome.index()] += weight_;
    weight_ *= continuation_;
    loop_[outcome.index()] += loop_weight_;
    loop_weight_ *= continuation_;
    ++loop_length_;
    if (left_ != for_ever) --left_;
  }

  /// What is added from here on may turn out to be a loop.
  void begin_loop() {
    loop_ = {};
    loop_weight_ = 1;
    loop_length_ = 0;
  }

  std::uint64_t loop_length() const { return loop_length_; }

  /// Adds `times` repetitions of the loop; `for_ever` ends the sum.
  void repeat_loop(std::uint64_t times) {
    if (times == for_ever && criterion_.kind() == Criterion::Kind::mean) {
      weights_ = loop_;
      left_ = 0;
      return;
    }
    const auto count = static_cast<double>(times);
    const auto length = static_cast<double>(loop_length_);
    double repeats = count;  // sum of continuation^(length k) over the repetitions k
    if (continuation_ < 1) {
      const double once_more = criterion_.lost_within(length);
      repeats = (times == for_ever ? 1 : criterion_.lost_within(length * count)) / once_more;
    }
    for (std::size_t o = 0; o < 4; ++o) weights_[o] += weight_ * repeats * loop_[o];
    if (times == for_ever) {
      left_ = 0;
      return;
    }
    if (continuation_ < 1) weight_ *= 1 - criterion_.lost_within(length * count);
    if (left_ != for_ever) left_ -= times * loop_length_;
  }

  /// What was added up, scaled to the criterion's total weight; cut off where the sum is not over.
  PairResult result() const {
    PairResult pair{weights_, 0, 0, over() ? Method::cycle : Method::bounded};
    double added = 0;
    for (const double weight : weights_) added += weight;
    for (double& weight : pair.weights) {
      // A mean is a mean of what was seen, and so is the missing end of a sum that was cut off.
      if (!over() || criterion_.kind() == Criterion::Kind::mean) {
        weight = weight / added * criterion_.total_weight();
      } else if (criterion_.kind() == Criterion::Kind::discounted) {
        weight *= criterion_.stopping();
      }
    }
    return pair;
  }

private:
  Criterion criterion_;
  double continuation_;
  std::uint64_t left_;
  double weight_ = 1;
  OutcomeWeights weights_{};
  OutcomeWeights loop_{};
  double loop_weight_ = 1;
  std::uint64_t loop_length_ = 0;
};

/// One machine's controls and counters, and how far its counters stayed from the ends of their ranges since a mark.
class Track {
public:
  explicit Track(const CounterView& view) { mark(view); }

  void mark(const CounterView& view) {
    marked_ = view;
    above_.fill(std::numeric_limits<std::int64_t>::max());
    below_ = above_;
  }

  /// False when the number of counters changed: one that comes into being may start at any value, so that no loop
  /// leads across.
  bool pass(const CounterView& view) {
    if (view.size != marked_.size) return false;
    constexpr auto lowest = std::numeric_limits<std::int64_t>::min();
    constexpr auto highest = std::numeric_limits<std::int64_t>::max();
    for (std::size_t c = 0; c < view.size; ++c) {
      const Counter& counter = view.counters[c];
      if (counter.high != highest) above_[c] = std::min(above_[c], counter.high - counter.value);
      if (counter.low != lowest) below_[c] = std::min(below_[c], counter.value - counter.low);
    }
    return true;
  }

  bool same_control(const CounterView& view) const { return view.control == marked_.control; }

  /// How often the loop from the mark to `now` can go on before a counter leaves the range of its control.
  std::uint64_t repeats(const CounterView& now) const {
    std::uint64_t times = for_ever;
    for (std::size_t c = 0; c < now.size; ++c) {
      const std::int64_t drift = now.counters[c].value - marked_.counters[c].value;
      const std::int64_t room = drift > 0 ? above_[c] : below_[c];
      if (drift != 0 && room != std::numeric_limits<std::int64_t>::max())
        times = std::min(times, static_cast<std::uint64_t>(room / std::abs(drift)));
    }
    return times;
  }

  /// `now` after that many more loops.
  CounterView drifted(CounterView now, std::uint64_t times) const {
    for (std::size_t c = 0; c < now.size; ++c)
      now.counters[c].value += (now.counters[c].value - marked_.counters[c].value) * static_cast<std::int64_t>(times);
    return now;
  }

private:
  CounterView marked_;
  std::array<std::int64_t, 2> above_{};
  std::array<std::int64_t, 2> below_{};
};

/// A match under way: both states, and a mark that moves on at doubling distances (Brent 1980), so that every loop is
/// found within about three times the rounds that lead into it and around it, in no memory.
class Play {
public:
  Play(const Machine& first, const Machine& second, const Criterion& criterion)
      : first_(first),
        second_(second),
        a_(first.start()),
        b_(second.start()),
        track_a_(first.view(a_)),
        track_b_(second.view(b_)),
        sum_(criterion) {}

  bool over() const { return sum_.over(); }
  PairResult result() const { return sum_.result(); }

  /// Plays one round, then skips the loop that it may have closed.
  void step() {
    const Move own = move_of(first_, a_);
    const Move theirs = move_of(second_, b_);
    sum_.add({own, theirs});
    a_ = first_.next(a_, own, theirs);
    b_ = second_.next(b_, theirs, own);
    const CounterView a = first_.view(a_);
    const CounterView b = second_.view(b_);
    const bool kept_a = track_a_.pass(a);
    const bool kept_b = track_b_.pass(b);
    if (!kept_a || !kept_b) {
      mark(a, b, 1);
    } else if (track_a_.same_control(a) && track_b_.same_control(b)) {
      skip(a, b);
    } else if (sum_.loop_length() == patience_) {
      mark(a, b, 2 * patience_);
    }
  }

private:
  void mark(const CounterView& a, const CounterView& b, std::uint64_t patience) {
    track_a_.mark(a);
    track_b_.mark(b);
    patience_ = patience;
    sum_.begin_loop();
  }

  void skip(const CounterView& a, const CounterView& b) {
    std::uint64_t times = std::min(track_a_.repeats(a), track_b_.repeats(b));
    if (sum_.left() != for_ever) times = std::min(times, sum_.left() / sum_.loop_length());
    if (times == 0) {
      if (sum_.loop_length() >= patience_) mark(a, b, 2 * patience_);
      return;
    }
    sum_.repeat_loop(times);
    if (sum_.over()) return;
    a_ = first_.state_of(track_a_.drifted(a, times));
    b_ = second_.state_of(track_b_.drifted(b, times));
    mark(first_.view(a_), second_.view(b_), 1);
  }

  const Machine& first_;
  const Machine& second_;
  State a_;
  State b_;
  Track track_a_;
  Track track_b_;
  std::uint64_t patience_ = 1;  // rounds until the mark moves on
  Sum sum_;
};

}  // namespace

PairResult play_deterministic(const Machine& first, const Machine& second, const Criterion& criterion,
                              std::uint64_t steps) {
  Play play(first, second, criterion);
  try {
    for (std::uint64_t step = 0; !play.over(); ++step) {
      if (step == steps && criterion.is_finite())
        throw UsageError(fmt::format("no cycle within {} rounds, and {} asks for more", steps, criterion.to_string()));
      if (step == steps) break;
      play.step();
    }
  } catch (const CounterOverflow&) {
    if (criterion.is_finite()) throw;
  }
  return play.result();
}

}  // namespace folk
