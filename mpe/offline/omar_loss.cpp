#include <folk/mpe/offline/omar_loss.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace folk::mpe {
namespace {

/// Rows (o, a): each observation with as many actions as there are for it.
template <class S>
void join(const Matrix<S>& observations, const Matrix<S>& actions, Matrix<S>& joined) {
  const Index inputs = observations.cols();
  const Index each = actions.rows() / observations.rows();
  joined.resize(actions.rows(), inputs + 2);
  for (Index r = 0; r < actions.rows(); ++r) {
    S* row = joined.data() + r * joined.cols();
    std::copy_n(observations.data() + (r / each) * inputs, inputs, row);
    row[inputs] = actions(r, 0);
    row[inputs + 1] = actions(r, 1);
  }
}

/// pi(o) of an actor.
template <class S>
void choose(const NormalisedShape& actor, const S* parameters, const Matrix<S>& observations, NormalisedTape<S>& tape,
            Matrix<S>& actions) {
  tape.input = observations;
  forward(actor, parameters, tape, 1);
  squash(Squash::tanh, tape.output(0), actions);
}

/// The conservative part of one critic from the values of uniform actions: the mean of their logarithmic sums, and its
/// gradient times `weight`.
template <class S>
double held_down(const Matrix<S>& values, Index rows, double weight, Matrix<S>& gradient) {
  const Index each = values.rows() / rows;
  const S share = static_cast<S>(weight / static_cast<double>(rows));
  gradient.resize(values.rows(), 1);
  double sum = 0;
  for (Index r = 0; r < rows; ++r) {
    const std::span row(values.data() + r * each, static_cast<std::size_t>(each));
    const S total = log_sum_exp<S>(row);
    sum += static_cast<double>(total) + std::log(4.0);
    for (Index k = 0; k < each; ++k)
      gradient(r * each + k, 0) = share * std::exp(row[static_cast<std::size_t>(k)] - total);
  }
  return sum / static_cast<double>(rows);
}

/// Where a search stands at one observation.
template <class S>
struct Aim {
  std::array<S, 2> mean{};
  std::array<S, 2> deviation{};

  /// Moves it to what the samples [n, 2] of these values say.
  void follow(std::span<const S> samples, std::span<const S> values) {
    const S most = *std::max_element(values.begin(), values.end());
    const S count = static_cast<S>(values.size());
    S weights = 0;
    std::array<S, 2> sums{};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const S weight = std::exp(values[k] - most);
      weights += weight;
      for (std::size_t axis = 0; axis < 2; ++axis) sums[axis] += weight * samples[2 * k + axis];
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      mean[axis] = sums[axis] / weights;
      S squares = 0;
      for (std::size_t k = 0; k < values.size(); ++k) {
        const S distance = samples[2 * k + axis] - mean[axis];
        squares += distance * distance;
      }
      deviation[axis] = std::sqrt(squares / count);
    }
  }
};

}  // namespace

template <class S>
void draw_uniform_actions(RandomStream& random, std::size_t rows, Matrix<S>& actions) {
  actions.resize(index(rows), 2);
  for (Index i = 0; i < actions.size(); ++i) actions.data()[i] = static_cast<S>(uniform(random, -1, 1));
}

template <class S>
S log_sum_exp(std::span<const S> values) {
  const S most = *std::max_element(values.begin(), values.end());
  S sum = 0;
  for (const S value : values) sum += std::exp(value - most);
  return most + std::log(sum);
}

template <class S>
void critic_targets(const NormalisedShape& actor, const S* target_actor, const NormalisedShape& critic,
                    const S* target_critic, const Transitions<S>& batch, double discount, OmarScratch<S>& scratch,
                    Matrix<S>& targets) {
  choose(actor, target_actor, batch.next_observations, scratch.actor, scratch.actions);
  join(batch.next_observations, scratch.actions, scratch.critic.input);
  forward(critic, target_critic, scratch.critic, 2);
  const auto smaller = scratch.critic.output(0).array().min(scratch.critic.output(1).array());
  targets = batch.rewards.array() + static_cast<S>(discount) * (S(1) - batch.dones.array()) * smaller;
}

template <class S>
CriticLoss critic_loss(const NormalisedShape& critic, const S* parameters, const Transitions<S>& batch,
                       const Matrix<S>& targets, const Matrix<S>& uniform, double conservatism, OmarScratch<S>& scratch,
                       S* gradient) {
  const Index rows = targets.rows();
  const double count = static_cast<double>(rows);
  CriticLoss loss;
  join(batch.observations, batch.actions, scratch.critic.input);
  forward(critic, parameters, scratch.critic, 2);
  join(batch.observations, uniform, scratch.wide_critic.input);
  forward(critic, parameters, scratch.wide_critic, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const Matrix<S>& values = scratch.critic.output(k);
    loss.conservative += held_down(scratch.wide_critic.output(k), rows, conservatism, scratch.wide_gradients[k]);
    Matrix<S>& up = scratch.gradients[k];
    up.resize(rows, 1);
    for (Index r = 0; r < rows; ++r) {
      const double error = static_cast<double>(values(r, 0) - targets(r, 0));
      loss.error += error * error / count;
      loss.conservative -= static_cast<double>(values(r, 0)) / count;
      up(r, 0) = static_cast<S>((2 * error - conservatism) / count);
    }
  }
  backward<S>(critic, parameters, scratch.critic, scratch.gradients, gradient);
  backward<S>(critic, parameters, scratch.wide_critic, scratch.wide_gradients, gradient);
  return loss;
}

template <class S>
void act(const NormalisedShape& actor, const S* actor_parameters, const NormalisedShape& critic,
         const S* critic_parameters, const Matrix<S>& observations, OmarScratch<S>& scratch) {
  choose(actor, actor_parameters, observations, scratch.actor, scratch.actions);
  join(observations, scratch.actions, scratch.critic.input);
  forward(critic, critic_parameters, scratch.critic, 1);
}

template <class S>
ActionValues<S> first_critic(const NormalisedShape& critic, const S* parameters, const Matrix<S>& observations,
                             OmarScratch<S>& scratch) {
  return [&critic, parameters, &observations, &scratch](const Matrix<S>& actions) -> const Matrix<S>& {
    join(observations, actions, scratch.wide_critic.input);
    forward(critic, parameters, scratch.wide_critic, 1);
    return scratch.wide_critic.output(0);
  };
}

template <class S>
void search_actions(const ActionValues<S>& values, const Matrix<S>& own_actions, const Matrix<S>& own_values,
                    RandomStream& random, Matrix<S>& best) {
  const auto rows = static_cast<std::size_t>(own_actions.rows());
  const S deviation = static_cast<S>(search_deviation);
  std::vector<Aim<S>> aims(rows, Aim<S>{{}, {deviation, deviation}});
  Matrix<S> samples(index(rows * search_samples), 2);
  best = own_actions;
  for (std::size_t round = 0; round < search_rounds; ++round) {
    S* next = samples.data();
    for (const auto& aim : aims)
      for (std::size_t k = 0; k < search_samples; ++k)
        for (std::size_t axis = 0; axis < 2; ++axis)
          *next++ = std::clamp(aim.mean[axis] + aim.deviation[axis] * static_cast<S>(random.normal()), S(-1), S(1));
    const Matrix<S>& found = values(samples);
    for (std::size_t r = 0; r < rows; ++r) {
      const std::span<const S> there(found.data() + r * search_samples, search_samples);
      const std::span<const S> those(samples.data() + 2 * r * search_samples, 2 * search_samples);
      if (round + 1 < search_rounds) {
        aims[r].follow(those, there);
        continue;
      }
      const auto top = std::max_element(there.begin(), there.end());
      if (!(*top > own_values(index(r), 0))) continue;
      const auto k = static_cast<std::size_t>(top - there.begin());
      best(index(r), 0) = those[2 * k];
      best(index(r), 1) = those[2 * k + 1];
    }
  }
}

template <class S>
double actor_loss(const NormalisedShape& actor, const S* actor_parameters, const NormalisedShape& critic,
                  const S* critic_parameters, const Matrix<S>& best, double imitation, OmarScratch<S>& scratch,
                  S* gradient) {
  const Matrix<S>& actions = scratch.actions;
  const double rows = static_cast<double>(actions.rows());
  const double each = 1 / (2 * rows);
  Matrix<S>& up = scratch.gradients[0];
  up.setConstant(actions.rows(), 1, static_cast<S>((imitation - 1) / rows));
  const Index inputs = index(actor.inputs());
  input_backward(critic, critic_parameters, scratch.critic, up, {inputs, 2}, scratch.action_gradient);
  double loss = 0;
  for (Index r = 0; r < actions.rows(); ++r) {
    loss -= (1 - imitation) * static_cast<double>(scratch.critic.output(0)(r, 0)) / rows;
    for (Index axis = 0; axis < 2; ++axis) {
      const double action = static_cast<double>(actions(r, axis));
      double slope = static_cast<double>(scratch.action_gradient(r, axis)) + 2 * action_penalty * action * each;
      loss += action_penalty * action * action * each;
      if (imitation > 0) {
        const double distance = action - static_cast<double>(best(r, axis));
        loss += imitation * distance * distance * each;
        slope += 2 * imitation * distance * each;
      }
      scratch.action_gradient(r, axis) = static_cast<S>(slope * (1 - action * action));
    }
  }
  backward<S>(actor, actor_parameters, scratch.actor, std::span(&scratch.action_gradient, 1), gradient);
  return loss;
}

template void draw_uniform_actions(RandomStream&, std::size_t, Matrix<float>&);
template float log_sum_exp(std::span<const float>);
template void critic_targets(const NormalisedShape&, const float*, const NormalisedShape&, const float*,
                             const Transitions<float>&, double, OmarScratch<float>&, Matrix<float>&);
template CriticLoss critic_loss(const NormalisedShape&, const float*, const Transitions<float>&, const Matrix<float>&,
                                const Matrix<float>&, double, OmarScratch<float>&, float*);
template void act(const NormalisedShape&, const float*, const NormalisedShape&, const float*, const Matrix<float>&,
                  OmarScratch<float>&);
template ActionValues<float> first_critic(const NormalisedShape&, const float*, const Matrix<float>&,
                                          OmarScratch<float>&);
template void search_actions(const ActionValues<float>&, const Matrix<float>&, const Matrix<float>&, RandomStream&,
                             Matrix<float>&);
template double actor_loss(const NormalisedShape&, const float*, const NormalisedShape&, const float*,
                           const Matrix<float>&, double, OmarScratch<float>&, float*);
template void draw_uniform_actions(RandomStream&, std::size_t, Matrix<double>&);
template double log_sum_exp(std::span<const double>);
template void critic_targets(const NormalisedShape&, const double*, const NormalisedShape&, const double*,
                             const Transitions<double>&, double, OmarScratch<double>&, Matrix<double>&);
template CriticLoss critic_loss(const NormalisedShape&, const double*, const Transitions<double>&,
                                const Matrix<double>&, const Matrix<double>&, double, OmarScratch<double>&, double*);
template void act(const NormalisedShape&, const double*, const NormalisedShape&, const double*, const Matrix<double>&,
                  OmarScratch<double>&);
template ActionValues<double> first_critic(const NormalisedShape&, const double*, const Matrix<double>&,
                                           OmarScratch<double>&);
template void search_actions(const ActionValues<double>&, const Matrix<double>&, const Matrix<double>&, RandomStream&,
                             Matrix<double>&);
template double actor_loss(const NormalisedShape&, const double*, const NormalisedShape&, const double*,
                           const Matrix<double>&, double, OmarScratch<double>&, double*);

}  // namespace folk::mpe
