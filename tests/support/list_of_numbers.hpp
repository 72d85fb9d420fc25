// Vectors as text of mechanism files.
#pragma once

#include <string>

#include <fmt/format.h>

#include "mechanism/math/types.hpp"

namespace bielle::test {

/// "[x, y, z]", exactly.
inline std::string list(const mechanism::Vector3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

}  // namespace bielle::test
