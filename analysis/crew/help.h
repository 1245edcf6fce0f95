#pragma once
// The side of shared work that ranks other than 0 have.

#include <folk/analysis/crew/correspondence.h>
#include <folk/analysis/crew/crew.h>

namespace folk {

/// Does the pieces that rank 0 gives, and ends with all results of all ranks. Throws as Ranks::run does.
void help(Correspondence& letters, const SharedWork& work, const Progress& progress);

}  // namespace folk
