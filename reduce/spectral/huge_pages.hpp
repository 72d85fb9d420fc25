// Memory for arrays that are read from end to end, again and again.
#pragma once

#include <cstddef>

namespace bielle {

/// What is at least as large comes from pages of 2 MB [bytes].
inline constexpr std::size_t large_allocation = std::size_t{4} << 20;

/// Like malloc, but what is large comes from pages of 2 MB; std::free gives it back.
void* allocate_in_huge_pages(std::size_t bytes) noexcept;

}  // namespace bielle
