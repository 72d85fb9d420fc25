#include "mechanism/contacts/nearest_on_surface.hpp"

#include <algorithm>
#include <limits>

#include "mechanism/contacts/core_overlap.hpp"

namespace bielle::mechanism {
namespace {

using Kind = ContactShape::Kind;
using Place = TriangleSurface::Place;

Touch<double> nowhere() {
  Touch<double> touch;
  touch.depth = -std::numeric_limits<double>::infinity();
  return touch;
}

/// Returns the touch of a point of the shape's core, at any distance.
Touch<double> nearest_of_point(const OnSurface<double>& on, const Triple<double>& point, double skin) {
  const TriangleSurface& triangles = on.triangles();
  const Vector3 q = on.along_axes(point);
  std::vector<Place> places;
  for (double within = 2 * skin; places.empty() && within < 4 * (q.norm() + triangles.reach() + skin); within *= 2)
    triangles.find_nearest(q, within, places);
  Touch<double> nearest = nowhere();
  if (places.empty()) return nearest;
  const auto& place = *std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    return (q - a.foot).squaredNorm() < (q - b.foot).squaredNorm();
  });
  const double distance = (q - place.foot).norm();
  const bool behind = place.normal.dot(q - place.foot) < 0;
  const bool within = behind && (triangles.open_edges() == 0 || distance <= skin);
  Vector3 normal = place.normal.normalized();
  if (distance > 0 && (place.kind != Place::Kind::face || (behind && !within)))
    normal = (within ? -1 : 1) / distance * (q - place.foot);
  nearest.depth = skin + (within ? distance : -distance);
  nearest.normal = on.side() == 1 ? on.turned(normal) : -on.turned(normal);
  nearest.place = point_of(on.surface(), place.foot - 0.5 * nearest.depth * normal);
  return nearest;
}

/// Returns the touch of an end of a cylinder.
Touch<double> nearest_of_disc_on(const OnSurface<double>& on, std::size_t corner, double skin) {
  const PlacedDisc<double> disc = disc_of(on.body(), corner);
  const Touch<double> of_middle = nearest_of_point(on, disc.middle, skin);
  if (of_middle.depth > skin) return of_middle;  // the middle is within the surface
  std::vector<Place> places;
  std::vector<Vector3> from;
  Touch<double> nearest = of_middle;
  try {
    // The nearest point of the disc is no farther from the surface than its middle.
    on.find_places_of_disc(corner, (1 + 1e-9) * (skin - of_middle.depth), places, from);
  } catch (const ComputationError&) {  // the disc cuts the surface, and its middle is nearer than its rim
    nearest.depth = of_middle.depth + on.body().shape->dome_radius();
    return nearest;
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vector3 way = from[k] - places[k].foot;
    const bool within = places[k].normal.dot(way) < 0 && way.norm() <= skin;
    const double depth = skin + (within ? way.norm() : -way.norm());
    if (depth <= nearest.depth || way.norm() == 0) continue;
    const Vector3 normal = (within ? -1 : 1) * way.normalized();
    nearest.depth = depth;
    nearest.normal = on.side() == 1 ? on.turned(normal) : -on.turned(normal);
    nearest.place = point_of(on.surface(), places[k].foot - 0.5 * depth * normal);
  }
  return nearest;
}

/// Finds the edges of the shape that pass through a triangle. The depth is that of the edge's end that is farther
/// behind the triangle.
Touch<double> deepest_piercing(const OnSurface<double>& on, const Ends<double>& edge, double skin) {
  const TriangleSurface& surface = on.triangles();
  const Vector3 a = on.along_axes(edge[0]), b = on.along_axes(edge[1]), low = a.cwiseMin(b), high = a.cwiseMax(b);
  std::vector<int> near;
  surface.find_triangles(
      [&](const Vector3& from, const Vector3& to) {
        return (to.array() >= low.array()).all() && (from.array() <= high.array()).all();
      },
      near);
  Touch<double> deepest = nowhere();
  for (const int t : near) {
    const Vector3& n = surface.normal(t);
    const double at_a = n.dot(a - surface.corner(t, 0)), at_b = n.dot(b - surface.corner(t, 0));
    if (!(at_a * at_b < 0)) continue;
    const Vector3 through = a + at_a / (at_a - at_b) * (b - a);
    const double depth = skin - std::min(at_a, at_b);
    const double beyond = (surface.nearest(t, through).foot - through).norm();
    if (beyond > 1e-9 * surface.reach() || depth <= deepest.depth) continue;
    deepest.depth = depth;
    deepest.normal = on.side() == 1 ? on.turned(n) : -on.turned(n);
    deepest.place = point_of(on.surface(), through);
  }
  return deepest;
}

}  // namespace

Touch<double> nearest_on_surface(const PairOfShapes<double>& pair) {
  const OnSurface<double> on(pair);
  const ContactShape& body = *on.body().shape;
  Touch<double> nearest = nowhere();
  const auto take = [&](const Touch<double>& touch) {
    if (touch.depth > nearest.depth) nearest = touch;
  };
  for (std::size_t k = 0; k < body.corners().size(); ++k)
    take(body.kind == Kind::cylinder ? nearest_of_disc_on(on, k, body.skin())
                                     : nearest_of_point(on, pair.corner(on.side(), k), body.skin()));
  if (body.kind == Kind::sphere) return nearest;
  if (body.kind == Kind::plane) {
    for (const int tip : on.triangles().tips()) take(on.tip_on_body(tip));
    return nearest;
  }
  // Tips and ridges of the surface may be nearer than the corners.
  const TriangleSurface::Outstanding near = on.outstanding(std::max(0.0, -nearest.depth));
  for (const int tip : near.tips) take(on.tip_on_body(tip));
  for (const int ridge : near.ridges) {
    for (std::size_t edge = 0; edge < body.edges().size(); ++edge)
      if (on.crosses(ridge, edge, std::numeric_limits<double>::infinity())) take(on.crossing(ridge, edge));
    if (body.kind == Kind::capsule) continue;  // a line has no interior
    const Ends<double> ends = on.ridge(ridge);
    const Touch<double> deepest = deepest_of_edge(ends[0], ends[1], 0, on.body(), on.side() == 0);
    if (deepest.depth > body.skin()) take(deepest);
  }
  for (std::size_t edge = 0; edge < body.edges().size(); ++edge)
    take(deepest_piercing(on, pair.edge(on.side(), edge), body.skin()));
  return nearest;
}

}  // namespace bielle::mechanism
