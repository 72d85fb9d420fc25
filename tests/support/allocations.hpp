// How often a piece of code asks for memory. Programs that link Bielle::test_allocations have malloc replaced by one
// that counts (glibc); Eigen and new allocate through it. Not for sanitizers, which replace malloc themselves.
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
