#include "reduce/spectral/huge_pages.hpp"

#include <cstdlib>

#include <sys/mman.h>

namespace bielle {

void* allocate_in_huge_pages(std::size_t bytes) noexcept {
  constexpr std::size_t page = std::size_t{2} << 20;
  if (bytes < large_allocation) return std::malloc(bytes);
  void* memory = std::aligned_alloc(page, (bytes + page - 1) / page * page);
  if (memory != nullptr) madvise(memory, bytes, MADV_HUGEPAGE);  // no more than advice
  return memory;
}

}  // namespace bielle
