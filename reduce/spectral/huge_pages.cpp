#include "reduce/spectral/huge_pages.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace bielle {

void* allocate_in_huge_pages(std::size_t bytes) noexcept {
  constexpr std::size_t page = std::size_t{2} << 20;
  if (bytes < large_allocation) return std::malloc(bytes);
  void* memory = std::aligned_alloc(page, (bytes + page - 1) / page * page);
  if (memory != nullptr) madvise(memory, bytes, MADV_HUGEPAGE);  // no more than advice
  return memory;
}

ZeroNumbers::ZeroNumbers(std::size_t count) : ZeroNumbers() {
  constexpr std::size_t page = std::size_t{2} << 20;
  const std::size_t bytes = (sizeof(double) * std::max<std::size_t>(count, 1) + page - 1) / page * page;
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, bytes, MADV_HUGEPAGE);  // no more than advice
  numbers_ = std::unique_ptr<double, Unmapped>(static_cast<double*>(memory), Unmapped{bytes});
}

void ZeroNumbers::Unmapped::operator()(double* numbers) const { munmap(numbers, bytes); }

}  // namespace bielle
