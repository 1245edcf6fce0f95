#pragma once
// The options that say how policies play: --sample and --extrapolate.

#include <folk/tools/program/program.h>

#include <folk/sct/policy/sct_player.h>

namespace folk::tools {

/// Adds --sample and --extrapolate.
void add_play_options(po::options_description& options);

sct::PlayOptions chosen_play_options(const po::variables_map& values);

}  // namespace folk::tools
