#include "base/large_vector.h"

#include <malloc.h>
#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace viewcell {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

std::size_t round_up(std::size_t n) {
  return (n + kHugePage - 1) / kHugePage * kHugePage;
}

}  // namespace

// Maps a page more than asked for, and gives back what is not between whole huge pages.
void* allocate_pages(std::size_t n_bytes) {
  if (n_bytes > SIZE_MAX / 2) throw std::bad_alloc();
  const std::size_t size = round_up(n_bytes);
  void* mapped =
      mmap(nullptr, size + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  char* const begin = static_cast<char*>(mapped);
  const std::size_t front =
      round_up(reinterpret_cast<std::uintptr_t>(begin)) - reinterpret_cast<std::uintptr_t>(begin);
  if (front > 0) munmap(begin, front);
  if (front < kHugePage) munmap(begin + front + size, kHugePage - front);
  madvise(begin + front, size, MADV_HUGEPAGE);  // a refusal costs time only
  return begin + front;
}

void free_pages(void* pages, std::size_t n_bytes) {
  munmap(pages, round_up(n_bytes));
}

void keep_freed_memory() {
  constexpr int kMost = 64 << 20;
  mallopt(M_MMAP_THRESHOLD, kMost);
  mallopt(M_TRIM_THRESHOLD, 2 * kMost);
}

}  // namespace viewcell
