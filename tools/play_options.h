#pragma once
// The options that say how policies play: --sample and --extrapolate.

#include "program.h"

#include <folk/sct/sct_player.h>

namespace folk::tools {

/// Adds --sample and --extrapolate.
void add_play_options(po::options_description& options);

sct::PlayOptions chosen_play_options(const po::variables_map& values);

}  // namespace folk::tools
