#include <folk/analysis/play/state_reduction.h>
#include <folk/games/random.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

namespace folk {
namespace {

Transitions random_chain(RandomStream& random, Eigen::Index rows, Eigen::Index columns) {
  Transitions p(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) p(i, j) = random.uniform();
    p.row(i) /= p.row(i).sum();
  }
  return p;
}

TEST(StateReduction, FindsTheStationaryDistribution) {
  RandomStream random({1, 0, 0, 0});
  for (Eigen::Index n = 1; n < 40; ++n) {
    const Transitions p = random_chain(random, n, n);
    const Eigen::VectorXd pi = stationary_distribution(p);
    EXPECT_NEAR(pi.sum(), 1, 1e-14);
    EXPECT_LT((pi.transpose() * p - pi.transpose()).norm(), 1e-14) << n;
  }
}

TEST(StateReduction, KeepsTheDigitsOfAChainThatNearlyFallsApart) {
  // Leaves state 0 with probability a, state 1 with probability 3a: 3/4 and 1/4 whatever a.
  for (const double a : {1e-3, 1e-9, 1e-16, 1e-30}) {
    Transitions p(2, 2);
    p << 1 - a, a, 3 * a, 1 - 3 * a;
    const Eigen::VectorXd pi = stationary_distribution(p);
    EXPECT_NEAR(pi[0], 0.75, 1e-15);
    EXPECT_NEAR(pi[1], 0.25, 1e-15);
  }
}

TEST(StateReduction, AbsorbsAsTheLinearSolveDoes) {
  RandomStream random({2, 0, 0, 0});
  for (Eigen::Index n = 1; n < 20; ++n) {
    const Transitions p = random_chain(random, n, n + 3);
    const Eigen::VectorXd ends = absorption_probabilities(p);
    const Eigen::MatrixXd solved =
        (Eigen::MatrixXd::Identity(n, n) - p.leftCols(n)).partialPivLu().solve(Eigen::MatrixXd(p.rightCols(3)));
    for (Eigen::Index c = 0; c < 3; ++c) EXPECT_NEAR(ends[c], solved(0, c), 1e-13);
  }
}

TEST(StateReduction, ExpectsAtAbsorptionWhatTheLinearSolveDoes) {
  RandomStream random({3, 0, 0, 0});
  for (Eigen::Index n = 1; n < 20; ++n) {
    const Transitions p = random_chain(random, n, n + 1);
    const Eigen::VectorXd ends = Eigen::VectorXd::Random(n);
    const Eigen::VectorXd solved = (Eigen::MatrixXd::Identity(n, n) - p.leftCols(n))
                                       .partialPivLu()
                                       .solve(Eigen::VectorXd(p.col(n).cwiseProduct(ends)));
    EXPECT_LT((expected_ends(p, ends) - solved).norm(), 1e-13);
  }
}

TEST(StateReduction, ExpectsTheSameFromStatesThatHardlyEverLeave) {
  for (const double a : {1e-6, 1e-12, 1e-30}) {
    Transitions p(2, 3);
    p << 1 - a, a / 2, a / 2, a / 4, 1 - a, 3 * a / 4;
    const Eigen::VectorXd ends = expected_ends(p, Eigen::Vector2d(7, 7));
    EXPECT_NEAR(ends[0], 7, 1e-14);
    EXPECT_NEAR(ends[1], 7, 1e-14);
  }
}

}  // namespace
}  // namespace folk
