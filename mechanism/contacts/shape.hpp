// Shapes in contact: spheres, planes, capsules, cylinders, boxes and triangulated surfaces, each fixed on a node.
//
// Corners and edges are rounded: box and cylinder are a smaller core with a skin of thickness `rounding`, a capsule is
// a line with a skin, a sphere a point with a skin. As long as only skins overlap, the direction from one core to the
// other is a continuous function of the position, even if the nearest point moves from a face to an edge to a corner.
// The ends of a cylinder's core are very flat domes (disc_distance.hpp).
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
  Frame frame;                     ///< frame in the node's axes; z: normal of a plane, axis of a capsule or cylinder
  double radius = 0;               ///< radius of a sphere, capsule or cylinder [m]
  double half_length = 0;          ///< half length of a cylinder, or of the line between a capsule's ends [m]
  Vector3 half = Vector3::Zero();  ///< half the edges of a box [m]
  double rounding = 0;             ///< rounding radius of a box or cylinder [m]
  std::shared_ptr<const TriangleSurface> surface;
  /// Velocity of the surface's material relative to the node (a conveyor belt), at the frame's origin, and its angular
  /// velocity about it (a turntable), in the frame's axes [m/s], [rad/s].
  Vector3 belt_velocity = Vector3::Zero(), belt_spin = Vector3::Zero();
  bool has_belt() const { return !belt_velocity.isZero(0) || !belt_spin.isZero(0); }

  const char* kind_name() const;
  std::string describe() const;
  double skin() const;          ///< thickness of the skin around the core [m]
  Vector3 middle() const;       ///< middle in the frame's axes [m]; for a surface, of its bounding box
  double reach() const;         ///< distance of the farthest point from the frame's origin [m]; infinite for a plane
  double thickness() const;     ///< thickness of the thinnest part [m]; infinite for a plane, 0 for a surface
  Vector3 half_extent() const;  ///< half extent of its bounding box along its axes, not for a plane or a surface [m]
  /// Corners of a core with flat faces; for a cylinder, the middles of its two ends, which are flat domes.
  const std::vector<Vector3>& corners() const { return corners_; }
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }        ///< for a cylinder, its axis
  double edge_skin() const { return kind == Kind::cylinder ? radius : skin(); }  ///< skin around its edges [m]
  double dome_radius() const { return radius - rounding; }                       ///< radius of a cylinder's ends [m]
  double dome_height() const;
  void complete();  ///< finds corners and edges

 private:
  std::vector<Vector3> corners_;
  std::vector<std::array<int, 2>> edges_;
};

/// Returns whether two kinds of shapes can be in contact.
bool can_touch(ContactShape::Kind a, ContactShape::Kind b);
/// Lists the kinds that a kind can touch: "sphere, plane".
std::string touchable_kinds(ContactShape::Kind kind);

}  // namespace bielle::mechanism
