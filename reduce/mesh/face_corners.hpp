// The corners of a face of a solid cell.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bielle::reduce {

/// Corner nodes of a triangle or quadrilateral, round it.
class FaceCorners {
 public:
  FaceCorners() = default;
  FaceCorners(std::initializer_list<int> nodes) : FaceCorners(nodes.begin(), static_cast<int>(nodes.size())) {}
  /// @param nodes  of a face, corners first @param count  3 or 4
  template <class Nodes>
  FaceCorners(const Nodes& nodes, int count) : count_(static_cast<std::size_t>(count)) {
    for (int k = 0; k < count; ++k) nodes_[static_cast<std::size_t>(k)] = static_cast<int>(nodes[k]);
  }
  std::size_t size() const { return count_; }
  int operator[](std::size_t k) const { return nodes_[k]; }
  int& operator[](std::size_t k) { return nodes_[k]; }
  const int* begin() const { return nodes_.data(); }
  const int* end() const { return nodes_.data() + count_; }
  int* begin() { return nodes_.data(); }
  int* end() { return nodes_.data() + count_; }

 private:
  std::array<int, 4> nodes_{-1, -1, -1, -1};
  std::size_t count_ = 0;
};

/// Twice the area vector: of a quadrilateral, also a warped one, the product of its diagonals.
inline Eigen::Vector3d twice_area(const Eigen::Matrix3Xd& points, const FaceCorners& face) {
  const Eigen::Vector3d a = points.col(face[0]), b = points.col(face[1]), c = points.col(face[2]);
  if (face.size() == 3) return (b - a).cross(c - a);
  return (c - a).cross(points.col(face[3]) - b);
}

}  // namespace bielle::reduce
