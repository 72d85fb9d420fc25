// A surface of triangles, as in STL files, and its nearest places to a point.
//
// A ball touches the surface at every local minimum of the distance from its middle: inside of a triangle, on an edge
// that is the nearest place of both its triangles, at a corner that is the nearest place of all its triangles. A flat
// floor of many triangles has one such place, like a plane; a groove has two. The order of the corners defines the
// outside: they are anticlockwise seen from outside.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class TriangleSurface {
 public:
  using Triangle = std::array<int, 3>;  ///< indices of its corners
  /// @param corners  three for each triangle, one after the other [m]; corners within a millionth of the surface's size
  /// are joined
  /// @throws InputError if no triangle has an area
  explicit TriangleSurface(const std::vector<Vector3>& corners);

  const std::vector<Vector3>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  double reach() const { return reach_; }            ///< distance of the farthest point from the origin [m]
  double size() const { return size_; }              ///< diagonal of the bounding box [m]
  const Vector3& middle() const { return middle_; }  ///< middle of the bounding box [m]
  /// Number of edges that belong to one triangle only, at which the surface ends.
  int open_edges() const { return open_edges_; }
  int flipped_edges() const { return flipped_edges_; }  ///< edges between opposite orientations

  /// A nearest place to a point: inside of a triangle, on an edge, or at a corner.
  struct Place {
    enum class Kind { face, edge, corner } kind;
    Vector3 foot;
    /// Outward normal. For an edge it is the sum of its faces' normals; for a corner the sum of those of its faces
    /// weighted by their angles there: a point is outside if it is on the side of this normal (J. A. Baerentzen, H.
    /// Aanaes, IEEE Trans. Visualization and Computer Graphics 11 (2005) 243-253), for edges and corners of any
    /// sharpness.
    Vector3 normal;
    Vector3 from, to;  ///< ends of the edge; `from` is the corner
  };
  /// Adds the places that are nearer than `radius` to a point, on both sides of a face.
  void find_nearest(const Vector3& point, double radius, std::vector<Place>& places) const;

  /// Convex edge of the surface, which may touch flat parts of another shape: see surface_ridges.cpp.
  struct Ridge {
    Vector3 from, to;
    std::array<int, 2> ends;  ///< indices of points
  };
  const std::vector<Ridge>& ridges() const { return ridges_; }
  const std::vector<int>& tips() const { return tips_; }  ///< indices of points, ascending
  /// Tips and ridges of the triangles that may be in a region, ascending.
  struct Outstanding {
    std::vector<int> tips, ridges;
  };
  /// @param near(low, whether a box with these corners may be in the region
  template <class Near>
  void find_outstanding(const Near& near, Outstanding& found) const {
    std::vector<int> triangles;
    find_triangles(near, triangles);
    collect(triangles, found);
  }
  /// Finds the numbers of the triangles whose boxes are near.
  template <class Near>
  void find_triangles(const Near& near, std::vector<int>& triangles) const {
    std::vector<int> waiting = {0};
    while (!waiting.empty()) {
      const Branch& branch = tree_[static_cast<std::size_t>(waiting.back())];
      waiting.pop_back();
      if (!near(branch.low, branch.high)) continue;
      if (branch.left < 0) {
        triangles.insert(triangles.end(), order_.begin() + branch.begin, order_.begin() + branch.end);
        continue;
      }
      waiting.push_back(branch.left);
      waiting.push_back(branch.right);
    }
  }
  /// The nearest place of a triangle to a point, with its feature: -1: inside; 0, 1, 2: the edge from that corner; 3,
  /// 4, 5: the corner.
  struct Nearest {
    Vector3 foot;
    int feature;
  };
  Nearest nearest(int triangle, const Vector3& point) const;
  const Vector3& normal(int triangle) const { return normals_[static_cast<std::size_t>(triangle)]; }
  /// @param number  0 to 2, or 3 for the first again
  const Vector3& corner(int triangle, int number) const {
    return points_[static_cast<std::size_t>(
        triangles_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(number % 3)])];
  }
  /// Returns the triangles that share an edge or a corner with a triangle, including itself.
  std::vector<int> sharing(int triangle, int feature) const;
  /// Outward normal at a feature of a triangle, as in Place.
  Vector3 outward(int triangle, int feature) const;

 private:
  void join_corners(const std::vector<Vector3>& corners);
  void find_neighbours();
  void build_tree();
  void find_ridges();
  void collect(const std::vector<int>& triangles, Outstanding& found) const;
  bool sticks_out(int triangle, int edge) const;
  int build_node(int begin, int end);
  bool is_local(int triangle, const Nearest& found, const Vector3& point) const;
  struct Branch {
    Vector3 low, high;
    int begin, end;  ///< range of triangles in `order_`
    int left = -1, right = -1;
  };
  std::vector<Vector3> points_, normals_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 3>> neighbours_;   ///< neighbour across the edge from each corner; -1: none
  std::vector<std::vector<int>> around_corner_;  ///< triangles around each corner
  std::vector<Ridge> ridges_;
  std::vector<int> tips_;
  std::vector<bool> is_tip_;                  ///< for each point
  std::vector<std::array<int, 3>> ridge_of_;  ///< ridge of each triangle's edges; -1: none
  std::vector<int> order_;
  std::vector<Branch> tree_;
  double reach_ = 0, size_ = 0;
  Vector3 middle_ = Vector3::Zero();
  int open_edges_ = 0, flipped_edges_ = 0;
};

/// Reads an STL file, binary or text. @param unit  of its lengths [m] @throws InputError
std::vector<Vector3> read_stl(const std::string& path, double unit);

}  // namespace bielle::mechanism
