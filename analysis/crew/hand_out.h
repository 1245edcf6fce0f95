#pragma once
// Rank 0's side of shared work.

#include <folk/analysis/crew/correspondence.h>
#include <folk/analysis/crew/crew.h>

namespace folk {

/// Gives pieces to each rank as it becomes free, its own threads among them, keeps what is finished in `store` (or
/// null), and tells all ranks all results in the end. Throws as Ranks::run does, after telling the others.
void hand_out(Correspondence& letters, const SharedWork& work, PieceStore* store, const Progress& progress);

}  // namespace folk
