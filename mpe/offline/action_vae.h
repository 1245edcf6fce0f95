#pragma once
// A conditional variational autoencoder of actions (Kingma & Welling 2014; Sohn, Lee & Yan 2015), in the form that
// batch-constrained Q-learning gives it (Fujimoto, Meger & Precup 2019): what would the data do here?

#include <folk/mpe/network/mlp.h>

#include <cstddef>

namespace folk::mpe {

/// Its two networks, which lie one after the other in a flat buffer: the encoder (observation, action) -> H -> H ->
/// (mean, log deviation) of the latent numbers, then the decoder (observation, latent) -> H -> H -> action before tanh.
class ActionVaeShape {
public:
  /// Two latent numbers for each of an action's two.
  static constexpr std::size_t latent = 4;

  ActionVaeShape(std::size_t observed, std::size_t hidden);

  std::size_t observed() const { return decoder_.inputs() - latent; }
  const MlpShape& encoder() const { return encoder_; }
  const MlpShape& decoder() const { return decoder_; }
  std::size_t decoder_begin() const { return encoder_.parameters(); }
  std::size_t parameters() const { return encoder_.parameters() + decoder_.parameters(); }

private:
  MlpShape encoder_;
  MlpShape decoder_;
};

/// What log deviations are cut to.
inline constexpr double least_log_deviation = -4;
inline constexpr double largest_log_deviation = 15;

/// Scratch of the loss.
template <class S>
struct ActionVaeTape {
  MlpTape<S> encoder;  ///< its input [rows, observed + 2] is to be filled in
  MlpTape<S> decoder;
  Matrix<S> deviations;       ///< [rows, latent], as the other two
  Matrix<S> reconstruction;   ///< actions [rows, 2]
  Matrix<S> output_gradient;  ///< of the decoder
  Matrix<S> latent_gradient;
  Matrix<S> code_gradient;  ///< of the encoder's output [rows, 2 latent]
};

/// The share in the loss of a batch of `examples` rows that the rows of tape.encoder.input() have: the mean square
/// error of the actions' two numbers, plus half the mean over the latent numbers of their divergence from the standard
/// normal, -(1 + log s^2 - m^2 - s^2) / 2. `normals` [rows, latent]: the latent numbers are m + s * normals. The
/// gradient is added to `gradient`; a log deviation that was cut has none.
template <class S>
double action_vae_loss(const ActionVaeShape& shape, const S* parameters, const Matrix<S>& normals, std::size_t examples,
                       ActionVaeTape<S>& tape, S* gradient);

}  // namespace folk::mpe
