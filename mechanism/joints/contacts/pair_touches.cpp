#include "mechanism/joints/contacts/pair_touches.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "mechanism/joints/contacts/core_overlap.hpp"
#include "mechanism/joints/contacts/point_distances.hpp"

namespace bielle::mechanism {
namespace {

using Kind = ContactShape::Kind;
using Twelve = GradientNumber<12>;

constexpr std::size_t crossings = 100000;  ///< their numbers begin there

/// V = k p^(n+1)/(n+1) and V'.
template <class T>
struct Spring {
  T potential{}, force{};
  Spring(const NormalLaw& law, const T& depth) {
    if (value_of(depth) <= 0) return;
    force = T(law.stiffness) * power_of(depth, law.exponent);
    potential = T(1 / (law.exponent + 1)) * (depth * force);
  }
};

template <class T>
Touch<T> touch_of(const PointDistance<T>& found, double point_skin, double core_skin, bool point_on_second) {
  Touch<T> touch;
  touch.depth = T(point_skin + core_skin) - found.distance;
  touch.place = found.foot + (T(core_skin) - T(0.5) * touch.depth) * found.normal;
  touch.normal = point_on_second ? found.normal : -found.normal;
  return touch;
}

/// Whether the lines along u and v, the second beginning at d from the first, are nearest to each other inside of both.
/// @param between  the square of their distance there
bool crosses_inside(const Vector3& u, const Vector3& v, const Vector3& d, double& between) {
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), D = uu * vv - uv * uv;
  if (D <= 1e-14 * uu * vv) return false;
  const double s = (d.dot(u) * vv - uv * d.dot(v)) / D, t = (uv * d.dot(u) - uu * d.dot(v)) / D;
  between = (d + t * v - s * u).squaredNorm();
  return s > 0 && s < 1 && t > 0 && t < 1;
}

/// Compares a pair of shapes feature by feature.
template <class T>
class PairOfShapes {
 public:
  PairOfShapes(const PlacedShape<T>& first, const PlacedShape<T>& second)
      : placed_{&first, &second}, shapes_{first.shape, second.shape} {}

  /// Calls act(touch, side, corner) for each corner of either shape against the other as a whole.
  template <class Act>
  void for_each_corner(const Act& act) const {
    for (const std::size_t side : {0UL, 1UL}) {
      const ContactShape &of = *shapes_[side], &other = *shapes_[1 - side];
      if (other.kind == Kind::sphere && of.kind != Kind::sphere) continue;  // its middle is compared, not the corners
      if (other.kind == Kind::sphere && side == 1) continue;
      for (std::size_t k = 0; k < of.corners().size(); ++k) {
        const Triple<T> point = point_of(*placed_[side], of.corners()[k]);
        if (other.kind == Kind::surface)
          for_each_place(point, side, [&](const Touch<T>& touch) { act(touch, side, k); });
        else
          act(touch_of(distance_to_core(point, *placed_[1 - side]), of.skin(), other.skin(), side == 1), side, k);
      }
      if (of.kind == Kind::cylinder && other.kind == Kind::plane)
        for (const int end : {-1, 1}) act(rim(side, end), side, end > 0 ? 1UL : 0UL);
    }
  }

  /// Calls act(i, j) for each pair of edges of the two cores whose crossing, nearer than the skins allow, lies inside
  /// of both.
  template <class Act>
  void for_each_crossing(const Act& act) const {
    const double skins = shapes_[0]->skin() + shapes_[1]->skin();
    std::array<std::vector<Vector3>, 2> corners;
    for (const std::size_t side : {0UL, 1UL})
      for (const Vector3& c : shapes_[side]->corners()) corners[side].push_back(value_of(point_of(*placed_[side], c)));
    for (std::size_t i = 0; i < shapes_[0]->edges().size(); ++i)
      for (std::size_t j = 0; j < shapes_[1]->edges().size(); ++j) {
        const auto at = [&](std::size_t side, int end) -> const Vector3& {
          const auto& edge = shapes_[side]->edges()[side == 0 ? i : j];
          return corners[side][static_cast<std::size_t>(edge[static_cast<std::size_t>(end)])];
        };
        const Vector3 u = at(0, 1) - at(0, 0), v = at(1, 1) - at(1, 0), d = at(1, 0) - at(0, 0);
        double between = 0;
        if (crosses_inside(u, v, d, between) && between < skins * skins) act(i, j);
      }
  }

  std::array<Triple<T>, 2> ends(std::size_t side, std::size_t edge) const {
    const auto& ends = shapes_[side]->edges()[edge];
    const auto corner = [&](int k) {
      return point_of(*placed_[side], shapes_[side]->corners()[static_cast<std::size_t>(k)]);
    };
    return {corner(ends[0]), corner(ends[1])};
  }

  /// Where the lines of two edges are nearest to each other.
  Touch<T> crossing(std::size_t i, std::size_t j) const {
    const auto a = ends(0, i), b = ends(1, j);
    const Triple<T> u = a[1] - a[0], v = b[1] - b[0], d = b[0] - a[0];
    const T uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), du = dot(d, u), dv = dot(d, v);
    const T D = uu * vv - uv * uv;
    const Triple<T> on_first = a[0] + ((du * vv - uv * dv) / D) * u, on_second = b[0] + ((uv * du - uu * dv) / D) * v;
    return touch_of(distance_to_point(on_second, on_first), shapes_[1]->skin(), shapes_[0]->skin(), true);
  }

  /// Calls act(touch, side, edge) for each edge of one shape that is nearer to a cylinder between its ends than at
  /// them.
  template <class Act>
  void for_each_edge_on_cylinder(const Act& act) const {
    for (const std::size_t side : {0UL, 1UL}) {
      if (shapes_[1 - side]->kind != Kind::cylinder) continue;
      const PlacedShape<T>& cylinder = *placed_[1 - side];
      for (std::size_t edge = 0; edge < shapes_[side]->edges().size(); ++edge) {
        const auto [from, to] = ends(side, edge);
        if (const auto point = nearest_between_ends(from, to, cylinder))
          act(touch_of(distance_to_core(*point, cylinder), shapes_[side]->skin(), cylinder.shape->skin(), side == 1),
              side, edge);
      }
    }
  }

  /// The place of a surface that is nearest to a corner of the other shape, however far it is: what is within a closed
  /// one is deeper than its skin. Behind an open one nothing is within.
  Touch<double> nearest_of_surface(std::size_t side, std::size_t corner) const requires std::is_same_v<T, double> {
    const PlacedShape<double>& surface = *placed_[1 - side];
    const TriangleSurface& triangles = *surface.shape->surface;
    const double skin = shapes_[side]->skin();
    const Triple<double> point = point_of(*placed_[side], shapes_[side]->corners()[corner]);
    const Triple<double> way = point - surface.origin;
    const Vector3 q(dot(surface.axes[0], way), dot(surface.axes[1], way), dot(surface.axes[2], way));
    std::vector<TriangleSurface::Place> places;
    for (double within = 2 * skin; places.empty() && within < 4 * (q.norm() + triangles.reach() + skin); within *= 2)
      triangles.find_nearest(q, within, places);
    Touch<double> nearest;
    nearest.depth = -std::numeric_limits<double>::infinity();
    if (places.empty()) return nearest;
    const auto& place = *std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
      return (q - a.foot).squaredNorm() < (q - b.foot).squaredNorm();
    });
    const double distance = (q - place.foot).norm();
    const bool behind = place.normal.dot(q - place.foot) < 0;
    const bool within = behind && (triangles.open_edges() == 0 || distance <= skin);
    Vector3 normal = place.normal.normalized();
    if (distance > 0 && (place.kind != TriangleSurface::Place::Kind::face || (behind && !within)))
      normal = (within ? -1 : 1) / distance * (q - place.foot);
    nearest.depth = skin + (within ? distance : -distance);
    nearest.normal = turned(surface, side == 1 ? normal : Vector3(-normal));
    nearest.place = point_of(surface, place.foot - 0.5 * nearest.depth * normal);
    return nearest;
  }

  /// An end of an edge of one shape against an edge of the other.
  Touch<T> end_on_edge(std::size_t side, const Triple<T>& end, const std::array<Triple<T>, 2>& edge) const {
    return touch_of(distance_to_segment(end, edge[0], edge[1]), shapes_[side]->skin(), shapes_[1 - side]->skin(),
                    side == 1);
  }

 private:
  /// The lowest place of a cylinder's rim above a plane. With s the sine of the angle between axis and normal, that of
  /// its core lies R f(s) below the middle of the core's end, f = (sqrt(s^2 + e^2) - e)/(sqrt(1 + e^2) - e), e = 0.01:
  /// exact for s = 0 and 1. An end that stands flat is the top of a very flat dome, and tilts smoothly.
  Touch<T> rim(std::size_t side, int end) const {
    constexpr double e = 0.01;
    const double whole = std::sqrt(1 + e * e) - e;
    const ContactShape& cylinder = *shapes_[side];
    const PlacedShape<T>& plane = *placed_[1 - side];
    const Triple<T>& axis = placed_[side]->axes[2];
    const Triple<T>& n = plane.axes[2];
    const double r = cylinder.rounding, R = cylinder.radius - r;
    const Triple<T> middle = point_of(*placed_[side], {0, 0, end * (cylinder.half_length - r)});
    const Triple<T> up = n - dot(axis, n) * axis;  // across the axis, of length s
    const T root = root_of(dot(up, up) + T(e * e));
    // f'(s)/s = 1/(root whole)
    const Triple<T> lowest = middle - (T(R / whole) / root) * up;
    const T below = T(R / whole) * (root - T(e));
    Touch<T> touch;
    touch.depth = below + T(r) - dot(n, middle - plane.origin);
    touch.place = lowest - (dot(n, lowest - plane.origin) + T(0.5) * touch.depth) * n;
    touch.normal = side == 1 ? n : -n;
    return touch;
  }

  template <class Act>
  void for_each_place(const Triple<T>& point, std::size_t side, const Act& act) const {
    const PlacedShape<T>& surface = *placed_[1 - side];
    const double skin = shapes_[side]->skin();
    const Vector3 p = value_of(point), o = value_of(surface.origin);
    Matrix3 axes;
    for (int k = 0; k < 3; ++k) axes.col(k) = value_of(surface.axes[static_cast<std::size_t>(k)]);
    const Vector3 q = axes.transpose() * (p - o);
    std::vector<TriangleSurface::Place> places;
    surface.shape->surface->find_nearest(q, skin, places);
    using Place = TriangleSurface::Place;
    for (const Place& place : places) {
      const bool behind = place.normal.dot(q - place.foot) < 0;
      if (place.kind == Place::Kind::face) {
        // What has gone through wholly is on the other side.
        if (behind && (q - place.foot).norm() > skin) continue;
        const Triple<T> normal = turned(surface, place.normal);
        act(touch_of(distance_to_plane(point, point_of(surface, place.foot), normal), skin, 0, side == 1));
      } else if (behind) {
        continue;
      } else if (place.kind == Place::Kind::edge) {
        act(touch_of(distance_to_segment(point, point_of(surface, place.from), point_of(surface, place.to)), skin, 0,
                     side == 1));
      } else {
        act(touch_of(distance_to_point(point, point_of(surface, place.from)), skin, 0, side == 1));
      }
    }
  }

  static Triple<T> turned(const PlacedShape<T>& placed, const Vector3& c) {
    return T(c.x()) * placed.axes[0] + T(c.y()) * placed.axes[1] + T(c.z()) * placed.axes[2];
  }

  std::array<const PlacedShape<T>*, 2> placed_;
  std::array<const ContactShape*, 2> shapes_;
};

/// The part of two edges that cross.
template <class T>
class CrossingShare {
 public:
  /// @param corner_touch  numbers of the touches of the corners of either shape, -1: none
  CrossingShare(const PairOfShapes<T>& pair, const NormalLaw& law, std::array<const ContactShape*, 2> shapes,
                std::array<std::vector<int>, 2> corner_touch)
      : pair_(pair), law_(law), shapes_(shapes), corner_touch_(std::move(corner_touch)) {}

  void add(std::size_t i, std::size_t j, PairTouches<T>& result) {
    Touch<T> crossing = pair_.crossing(i, j);
    const Spring<T> whole(law_, crossing.depth);
    const std::array<std::array<Triple<T>, 2>, 2> ends = {pair_.ends(0, i), pair_.ends(1, j)};
    std::array<T, 4> left;  // 1 - V_i/V_e
    std::array<Touch<T>, 4> touch;
    std::array<T, 4> slope;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t side = k / 2;
      touch[k] = pair_.end_on_edge(side, ends[side][k % 2], ends[1 - side]);
      const Spring<T> end(law_, touch[k].depth);
      left[k] = T(1) - end.potential / whole.potential;
      slope[k] = end.force;
    }
    const auto product_without = [&](std::size_t without) {
      T product(1);
      for (std::size_t k = 0; k < 4; ++k)
        if (k != without) product *= left[k];
      return product;
    };
    T share = product_without(4);
    result.potential += whole.potential * share;
    for (std::size_t k = 0; k < 4; ++k) {
      if (value_of(touch[k].depth) <= 0) continue;
      const T others = product_without(k);
      share += (T(1) - left[k]) * others;
      touch[k].force = -(slope[k] * others);
      unload(k / 2, (k < 2 ? i : j), k % 2, touch[k].force, result);
      result.touches.push_back(touch[k]);
    }
    crossing.force = crossing.load = whole.force * share;
    crossing.id = static_cast<int>(crossings + 32 * i + j);
    result.touches.push_back(crossing);
  }

  /// An edge that a cylinder presses between its ends, at `inner`: of the potential, V(p) prod_i (1 - V(p_i)/V(p)), i
  /// its two ends against the cylinder.
  void add_on_cylinder(Touch<T> inner, std::size_t side, std::size_t edge, PairTouches<T>& result) const {
    if (value_of(inner.depth) <= 0) return;
    const Spring<T> whole(law_, inner.depth);
    const auto& corners = shapes_[side]->edges()[edge];
    std::array<int, 2> number;
    std::array<T, 2> left{T(1), T(1)}, slope{};
    for (std::size_t k = 0; k < 2; ++k) {
      number[k] = corner_touch_[side][static_cast<std::size_t>(corners[k])];
      if (number[k] < 0) continue;
      const Spring<T> end(law_, result.touches[static_cast<std::size_t>(number[k])].depth);
      left[k] = T(1) - end.potential / whole.potential;
      slope[k] = end.force;
    }
    T share = left[0] * left[1];
    result.potential += whole.potential * share;
    for (std::size_t k = 0; k < 2; ++k) {
      if (number[k] < 0) continue;
      share += (T(1) - left[k]) * left[1 - k];
      Touch<T>& end = result.touches[static_cast<std::size_t>(number[k])];
      end.force -= slope[k] * left[1 - k];
      end.load = value_of(end.force) > 0 ? end.force : T(0);
    }
    inner.force = inner.load = whole.force * share;
    inner.id = static_cast<int>(crossings + edge);
    result.touches.push_back(inner);
  }

 private:
  /// What a crossing takes over from a corner is no load of it any more.
  void unload(std::size_t side, std::size_t edge, std::size_t end, const T& force, PairTouches<T>& result) const {
    const int corner = shapes_[side]->edges()[edge][end];
    const int number = corner_touch_[side][static_cast<std::size_t>(corner)];
    if (number < 0) return;
    T& load = result.touches[static_cast<std::size_t>(number)].load;
    load += force;
    if (value_of(load) < 0) load = T(0);
  }
  const PairOfShapes<T>& pair_;
  const NormalLaw& law_;
  std::array<const ContactShape*, 2> shapes_;
  std::array<std::vector<int>, 2> corner_touch_;
};

}  // namespace

template <class T>
void find_touches(const PlacedShape<T>& first, const PlacedShape<T>& second, const NormalLaw& law,
                  PairTouches<T>& result) {
  result.touches.clear();
  result.potential = T(0);
  const PairOfShapes<T> pair(first, second);
  std::array<std::vector<int>, 2> corner_touch;
  corner_touch[0].assign(first.shape->corners().size(), -1);
  corner_touch[1].assign(second.shape->corners().size(), -1);
  pair.for_each_corner([&](Touch<T> touch, std::size_t side, std::size_t corner) {
    if (value_of(touch.depth) <= 0) return;
    const Spring<T> spring(law, touch.depth);
    touch.force = touch.load = spring.force;
    touch.id = static_cast<int>(32 * side + corner);
    result.potential += spring.potential;
    if (corner < corner_touch[side].size()) corner_touch[side][corner] = static_cast<int>(result.touches.size());
    result.touches.push_back(touch);
  });
  CrossingShare<T> crossings(pair, law, {first.shape, second.shape}, std::move(corner_touch));
  pair.for_each_crossing([&](std::size_t i, std::size_t j) { crossings.add(i, j, result); });
  pair.for_each_edge_on_cylinder([&](const Touch<T>& inner, std::size_t side, std::size_t edge) {
    crossings.add_on_cylinder(inner, side, edge, result);
  });
}

template void find_touches(const PlacedShape<double>&, const PlacedShape<double>&, const NormalLaw&,
                           PairTouches<double>&);
template void find_touches(const PlacedShape<Twelve>&, const PlacedShape<Twelve>&, const NormalLaw&,
                           PairTouches<Twelve>&);

Touch<double> find_nearest_place(const PlacedShape<double>& first, const PlacedShape<double>& second) {
  if (const auto overlap = overlap_of_cores(first, second)) {
    Touch<double> through;
    through.depth = overlap->depth + first.shape->skin() + second.shape->skin();
    through.normal = Triple<double>(overlap->normal);
    through.place = Triple<double>(overlap->place);
    return through;
  }
  Touch<double> nearest;
  nearest.depth = -std::numeric_limits<double>::infinity();
  const PairOfShapes<double> pair(first, second);
  const auto take = [&](const Touch<double>& touch) {
    if (touch.depth > nearest.depth) nearest = touch;
  };
  for (const std::size_t side : {0UL, 1UL})
    if ((side == 0 ? second : first).shape->kind == Kind::surface)
      for (std::size_t k = 0; k < (side == 0 ? first : second).shape->corners().size(); ++k)
        take(pair.nearest_of_surface(side, k));
  if (!std::isinf(nearest.depth)) return nearest;
  pair.for_each_corner([&](const Touch<double>& touch, std::size_t, std::size_t) { take(touch); });
  pair.for_each_edge_on_cylinder([&](const Touch<double>& touch, std::size_t, std::size_t) { take(touch); });
  // Crossings of edges that do not press yet.
  for (std::size_t i = 0; i < first.shape->edges().size(); ++i)
    for (std::size_t j = 0; j < second.shape->edges().size(); ++j) {
      const auto a = pair.ends(0, i), b = pair.ends(1, j);
      const Vector3 u = value_of(a[1] - a[0]), v = value_of(b[1] - b[0]), d = value_of(b[0] - a[0]);
      double between = 0;
      if (crosses_inside(u, v, d, between)) take(pair.crossing(i, j));
    }
  return nearest;
}

}  // namespace bielle::mechanism
