// Token by token against the whole window at once.

#include <folk/sct/stream.h>
#include <gtest/gtest.h>
#include <sct/playing_policy.h>

#include <numeric>

namespace folk::sct {
namespace {

class StreamTest : public ::testing::Test {
protected:
  /// The window's embedded tokens and their final states, as training computes them.
  StreamTest() {
    batch_.window_rounds = {architecture_.context};
    test::Draw draw(3);
    for (std::size_t t = 0; t < architecture_.context; ++t) {
      batch_.returns.push_back(static_cast<float>(draw.number()));
      batch_.timesteps.push_back(static_cast<std::int32_t>(t + 2));
      batch_.opponent.classes.push_back(static_cast<std::int32_t>(draw.between(0, 1)));
      batch_.own.classes.push_back(static_cast<std::int32_t>(draw.between(0, 1)));
      for (std::size_t k = 0; k < architecture_.observation_size; ++k)
        batch_.observations.push_back(static_cast<float>(draw.number()));
    }
    std::vector<std::size_t> every(architecture_.round_tokens());
    std::iota(every.begin(), every.end(), std::size_t{0});
    const Chunk<float> chunk{batch_, 0, 0, batch_.window_rounds};
    const TokenRows rows(batch_.window_rounds, every.size(), every);
    EmbeddingTape<float> tape;
    embed(architecture_, network_.embedding(), parameters(), chunk, batch_.opponent, rows, Dropout(), tape, embedded_);
    NetworkTape<float> pass;
    const Dropout none;
    network_.forward(parameters(), chunk, {batch_.opponent, none, every}, pass);
    states_ = pass.hidden;
  }

  const float* parameters() const { return policy_.parameters.data(); }

  /// Appends tokens up to `end` and compares the last one's state.
  void expect_state(Stream& stream, std::size_t end) const {
    const auto begin = stream.tokens();
    const Matrix<float> tokens = embedded_.middleRows(index(begin), index(end - begin));
    const Matrix<float> state = stream.append(tokens);
    ASSERT_EQ(stream.tokens(), end);
    ASSERT_EQ(state.rows(), 1);
    EXPECT_LT((state - states_.row(index(end) - 1)).cwiseAbs().maxCoeff(), 1e-4F) << begin << " to " << end;
  }

  Policy policy_ = test::playing_policy({});
  Architecture architecture_ = policy_.architecture;
  Network<float> network_{architecture_};
  Batch<float> batch_;
  Matrix<float> embedded_, states_;
};

TEST_F(StreamTest, SaysOfEachTokenWhatTrainingComputes) {
  Stream stream(network_, parameters());
  for (Index token = 0; token < embedded_.rows(); ++token) expect_state(stream, static_cast<std::size_t>(token) + 1);
}

TEST_F(StreamTest, TakesTokensInAnyPieces) {
  const auto all = static_cast<std::size_t>(embedded_.rows());
  test::Draw draw(4);
  for (int repetition = 0; repetition < 20; ++repetition) {
    Stream stream(network_, parameters());
    while (stream.tokens() < all) expect_state(stream, draw.between(stream.tokens() + 1, all));
  }
}

TEST_F(StreamTest, ForgetsWhatIsNotKept) {
  Stream stream(network_, parameters());
  test::Draw draw(5);
  const auto all = static_cast<std::size_t>(embedded_.rows());
  const Matrix<float> other = Matrix<float>::Random(2, embedded_.cols());
  for (int repetition = 0; repetition < 50; ++repetition) {
    stream.keep(draw.between(0, all - 2));
    const auto kept = stream.tokens();
    stream.append(other);
    EXPECT_EQ(stream.tokens(), kept + 2);
    stream.keep(kept);
    expect_state(stream, draw.between(kept + 1, all));
  }
}

}  // namespace
}  // namespace folk::sct
