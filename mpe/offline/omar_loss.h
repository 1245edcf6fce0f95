#pragma once
// What OMAR minimises (Pan, Huang, Ma & Xu, "Plan Better Amid Conservatism", ICML 2022), one predator at a time, and
// with it conservative Q-learning (Kumar et al. 2020) in that program's form.
//
// o, a, r, o', d: a batch of transitions. pi: the actor, tanh of a network behind a batch normalisation; Q_1, Q_2: twin
// critics of (o, a) behind one; primes: their targets. All normalise with the batch's own numbers here, so each call
// below sees the actions that it is given on a scale of their own, as in the published program.

#include <folk/mpe/network/batch_norm.h>
#include <folk/mpe/world/random_stream.h>

#include <array>
#include <cstddef>
#include <functional>
#include <span>

namespace folk::mpe {

inline constexpr std::size_t uniform_actions_each = 10;  ///< of an observation, that conservatism holds down
inline constexpr std::size_t search_rounds = 3;
inline constexpr std::size_t search_samples = 10;  ///< actions of an observation in a round
inline constexpr double search_deviation = 2;      ///< of the first round's, about 0
inline constexpr double action_penalty = 1e-3;

/// What a predator learns from, a transition a row.
template <class S>
struct Transitions {
  Matrix<S> observations;       ///< [rows, inputs]
  Matrix<S> actions;            ///< [rows, 2]
  Matrix<S> rewards;            ///< [rows, 1]
  Matrix<S> next_observations;  ///< [rows, inputs]
  Matrix<S> dones;              ///< [rows, 1], 0 or 1
};

/// Room for what is computed on the way.
template <class S>
struct OmarScratch {
  NormalisedTape<S> actor;
  NormalisedTape<S> critic;       ///< of one action an observation
  NormalisedTape<S> wide_critic;  ///< of several
  std::array<Matrix<S>, 2> gradients;
  std::array<Matrix<S>, 2> wide_gradients;
  Matrix<S> actions;  ///< of the actor
  Matrix<S> action_gradient;
};

/// Actions uniform in [-1, 1]^2: [rows, 2].
template <class S>
void draw_uniform_actions(RandomStream& random, std::size_t rows, Matrix<S>& actions);

/// log of the sum of exp(values), which may be large; at least one value.
template <class S>
S log_sum_exp(std::span<const S> values);

/// y = r + discount (1 - d) min_k Q'_k(o', pi'(o')) [rows, 1].
template <class S>
void critic_targets(const NormalisedShape& actor, const S* target_actor, const NormalisedShape& critic,
                    const S* target_critic, const Transitions<S>& batch, double discount, OmarScratch<S>& scratch,
                    Matrix<S>& targets);

struct CriticLoss {
  double error = 0;         ///< sum over k of the mean of (Q_k(o, a) - y)^2
  double conservative = 0;  ///< sum over k of the mean of log sum_u exp(Q_k(o, u) - log 1/4) - Q_k(o, a)
};

/// The parts of error + conservatism * conservative; adds its gradient to `gradient`. `uniform`: the actions u, so many
/// rows of them for each observation, [rows * n, 2]; 1/4 is their density.
template <class S>
CriticLoss critic_loss(const NormalisedShape& critic, const S* parameters, const Transitions<S>& batch,
                       const Matrix<S>& targets, const Matrix<S>& uniform, double conservatism, OmarScratch<S>& scratch,
                       S* gradient);

/// scratch.actions = pi(o), and the tapes from which actor_loss goes on.
template <class S>
void act(const NormalisedShape& actor, const S* actor_parameters, const NormalisedShape& critic,
         const S* critic_parameters, const Matrix<S>& observations, OmarScratch<S>& scratch);

/// Values [rows * n, 1] of n actions [rows * n, 2] of each observation; they need not outlive the next call.
template <class S>
using ActionValues = std::function<const Matrix<S>&(const Matrix<S>&)>;

/// Q_1 of these observations.
template <class S>
ActionValues<S> first_critic(const NormalisedShape& critic, const S* parameters, const Matrix<S>& observations,
                             OmarScratch<S>& scratch);

/// The search for better actions: in each round samples of N(mu, sigma) cut to [-1, 1], then mu = their mean weighted
/// by the softmax of their values and sigma = the root of their mean square about mu, axis by axis. `best` [rows, 2]:
/// of the last round's samples and the own action the one of largest value.
template <class S>
void search_actions(const ActionValues<S>& values, const Matrix<S>& own_actions, const Matrix<S>& own_values,
                    RandomStream& random, Matrix<S>& best);

/// imitation * mean (pi(o) - best)^2 - (1 - imitation) * mean Q_1(o, pi(o)) + action_penalty * mean pi(o)^2, after
/// `act`; means of squares are over rows and axes. Adds the gradient with respect to the actor's parameters to
/// `gradient`. With imitation 0 `best` is not looked at: the actor of conservative Q-learning.
template <class S>
double actor_loss(const NormalisedShape& actor, const S* actor_parameters, const NormalisedShape& critic,
                  const S* critic_parameters, const Matrix<S>& best, double imitation, OmarScratch<S>& scratch,
                  S* gradient);

}  // namespace folk::mpe
