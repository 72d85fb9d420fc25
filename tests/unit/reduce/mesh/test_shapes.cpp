// Tests of the recognition of elementary surfaces from points and normals.
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/mesh/shapes.hpp"
#include "tests/support/random.hpp"

using namespace bielle::reduce;
using namespace bielle::test;
using Eigen::Vector3d;

namespace {

struct Samples {
  Eigen::Matrix3Xd x, n;
};

// A patch of a surface: position and normal as functions of two parameters, displaced and rotated in space.
template <class Position, class Normal>
Samples patch(const Position& position, const Normal& normal, double u0, double u1, double v0, double v1,
              const Eigen::Isometry3d& motion, double roughness) {
  Random random(7);
  Samples s{Eigen::Matrix3Xd(3, 48), Eigen::Matrix3Xd(3, 48)};
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 6; ++j) {
      const double u = u0 + (u1 - u0) * i / 7, v = v0 + (v1 - v0) * j / 5;
      s.x.col(6 * i + j) = motion * Vector3d(position(u, v));
      s.n.col(6 * i + j) = (motion.linear() * Vector3d(normal(u, v)) + random.vector3(roughness)).normalized();
    }
  return s;
}

Eigen::Isometry3d somewhere() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translate(Vector3d(3, -1, 2)).rotate(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  return motion;
}

}  // namespace

TEST_CASE("patches of plane, cylinder, cone, sphere and torus are recognised with their dimensions") {
  const Eigen::Isometry3d motion = somewhere();
  const Vector3d axis = motion.linear().col(2);
  // Normals are exact on a geometry, and approximate on triangles of a mesh.
  for (double roughness : {0.0, 0.1}) {
    CAPTURE(roughness);
    const auto along = [&](const Vector3d& a) { return std::abs(std::abs(a.dot(axis)) - 1); };

    const Samples flat = patch([](double u, double v) { return Vector3d(u, v, 0); },
                               [](double, double) { return Vector3d(0, 0, 1); }, 0, 0.1, 0, 0.2, motion, roughness);
    const auto plane = std::get<PlaneShape>(recognise_shape(flat.x, flat.n, 1e-7));
    CHECK(along(plane.normal) < 1e-12);
    CHECK(std::abs(axis.dot(plane.point - motion.translation())) < 1e-12);

    // The patches are a quarter of a cylinder and a whole one.
    for (double turn : {std::numbers::pi / 2, 2 * std::numbers::pi}) {
      const Samples round = patch(
          [](double u, double v) { return Vector3d(0.02 * std::cos(u), 0.02 * std::sin(u), v); },
          [](double u, double) { return Vector3d(std::cos(u), std::sin(u), 0); }, 0, turn, 0, 0.03, motion, roughness);
      const auto cylinder = std::get<CylinderShape>(recognise_shape(round.x, round.n, 1e-7));
      CHECK(along(cylinder.axis) < 1e-9);
      CHECK(cylinder.radius == Approx(0.02).margin(1e-9));
      CHECK((cylinder.point - motion * Vector3d(0, 0, 0.015)).norm() < 1e-8);
    }

    const double half = 0.3;
    const Samples pointed =
        patch([&](double u,
                  double v) { return Vector3d(v * std::tan(half) * std::cos(u), v * std::tan(half) * std::sin(u), v); },
              [&](double u, double) {
                return Vector3d(std::cos(half) * std::cos(u), std::cos(half) * std::sin(u), -std::sin(half));
              },
              0, 3, 0.02, 0.05, motion, roughness);
    const auto cone = std::get<ConeShape>(recognise_shape(pointed.x, pointed.n, 1e-7));
    CHECK(cone.half_angle == Approx(half).margin(1e-7));
    CHECK(cone.axis.dot(axis) == Approx(1).margin(1e-9));
    CHECK((cone.apex - motion.translation()).norm() < 1e-7);

    const auto direction = [](double u, double v) {
      return Vector3d(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
    };
    const Samples ball = patch([&](double u, double v) { return Vector3d(0.04 * direction(u, v)); }, direction, 0, 2,
                               -1, 1, motion, roughness);
    const auto sphere = std::get<SphereShape>(recognise_shape(ball.x, ball.n, 1e-7));
    CHECK(sphere.radius == Approx(0.04).margin(1e-10));
    CHECK((sphere.centre - motion.translation()).norm() < 1e-10);

    const Samples fillet = patch(
        [&](double u, double v) {
          return Vector3d(Vector3d(0.03 * std::cos(u), 0.03 * std::sin(u), 0) + 0.005 * direction(u, v));
        },
        direction, 0, 2, 0, 1.5, motion, roughness / 10);
    const auto torus = std::get<TorusShape>(recognise_shape(fillet.x, fillet.n, 1e-7));
    CHECK(torus.major_radius == Approx(0.03).margin(1e-7));
    CHECK(torus.minor_radius == Approx(0.005).margin(1e-7));
    CHECK(along(torus.axis) < 1e-8);
    CHECK((torus.centre - motion.translation()).norm() < 1e-7);
  }
}

TEST_CASE("a saddle is not an elementary surface, and few points are a plane or not recognised") {
  const Samples saddle = patch([](double u, double v) { return Vector3d(u, v, u * v); },
                               [](double u, double v) { return Vector3d(Vector3d(-v, -u, 1).normalized()); }, -1, 1, -1,
                               1, somewhere(), 0);
  CHECK(shape_kind(recognise_shape(saddle.x, saddle.n, 1e-5)) == "free form");
  CHECK(shape_kind(recognise_shape(saddle.x.leftCols(3), saddle.n.leftCols(3), 1e-9)) == "plane");
  Eigen::Matrix3Xd four(3, 4);
  four << 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1;
  CHECK(shape_kind(recognise_shape(four, Eigen::Matrix3Xd::Constant(3, 4, std::sqrt(1.0 / 3)), 1e-6)) == "free form");
}
