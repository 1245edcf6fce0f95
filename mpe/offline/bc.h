#pragma once
// Behaviour cloning (BC): a network that says what the predators did next after the last steps of what they observed.

#include <folk/analysis/play/workers.h>
#include <folk/mpe/data/data_set.h>
#include <folk/mpe/offline/bc_loss.h>
#include <folk/mpe/offline/offline_learner.h>
#include <folk/mpe/players/window_policy.h>
#include <folk/sct/training/adamw.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace folk::mpe {

/// Li et al. (arXiv 2310.04579) give context, hidden, layers, dropout, batch, rate and decay, for 15 epochs of 10,000
/// steps.
struct BcSettings {
  std::size_t context = 20;  ///< steps of a window
  std::size_t hidden = 128;
  /// One layer in, layers - 1 between hidden ones, and one out. The paper says 3; which they are is ours, after the
  /// cloning network in the code of the decision transformer (Chen et al. 2021), from which the paper's code descends.
  std::size_t layers = 3;
  double dropout = 0.1;  ///< of all hidden units
  std::size_t batch = 64;
  double learning_rate = 1e-4;
  double weight_decay = 1e-4;
  std::uint64_t warmup_steps = 10'000;  ///< ours, as the published transformer has it
  std::uint64_t decay_steps = 0;        ///< the rate falls along a half cosine to 0 at this step; 0: never
  double clip = 0.25;                   ///< largest norm of the gradient; ours, as the published transformer has it
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// Throws UsageError, naming the setting, unless all are in range.
void require_sound(const BcSettings& settings);

/// Its loss is "action", a mean square over the numbers of the predators' actions. A step's examples are windows of
/// which the episode and the last step are uniform; a window that begins before its episode has zeros there.
class BcLearner final : public OfflineLearner {
public:
  /// `data` must outlive it. Throws UsageError when the settings are not sound.
  BcLearner(const DataSet& data, const BcSettings& settings);

  std::uint64_t steps() const override { return optimiser_.steps; }
  std::vector<NamedLoss> step() override;
  void save(sct::RecordWriter& writer) const override;
  void load(sct::RecordReader& reader) override;
  std::string description() const override;
  std::string policy(const std::map<std::string, std::string>& notes) const override;

  const MlpShape& shape() const { return shape_; }
  const std::vector<float>& parameters() const { return parameters_; }

private:
  struct Ending {  // where a window ends
    std::size_t episode;
    std::size_t last;
  };
  struct Rows {  // [first, end) of the data
    std::size_t first;
    std::size_t end;
  };

  void draw_examples();
  Rows rows_of(const Ending& ending) const;
  void expect(const Ending& ending) const;
  void gather(Index row, const Ending& ending);
  void draw_dropout();

  const DataSet& data_;
  BcSettings settings_;
  ObservationScale scale_;
  MlpShape shape_;
  std::vector<float> parameters_;
  sct::AdamWState<float> optimiser_;
  BcExamples<float> examples_;
  BcTape<float> tape_;
  std::vector<float> gradient_;
  Workers workers_;
};

}  // namespace folk::mpe
