#include <folk/games/error.h>
#include <folk/sct/training/self_confirming_loss.h>

#include <cmath>

namespace folk::sct {
namespace {

/// What actions are compared with: classes, or probabilities of all classes where there are some.
template <class S>
struct Truth {
  const std::int32_t* classes;  // [rows, players]
  const S* probabilities;       // [rows, players, classes], or null
};

/// Sum over rows of weight * cross-entropy of `logits` (several players' side by side) and its gradient, times
/// `factor`.
template <class S>
double cross_entropy(const Matrix<S>& logits, std::size_t classes, const Truth<S>& truth, const S* weights,
                     double factor, Matrix<S>& d) {
  const Index size = index(classes);
  const Index players = logits.cols() / size;
  d.resize(logits.rows(), logits.cols());
  double sum = 0;
  for (Index r = 0; r < logits.rows(); ++r) {
    const double weight = factor * (weights != nullptr ? static_cast<double>(weights[r]) : 1.0);
    for (Index i = 0; i < players; ++i) {
      const auto row = logits.row(r).segment(i * size, size).array();
      auto d_row = d.row(r).segment(i * size, size).array();
      const S most = row.maxCoeff();
      d_row = (row - most).exp();
      const S total = d_row.sum();
      d_row *= static_cast<S>(weight) / total;
      const auto learn = [&](Index action, double probability) {
        sum += weight * probability * (std::log(static_cast<double>(total)) - static_cast<double>(row(action) - most));
        d_row(action) -= static_cast<S>(weight * probability);
      };
      const Index cell = r * players + i;
      if (truth.probabilities == nullptr)
        learn(truth.classes[cell], 1);
      else
        for (Index k = 0; k < size; ++k) learn(k, static_cast<double>(truth.probabilities[cell * size + k]));
    }
  }
  return sum;
}

/// factor * sum of weighted squared errors, and its gradient.
template <class S>
double squared_error(const Matrix<S>& out, const S* truth, const S* weights, double factor, Matrix<S>& d) {
  d = out - Eigen::Map<const Matrix<S>>(truth, out.rows(), out.cols());
  double sum = 0;
  for (Index r = 0; r < d.rows(); ++r) {
    const double weight = factor * (weights != nullptr ? static_cast<double>(weights[r]) : 1.0);
    sum += weight * static_cast<double>(d.row(r).squaredNorm());
    d.row(r) *= static_cast<S>(2 * weight);
  }
  return sum;
}

/// The loss of predicted actions, players side by side. `probabilities`: of the classes, or none.
template <class S>
double action_loss(const Architecture& architecture, const Matrix<S>& out, const Actions<S>& truth,
                   const std::vector<S>& probabilities, std::size_t first_round, const S* weights, double denominator,
                   Matrix<S>& d) {
  const auto players = static_cast<std::size_t>(out.cols()) / architecture.action_size;
  const double cells = denominator * static_cast<double>(players);
  if (architecture.discrete)
    return cross_entropy(
        out, architecture.action_size,
        Truth<S>{truth.classes.data() + first_round * players,
                 probabilities.empty() ? nullptr
                                       : probabilities.data() + first_round * static_cast<std::size_t>(out.cols())},
        weights, 1 / cells, d);
  return squared_error(out, truth.numbers.data() + first_round * static_cast<std::size_t>(out.cols()), weights,
                       1 / (cells * static_cast<double>(architecture.action_size)), d);
}

}  // namespace

Losses& Losses::operator+=(const Losses& other) {
  belief += other.belief;
  action += other.action;
  next_observation += other.next_observation;
  next_return += other.next_return;
  return *this;
}

template <class S>
Denominators<S>::Denominators(const Batch<S>& batch)
    : rounds(static_cast<double>(batch.rounds())),
      action_weight(rounds) {
  if (batch.action_weights.empty()) return;
  action_weight = 0;
  for (const S weight : batch.action_weights) action_weight += static_cast<double>(weight);
}

template <class S>
SelfConfirmingLoss<S>::SelfConfirmingLoss(const Network<S>& network, LossMode mode, bool read_everything)
    : network_(network),
      mode_(mode),
      first_(network.architecture(), network.layout(), {}),
      second_(network.architecture(), network.layout(), {}) {
  const auto& architecture = network.architecture();
  if (mode == LossMode::composite && architecture.discrete)
    throw UsageError("loss mode composite needs continuous actions: a class that was chosen has no gradient");
  std::vector<std::size_t> everything;
  for (std::size_t token = 1; token < architecture.round_tokens(); ++token) everything.push_back(token);
  const auto heads = [&](bool belief, bool action) {
    return Heads<S>(architecture, network.layout(),
                    read_everything ? everything : read_tokens(architecture, belief, action));
  };
  first_ = heads(mode != LossMode::action_only, !two_passes());
  second_ = heads(false, true);
}

template <class S>
const Matrix<S>& SelfConfirmingLoss<S>::hidden() const {
  return tapes_[two_passes() ? 1 : 0].hidden;
}

template <class S>
const std::vector<std::size_t>& SelfConfirmingLoss<S>::read() const {
  return two_passes() ? second_.read() : first_.read();
}

template <class S>
bool SelfConfirmingLoss<S>::untouched(const Tensor& tensor) const {
  const auto& architecture = network_.architecture();
  const bool opponent = tensor.name.starts_with("embed_opoact") && !architecture.belief_token;
  const bool belief = tensor.name.starts_with("predict_opoact") && mode_ == LossMode::action_only;
  return opponent || belief;
}

template <class S>
void SelfConfirmingLoss<S>::feed_beliefs(const Chunk<S>& chunk) {
  const auto& architecture = network_.architecture();
  fed_ = chunk.batch.opponent;  // the other chunks' rounds are not looked at
  for (std::size_t t = 0; t < chunk.rounds(); ++t) {
    const auto belief = predictions_.belief.row(index(t));
    const auto round = chunk.first_round + t;
    if (architecture.discrete) {
      Index likeliest = 0;
      belief.maxCoeff(&likeliest);
      fed_.classes[round] = static_cast<std::int32_t>(likeliest);
    } else {
      for (std::size_t k = 0; k < architecture.action_size; ++k)
        fed_.numbers[round * architecture.action_size + k] = belief[index(k)];
    }
  }
}

template <class S>
Losses SelfConfirmingLoss<S>::operator()(const S* parameters, const Chunk<S>& chunk,
                                         const Denominators<S>& denominators, const std::array<Dropout, 2>& dropouts,
                                         S* gradient) {
  const auto& architecture = network_.architecture();
  const auto& batch = chunk.batch;
  const bool believes = mode_ != LossMode::action_only;
  Losses losses;

  const Pass<S> first{batch.opponent, dropouts[0], first_.read()};
  network_.forward(parameters, chunk, first, tapes_[0]);
  if (believes) {
    first_.belief(parameters, tapes_[0].hidden, predictions_.belief);
    losses.belief = action_loss(architecture, predictions_.belief, batch.opponent, batch.belief_targets,
                                chunk.first_round, static_cast<const S*>(nullptr), denominators.rounds, d_belief_);
  }
  if (two_passes()) {
    feed_beliefs(chunk);
  }
  const Pass<S> second{two_passes() ? fed_ : batch.opponent, dropouts[1], second_.read()};
  if (two_passes()) network_.forward(parameters, chunk, second, tapes_[1]);
  const auto& acting = two_passes() ? second_ : first_;
  auto& tape = tapes_[two_passes() ? 1 : 0];
  acting.action(parameters, tape.hidden, predictions_.action);
  const S* weights = batch.action_weights.empty() ? nullptr : batch.action_weights.data() + chunk.first_round;
  losses.action = action_loss(architecture, predictions_.action, batch.policy_target(), {}, chunk.first_round, weights,
                              denominators.action_weight, d_action_);
  Predictions<S> d_auxiliary;
  if (architecture.auxiliary) {
    acting.auxiliary(parameters, tape.hidden, predictions_);
    const auto cells = architecture.agents * architecture.observation_size;
    losses.next_observation =
        squared_error(predictions_.next_observation, batch.next_observations.data() + chunk.first_round * cells,
                      static_cast<const S*>(nullptr), 1 / (denominators.rounds * static_cast<double>(cells)),
                      d_auxiliary.next_observation);
    losses.next_return =
        squared_error(predictions_.next_return, batch.next_returns.data() + chunk.first_round,
                      static_cast<const S*>(nullptr), 1 / denominators.rounds, d_auxiliary.next_return);
  }
  if (gradient == nullptr) return losses;

  auto& d_hidden = d_hidden_[two_passes() ? 1 : 0];
  d_hidden.setZero(tape.hidden.rows(), tape.hidden.cols());
  acting.action_backward(parameters, tape.hidden, predictions_.action, d_action_, d_hidden, gradient);
  if (architecture.auxiliary) acting.auxiliary_backward(parameters, tape.hidden, d_auxiliary, d_hidden, gradient);
  if (two_passes()) {
    network_.backward(parameters, chunk, second, tape, d_hidden, gradient,
                      mode_ == LossMode::composite ? &d_opponent_ : nullptr);
    if (mode_ == LossMode::composite) d_belief_ += d_opponent_;
    d_hidden_[0].setZero(tapes_[0].hidden.rows(), tapes_[0].hidden.cols());
  }
  if (believes)
    first_.belief_backward(parameters, tapes_[0].hidden, predictions_.belief, d_belief_, d_hidden_[0], gradient);
  network_.backward(parameters, chunk, first, tapes_[0], d_hidden_[0], gradient);
  return losses;
}

template struct Denominators<float>;
template struct Denominators<double>;
template class SelfConfirmingLoss<float>;
template class SelfConfirmingLoss<double>;

}  // namespace folk::sct
