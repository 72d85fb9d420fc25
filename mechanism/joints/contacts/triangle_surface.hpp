// A surface of triangles, as STL files hold it, and the places of it that are nearest to a point.
//
// A ball touches the surface at every place that is nearer to its middle than all places around it: inside of a
// triangle, on an edge whose two triangles are both nearest there, at a corner all of whose triangles are. A flat floor
// of many triangles has one such place, as a plane has; a groove has two. Sides are told apart by the order of the
// corners: anticlockwise seen from outside.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class TriangleSurface {
 public:
  using Triangle = std::array<int, 3>;  ///< its corners
  /// @param corners  three of each triangle, one after the other [m]; equal ones are joined
  /// @throws InputError where no triangle has an area
  explicit TriangleSurface(const std::vector<Vector3>& corners);

  const std::vector<Vector3>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Vector3& middle() const { return middle_; }  ///< of the box around it
  double reach() const { return reach_; }            ///< of the farthest point from the origin [m]

  /// A place that is nearest to a point: inside of a triangle, on an edge, or at a corner.
  struct Place {
    enum class Kind { face, edge, corner } kind;
    Vector3 foot;
    Vector3 normal;    ///< of the face
    Vector3 from, to;  ///< of the edge; `from` is the corner
  };
  /// Adds those nearer than `radius` to a point; behind a face as well as before it.
  void find_nearest(const Vector3& point, double radius, std::vector<Place>& places) const;

 private:
  struct Nearest {
    Vector3 foot;
    int feature;  ///< -1: inside; 0, 1, 2: the edge from that corner; 3, 4, 5: the corner
  };
  Nearest nearest(int triangle, const Vector3& point) const;
  void join_corners(const std::vector<Vector3>& corners);
  void find_neighbours();
  void build_tree();
  int build_node(int begin, int end);
  bool is_local(int triangle, const Nearest& found, const Vector3& point) const;
  struct Branch {
    Vector3 low, high;
    int begin, end;  ///< triangles in `order_`
    int left = -1, right = -1;
  };
  std::vector<Vector3> points_, normals_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 3>> neighbours_;   ///< across the edge from each corner; -1: none
  std::vector<std::vector<int>> around_corner_;  ///< triangles
  std::vector<int> order_;
  std::vector<Branch> tree_;
  Vector3 middle_ = Vector3::Zero();
  double reach_ = 0;
};

/// Reads an STL file, binary or text. @param unit  of its lengths [m] @throws InputError
std::vector<Vector3> read_stl(const std::string& path, double unit);

}  // namespace bielle::mechanism
