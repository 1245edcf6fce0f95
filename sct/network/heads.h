#pragma once
// What is read off the hidden states: beliefs, actions and, where wanted, the next observation and return.

#include <folk/sct/network/matrix.h>

#include <optional>
#include <vector>

namespace folk::sct {

/// Logits where actions are discrete, numbers in (-1, 1) where they are continuous; one row a round.
template <class S>
struct Predictions {
  Matrix<S> belief;            ///< [rounds, action_size]
  Matrix<S> action;            ///< [rounds, agents * action_size]
  Matrix<S> next_observation;  ///< [rounds, agents * observation_size], with auxiliary heads
  Matrix<S> next_return;       ///< [rounds, 1], with auxiliary heads
};

/// The heads, on the hidden states of some tokens of each round.
template <class S>
class Heads {
public:
  /// `read`: which tokens of a round the hidden states are of, ascending. Beliefs need all observations.
  Heads(const Architecture& architecture, const ParameterLayout& layout, std::vector<std::size_t> read);

  const std::vector<std::size_t>& read() const { return read_; }

  /// [rounds, action_size]
  void belief(const S* parameters, const Matrix<S>& hidden, Matrix<S>& out) const;
  /// [rounds, agents * action_size]
  void action(const S* parameters, const Matrix<S>& hidden, Matrix<S>& out) const;
  /// The auxiliary heads; Predictions::next_observation and next_return.
  void auxiliary(const S* parameters, const Matrix<S>& hidden, Predictions<S>& out) const;

  /// Each adds to d_hidden (of the size of the hidden states) and to the gradient. `out` is what the head said, d_out
  /// the gradient of the loss by it; both as above.
  void belief_backward(const S* parameters, const Matrix<S>& hidden, const Matrix<S>& out, const Matrix<S>& d_out,
                       Matrix<S>& d_hidden, S* gradient) const;
  void action_backward(const S* parameters, const Matrix<S>& hidden, const Matrix<S>& out, const Matrix<S>& d_out,
                       Matrix<S>& d_hidden, S* gradient) const;
  void auxiliary_backward(const S* parameters, const Matrix<S>& hidden, const Predictions<S>& d_out,
                          Matrix<S>& d_hidden, S* gradient) const;

private:
  struct Linear {
    Tensor weight, bias;
  };

  Index column(std::size_t token) const;
  Matrix<S> source(const S* parameters, const Matrix<S>& hidden, std::size_t agent) const;
  void squash(Matrix<S>& out) const;
  Matrix<S> unsquashed(const Matrix<S>& out, const Matrix<S>& d_out) const;

  Architecture architecture_;
  std::vector<std::size_t> read_;
  Linear belief_;
  std::vector<Linear> action_;  // one an agent
  Linear mix_;                  // of the readout `cat`
  Linear next_observation_, next_return_;
};

/// The tokens that a loss needs: observations for beliefs, what the readout reads for actions, actions for the
/// auxiliary heads.
std::vector<std::size_t> read_tokens(const Architecture& architecture, bool belief, bool action);

}  // namespace folk::sct
