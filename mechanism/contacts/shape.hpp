// Shapes that touch: spheres, planes, capsules, cylinders, boxes and triangulated surfaces, each fixed on a node.
//
// What has corners has them rounded: box and cylinder are a smaller core with a skin of thickness `rounding`, a capsule
// is a line with a skin, a sphere a point. Where only skins overlap, the direction from one core to the other is a
// smooth function of the position, also where it passes from a face to an edge to a corner. The ends of a cylinder's
// core are the tops of very flat domes (disc_distance.hpp).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "mechanism/contacts/triangle_surface.hpp"
#include "mechanism/math/se3.hpp"

namespace bielle::mechanism {

struct ContactShape {
  enum class Kind { sphere, plane, capsule, cylinder, box, surface };
  Kind kind = Kind::sphere;
  int node = 0;
  std::string node_name;
  Frame frame;                     ///< in the node's axes; a plane's normal, the axis of a capsule or cylinder along z
  double radius = 0;               ///< of sphere, capsule, cylinder [m]
  double half_length = 0;          ///< of a capsule's line between the middles of its ends, of a cylinder [m]
  Vector3 half = Vector3::Zero();  ///< half the edges of a box [m]
  double rounding = 0;             ///< of box and cylinder [m]
  std::shared_ptr<const TriangleSurface> surface;

  const char* kind_name() const;
  std::string describe() const;
  double skin() const;          ///< thickness of the skin around the core [m]
  Vector3 middle() const;       ///< in the frame's axes [m]; of a surface, of the box around it
  double reach() const;         ///< of the farthest point from the frame's origin [m]; infinite of a plane
  double thickness() const;     ///< of its thinnest part; infinite of a plane, 0 of a surface [m]
  Vector3 half_extent() const;  ///< of the box along its axes that holds it, not of a plane or a surface [m]
  /// Of the core, where it has flat faces; of a cylinder, the middles of its two ends, which are flat domes.
  const std::vector<Vector3>& corners() const { return corners_; }
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }        ///< of a cylinder, its axis
  double edge_skin() const { return kind == Kind::cylinder ? radius : skin(); }  ///< around its edges [m]
  double dome_radius() const { return radius - rounding; }                       ///< of a cylinder's ends [m]
  double dome_height() const;
  void complete();  ///< finds corners and edges

 private:
  std::vector<Vector3> corners_;
  std::vector<std::array<int, 2>> edges_;
};

/// Whether two kinds of shapes can touch.
bool can_touch(ContactShape::Kind a, ContactShape::Kind b);
/// The kinds that a kind can touch, in words: "sphere, plane".
std::string touchable_kinds(ContactShape::Kind kind);

}  // namespace bielle::mechanism
