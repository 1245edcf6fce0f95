#pragma once
// mpe-train curve: draws how training runs went, several in one picture.

namespace folk::tools {

/// The whole program; argv[1] is its first argument.
int mpe_curve(int argc, char** argv);

}  // namespace folk::tools
