// Corners of the faces of solid cells and of surface cells, and their plane triangles.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "reduce/mesh/cell_type.hpp"

namespace bielle::reduce {

/// Corner nodes of a triangle or a quadrilateral, in the order round it.
class Corners {
 public:
  Corners() = default;
  Corners(std::initializer_list<int> nodes) : count_(static_cast<int>(nodes.size())) {
    if (count_ > 4) throw std::logic_error("a face with more than four corners");
    std::copy(nodes.begin(), nodes.end(), nodes_.begin());
  }

  int size() const { return count_; }  ///< 3 or 4
  int operator[](int k) const { return nodes_[k]; }
  const int* begin() const { return nodes_.data(); }
  const int* end() const { return nodes_.data() + count_; }
  int* begin() { return nodes_.data(); }
  int* end() { return nodes_.data() + count_; }
  bool contains(int node) const { return std::find(begin(), end(), node) != end(); }
  void push_back(int node) { nodes_.at(count_++) = node; }
  bool operator==(const Corners&) const = default;

  /// Returns the same nodes in ascending order; -1 stands behind three.
  std::array<int, 4> key() const {
    std::array<int, 4> sorted = nodes_;
    for (int k = 1; k < count_; ++k)
      for (int j = k; j > 0 && sorted[j] < sorted[j - 1]; --j) std::swap(sorted[j], sorted[j - 1]);
    return sorted;
  }

 private:
  std::array<int, 4> nodes_{-1, -1, -1, -1};
  int count_ = 0;
};

/// Corners of a surface cell. @param nodes  its nodes in gmsh's order
template <class Nodes>
Corners corners_of(CellType type, const Nodes& nodes) {
  Corners corners;
  for (int k = 0; k < vertex_count(type); ++k) corners.push_back(nodes[k]);
  return corners;
}

/// Returns the triangles into which a face is divided, with its orientation: itself, or the two on the sides of a
/// diagonal.
inline std::vector<std::array<int, 3>> triangles_of(const Corners& c) {
  if (c.size() == 3) return {{c[0], c[1], c[2]}};
  return {{c[0], c[1], c[2]}, {c[0], c[2], c[3]}};
}

/// Area of a plane triangle times its unit normal [m^2].
inline Eigen::Vector3d area_vector(const Eigen::Matrix3Xd& points, const std::array<int, 3>& t) {
  return (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0])) / 2;
}

/// Integral of the unit normal over a face, which does not depend on how a warped face is filled [m^2].
inline Eigen::Vector3d area_vector(const Eigen::Matrix3Xd& points, const Corners& corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& triangle : triangles_of(corners)) sum += area_vector(points, triangle);
  return sum;
}

/// Area of the plane triangles of a face [m^2].
inline double area_of(const Eigen::Matrix3Xd& points, const Corners& corners) {
  double sum = 0;
  for (const auto& triangle : triangles_of(corners)) sum += area_vector(points, triangle).norm();
  return sum;
}

}  // namespace bielle::reduce
