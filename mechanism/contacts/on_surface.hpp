// A shape on a surface of triangles: corners of the shape on the surface, and convex features of the surface (tips and
// ridges) on the shape.
//
// A corner touches the surface at every point that is nearer to it than all neighbouring points, as a ball does
// (triangle_surface.hpp). The end of a cylinder does the same: it has one nearest point to each triangle.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "mechanism/contacts/pair_of_shapes.hpp"

namespace bielle::mechanism {

/// A triangle of a placed surface, on the side of a given point.
template <class T>
struct TriangleTarget {
  PlacedShape<T> surface;
  int triangle;
  Vector3 along_axes(const Vector3& p) const {
    const Vector3 way = p - value_of(surface.origin);
    return {value_of(surface.axes[0]).dot(way), value_of(surface.axes[1]).dot(way), value_of(surface.axes[2]).dot(way)};
  }
  TriangleSurface::Nearest nearest(const Vector3& p) const {
    return surface.shape->surface->nearest(triangle, along_axes(p));
  }
  PointDistance<T> from(const Triple<T>& p) const {
    const TriangleSurface& triangles = *surface.shape->surface;
    const auto found = nearest(value_of(p));
    if (found.feature < 0) {
      const Vector3& outside = triangles.normal(triangle);
      const Vector3 n = outside.dot(along_axes(value_of(p)) - found.foot) < 0 ? Vector3(-outside) : outside;
      return distance_to_plane(p, point_of(surface, found.foot), point_of(surface, n) - surface.origin);
    }
    const Triple<T> a = point_of(surface, triangles.corner(triangle, found.feature));
    if (found.feature >= 3) return distance_to_point(p, a);
    return distance_to_segment(p, a, point_of(surface, triangles.corner(triangle, found.feature + 1)));
  }
  template <class U>
  TriangleTarget<U> still() const {
    return {CoreTarget<T>{surface}.template still<U>().placed, triangle};
  }
};

template <class T>
class OnSurface {
 public:
  using Place = TriangleSurface::Place;
  /// @param pair  a pair in which one shape is a surface
  explicit OnSurface(const PairOfShapes<T>& pair)
      : pair_(pair), side_(pair.shape(0).kind == ContactShape::Kind::surface ? 1 : 0) {
    for (int k = 0; k < 3; ++k) axes_.col(k) = value_of(surface().axes[static_cast<std::size_t>(k)]);
  }

  std::size_t side() const { return side_; }  ///< index of the shape that is no surface
  const PlacedShape<T>& surface() const { return pair_.placed(1 - side_); }
  const PlacedShape<T>& body() const { return pair_.placed(side_); }
  const TriangleSurface& triangles() const { return *surface().shape->surface; }
  Vector3 along_axes(const Triple<T>& p) const {
    return axes_.transpose() * (value_of(p) - value_of(surface().origin));
  }
  Triple<T> turned(const Vector3& c) const { return point_of(surface(), c) - surface().origin; }
  Triple<T> point(int number) const {
    return point_of(surface(), triangles().points()[static_cast<std::size_t>(number)]);
  }

  /// Calls act(touch) for each local minimum of the distance from a corner of the shape to the surface that is smaller
  /// than its skin.
  template <class Act>
  void for_each_place(std::size_t corner, const Act& act) const {
    const bool disc = body().shape->kind == ContactShape::Kind::cylinder;
    const double skin = body().shape->skin();
    std::vector<Place> places;
    std::vector<Vector3> from;  // nearest point of the corner, for each place
    if (disc) {
      find_places_of_disc(corner, skin, places, from);
    } else {
      from.assign(1, along_axes(pair_.corner(side_, corner)));
      triangles().find_nearest(from.front(), skin, places);
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Place& place = places[k];
      const Vector3 way = from[disc ? k : 0] - place.foot;
      const bool behind = place.normal.dot(way) < 0;
      if (place.kind == Place::Kind::face) {
        // A corner at this distance behind the surface has passed through it completely.
        if (behind && way.norm() > skin) continue;
        act(pair_.corner_on(side_, corner, PlaneTarget<T>{point_of(surface(), place.foot), turned(place.normal)}, 0));
      } else if (behind) {
        continue;
      } else if (place.kind == Place::Kind::edge) {
        const SegmentTarget<T> edge{point_of(surface(), place.from), point_of(surface(), place.to)};
        act(pair_.corner_on(side_, corner, edge, 0));
      } else {
        act(pair_.corner_on(side_, corner, PointTarget<T>{point_of(surface(), place.from)}, 0));
      }
    }
  }

  /// Adds places at which an end of a cylinder is nearer than `within`, and the nearest points of the end.
  void find_places_of_disc(std::size_t corner, double within, std::vector<Place>& places,
                           std::vector<Vector3>& from) const {
    const PlacedDisc<T> disc = disc_of(body(), corner);
    const Vector3 middle = along_axes(disc.middle);
    Vector3 reach = Vector3::Constant(within);
    Matrix3 M;
    for (int k = 0; k < 3; ++k) M.col(k) = axes_.transpose() * value_of(disc.half_axes[static_cast<std::size_t>(k)]);
    for (int k = 0; k < 3; ++k) reach[k] += M.row(k).norm();
    std::vector<int> near;
    triangles().find_triangles(
        [&](const Vector3& low, const Vector3& high) { return overlap(low, high, middle, reach); }, near);
    std::vector<Found> found;
    for (const int t : near) found.push_back(nearest_of(disc, t));
    const double same = 1e-7 * (triangles().reach() + reach.norm());
    for (const Found& each : found) {
      if (!((each.from - each.place.foot).norm() < within) || !is_local(each, found, same)) continue;
      if (std::any_of(places.begin(), places.end(),
                      [&](const Place& p) { return (p.foot - each.place.foot).norm() <= same; }))
        continue;
      places.push_back(each.place);
      from.push_back(each.from);
    }
  }

  /// Returns tips and ridges that may be nearer to the shape than `within`.
  TriangleSurface::Outstanding outstanding(double within) const {
    TriangleSurface::Outstanding found;
    const Vector3 middle = along_axes(body().origin);
    if (body().shape->kind == ContactShape::Kind::plane) {
      const Vector3 n = axes_.transpose() * value_of(body().axes[2]);
      triangles().find_outstanding(
          [&](const Vector3& low, const Vector3& high) {
            return n.dot(0.5 * (low + high) - middle) - n.cwiseAbs().dot(0.5 * (high - low)) <= within;
          },
          found);
      return found;
    }
    Vector3 reach = Vector3::Constant(within);
    for (std::size_t k = 0; k < 3; ++k)
      reach += body().shape->half_extent()[static_cast<Eigen::Index>(k)] *
               (axes_.transpose() * value_of(body().axes[k])).cwiseAbs();
    triangles().find_outstanding(
        [&](const Vector3& low, const Vector3& high) { return overlap(low, high, middle, reach); }, found);
    return found;
  }

  bool tip_may_touch(int number) const {
    const CoreTarget<double> still = CoreTarget<T>{body()}.template still<double>();
    return still.from(at_rest<double>(point(number))).distance < body().shape->skin();
  }
  /// Touch of a point of the surface with the shape as a whole.
  Touch<T> tip_on_body(int number) const {
    return touch_of(distance_to_core(point(number), body()), 0, body().shape->skin(), side_ == 0);
  }
  Ends<T> ridge(int number) const {
    const auto& ends = triangles().ridges()[static_cast<std::size_t>(number)].ends;
    return {point(ends[0]), point(ends[1])};
  }
  bool crosses(int ridge_number, std::size_t edge, double within) const {
    return crosses_within(ridge(ridge_number), pair_.edge(side_, edge), within);
  }
  Touch<T> crossing(int ridge_number, std::size_t edge) const {
    const Ends<T> along = ridge(ridge_number), other = pair_.edge(side_, edge);
    const double skin = body().shape->edge_skin();
    return side_ == 1 ? crossing_of(along, 0, other, skin) : crossing_of(other, skin, along, 0);
  }
  /// Touch of a corner of the shape with a ridge.
  Touch<T> corner_on_ridge(std::size_t corner, int ridge_number) const {
    const Ends<T> along = ridge(ridge_number);
    return pair_.corner_on(side_, corner, SegmentTarget<T>{along[0], along[1]}, 0);
  }
  /// Touch of an end of a ridge with an edge of the shape; a cylinder is compared as a whole.
  Touch<T> tip_on_edge(int number, std::size_t edge) const {
    if (body().shape->kind == ContactShape::Kind::cylinder) return tip_on_body(number);
    const Ends<T> ends = pair_.edge(side_, edge);
    return touch_of(distance_to_segment(point(number), ends[0], ends[1]), 0, body().shape->skin(), side_ == 0);
  }

 private:
  struct Found {
    int triangle, feature;
    Place place;
    Vector3 from;
  };
  static bool overlap(const Vector3& low, const Vector3& high, const Vector3& middle, const Vector3& reach) {
    return ((middle + reach - low).array() >= 0).all() && ((high + reach - middle).array() >= 0).all();
  }

  Found nearest_of(const PlacedDisc<T>& disc, int t) const {
    const TriangleTarget<double> target = TriangleTarget<T>{surface(), t}.template still<double>();
    PlacedDisc<double> still{at_rest<double>(disc.middle), {}};
    for (std::size_t k = 0; k < 3; ++k) still.half_axes[k] = at_rest<double>(disc.half_axes[k]);
    const Triple<double> from = nearest_of_disc(still, target);
    const auto [foot, feature] = target.nearest(value_of(from));
    Place place{feature < 0   ? Place::Kind::face
                : feature < 3 ? Place::Kind::edge
                              : Place::Kind::corner,
                foot, triangles().outward(t, feature), foot, foot};
    if (feature >= 0) place.from = triangles().corner(t, feature);
    if (place.kind == Place::Kind::edge) place.to = triangles().corner(t, feature + 1);
    // The edge between coplanar triangles is a place of their plane.
    const std::vector<int> around = triangles().sharing(t, feature);
    const Vector3 &n = triangles().normal(t), at = target.along_axes(value_of(from)), way = at - foot;
    const bool flat = std::all_of(around.begin(), around.end(),
                                  [&](int other) { return (triangles().normal(other) - n).norm() < 1e-9; });
    if (flat && n.cross(way).norm() <= 1e-6 * way.norm()) {
      place.kind = Place::Kind::face;
      place.normal = n;
    }
    return {t, feature, place, at};
  }

  /// Returns whether the nearest point is also that of the triangles that share the edge or corner.
  bool is_local(const Found& each, const std::vector<Found>& all, double same) const {
    const std::vector<int> around = triangles().sharing(each.triangle, each.feature);
    return std::all_of(around.begin(), around.end(), [&](int t) {
      const auto other = std::find_if(all.begin(), all.end(), [&](const Found& f) { return f.triangle == t; });
      return other == all.end() || (other->place.foot - each.place.foot).norm() <= same;
    });
  }

  const PairOfShapes<T>& pair_;
  std::size_t side_;
  Matrix3 axes_;
};

}  // namespace bielle::mechanism
