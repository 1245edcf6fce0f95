// A batch's gradient: the same bits on any number of threads, and that of the whole batch taken at once.

#include <folk/sct/training/batch_gradient.h>
#include <gtest/gtest.h>
#include <sct/network/random_network.h>

#include <utility>

namespace folk::sct {
namespace {

constexpr std::array modes{LossMode::teacher, LossMode::selfconf, LossMode::composite, LossMode::action_only};
constexpr StepDropout quarter{0.25, 5, 9};

/// Architecture, parameters and a batch that fills the lanes unevenly.
template <class S>
struct Problem {
  Problem(LossMode mode, std::uint64_t seed)
      : draw(seed),
        network(test::random_architecture(mode, draw)),
        parameters(test::random_parameters<S>(network.architecture(), draw)),
        batch(test::random_batch<S>(network.architecture(), draw.between(1, 45), draw)) {}

  test::Draw draw;
  Network<S> network;
  std::vector<S> parameters;
  Batch<S> batch;
};

TEST(BatchGradientThreads, GiveTheSameBitsWhateverTheirNumber) {
  for (const auto mode : modes)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Problem<float> problem(mode, seed);
      std::vector<std::vector<float>> gradients;
      std::vector<double> losses;
      for (const unsigned threads : {1U, 2U, 3U}) {
        BatchGradient<float> of_batch(problem.network, mode, threads);
        gradients.emplace_back(problem.parameters.size(), 7.0F);
        losses.push_back(of_batch(problem.parameters, problem.batch, quarter, gradients.back()).total());
      }
      for (std::size_t i = 1; i < gradients.size(); ++i) {
        EXPECT_EQ(losses[i], losses[0]);
        EXPECT_EQ(gradients[i], gradients[0]);
      }
    }
}

TEST(BatchGradient, IsThatOfTheBatchAsOneChunk) {
  for (const auto mode : modes)
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const Problem<double> problem(mode, seed);
      const auto& batch = problem.batch;
      const Chunk<double> chunk{batch, 0, 0, batch.window_rounds};
      SelfConfirmingLoss<double> loss(problem.network, mode);
      std::vector<double> whole(problem.parameters.size());
      const auto expected = loss(problem.parameters.data(), chunk, Denominators<double>(batch),
                                 {Dropout(0.25, 5, 9, 0), Dropout(0.25, 5, 9, 1)}, whole.data());
      BatchGradient<double> of_batch(problem.network, mode, 1);
      std::vector<double> gradient(whole.size());
      const auto losses = of_batch(problem.parameters, batch, quarter, gradient);
      EXPECT_NEAR(losses.belief, expected.belief, 1e-12);
      EXPECT_NEAR(losses.action, expected.action, 1e-12);
      EXPECT_NEAR(losses.next_observation, expected.next_observation, 1e-12);
      EXPECT_NEAR(losses.next_return, expected.next_return, 1e-12);
      for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_NEAR(gradient[i], whole[i], 1e-12) << i;
    }
}

TEST(BatchGradient, TouchesWhatTheLossTouches) {
  Architecture architecture;
  architecture.hidden = 4;
  architecture.layers = 1;
  architecture.readout = Readout::own;
  architecture.belief_token = false;
  const Network<float> network(architecture);
  const auto& layout = network.layout();
  const BatchGradient<float> of_batch(network, LossMode::action_only, 1);
  const auto touched = [&](const Tensor& tensor) {
    std::size_t covered = 0;
    for (const auto& [begin, end] : of_batch.touched())
      for (std::size_t i = tensor.offset; i < tensor.offset + tensor.size(); ++i)
        covered += i >= begin && i < end ? 1U : 0U;
    return covered;
  };
  for (const auto& tensor : layout.tensors()) {
    const bool none = tensor.name == "embed_opoact.weight" || tensor.name.starts_with("predict_opoact");
    EXPECT_EQ(touched(tensor), none ? 0 : tensor.size()) << tensor.name;
  }
  EXPECT_EQ(BatchGradient<float>(Network<float>(Architecture{}), LossMode::teacher, 1).touched().size(), 1U);
}

}  // namespace
}  // namespace folk::sct
