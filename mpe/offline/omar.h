#pragma once
// OMAR (Pan, Huang, Ma & Xu, "Plan Better Amid Conservatism", ICML 2022) and, as the case without its search,
// conservative Q-learning (CQL): each predator learns for itself from its own rows of the data.

#include <folk/analysis/play/workers.h>
#include <folk/mpe/data/data_set.h>
#include <folk/mpe/offline/offline_learner.h>
#include <folk/mpe/offline/omar_loss.h>
#include <folk/sct/training/adamw.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace folk::mpe {

/// Defaults are those of the published program in simple_tag with expert data.
struct OmarSettings {
  bool cql = false;             ///< the actor climbs its critic alone, as with an imitation of 0
  double conservatism = 5;      ///< alpha: weight of what holds actions down that the data do not have
  double imitation = 0.9;       ///< c: weight of the searched actions against the critic's slope
  std::size_t hidden = 64;      ///< units in each of two hidden layers
  double learning_rate = 1e-2;  ///< Adam's, of actors and critics
  std::size_t batch = 1024;     ///< transitions of each predator in a step, no two the same
  double discount = 0.95;       ///< the program's; the submission's text has 0.99
  double averaging = 0.01;      ///< tau, a step of the target networks
  double clip = 0.5;            ///< largest norm of an actor's gradient and of a predator's two critics' together
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< changes no bit of the result; more than the predators have nothing to do

  /// What the published program has for data of this scenario and level: random, medium-replay, medium or expert. It
  /// reads the conservatism of CQL from the same table, although the paper says that alpha was tuned; the submission's
  /// text has other values of c (0.5, 0.5, 0.7, 0.9 by level). Throws UsageError on other names.
  static OmarSettings published(std::string_view scenario, std::string_view level, bool cql = false);
};

/// Gradient steps of the published program: one in a hundred of its 200,000 (100,000) "steps", the first and the last
/// included. Throws UsageError on other names.
std::uint64_t published_omar_steps(std::string_view scenario, std::string_view level);

/// Throws UsageError, naming the setting, when one is out of range.
void require_sound(const OmarSettings& settings);

/// A step is one update of every predator: its critics, then its actor, then the targets. Losses: "critic" (the sum of
/// the two mean squared errors), "conservative" (what alpha weighs) and "actor", means over the predators.
class OmarLearner final : public OfflineLearner {
public:
  /// `data` must outlive it. Throws UsageError when the settings are not sound or the data have fewer transitions than
  /// a batch.
  OmarLearner(const DataSet& data, const OmarSettings& settings);
  ~OmarLearner() override;

  std::uint64_t steps() const override { return steps_; }
  std::vector<NamedLoss> step() override;
  void save(sct::RecordWriter& writer) const override;
  void load(sct::RecordReader& reader) override;
  std::string description() const override;
  std::string policy(const std::map<std::string, std::string>& notes) const override;

private:
  /// A network that learns: its parameters, those of its target, and Adam's moments.
  struct Network {
    std::vector<float> parameters;
    std::vector<float> target;
    sct::AdamWState<float> optimiser;
  };

  /// What changes from step to step. Only actors ever meet single observations, so only they remember batches; the
  /// targets' normalisations have parameters of their own, and the numbers of their own batches.
  struct Predator {
    Network actor;
    Network critic;
    std::vector<float> mean;
    std::vector<float> variance;
  };

  struct Work;  // what a predator's update needs besides

  static Network fresh(const NormalisedShape& shape, std::uint64_t seed, std::uint64_t first, double last = 0);
  void draw_batch(std::size_t agent);
  void update(std::size_t agent);
  void descend(Network& network, std::vector<float>& gradient) const;
  void require_fit(const sct::RecordReader& reader, const Predator& read) const;

  const DataSet& data_;
  OmarSettings settings_;
  NormalisedShape actor_shape_;
  NormalisedShape critic_shape_;
  std::vector<Predator> predators_;
  std::uint64_t steps_ = 0;
  std::vector<std::unique_ptr<Work>> work_;
  Workers workers_;
};

}  // namespace folk::mpe
