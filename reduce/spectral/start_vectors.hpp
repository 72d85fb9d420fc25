// Start vectors of a search for eigenvectors: random, but the same in every run and on every machine.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace bielle {

/// An endless sequence of vectors with entries in (-1, 1): a linear congruential generator with the constants of
/// Knuth's MMIX.
class StartVectors {
 public:
  explicit StartVectors(Eigen::Index size) : size_(size) {}

  /// Returns the next vectors as columns.
  Eigen::MatrixXd draw(Eigen::Index count);

 private:
  Eigen::Index size_;
  std::uint64_t state_ = 0x9E3779B97F4A7C15ULL;
};

}  // namespace bielle
