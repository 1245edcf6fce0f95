// Offline training runs: their curve, their checkpoints, and what becomes of both when a run is interrupted.

#include <folk/mpe/offline/offline_training.h>
#include <folk/mpe/offline/resumable_training.h>
#include <folk/mpe/offline/transformer.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "games/ended_work.h"
#include "games/expect_error.h"
#include "mpe/data/small_data_set.h"

namespace folk::mpe {
namespace {

using folk::test::expect_error;

constexpr sct::RecordKind training_record{"FOLKOFFL", 1, "mpe-train offline"};

/// Learns to count.
class Counter final : public OfflineLearner {
public:
  /// Its losses are no numbers in step `bad`.
  explicit Counter(std::size_t losses = 2, std::uint64_t bad = 0)
      : losses_(losses),
        bad_(bad) {}

  std::uint64_t steps() const override { return steps_; }
  std::vector<NamedLoss> step() override {
    const double x = static_cast<double>(++steps_);
    sum_ += static_cast<float>(1 / x);
    std::vector<NamedLoss> losses{{"first", 1 / x}, {"second", x * x}, {"third", -x}};
    losses.resize(losses_);
    if (steps_ == bad_) losses.back().value = std::numeric_limits<double>::infinity();
    return losses;
  }
  void save(sct::RecordWriter& writer) const override {
    writer.word(steps_);
    writer.floats(std::vector<float>{sum_});
  }
  void load(sct::RecordReader& reader) override {
    const auto steps = reader.steps();
    const auto numbers = reader.floats();
    if (numbers.size() != 1) reader.wrong("no number");
    steps_ = steps;
    sum_ = numbers.front();
  }
  std::string description() const override { return "what = counting\n"; }
  std::string policy(const std::map<std::string, std::string>&) const override { return fmt::format("{}", sum_); }

private:
  std::size_t losses_;
  std::uint64_t bad_;
  std::uint64_t steps_ = 0;
  float sum_ = 0;
};

OfflineTraining counting(std::uint64_t steps, const std::string& description = "what = counting\nseed = 1\n",
                         std::size_t losses = 2, std::uint64_t bad = 0) {
  return {std::make_unique<Counter>(losses, bad), description, steps};
}

void go(OfflineTraining& training, std::uint64_t to) {
  while (training.steps() < to) training.step();
}

std::vector<std::pair<std::uint64_t, std::vector<double>>> points(const OfflineTraining& training) {
  std::vector<std::pair<std::uint64_t, std::vector<double>>> all;
  for (const auto& point : training.curve()) all.emplace_back(point.steps, point.losses);
  return all;
}

// ---- the curve ---------------------------------------------------------------------------------------------------

TEST(OfflineTraining, HasACurveOfMeansSinceThePointBefore) {
  auto training = counting(7);
  EXPECT_EQ(training.last_step(), 7U);
  EXPECT_TRUE(training.names().empty());
  go(training, 7);
  EXPECT_TRUE(training.finished());
  EXPECT_EQ(training.names(), (std::vector<std::string>{"first", "second"}));
  ASSERT_EQ(training.curve().size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(training.curve()[i].steps, i + 1);
    EXPECT_EQ(training.curve()[i].losses[1], static_cast<double>((i + 1) * (i + 1)));
  }
}

TEST(OfflineTraining, HasAPointEveryHundredthOfTheRunAndAtTheEnd) {
  for (const std::uint64_t steps : {99, 100, 101, 250, 1000, 1050}) {
    auto training = counting(steps);
    go(training, steps);
    const std::uint64_t every = (steps + 99) / 100;
    ASSERT_EQ(training.curve().size(), (steps + every - 1) / every) << steps;
    std::uint64_t before = 0;
    for (const auto& point : training.curve()) {
      EXPECT_EQ(point.steps, std::min(before + every, steps));
      double sum = 0;
      for (auto step = before + 1; step <= point.steps; ++step) sum += static_cast<double>(step * step);
      EXPECT_NEAR(point.losses[1], sum / static_cast<double>(point.steps - before), 1e-9 * sum);
      before = point.steps;
    }
  }
}

TEST(OfflineTraining, OfNoStepsIsOver) {
  const auto training = counting(0);
  EXPECT_TRUE(training.finished());
  EXPECT_TRUE(training.curve().empty());
}

TEST(OfflineTraining, SaysWhenItHasDiverged) {
  auto training = counting(10, "", 2, 4);
  go(training, 3);
  expect_error<TrainingDiverged>([&] { training.step(); },
                                 "training has diverged: the second loss of step 4 is inf; lower the learning rate");
}

// ---- checkpoints -------------------------------------------------------------------------------------------------

TEST(OfflineCheckpoint, ChangesNothingWhereverTheRunIsInterrupted) {
  for (const std::uint64_t steps : {12, 230}) {
    auto whole = counting(steps);
    go(whole, steps);
    for (std::uint64_t at = 0; at <= steps; at += steps > 100 ? 7 : 1) {
      auto before = counting(steps);
      go(before, at);
      const auto bytes = before.checkpoint();
      auto after = counting(steps);
      go(after, std::min<std::uint64_t>(steps, 3));  // what was before is gone
      after.restore(bytes, "c");
      EXPECT_EQ(after.steps(), at);
      EXPECT_EQ(after.checkpoint(), bytes);
      go(after, steps);
      EXPECT_EQ(points(after), points(whole)) << at;
      EXPECT_EQ(after.names(), whole.names());
      EXPECT_EQ(after.checkpoint(), whole.checkpoint());
      EXPECT_EQ(after.learner().policy({}), whole.learner().policy({}));
    }
  }
}

TEST(OfflineCheckpoint, OfAnotherRunIsRefusedByItsDifference) {
  auto there = counting(12, "what = counting\nseed = 1\n");
  go(there, 5);
  const auto bytes = there.checkpoint();
  auto seed = counting(12, "what = counting\nseed = 2\n");
  expect_error<UsageError>([&] { seed.restore(bytes, "c"); },
                           "the checkpoint is of another run: seed = 1 there, 2 here; give that run's settings");
  auto longer = counting(13);
  expect_error<UsageError>([&] { longer.restore(bytes, "c"); },
                           "the checkpoint is of another run: steps = 12 there, 13 here; give that run's settings");
  for (auto* training : {&seed, &longer}) {
    EXPECT_EQ(training->steps(), 0U);
    EXPECT_TRUE(training->curve().empty());
  }
  auto other = counting(12, "what = counting\nseed = 1\n", 3);  // the same by its words, but not by its losses
  other.restore(bytes, "c");
  expect_error<UsageError>([&] { other.step(); }, "the checkpoint is of another run: 2 losses there, 3 here");
}

std::string small_checkpoint() {
  auto training = counting(12);
  go(training, 5);
  return training.checkpoint();
}

void expect_refusal(const std::string& bytes, const std::string& part) {
  auto training = counting(12);
  expect_error<InputFileError>([&] { training.restore(bytes, "a\nfile"); }, "a?file: " + part);
}

TEST(OfflineCheckpoint, ThatIsCutOrChangedAnywhereIsRefused) {
  const auto whole = small_checkpoint();
  for (std::size_t size = 0; size < whole.size(); ++size) expect_refusal(whole.substr(0, size), "");
  expect_refusal(whole + "x", "damaged checkpoint");
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    auto bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    expect_refusal(bytes, "");
  }
  expect_refusal("", "no checkpoint of mpe-train offline");
}

/// The payload under a checksum that is right.
std::string resealed(const std::string& payload) {
  sct::RecordWriter writer(training_record);
  writer.digits({reinterpret_cast<const std::uint8_t*>(payload.data()), payload.size()});
  return std::move(writer).sealed();
}

std::string payload_of(const std::string& checkpoint) { return checkpoint.substr(16, checkpoint.size() - 24); }

TEST(OfflineCheckpoint, ThatIsChangedUnderARightChecksumIsRefusedOrHarmless) {
  const auto payload = payload_of(small_checkpoint());
  {
    auto training = counting(12);
    training.restore(resealed(payload), "c");
    EXPECT_EQ(training.checkpoint(), small_checkpoint());
  }
  std::size_t harmless = 0;
  const auto try_out = [&](const std::string& changed) {
    auto training = counting(12);
    try {
      training.restore(resealed(changed), "c");
      ++harmless;
      EXPECT_LE(training.steps(), 12U);
      go(training, 12);
      EXPECT_EQ(training.curve().back().steps, 12U);
      for (const auto& point : training.curve()) EXPECT_EQ(point.losses.size(), training.names().size());
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_TRUE(std::none_of(message.begin(), message.end(), [](unsigned char c) { return c < 0x20; })) << message;
    }
  };
  for (std::size_t at = 0; at < payload.size(); ++at)
    for (const int mask : {0x01, 0x80, 0xFF}) {
      auto changed = payload;
      changed[at] = static_cast<char>(changed[at] ^ mask);
      try_out(changed);
    }
  EXPECT_GT(harmless, 100U);  // the numbers of the losses
  for (std::size_t size = 0; size < payload.size(); ++size) expect_refusal(resealed(payload.substr(0, size)), "");
  expect_refusal(resealed(payload + std::string(8, '\0')), "damaged checkpoint: bytes too many at its end");
}

/// A checkpoint put together by hand.
struct Draft {
  std::string description = "what = counting\nseed = 1\n";
  std::uint64_t last = 12, at = 5, summed = 0, learner = 5;
  std::vector<std::string> names{"first", "second"};
  std::vector<std::uint64_t> points{1, 2, 3, 4, 5};

  std::string bytes() const {
    sct::RecordWriter writer(training_record);
    writer.text(description);
    writer.word(last);
    writer.word(at);
    writer.word(names.size());
    for (const auto& name : names) {
      writer.text(name);
      writer.real(0);
    }
    writer.word(summed);
    writer.word(points.size());
    for (const auto step : points) {
      writer.word(step);
      for (std::size_t k = 0; k < names.size(); ++k) writer.real(1);
    }
    writer.word(learner);
    writer.floats(std::vector<float>{2.5F});
    return std::move(writer).sealed();
  }
};

TEST(OfflineCheckpoint, ThatMakesNoSenseIsRefusedThoughItsChecksumIsRight) {
  const auto refused = [](const std::function<void(Draft&)>& change, const std::string& part) {
    Draft draft;
    change(draft);
    expect_refusal(draft.bytes(), "damaged checkpoint: " + part);
  };
  auto training = counting(12);
  training.restore(Draft().bytes(), "c");
  EXPECT_EQ(training.steps(), 5U);
  refused([](Draft& d) { d.at = d.learner = 13; }, "a step beyond the last");
  refused([](Draft& d) { d.learner = 4; }, "a learner at another step");
  refused([](Draft& d) { d.points = {1, 2, 2}; }, "a curve out of order");
  refused([](Draft& d) { d.points = {1, 6}; }, "a curve out of order");
  refused([](Draft& d) { d.names.clear(); }, "losses without a step, or steps without a loss");
  refused([](Draft& d) { d.at = d.learner = 0, d.points.clear(); }, "losses without a step, or steps without a loss");
}

// ---- a folder ----------------------------------------------------------------------------------------------------

const DataSet& counted_data() {
  static const test::Files files =
      test::files_of(test::played_arrays(Layout(Scenario::named("simple_tag")), test::pursuit_cast(), 3, 0, 2));
  static const DataSet data = test::parse(files);
  return data;
}

OfflineTraining tiny_transformer(std::uint64_t steps, unsigned threads = 1) {
  TransformerSettings settings;
  settings.hidden = 8;
  settings.layers = 1;
  settings.context = 3;
  settings.batch = 4;
  settings.threads = threads;
  auto learner = std::make_unique<TransformerLearner>(counted_data(), settings);
  auto description = learner->description();
  return {std::move(learner), std::move(description), steps};
}

TEST(ResumableTraining, GoesOnInItsFolderWhereverItWasInterrupted) {
  auto whole = tiny_transformer(9);
  train(whole, {});
  EXPECT_FALSE(resume(whole, {}));  // without a folder there is nothing to go on with
  for (std::uint64_t at = 0; at <= 9; ++at) {
    const test::Folder folder;
    {
      sct::CheckpointFiles files(folder / "run");
      auto training = tiny_transformer(9);
      const TrainingWatch watch{&files, 4};
      EXPECT_FALSE(resume(training, watch));
      const Progress progress{nullptr, [&] { return training.steps() == at; }};
      if (at == 9)
        train(training, watch, progress);  // nobody asks when all is done
      else
        EXPECT_THROW(train(training, watch, progress), Cancelled);
      EXPECT_EQ(training.steps(), at);
    }
    sct::CheckpointFiles files(folder / "run");
    auto training = tiny_transformer(9);
    std::vector<double> shares;
    const TrainingWatch watch{&files, 4};
    EXPECT_EQ(resume(training, watch), at > 0);
    EXPECT_EQ(training.steps(), at);
    train(training, watch, [&](double share) { shares.push_back(share); });
    EXPECT_EQ(training.checkpoint(), whole.checkpoint()) << at;
    EXPECT_EQ(shares.size(), 9 - at);
    EXPECT_TRUE(at == 9 || shares.back() == 1);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  }
}

// Whatever ends a training: its folder has it as it stands, whole, and it goes on from there.
TEST(ResumableTrainingThreads, EndsAsItsProgressWishes) {
  auto whole = tiny_transformer(9);
  train(whole, {});
  for (const unsigned threads : {1U, 4U})
    folk::test::expect_ends([&](const Progress& progress) {
      const test::Folder folder;
      sct::CheckpointFiles files(folder / "run");
      const TrainingWatch watch{&files, 4};
      auto training = tiny_transformer(9, threads);
      try {
        train(training, watch, progress);
      } catch (...) {
        auto again = tiny_transformer(9, threads);
        EXPECT_EQ(resume(again, watch), training.steps() > 0);
        EXPECT_EQ(again.steps(), training.steps());
        EXPECT_EQ(again.checkpoint(), training.checkpoint());
        train(again, watch);
        EXPECT_EQ(again.checkpoint(), whole.checkpoint());
        throw;
      }
      EXPECT_EQ(training.checkpoint(), whole.checkpoint());
    });
}

TEST(ResumableTraining, KeepsTheRunEverySoManySteps) {
  const test::Folder folder;
  sct::CheckpointFiles files(folder / "run");
  auto training = counting(10);
  std::vector<std::string> kept;
  const TrainingWatch watch{&files, 4};
  train(training, watch, [&](double) {
    if (!files.checkpoints().empty()) {
      const auto newest = files.checkpoints().back().filename().string();
      if (kept.empty() || kept.back() != newest) kept.push_back(newest);
    }
  });
  EXPECT_EQ(kept, (std::vector<std::string>{"step-4.checkpoint", "step-8.checkpoint"}));
  EXPECT_EQ(files.checkpoints().back().filename(), "step-10.checkpoint");
  train(training, watch);  // there is nothing left to do
  EXPECT_EQ(files.checkpoints().size(), 2U);
}

TEST(ResumableTraining, GoesBackToTheCheckpointBeforeADamagedOne) {
  const test::Folder folder;
  sct::CheckpointFiles files(folder / "run");
  auto first = counting(10);
  train(first, {&files, 4});
  ASSERT_EQ(files.checkpoints().size(), 2U);
  std::ofstream(files.checkpoints().back()) << "damaged";
  std::vector<std::string> notes;
  auto again = counting(10);
  const TrainingWatch watch{&files, 4, [&](const std::string& note) { notes.push_back(note); }};
  EXPECT_TRUE(resume(again, watch));
  EXPECT_EQ(again.steps(), 8U);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("step-10.checkpoint: no checkpoint"), std::string::npos) << notes[0];
  train(again, watch);
  EXPECT_EQ(again.checkpoint(), first.checkpoint());
  auto other = counting(10, "what = counting\nseed = 2\n");
  expect_error<UsageError>([&] { resume(other, watch); }, "seed = 1 there, 2 here");
}

}  // namespace
}  // namespace folk::mpe
