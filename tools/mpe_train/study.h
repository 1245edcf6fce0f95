#pragma once
// mpe-train study: the paper's comparison of offline learners, from data to tables.

namespace folk::tools {

/// The whole program; argv[1] is its first argument.
int mpe_study(int argc, char** argv);

}  // namespace folk::tools
