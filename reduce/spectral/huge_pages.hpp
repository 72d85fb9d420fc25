// Memory for arrays that are read from end to end, again and again.
#pragma once

#include <cstddef>

namespace bielle {

/// Like malloc, but what is large comes from pages of 2 MB; std::free gives it back.
void* allocate_in_huge_pages(std::size_t bytes) noexcept;

}  // namespace bielle
