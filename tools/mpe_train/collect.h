#pragma once
// mpe-train collect: plays episodes of the particle world and keeps them as a data set.

namespace folk::tools {

/// A whole program; argv[0] stands for its name.
int mpe_collect(int argc, char** argv);

}  // namespace folk::tools
