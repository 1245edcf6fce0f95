#pragma once
// mpe-train inspect: reads a data set of the particle world, checks it and says what it is.

namespace folk::tools {

/// A whole program; argv[0] stands for its name.
int mpe_inspect(int argc, char** argv);

}  // namespace folk::tools
