// Finds the convex features of a surface of triangles: ridges, at which both sides fall off (or the surface ends), and
// tips, the ends of ridges.
//
// Flat parts have none, for any number of triangles: corners and edges of the other body touch them. Collinear edges of
// consecutive triangles are one ridge. A side falls off if its slope relative to the other is at least `least_slope`:
// the corners in STL files are single-precision numbers, and are not exactly in a plane.
#include <algorithm>
#include <map>
#include <utility>

#include "mechanism/contacts/triangle_surface.hpp"

namespace bielle::mechanism {
namespace {

constexpr double least_slope = 1e-4;

void sort_once(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

/// @param edge  0 to 2, edge of a triangle
bool TriangleSurface::sticks_out(int triangle, int edge) const {
  const int other = neighbours_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(edge)];
  if (other < 0) return true;
  const Vector3 &from = corner(triangle, edge), &to = corner(triangle, edge + 1), along = (to - from).normalized();
  double lowest = 0, farthest = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3 way = corner(other, k) - from, across = way - along.dot(way) * along;
    if (across.norm() <= farthest) continue;
    farthest = across.norm();
    lowest = normal(triangle).dot(way);
  }
  return lowest < -least_slope * farthest;
}

void TriangleSurface::find_ridges() {
  using Edge = std::pair<int, int>;
  std::map<Edge, int> ridge_of_edge;                 // (smaller, larger point) -> its ridge, -1: not known yet
  std::vector<std::vector<int>> at(points_.size());  // for each point: the other ends of convex edges
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    for (int e = 0; e < 3; ++e) {
      const Triangle& corners = triangles_[static_cast<std::size_t>(t)];
      const int a = corners[static_cast<std::size_t>(e)], b = corners[static_cast<std::size_t>((e + 1) % 3)];
      if (!sticks_out(t, e) || !ridge_of_edge.emplace(std::minmax(a, b), -1).second) continue;
      at[static_cast<std::size_t>(a)].push_back(b);
      at[static_cast<std::size_t>(b)].push_back(a);
    }
  const auto point = [&](int k) -> const Vector3& { return points_[static_cast<std::size_t>(k)]; };
  const auto goes_straight_on = [&](int k) {
    const std::vector<int>& ends = at[static_cast<std::size_t>(k)];
    if (ends.size() != 2) return false;
    const Vector3 one = (point(ends[0]) - point(k)).normalized(), other = (point(ends[1]) - point(k)).normalized();
    return (one + other).norm() < least_slope;
  };
  is_tip_.assign(points_.size(), false);
  for (std::size_t k = 0; k < points_.size(); ++k)
    is_tip_[k] = !at[k].empty() && !goes_straight_on(static_cast<int>(k));
  for (auto& [edge, ridge] : ridge_of_edge) {
    if (ridge >= 0) continue;
    ridge = static_cast<int>(ridges_.size());
    const auto end_from = [&](int before, int here) {
      const int begin = before;  // a ring without corners returns to its start
      while (!is_tip_[static_cast<std::size_t>(here)] && here != begin) {
        const std::vector<int>& ends = at[static_cast<std::size_t>(here)];
        const int next = ends[0] == before ? ends[1] : ends[0];
        ridge_of_edge[std::minmax(here, next)] = ridge;
        before = std::exchange(here, next);
      }
      return here;
    };
    const int to = end_from(edge.first, edge.second), from = end_from(edge.second, edge.first);
    ridges_.push_back({point(from), point(to), {from, to}});
  }
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (is_tip_[k]) tips_.push_back(static_cast<int>(k));
  ridge_of_.assign(triangles_.size(), {-1, -1, -1});
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (const auto found = ridge_of_edge.find(std::minmax(triangles_[t][e], triangles_[t][(e + 1) % 3]));
          found != ridge_of_edge.end())
        ridge_of_[t][e] = found->second;
}

void TriangleSurface::collect(const std::vector<int>& triangles, Outstanding& found) const {
  found.tips.clear();
  found.ridges.clear();
  for (const int t : triangles) {
    for (const int corner : triangles_[static_cast<std::size_t>(t)])
      if (is_tip_[static_cast<std::size_t>(corner)]) found.tips.push_back(corner);
    for (const int ridge : ridge_of_[static_cast<std::size_t>(t)])
      if (ridge >= 0) found.ridges.push_back(ridge);
  }
  sort_once(found.tips);
  sort_once(found.ridges);
}

}  // namespace bielle::mechanism
