#pragma once

#include <array>

namespace bielle {

/// The words of files and messages for translations along and rotations about the three axes.
inline constexpr std::array<const char*, 6> direction_words = {"x", "y", "z", "rx", "ry", "rz"};

}  // namespace bielle
