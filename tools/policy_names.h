#pragma once
// The names of trained policies: sct, sct-bayes and sct:FILE.

#include <folk/sct/sct_player.h>
#include <folk/strategies/registry.h>

namespace folk::tools {

/// Adds the two shipped policies and the prefix for any other. The file is read when the name is made to a strategy;
/// that throws InputFileError. Shipped ones lie in policies/ of the folder that the environment's FOLK_DATA names, else
/// of the installation's or the source tree's data.
void add_policies(Registry& registry, const sct::PlayOptions& options);

}  // namespace folk::tools
