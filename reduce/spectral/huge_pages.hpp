// Memory for arrays that are read from end to end, again and again.
#pragma once

#include <cstddef>
#include <memory>

namespace bielle {

/// What is at least as large comes from pages of 2 MB [bytes].
inline constexpr std::size_t large_allocation = std::size_t{4} << 20;

/// Like malloc, but what is large comes from pages of 2 MB; std::free gives it back.
void* allocate_in_huge_pages(std::size_t bytes) noexcept;

/// So many numbers, all zero, from pages of 2 MB: the system clears them where they are first written to.
class ZeroNumbers {
 public:
  ZeroNumbers() : numbers_(nullptr, Unmapped{0}) {}
  /// @throws std::bad_alloc
  explicit ZeroNumbers(std::size_t count);
  double* get() const { return numbers_.get(); }

 private:
  struct Unmapped {
    std::size_t bytes;
    void operator()(double* numbers) const;
  };
  std::unique_ptr<double, Unmapped> numbers_;
};

}  // namespace bielle
