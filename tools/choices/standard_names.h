#pragma once
// The names that every program knows.

#include <folk/sct/policy/sct_player.h>
#include <folk/strategies/registry.h>

namespace folk::tools {

/// Registry::standard() and the strategies of the folders above it: bayes(SPEC), sct, sct-bayes, sct:FILE. `options`
/// says how policies play.
Registry standard_names(const sct::PlayOptions& options = {});

}  // namespace folk::tools
