// Products of a recovery matrix with the local coordinates of several instants ("frames") at once.
//
// The product for one frame reads the whole matrix, some 50 MB for 24,000 nodes, and performs two operations per
// number, so that memory bandwidth limits its speed. Therefore frames are collected, and a part of the matrix that fits
// into the cache is used for all of them, eight frames at a time.
#pragma once

#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

using RecoveryMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Number of frames computed together in a product.
inline constexpr int frames_abreast = 8;

/// Local coordinates of some frames, interleaved by eights; missing frames in the last eight are zero.
class FrameBlock {
 public:
  /// Resizes the block; allocates memory only if it grows. @param coordinates  number for each frame
  void reset(Eigen::Index coordinates, int frames);
  void set(int frame, const double* q);
  int frames() const { return frames_; }
  int groups() const { return (frames_ + frames_abreast - 1) / frames_abreast; }
  /// Coordinates of one frame.
  Eigen::Map<const VectorX, 0, Eigen::InnerStride<frames_abreast>> of(int frame) const {
    return {group(frame / frames_abreast) + frame % frames_abreast, coordinates_};
  }
  /// Coordinates of eight frames: (coordinates, frames_abreast).
  const double* group(int g) const { return values_.data() + begin_ + g * frames_abreast * coordinates_; }

 private:
  std::vector<double> values_;
  /// Index of the first value that begins a cache line: loads across two lines take twice as long.
  Eigen::Index begin_ = 0;
  Eigen::Index coordinates_ = 0;
  int frames_ = 0;
};

/// Computes values[frames_abreast * r + f] = row `begin + r` of the matrix times the coordinates of frame f. Sums are
/// over the coordinates in their order, so that a frame's numbers are identical bit by bit for any neighbouring frames,
/// any division of the rows, and any number of threads.
/// @param count  number of rows, a multiple of 3
void multiply_rows(const RecoveryMatrix& matrix, Eigen::Index begin, Eigen::Index count, const double* group,
                   double* values);

/// Returns the number of threads for a product of this size; one if starting more threads takes longer than they save.
int recovery_threads(Eigen::Index rows, Eigen::Index coordinates, int frames);

}  // namespace bielle::mechanism
