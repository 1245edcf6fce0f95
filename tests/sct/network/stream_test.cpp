// Token by token against the whole window at once, and windows side by side against each alone.

#include <folk/sct/network/stream.h>
#include <gtest/gtest.h>
#include <sct/policy/playing_policy.h>

#include <numeric>
#include <string>
#include <utility>
#include <vector>

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

// ---- windows side by side ----------------------------------------------------------------------------------------

struct Shape {
  const char* name;
  bool discrete = true;
  std::size_t agents = 1;
  std::size_t hidden = 16;
  std::size_t heads = 2;
};

class StreamsSideBySide : public ::testing::TestWithParam<Shape> {
protected:
  static Architecture architecture() {
    Architecture a;
    a.discrete = GetParam().discrete;
    a.agents = GetParam().agents;
    a.hidden = GetParam().hidden;
    a.heads = GetParam().heads;
    a.layers = 2;
    a.context = 4;
    a.time_rows = 9;
    return a;
  }

  std::size_t window_tokens() const { return network_.architecture().context * network_.architecture().round_tokens(); }
  Matrix<float> any_tokens(std::size_t count) {
    Matrix<float> tokens(index(count), index(network_.architecture().hidden));
    for (Index i = 0; i < tokens.size(); ++i) tokens.data()[i] = static_cast<float>(draw_.normal());
    return tokens;
  }

  /// Appends the next `added` tokens of every window to the stream.
  Matrix<float> append(Stream& stream, const std::vector<Matrix<float>>& windows, std::size_t added,
                       std::size_t asked) const {
    Matrix<float> pieces(index(windows.size() * added), windows.front().cols());
    for (std::size_t w = 0; w < windows.size(); ++w)
      pieces.middleRows(index(w * added), index(added)) = windows[w].middleRows(index(stream.tokens()), index(added));
    return stream.append(pieces, asked);
  }

  test::Draw draw_{11};
  Network<float> network_{architecture()};
  std::vector<float> parameters_ = test::random_parameters<float>(network_.architecture(), draw_);
};

TEST_P(StreamsSideBySide, SayOfEachWindowToTheBitWhatItSaysAlone) {
  for (const std::size_t count : {2, 3, 16, 21}) {
    std::vector<Matrix<float>> windows;
    for (std::size_t w = 0; w < count; ++w) windows.push_back(any_tokens(window_tokens()));
    for (int repetition = 0; repetition < 4; ++repetition) {
      Stream together(network_, parameters_.data(), count);
      EXPECT_EQ(together.windows(), count);
      std::vector<Stream> alone(count, Stream(network_, parameters_.data()));
      while (together.tokens() < window_tokens()) {
        const auto added = draw_.between(1, window_tokens() - together.tokens());
        const auto asked = draw_.between(1, added);
        const Matrix<float> states = append(together, windows, added, asked);
        ASSERT_EQ(states.rows(), index(count * asked));
        for (std::size_t w = 0; w < count; ++w) {
          const Matrix<float> own = append(alone[w], {windows[w]}, added, asked);
          ASSERT_EQ(Matrix<float>(states.middleRows(index(w * asked), index(asked))), own)
              << "window " << w << " of " << count << ", " << added << " tokens to " << together.tokens() << ", "
              << asked << " asked";
        }
        if (draw_.chance(0.3)) {  // some of it was a mistake
          const auto kept = draw_.between(0, together.tokens());
          together.keep(kept);
          for (auto& stream : alone) stream.keep(kept);
        }
        for (const auto& stream : alone) ASSERT_EQ(stream.tokens(), together.tokens());
      }
    }
  }
}

TEST_P(StreamsSideBySide, SayTheSameOfATokenHoweverManyAreAsked) {
  const std::vector<Matrix<float>> windows{any_tokens(window_tokens()), any_tokens(window_tokens())};
  const std::size_t all = window_tokens();
  Stream stream(network_, parameters_.data(), 2);
  const Matrix<float> every = append(stream, windows, all, all);
  for (std::size_t asked = 1; asked < all; ++asked) {
    stream.keep(0);
    const Matrix<float> last = append(stream, windows, all, asked);
    ASSERT_EQ(last.rows(), index(2 * asked));
    for (std::size_t w = 0; w < 2; ++w)
      EXPECT_LT((last.middleRows(index(w * asked), index(asked)) -
                 every.middleRows(index((w + 1) * all - asked), index(asked)))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-4F)
          << asked << " asked";
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, StreamsSideBySide,
                         testing::Values(Shape{"classes"}, Shape{"numbers", false},
                                         Shape{"three_agents", false, 3, 16, 1}, Shape{"wide", false, 3, 48, 3},
                                         Shape{"odd", false, 3, 36, 3}),
                         [](const auto& shape) { return std::string(shape.param.name); });

}  // namespace
}  // namespace folk::sct
