// A part of a symmetric matrix and a few dense rows and columns appended, without a copy of the part.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "reduce/spectral/symmetric_matrix.hpp"

namespace bielle {

/// [A B; B^T C]: A is made of rows and columns of another matrix.
struct BorderedPart {
  const SymmetricMatrix& whole;
  std::span<const std::int64_t> kept;  ///< of it, ascending
  Eigen::MatrixXd border;              ///< B (kept, c)
  Eigen::MatrixXd corner;              ///< C (c, c), its lower triangle is read

  std::int64_t size() const { return static_cast<std::int64_t>(kept.size()) + corner.cols(); }
  std::vector<double> diagonal() const;
};

}  // namespace bielle
