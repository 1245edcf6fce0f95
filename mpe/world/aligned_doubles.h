#pragma once
// Numbers at a 64-byte boundary, in the library and in programs that use it alike: Eigen's allocator goes by the vector
// instructions that each was compiled for, and one would free what the other has allocated in another way.

#include <cstddef>
#include <new>
#include <vector>

namespace folk::mpe {

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, alignment); }

  bool operator==(const CacheLineAllocator&) const = default;
};

using AlignedDoubles = std::vector<double, CacheLineAllocator<double>>;

}  // namespace folk::mpe
