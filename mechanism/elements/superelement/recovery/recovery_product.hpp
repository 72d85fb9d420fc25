// Products of a recovery matrix with the local coordinates of several instants ("frames") at once.
//
// One frame reads the whole matrix for two operations per number: memory decides, at some 50 MB for 24,000 nodes. So
// frames are collected, and a piece of the matrix that fits into the cache serves all of them, eight frames side by
// side.
#pragma once

#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

using RecoveryMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Frames side by side in a product.
inline constexpr int frames_abreast = 8;

/// Local coordinates of some frames, interleaved by eights; what is missing in the last eight is zero.
class FrameBlock {
 public:
  /// Makes room; allocates only when there was less. @param coordinates  of a frame
  void reset(Eigen::Index coordinates, int frames);
  void set(int frame, const double* q);
  int frames() const { return frames_; }
  int groups() const { return (frames_ + frames_abreast - 1) / frames_abreast; }
  /// Of eight frames: (coordinates, frames_abreast).
  const double* group(int g) const { return values_.data() + begin_ + g * frames_abreast * coordinates_; }

 private:
  std::vector<double> values_;
  Eigen::Index begin_ = 0;  ///< where a line of the processor's cache begins: loads that cross two take twice as long
  Eigen::Index coordinates_ = 0;
  int frames_ = 0;
};

/// values[frames_abreast * r + f] = row `begin + r` of the matrix times the coordinates of frame f. Sums run over the
/// coordinates in their order, so that a frame's numbers are the same to the bit whichever frames stand next to it,
/// however the rows are divided, and with any number of threads.
/// @param count  of rows, a multiple of 3
void multiply_rows(const RecoveryMatrix& matrix, Eigen::Index begin, Eigen::Index count, const double* group,
                   double* values);

/// Threads for so many products: one where starting others takes longer.
int recovery_threads(Eigen::Index rows, Eigen::Index coordinates, int frames);

}  // namespace bielle::mechanism
