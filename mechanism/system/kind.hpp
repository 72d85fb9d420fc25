// Kinds of unknowns and equations, which determine scales and tolerances.
#pragma once

#include <array>
#include <cstddef>

namespace bielle::mechanism {

enum class Kind : unsigned char { translation, rotation, amplitude, first_order, multiplier };
inline constexpr std::size_t kind_count = 5;

/// Largest absolute contribution of any component to the equations of each kind: the reference for the size of a
/// residual.
struct ResidualScale {
  std::array<double, kind_count> largest{};
  double& operator[](Kind kind) { return largest[static_cast<std::size_t>(kind)]; }
  double operator[](Kind kind) const { return largest[static_cast<std::size_t>(kind)]; }
};

}  // namespace bielle::mechanism
