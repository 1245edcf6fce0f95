#pragma once
// MA-BCQ: batch-constrained Q-learning (Fujimoto, Meger & Precup 2019) for predators whose values a monotone mixer adds
// up.
//
// Each predator has an autoencoder of the data's actions, a network that shifts them a little and twin critics of its
// own observation and action. The comparison of Li et al. names BCQ for each predator, six critics and a QMIX-like
// mixer of six values, and no more. What is our choice, beyond that: the mixer is ICQ's (mixer.h), without bias and
// learned by Adam at the critics' rate; its state is the observations of all predators one after the other; a next
// state's candidate is each predator's own best; the critics learn from the error of the mixed value alone; the
// perturbations ascend the mixed value of all six.

#include <folk/analysis/play/workers.h>
#include <folk/mpe/data/data_set.h>
#include <folk/mpe/offline/action_vae.h>
#include <folk/mpe/offline/mixer.h>
#include <folk/mpe/offline/offline_learner.h>
#include <folk/mpe/online/learner.h>
#include <folk/mpe/players/bcq_policy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// Defaults are those of Fujimoto et al.'s program.
struct MaBcqSettings {
  std::size_t vae_hidden = 750;                    ///< units in each of two hidden layers
  std::array<std::size_t, 2> hidden = {400, 300};  ///< of critics and perturbations
  double learning_rate = 1e-3;
  double discount = 0.99;
  double averaging = 0.005;  ///< tau, a step of the target networks
  std::size_t batch = 100;
  std::size_t candidates = 10;          ///< actions of a next state
  std::size_t acting_candidates = 100;  ///< actions of which the policy takes the best
  double perturbation = 0.05;           ///< the largest shift of an action's number
  double lambda = 0.75;                 ///< weight of the smaller twin where a next state's candidate is chosen
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< changes no bit of the result
};

/// Throws UsageError, naming the setting, when one is out of range.
void require_sound(const MaBcqSettings& settings);

// ---- losses ------------------------------------------------------------------------------------------------------

/// Critics of one shape, the twins of each predator side by side, and their mixer.
template <class S>
struct MixedCritics {
  const MlpShape& critic;
  std::vector<const S*> critics;  ///< parameters
  const MixerShape& mixer;
  const S* mixing;  ///< parameters of the mixer
};

/// Scratch of their loss, and its gradients.
template <class S>
struct MixedCriticsTape {
  std::vector<MlpTape<S>> critics;
  MixerTape<S> mixer;  ///< the states are its input
  Matrix<S> values;    ///< [rows, critics]
  Matrix<S> mixed;     ///< [rows, 1], as the next
  Matrix<S> mixed_gradient;
  std::vector<Matrix<S>> value_gradients;        ///< [rows, 1] each
  std::vector<std::vector<S>> critic_gradients;  ///< with respect to each critic's parameters
  std::vector<S> mixing_gradient;
};

/// tape.mixed of what predators did: `inputs` [rows, observed + 2] are a predator's observation and action each,
/// tape.mixer.layer.input() the states.
template <class S>
void mixed_value(const MixedCritics<S>& networks, const std::vector<Matrix<S>>& inputs, MixedCriticsTape<S>& tape,
                 Workers& workers);

/// The mean over the rows of (mixed_value - wanted)^2, `wanted` being [rows, 1], and its gradients.
template <class S>
double mixed_critics_loss(const MixedCritics<S>& networks, const std::vector<Matrix<S>>& inputs,
                          const Matrix<S>& wanted, MixedCriticsTape<S>& tape, Workers& workers);

/// Scratch of a perturbation's loss.
template <class S>
struct PerturbationTape {
  CandidateTape<S> candidates;  ///< as proposed, of the states that are learned from
  std::array<MlpTape<S>, 2> critics;
  Matrix<S> value_gradient;
  Matrix<S> action_gradient;
  Matrix<S> output_gradient;
};

/// A predator's part of -mean mixed value at the actions tape.candidates proposes: -mean over the rows of the sum of
/// its critics' values times `weights` [rows, 2], which are the mixer's. The gradient is added to `gradient`; an action
/// that was cut has none.
template <class S>
double perturbation_loss(NetworkView<S> perturbation, S most, const MlpShape& critic,
                         const std::array<const S*, 2>& critics, const Matrix<S>& weights, PerturbationTape<S>& tape,
                         S* gradient);

/// Of the values [rows of all candidates, 1] of twin critics, those of the candidate of each state whose lambda *
/// smaller + (1 - lambda) * larger is highest: written to rows [first, ...) and columns [column, column + 2) of
/// `chosen`.
template <class S>
void choose_candidates(const std::array<const Matrix<S>*, 2>& values, std::size_t candidates, S lambda, Index first,
                       Index column, Matrix<S>& chosen);

// ---- learner -----------------------------------------------------------------------------------------------------

/// What a predator learns with. The autoencoder's target is empty: it needs none.
struct BcqAgent {
  LearningNetwork vae;
  LearningNetwork perturbation;
  std::array<LearningNetwork, 2> critics;
};

/// Losses: "vae", mean over the predators; "critic"; "actor", minus the mean mixed value of the actors' actions. Each
/// step moves the autoencoders, then critics and mixer, then the perturbations and the targets, on one batch.
class MaBcqLearner final : public OfflineLearner {
public:
  /// The data must outlive it. The predators' reward is that of predator 0; nothing is terminal. Throws UsageError.
  MaBcqLearner(const DataSet& data, const MaBcqSettings& settings);
  ~MaBcqLearner() override;

  std::uint64_t steps() const override { return steps_; }
  std::vector<NamedLoss> step() override;
  void save(sct::RecordWriter& writer) const override;
  void load(sct::RecordReader& reader) override;
  std::string description() const override;
  std::string policy(const std::map<std::string, std::string>& notes) const override;

  /// The same as a policy that plays.
  BcqPolicy bcq_policy(const std::map<std::string, std::string>& notes) const;

  /// What it has learned with: the predators' networks, and the mixer that they share.
  const std::vector<BcqAgent>& agents() const { return agents_; }
  const LearningNetwork& mixer() const { return mixer_; }

private:
  struct Batch;
  struct Scratch;

  void gather();
  double learn_actions();
  void choose_next();
  void choose_next(std::size_t agent, std::size_t first, std::size_t rows, Scratch& scratch);
  double learn_values();
  double learn_perturbations();
  double learn_perturbation(std::size_t agent, Scratch& scratch);
  void descend(LearningNetwork& network, std::span<const float> gradient) const;
  void follow(LearningNetwork& network) const;
  NetworkView<float> decoder(const BcqAgent& agent) const;

  const DataSet& data_;
  MaBcqSettings settings_;
  ActionVaeShape vae_shape_;
  MlpShape perturbation_shape_;
  MlpShape critic_shape_;
  MixerShape mixer_shape_;
  std::vector<BcqAgent> agents_;
  LearningNetwork mixer_;
  std::uint64_t steps_ = 0;
  Workers workers_;
  std::unique_ptr<Batch> batch_;
  std::vector<std::unique_ptr<Scratch>> scratch_;  ///< one a thread
};

}  // namespace folk::mpe
