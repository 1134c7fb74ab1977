// Vectors for arrays that are visited at random: where they are large, they lie in huge pages of
// 2 MB, so that the processor's address cache (TLB) covers a hundred times as many bytes.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace viewcell {

/// Memory straight from the system, in huge pages where it has them (Linux: where
/// /sys/kernel/mm/transparent_hugepage/enabled is not "never"). Throws std::bad_alloc.
void* allocate_pages(std::size_t n_bytes);
void free_pages(void* pages, std::size_t n_bytes);

/// Memory that is freed stays with the process for what is allocated next, which then has no pages
/// to fault in (6 % of a build of 69,000 triangles); by default the C library (glibc) gives blocks
/// back. For tools that fill the same megabytes several times over, called once at their start.
void keep_freed_memory();

/// Allocates in pages of its own from kLeastBytes on, else as usual.
template <typename T>
struct LargeAllocator {
  using value_type = T;
  static constexpr std::size_t kLeastBytes = std::size_t{4} << 20;  // waste: below 2 MB, a half

  LargeAllocator() = default;
  template <typename U>
  LargeAllocator(const LargeAllocator<U>&) {}
  template <typename U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }

  T* allocate(std::size_t n) {
    if (n < kLeastBytes / sizeof(T)) return std::allocator<T>().allocate(n);
    return static_cast<T*>(allocate_pages(n * sizeof(T)));
  }
  void deallocate(T* at, std::size_t n) {
    if (n < kLeastBytes / sizeof(T)) return std::allocator<T>().deallocate(at, n);
    free_pages(at, n * sizeof(T));
  }
};

template <typename T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace viewcell
