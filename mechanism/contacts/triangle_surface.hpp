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
  /// @param corners  three of each triangle, one after the other [m]; those within a millionth of the surface's size
  /// are joined
  /// @throws InputError where no triangle has an area
  explicit TriangleSurface(const std::vector<Vector3>& corners);

  const std::vector<Vector3>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  double reach() const { return reach_; }               ///< of the farthest point from the origin [m]
  double size() const { return size_; }                 ///< of the box around it, from corner to corner [m]
  const Vector3& middle() const { return middle_; }     ///< of that box [m]
  int open_edges() const { return open_edges_; }        ///< of one triangle alone: the surface ends there
  int flipped_edges() const { return flipped_edges_; }  ///< of triangles whose outsides are on different sides

  /// A place that is nearest to a point: inside of a triangle, on an edge, or at a corner.
  struct Place {
    enum class Kind { face, edge, corner } kind;
    Vector3 foot;
    /// Outwards. Of an edge the sum of its faces' normals; of a corner that of its faces weighted by their angles
    /// there: a point is outside if it is on that side (J. A. Baerentzen, H. Aanaes, IEEE Trans. Visualization and
    /// Computer Graphics 11 (2005) 243-253), however sharp they are.
    Vector3 normal;
    Vector3 from, to;  ///< of the edge; `from` is the corner
  };
  /// Adds those nearer than `radius` to a point; behind a face as well as before it.
  void find_nearest(const Vector3& point, double radius, std::vector<Place>& places) const;

  /// What sticks out of the surface, and may touch what is flat: see surface_ridges.cpp.
  struct Ridge {
    Vector3 from, to;
    std::array<int, 2> ends;  ///< numbers of points
  };
  const std::vector<Ridge>& ridges() const { return ridges_; }
  const std::vector<int>& tips() const { return tips_; }  ///< numbers of points, ascending
  /// Tips and ridges of the triangles that may reach into a region, ascending.
  struct Outstanding {
    std::vector<int> tips, ridges;
  };
  /// @param near(low, high)  whether a box with these corners may reach into it
  template <class Near>
  void find_outstanding(const Near& near, Outstanding& found) const {
    std::vector<int> triangles;
    find_triangles(near, triangles);
    collect(triangles, found);
  }
  /// Numbers of the triangles whose boxes are near.
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
  /// The place of a triangle that is nearest to a point, with its feature: -1: inside; 0, 1, 2: the edge from that
  /// corner; 3, 4, 5: the corner.
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
  /// Those that share an edge or a corner of a triangle with it, itself among them.
  std::vector<int> sharing(int triangle, int feature) const;
  /// Outwards at a feature of a triangle, as in Place.
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
    int begin, end;  ///< triangles in `order_`
    int left = -1, right = -1;
  };
  std::vector<Vector3> points_, normals_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 3>> neighbours_;   ///< across the edge from each corner; -1: none
  std::vector<std::vector<int>> around_corner_;  ///< triangles
  std::vector<Ridge> ridges_;
  std::vector<int> tips_;
  std::vector<bool> is_tip_;                  ///< of each point
  std::vector<std::array<int, 3>> ridge_of_;  ///< of each triangle's edges; -1: none
  std::vector<int> order_;
  std::vector<Branch> tree_;
  double reach_ = 0, size_ = 0;
  Vector3 middle_ = Vector3::Zero();
  int open_edges_ = 0, flipped_edges_ = 0;
};

/// Reads an STL file, binary or text. @param unit  of its lengths [m] @throws InputError
std::vector<Vector3> read_stl(const std::string& path, double unit);

}  // namespace bielle::mechanism
