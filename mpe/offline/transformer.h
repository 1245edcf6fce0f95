#pragma once
// The transformers of the paper as offline learners: MADT, RMADT and SCT (Li et al., arXiv 2310.04579).

#include <folk/mpe/data/data_set.h>
#include <folk/mpe/offline/offline_learner.h>
#include <folk/mpe/players/transformer_policy.h>
#include <folk/sct/network/network.h>
#include <folk/sct/training/adamw.h>
#include <folk/sct/training/batch_gradient.h>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace folk::mpe {

/// Defaults are the paper's SCT, trained as the published program does it.
struct TransformerSettings {
  sct::LossMode mode = sct::LossMode::teacher;
  sct::Readout readout = sct::Readout::cat;
  bool belief_token = true;
  std::size_t hidden = 128;
  std::size_t layers = 3;
  std::size_t heads = 1;
  std::size_t context = 20;
  std::size_t batch = 64;  ///< windows
  double dropout = 0.1;
  double return_scale = 100;
  sct::AdamWSettings optimiser{};
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// The action loss alone, no belief token in the stream: what is left of SCT without its beliefs.
TransformerSettings madt(TransformerSettings base = {});

/// Belief and action loss, but the action is read off the observation alone and cannot look at the belief.
TransformerSettings rmadt(TransformerSettings base = {});

class TransformerLearner final : public OfflineLearner {
public:
  /// `data` must outlive this. Throws UsageError, naming the setting, when one is out of range.
  TransformerLearner(const DataSet& data, const TransformerSettings& settings);

  std::uint64_t steps() const override { return optimiser_.steps; }
  /// "belief" (0 for MADT) and "action": mean squared errors of an action's number.
  std::vector<NamedLoss> step() override;
  void save(sct::RecordWriter& writer) const override;
  void load(sct::RecordReader& reader) override;
  std::string description() const override;
  std::string policy(const std::map<std::string, std::string>& notes) const override;

  /// The policy as it now stands; the return that it asks for is the data's mean.
  TransformerPolicy trained() const;

  const sct::Network<float>& network() const { return *network_; }

private:
  const DataSet& data_;
  TransformerSettings settings_;
  ObservationScale scale_;
  double mean_return_ = 0;
  std::unique_ptr<sct::Network<float>> network_;
  sct::BatchGradient<float> gradient_of_;
  std::vector<float> parameters_, gradient_;
  sct::AdamWState<float> optimiser_;
};

}  // namespace folk::mpe
