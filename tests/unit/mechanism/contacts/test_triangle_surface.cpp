// Surfaces of triangles: the side of sharp edges on which a point lies, and the identification of corners.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/contacts/triangle_surface.hpp"

using bielle::mechanism::TriangleSurface;
using bielle::mechanism::Vector3;

namespace {

/// Returns a wedge of 40 degrees with its ridge along y, closed but for its ends: two flanks and a bottom.
/// @param seam  distance of the left flank's upper corners from those of the right one
std::vector<Vector3> wedge(double seam = 0) {
  const double half = 20 * M_PI / 180, x = std::tan(half);
  const Vector3 a(0, -1, 0), b(0, 1, 0), right_a(x, -1, -1), right_b(x, 1, -1), left_a(-x, -1, -1), left_b(-x, 1, -1);
  const Vector3 off(0, 0, seam);
  return {a,       right_a, right_b, a,      right_b, b,       a + off, b + off, left_b,
          a + off, left_b,  left_a,  left_a, left_b,  right_b, left_a,  right_b, right_a};
}

/// Returns the same triangles from the last to the first.
std::vector<Vector3> reversed(const std::vector<Vector3>& corners) {
  std::vector<Vector3> result;
  for (std::size_t k = corners.size(); k >= 3; k -= 3)
    result.insert(result.end(), corners.begin() + static_cast<std::ptrdiff_t>(k - 3),
                  corners.begin() + static_cast<std::ptrdiff_t>(k));
  return result;
}

}  // namespace

TEST_CASE("all around a sharp ridge a point is outside, whatever the order of the triangles") {
  for (const auto& corners : {wedge(), reversed(wedge())}) {
    const TriangleSurface surface(corners);
    CHECK(surface.flipped_edges() == 0);
    CHECK(surface.open_edges() == 6);  // three at either end
    // The direction changes from the normal of one flank, over the top, to that of the other.
    for (double angle = -109; angle <= 109; angle += 1) {
      const double a = angle * M_PI / 180;
      const Vector3 point = 0.01 * Vector3(std::sin(a), 0, std::cos(a)) + Vector3(0, 0.3, 0);
      std::vector<TriangleSurface::Place> places;
      surface.find_nearest(point, 0.02, places);
      CAPTURE(angle);
      REQUIRE(places.size() == 1);
      CHECK((point - places.front().foot).dot(places.front().normal) > 0);
      // The point is inside, below the ridge.
      places.clear();
      surface.find_nearest({0.002 * std::sin(a), 0.3, -0.02}, 0.02, places);
      for (const auto& place : places)
        CHECK((Vector3(0.002 * std::sin(a), 0.3, -0.02) - place.foot).dot(place.normal) < 0);
    }
  }
}

TEST_CASE("corners that differ by rounding are one") {
  CHECK(TriangleSurface(wedge(1e-7)).open_edges() == 6);
  CHECK(TriangleSurface(wedge(1e-4)).open_edges() == 8);
}

TEST_CASE("a triangle that is listed the other way round is noticed") {
  std::vector<Vector3> corners = wedge();
  std::swap(corners[0], corners[1]);
  CHECK(TriangleSurface(corners).flipped_edges() == 2);
}

TEST_CASE("a cube of many triangles has twelve ridges and eight tips, although its faces are rounded") {
  constexpr int n = 3;
  std::vector<Vector3> corners;
  for (const int axis : {0, 1, 2})
    for (const bool far : {false, true}) {
      const auto point = [&](int i, int j) {
        const bool inside = i > 0 && i < n && j > 0 && j < n;
        Vector3 x;
        // Single precision moves corners by up to 1e-7 out of the plane.
        x[axis] = (far ? 1.0 : 0.0) + (inside ? 1e-7 * ((i + j) % 2 == 0 ? 1 : -1) : 0);
        x[(axis + 1) % 3] = static_cast<double>(i) / n;
        x[(axis + 2) % 3] = static_cast<double>(j) / n;
        return x;
      };
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          std::vector<Vector3> quad = {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)};
          if (!far) std::reverse(quad.begin(), quad.end());
          for (const int k : {0, 1, 2, 0, 2, 3}) corners.push_back(quad[static_cast<std::size_t>(k)]);
        }
    }
  const TriangleSurface surface(corners);
  CHECK(surface.open_edges() == 0);
  CHECK(surface.flipped_edges() == 0);
  CHECK(surface.ridges().size() == 12);
  CHECK(surface.tips().size() == 8);
}
