#pragma once
// Markov chains solved by state reduction, without a single subtraction.

#include <Eigen/Core>
#include <vector>

namespace folk {

/// Row i holds the probabilities of moving from state i.
using Transitions = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The stationary distribution of a chain in which state 0 is reached from every state, by the elimination of
/// Grassmann, Taksar & Heyman (Operations Research 33, 1985): every entry is accurate to its own last digits, also
/// where the chain nearly falls apart. O(n^3).
Eigen::VectorXd stationary_distribution(Transitions transitions);

/// With which probability a chain that starts in its state 0 is absorbed in each class: row i holds the probabilities
/// of moving from transient state i to each transient state, then to each absorbing class. By the same elimination.
Eigen::VectorXd absorption_probabilities(Transitions transient);

/// What is expected at absorption from each transient state on: row i of `transient` holds the probabilities of moving
/// from transient state i to each transient state, and then that of being absorbed at once; `ends[i]` is what is had on
/// average by those that are absorbed at once from i. By the same elimination.
Eigen::VectorXd expected_ends(Transitions transient, const Eigen::VectorXd& ends);

}  // namespace folk
