#pragma once
// mpe-train offline: trains predators of the particle world from a data set alone.

namespace folk::tools {

/// The whole program; argv[1] is its first argument.
int mpe_offline(int argc, char** argv);

}  // namespace folk::tools
