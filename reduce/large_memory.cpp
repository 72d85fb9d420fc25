// Large arrays of the program come from pages of 2 MB, of which the system has fewer to find than of 4 kB. Smaller ones
// stay with malloc, which uses their memory again without having it cleared. The linker puts these functions in the
// place of malloc and operator new where our own code calls them (its option --wrap), and nowhere else: other libraries
// keep theirs. What comes from here is freed as usual.
#include <cstddef>
#include <new>

#include "reduce/spectral/huge_pages.hpp"

namespace {

/// Above this malloc asks the system each time, and gives back to it (M_MMAP_THRESHOLD grows no further) [bytes].
constexpr std::size_t never_kept = std::size_t{32} << 20;

}  // namespace

extern "C" {

void* __real_malloc(std::size_t bytes);
void* __real__Znwm(std::size_t bytes);

void* __wrap_malloc(std::size_t bytes) {
  return bytes < never_kept ? __real_malloc(bytes) : bielle::allocate_in_huge_pages(bytes);
}

void* __wrap__Znwm(std::size_t bytes) {
  if (bytes < never_kept) return __real__Znwm(bytes);
  void* memory = bielle::allocate_in_huge_pages(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}
