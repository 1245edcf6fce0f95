#pragma once
// mpe-train online: trains agents of the particle world while they play.

namespace folk::tools {

/// The whole program; argv[1] is its first argument.
int mpe_online(int argc, char** argv);

}  // namespace folk::tools
