#include "tests/support/allocations.hpp"

#include <cstdlib>

extern "C" void* __libc_malloc(std::size_t size);

namespace {
bool counting = false;
int count = 0;
}  // namespace

extern "C" void* malloc(std::size_t size) {
  if (counting) ++count;
  return __libc_malloc(size);
}

namespace bielle::test {

AllocationCount::AllocationCount() {
  count = 0;
  counting = true;
}

AllocationCount::~AllocationCount() { counting = false; }

int AllocationCount::calls() const { return count; }

}  // namespace bielle::test
