#pragma once
// A network that chooses actions: observation -> perhaps a normalisation -> fully connected -> squashed to [-1, 1]^2.

#include <folk/mpe/network/mlp.h>

#include <optional>
#include <vector>

namespace folk::mpe {

/// How the last layer's numbers become actions.
enum class Squash {
  tanh,
  clamp  ///< cut to [-1, 1], as the published program does with its prey
};

/// Batch normalisation with its running numbers (Ioffe & Szegedy 2015), each of one number an input.
struct InputNormalisation {
  std::vector<float> weight;
  std::vector<float> bias;
  std::vector<float> mean;
  std::vector<float> variance;
  double epsilon = 1e-5;
};

struct PolicyNetwork {
  MlpShape shape;  ///< to two outputs
  std::vector<float> parameters;
  std::optional<InputNormalisation> normalisation;
  Squash squash = Squash::tanh;
};

/// A policy network made ready to act in float or double. Holds scratch space: one a thread.
template <class S>
class Actor {
public:
  explicit Actor(const PolicyNetwork& network);

  std::size_t inputs() const { return shape_.inputs(); }

  /// Where the observations of `rows` examples go, a row each.
  Matrix<S>& observations(std::size_t rows);

  /// Actions of the observations that were filled in [rows, 2]; `raw` before they are squashed.
  const Matrix<S>& act();
  const Matrix<S>& raw() const { return tape_.output(); }

private:
  MlpShape shape_;
  std::vector<S> parameters_;
  Squash squash_;
  bool normalises_;
  std::vector<S> weight_, bias_, mean_, deviation_;
  MlpTape<S> tape_;
  Matrix<S> actions_;
};

/// The squashed numbers of `raw`.
template <class S>
void squash(Squash how, const Matrix<S>& raw, Matrix<S>& actions);

}  // namespace folk::mpe
