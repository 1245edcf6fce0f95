#include <folk/mpe/network/policy_network.h>
#include <folk/mpe/offline/action_vae.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace folk::mpe {
namespace {

constexpr Index latent = index(ActionVaeShape::latent);

/// Of the encoder's output, a log deviation and whether it was cut.
template <class S>
S log_deviation(const Matrix<S>& code, Index row, Index k) {
  return std::clamp(code(row, latent + k), static_cast<S>(least_log_deviation), static_cast<S>(largest_log_deviation));
}

/// Draws latent numbers by the encoder's output, behind the observations in the decoder's input.
template <class S>
void draw(const Matrix<S>& code, const Matrix<S>& normals, ActionVaeTape<S>& tape) {
  Matrix<S>& input = tape.decoder.input();
  const Index observed = input.cols() - latent;
  input.leftCols(observed) = tape.encoder.input().leftCols(observed);
  tape.deviations.resize(code.rows(), latent);
  for (Index r = 0; r < code.rows(); ++r)
    for (Index k = 0; k < latent; ++k) {
      tape.deviations(r, k) = std::exp(log_deviation(code, r, k));
      input(r, observed + k) = code(r, k) + tape.deviations(r, k) * normals(r, k);
    }
}

}  // namespace

ActionVaeShape::ActionVaeShape(std::size_t observed, std::size_t hidden)
    : encoder_(std::vector{observed + 2, hidden, hidden, 2 * latent}),
      decoder_(std::vector{observed + latent, hidden, hidden, std::size_t{2}}) {}

template <class S>
double action_vae_loss(const ActionVaeShape& shape, const S* parameters, const Matrix<S>& normals, std::size_t examples,
                       ActionVaeTape<S>& tape, S* gradient) {
  const S* decoder_parameters = parameters + shape.decoder_begin();
  forward(shape.encoder(), parameters, tape.encoder);
  const Matrix<S>& code = tape.encoder.output();
  const Index rows = code.rows();
  tape.decoder.prepare(shape.decoder(), static_cast<std::size_t>(rows));
  draw(code, normals, tape);
  forward(shape.decoder(), decoder_parameters, tape.decoder);
  squash(Squash::tanh, tape.decoder.output(), tape.reconstruction);

  const S error_scale = S(1) / static_cast<S>(2 * examples);
  const S divergence_scale = S(1) / (S(2) * static_cast<S>(ActionVaeShape::latent * examples));
  const auto actions = tape.encoder.input().rightCols(2);
  double errors = 0;
  tape.output_gradient.resize(rows, 2);
  for (Index r = 0; r < rows; ++r)
    for (Index c = 0; c < 2; ++c) {
      const S action = tape.reconstruction(r, c);
      const S error = action - actions(r, c);
      errors += static_cast<double>(error) * static_cast<double>(error);
      tape.output_gradient(r, c) = 2 * error_scale * error * (1 - action * action);
    }
  backward<S>(shape.decoder(), decoder_parameters, tape.decoder, tape.output_gradient, gradient + shape.decoder_begin(),
              &tape.latent_gradient, {index(shape.observed()), latent});

  double divergences = 0;
  tape.code_gradient.resize(rows, 2 * latent);
  for (Index r = 0; r < rows; ++r)
    for (Index k = 0; k < latent; ++k) {
      const S mean = code(r, k);
      const S log = log_deviation(code, r, k);
      const S deviation = tape.deviations(r, k);
      const S square = deviation * deviation;
      divergences -= 0.5 * static_cast<double>(1 + 2 * log - mean * mean - square);
      const S pull = tape.latent_gradient(r, k);
      tape.code_gradient(r, k) = pull + divergence_scale * mean;
      const bool cut = log != code(r, latent + k);
      tape.code_gradient(r, latent + k) =
          cut ? S(0) : pull * deviation * normals(r, k) + divergence_scale * (square - 1);
    }
  backward<S>(shape.encoder(), parameters, tape.encoder, tape.code_gradient, gradient, nullptr);
  return static_cast<double>(error_scale) * errors + static_cast<double>(divergence_scale) * divergences;
}

template double action_vae_loss(const ActionVaeShape&, const float*, const Matrix<float>&, std::size_t,
                                ActionVaeTape<float>&, float*);
template double action_vae_loss(const ActionVaeShape&, const double*, const Matrix<double>&, std::size_t,
                                ActionVaeTape<double>&, double*);

}  // namespace folk::mpe
