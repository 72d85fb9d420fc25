// Rotational coordinates of interfaces: agreement to first order, blindness to free rotations, and every derivative
// against finite differences.
#include <catch2/catch.hpp>

#include "mechanism/elements/superelement/interface_rotation.hpp"
#include "mechanism/math/so3.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::derivative;
using bielle::test::error;
using bielle::test::jacobian;
using bielle::test::Random;
using Kind = InterfaceRotation::Kind;

namespace {

constexpr std::array<std::array<bool, 3>, 8> all_kept = {{{true, true, true},
                                                          {true, true, false},
                                                          {true, false, true},
                                                          {false, true, true},
                                                          {true, false, false},
                                                          {false, true, false},
                                                          {false, false, true},
                                                          {false, false, false}}};

}  // namespace

TEST_CASE("a rotational coordinate is the kept part of a small rotation vector") {
  Random random(1);
  for (const auto& kept : all_kept) {
    const Matrix3 axes = exp_so3(random.vector3(2));
    const InterfaceRotation rotation(axes, kept);
    Matrix3 keep = Matrix3::Zero();
    for (int k = 0; k < 3; ++k)
      if (kept[static_cast<std::size_t>(k)]) keep += axes.col(k) * axes.col(k).transpose();
    CHECK(error(rotation.differential(Matrix3::Identity()), keep) < 1e-15);
    const Vector3 small = random.vector3(1e-6);
    // The difference is of higher order: 1e-12.
    CHECK(error(rotation.coordinate(exp_so3(small)), keep * small) < 1e-11);
  }
}

TEST_CASE("turns about free axes leave no trace in the rotational coordinate") {
  Random random(2);
  for (int k = 0; k < 3; ++k) {
    const Matrix3 axes = exp_so3(random.vector3(2));
    const Vector3 e = axes.col(k);
    std::array<bool, 3> kept = {true, true, true};
    kept[static_cast<std::size_t>(k)] = false;
    const InterfaceRotation tilt(axes, kept);
    REQUIRE(tilt.kind() == Kind::tilt);
    const Matrix3 E = exp_so3(random.vector3(0.3));
    for (double angle : {0.1, 1.0, M_PI, 4.0, 2 * M_PI})
      CHECK(error(tilt.coordinate(E * exp_so3(angle * e)), tilt.coordinate(E)) < 1e-14);

    const InterfaceRotation twist(axes, {k == 0, k == 1, k == 2});
    REQUIRE(twist.kind() == Kind::twist);
    const Vector3 across = axes.col((k + 1) % 3) + 0.7 * axes.col((k + 2) % 3);
    for (double angle : {0.1, 1.0, 2.5}) {
      // A tilt about any axis normal to e has no twist; after it, the twist is the sine of the turn about e.
      CHECK(twist.coordinate(exp_so3(angle * across.normalized())).norm() < 1e-14);
      CHECK(error(twist.coordinate(exp_so3(angle * across.normalized()) * exp_so3(0.2 * e)), std::sin(0.2) * e) <
            1e-14);
    }
  }
}

TEST_CASE("derivatives of rotational coordinates hold against finite differences") {
  Random random(3);
  constexpr double difference = 3e-11;  // see finite_difference.hpp; third derivatives grow with the angle
  for (const auto& kept : all_kept)
    for (double size : {0.0, 1e-8, 0.1, 0.8}) {
      const InterfaceRotation rotation(exp_so3(random.vector3(2)), kept);
      const Matrix3 E = exp_so3(random.vector3(size));
      const Vector3 r = random.vector3(), m = random.vector3();
      const auto turned = [&](const VectorX& phi) { return Matrix3(exp_so3(Vector3(phi)) * E); };
      CAPTURE(kept, size);
      CHECK(error(rotation.differential(E),
                  jacobian([&](const VectorX& phi) -> VectorX { return rotation.coordinate(turned(phi)); }, 3)) <
            difference);
      CHECK(error(rotation.gradient(E, r),
                  jacobian([&](const VectorX& phi) -> VectorX { return rotation.differential(turned(phi)) * r; }, 3)) <
            difference);
      CHECK(error(rotation.transpose_gradient(E, m),
                  jacobian(
                      [&](const VectorX& phi) -> VectorX { return rotation.differential(turned(phi)).transpose() * m; },
                      3)) < difference);
      CHECK(error(rotation.differential_rate(E, r), derivative([&](double s) {
                    return Matrix3(rotation.differential(exp_so3(s * r) * E));
                  })) < difference);
      CHECK(
          error(rotation.rate_gradient(E, r),
                jacobian([&](const VectorX& phi) -> VectorX { return rotation.differential_rate(turned(phi), r) * r; },
                         3)) < difference);
    }
}
