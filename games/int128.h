#pragma once
// Whole numbers of 128 bits, where 64 are too few and any size is more than is needed.

namespace folk {

__extension__ using Int128 = __int128;

}  // namespace folk
