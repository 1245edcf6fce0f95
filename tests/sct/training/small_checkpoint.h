#pragma once
// A checkpoint with everything that one can hold, small enough to be written out.

#include <folk/sct/training/checkpoint.h>

namespace folk::test {

/// A copy of its file is tests/fuzz/corpus/checkpoint/small.
inline sct::Checkpoint small_checkpoint() {
  sct::Checkpoint checkpoint;
  checkpoint.run = "hidden = 8\nlearning-rate = 0.001\n";
  auto& training = checkpoint.training;
  training.parameters = {0.5F, -1.25F, 3.0F};
  training.average = {0.25F, -1.0F, 2.0F};
  training.optimiser = {{0.125F, 0.0F, -0.0F}, {1e-30F, 2.0F, 1e30F}, 25};
  checkpoint.losses = {1.5, 2.5, 5};
  checkpoint.added = {{{0, 1, 4}, {0, 1, 1}, {0, 1, 0}, {1, 1, 0}, {1.0F, 0.0F, 5.0F}, {300.0F, 297.0F, 296.0F}},
                      {{0}, {1}, {1}, {0}, {2.0F}, {1.0F}}};
  checkpoint.history = {{10, 0.75, 0.5, {{260, 4700.25, 0.875}, {280, 4800, std::nullopt}}},
                        {20, 0.625, 0.25, {{260, 4750, 0.0}, {280, 4650.5, 1.0}}}};
  checkpoint.kept = 0;
  checkpoint.kept_parameters = {1.0F, 2.0F, 4.0F};
  return checkpoint;
}

}  // namespace folk::test
