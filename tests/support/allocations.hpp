// Counts the allocations of a piece of code. Programs that link Bielle::test_allocations use a malloc that counts
// (glibc); Eigen and new allocate through it. It does not work with sanitizers, which replace malloc themselves.
#pragma once

namespace bielle::test {

/// Counts the calls of malloc while it lives.
class AllocationCount {
 public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;
  int calls() const;
};

}  // namespace bielle::test
