// Surfaces of triangles: three corners of each, one after the other, anticlockwise seen from outside.
#pragma once

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::test {

using Corners = std::vector<mechanism::Vector3>;

inline void add_quad(Corners& corners, const mechanism::Vector3& a, const mechanism::Vector3& b,
                     const mechanism::Vector3& c, const mechanism::Vector3& d) {
  corners.insert(corners.end(), {a, b, c, a, c, d});
}

/// Returns a floor at z = 0 of n x n squares within +-half, cut along their diagonals.
inline Corners floor_of_triangles(double half, int n) {
  Corners corners;
  const auto at = [&](int k) { return half * (2. * k / n - 1); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      add_quad(corners, {at(i), at(j), 0}, {at(i + 1), at(j), 0}, {at(i + 1), at(j + 1), 0}, {at(i), at(j + 1), 0});
  return corners;
}

/// Returns a closed box, each face of two triangles.
inline Corners box_of_triangles(const mechanism::Vector3& half) {
  Corners corners;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1., 1.}) {
      using mechanism::Vector3;
      const Vector3 n = side * half[axis] * Vector3::Unit(axis),
                    u = half[(axis + 1) % 3] * Vector3::Unit((axis + 1) % 3),
                    v = side * half[(axis + 2) % 3] * Vector3::Unit((axis + 2) % 3);
      add_quad(corners, n - u - v, n + u - v, n + u + v, n - u + v);
    }
  return corners;
}

/// Returns a wedge on z = 0 that rises along x from 0 to `length` at an angle, +-half wide along y.
inline Corners wedge_of_triangles(double length, double angle, double half) {
  const double h = length * std::tan(angle);
  const mechanism::Vector3 a(0, -half, 0), b(0, half, 0), c(length, -half, 0), d(length, half, 0), e(length, -half, h),
      f(length, half, h);
  Corners corners;
  add_quad(corners, a, e, f, b);
  add_quad(corners, c, d, f, e);
  add_quad(corners, a, b, d, c);
  corners.insert(corners.end(), {a, c, e, b, f, d});
  return corners;
}

/// Returns a ball: an octahedron whose triangles are each divided in four, `levels` times, its corners on the ball.
inline Corners ball_of_triangles(double radius, int levels) {
  using mechanism::Vector3;
  Corners corners;
  for (const double x : {-1., 1.})
    for (const double y : {-1., 1.})
      for (const double z : {-1., 1.}) {
        const Vector3 a(x, 0, 0), b(0, y, 0), c(0, 0, z);
        if (x * y * z > 0)
          corners.insert(corners.end(), {a, b, c});
        else
          corners.insert(corners.end(), {a, c, b});
      }
  for (int level = 0; level < levels; ++level) {
    Corners finer;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const Vector3 &a = corners[k], &b = corners[k + 1], &c = corners[k + 2];
      const Vector3 ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    corners = finer;
  }
  for (Vector3& corner : corners) corner *= radius;
  return corners;
}

inline void write_triangles(const std::string& path, const Corners& corners) {
  std::ofstream file(path);
  file.precision(17);
  file << "solid s\n";
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    file << " facet normal 0 0 0\n  outer loop\n";
    for (std::size_t c = k; c < k + 3; ++c)
      file << "   vertex " << corners[c].x() << " " << corners[c].y() << " " << corners[c].z() << "\n";
    file << "  endloop\n endfacet\n";
  }
  file << "endsolid s\n";
}

}  // namespace bielle::test
