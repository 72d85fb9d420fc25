// A pair of shapes, compared by features: corners of one with the other as a whole, edges with each other.
//
// A corner is a point, or the end of a cylinder (disc_distance.hpp). The edge of a cylinder is its axis, with its
// radius as the skin: it represents the side of the cylinder at a crossing with another edge.
#pragma once

#include <limits>
#include <vector>

#include "mechanism/contacts/disc_distance.hpp"

namespace bielle::mechanism {

template <class T>
using Ends = std::array<Triple<T>, 2>;

template <class T>
Touch<T> touch_of(const PointDistance<T>& found, double point_skin, double core_skin, bool point_on_second) {
  Touch<T> touch;
  touch.depth = T(point_skin + core_skin) - found.distance;
  touch.place = found.foot + (T(core_skin) - T(0.5) * touch.depth) * found.normal;
  touch.normal = point_on_second ? found.normal : -found.normal;
  return touch;
}

/// Returns whether the nearest points of the lines along u and v are inside of both; the second begins at d from the
/// first.
/// @param between  the square of their distance there
inline bool crosses_inside(const Vector3& u, const Vector3& v, const Vector3& d, double& between) {
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), D = uu * vv - uv * uv;
  if (D <= 1e-14 * uu * vv) return false;
  const double s = (d.dot(u) * vv - uv * d.dot(v)) / D, t = (uv * d.dot(u) - uu * d.dot(v)) / D;
  between = (d + t * v - s * u).squaredNorm();
  return s > 0 && s < 1 && t > 0 && t < 1;
}

/// Returns whether two edges cross at a distance smaller than `skins`.
template <class T>
bool crosses_within(const Ends<T>& a, const Ends<T>& b, double skins) {
  const Vector3 from = value_of(a[0]), u = value_of(a[1]) - from, start = value_of(b[0]), v = value_of(b[1]) - start;
  double between = 0;
  return crosses_inside(u, v, start - from, between) && between < skins * skins;
}

/// Returns the touch at the nearest points of the lines of two edges. @param a  on the first shape @param b  on the
/// second
template <class T>
Touch<T> crossing_of(const Ends<T>& a, double skin_a, const Ends<T>& b, double skin_b) {
  const Triple<T> u = a[1] - a[0], v = b[1] - b[0], d = b[0] - a[0];
  const T uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), du = dot(d, u), dv = dot(d, v);
  const T D = uu * vv - uv * uv;
  const Triple<T> on_first = a[0] + ((du * vv - uv * dv) / D) * u, on_second = b[0] + ((uv * du - uu * dv) / D) * v;
  return touch_of(distance_to_point(on_second, on_first), skin_b, skin_a, true);
}

/// Selects the features of two shapes that are evaluated.
enum class Among { all, touching };

template <class T>
class PairOfShapes {
 public:
  PairOfShapes(const PlacedShape<T>& first, const PlacedShape<T>& second)
      : placed_{&first, &second}, shapes_{first.shape, second.shape} {}

  const PlacedShape<T>& placed(std::size_t side) const { return *placed_[side]; }
  const ContactShape& shape(std::size_t side) const { return *shapes_[side]; }

  Triple<T> corner(std::size_t side, std::size_t k) const {
    return point_of(*placed_[side], shapes_[side]->corners()[k]);
  }

  Ends<T> edge(std::size_t side, std::size_t k) const {
    const auto& ends = shapes_[side]->edges()[k];
    return {corner(side, static_cast<std::size_t>(ends[0])), corner(side, static_cast<std::size_t>(ends[1]))};
  }

  /// Touch of a corner with a target that has the skin `core_skin`.
  template <class Target>
  Touch<T> corner_on(std::size_t side, std::size_t k, const Target& target, double core_skin) const {
    const bool disc = shapes_[side]->kind == ContactShape::Kind::cylinder;
    const Triple<T> point = disc ? nearest_of_disc(disc_of(*placed_[side], k), target) : corner(side, k);
    return touch_of(target.from(point), shapes_[side]->skin(), core_skin, side == 1);
  }

  /// Touch of a corner with the other shape as a whole, which is not a surface.
  Touch<T> corner_on_other(std::size_t side, std::size_t k) const {
    return corner_on(side, k, CoreTarget<T>{*placed_[1 - side]}, shapes_[1 - side]->skin());
  }

  /// Touch of an end of an edge of one shape with an edge of the other; a cylinder has one edge, and is compared as a
  /// whole.
  Touch<T> end_on_edge(std::size_t side, std::size_t corner, std::size_t edge_of_other) const {
    if (shapes_[1 - side]->kind == ContactShape::Kind::cylinder) return corner_on_other(side, corner);
    const Ends<T> ends = edge(1 - side, edge_of_other);
    return corner_on(side, corner, SegmentTarget<T>{ends[0], ends[1]}, shapes_[1 - side]->skin());
  }

  /// Returns whether an end of a cylinder may touch the other shape, which is not a surface.
  bool may_touch(std::size_t side, std::size_t k) const {
    const ContactShape &of = *shapes_[side], &other = *shapes_[1 - side];
    if (of.kind != ContactShape::Kind::cylinder) return true;
    const CoreTarget<double> still = CoreTarget<T>{*placed_[1 - side]}.template still<double>();
    return still.from(at_rest<double>(corner(side, k))).distance < of.dome_radius() + of.skin() + other.skin();
  }

  /// Calls act(touch, side, corner) for each corner of either shape with the other; neither is a surface.
  template <class Act>
  void for_each_corner(const Act& act, Among which) const {
    for (const std::size_t side : {0UL, 1UL}) {
      const ContactShape &of = *shapes_[side], &other = *shapes_[1 - side];
      // A sphere is compared by its middle only; the corners of the other shape are not compared with it.
      if (other.kind == ContactShape::Kind::sphere && (of.kind != ContactShape::Kind::sphere || side == 1)) continue;
      for (std::size_t k = 0; k < of.corners().size(); ++k)
        if (which == Among::all || may_touch(side, k)) act(corner_on_other(side, k), side, k);
    }
  }

  /// Calls act(i, j) for each pair of edges of the two cores whose crossing lies inside of both.
  template <class Act>
  void for_each_crossing(const Act& act, Among which) const {
    std::array<std::vector<Ends<double>>, 2> edges;
    for (const std::size_t side : {0UL, 1UL})
      for (std::size_t k = 0; k < shapes_[side]->edges().size(); ++k) {
        const Ends<T> ends = edge(side, k);
        edges[side].push_back({at_rest<double>(ends[0]), at_rest<double>(ends[1])});
      }
    const double within = which == Among::all ? std::numeric_limits<double>::infinity()
                                              : shapes_[0]->edge_skin() + shapes_[1]->edge_skin();
    for (std::size_t i = 0; i < edges[0].size(); ++i)
      for (std::size_t j = 0; j < edges[1].size(); ++j)
        if (crosses_within(edges[0][i], edges[1][j], within)) act(i, j);
  }

  Touch<T> crossing(std::size_t i, std::size_t j) const {
    return crossing_of(edge(0, i), shapes_[0]->edge_skin(), edge(1, j), shapes_[1]->edge_skin());
  }

 private:
  std::array<const PlacedShape<T>*, 2> placed_;
  std::array<const ContactShape*, 2> shapes_;
};

}  // namespace bielle::mechanism
