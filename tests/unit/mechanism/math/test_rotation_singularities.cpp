// Particular properties of each parametrisation of rotations: closed forms, and the behaviour at singularities.
#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/math/rotation_parameters.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::ComputationError;
using bielle::test::error;
using bielle::test::Random;
using Catch::Matchers::Contains;

namespace {

Matrix3 about(int axis, double angle) {
  Matrix3 R = Matrix3::Identity();
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  R(j, j) = R(k, k) = std::cos(angle);
  R(k, j) = std::sin(angle);
  R(j, k) = -std::sin(angle);
  return R;
}

}  // namespace

TEST_CASE("a turn about an axis has the parameters of the definitions") {
  const Vector3 e = Vector3(2, -1, 2) / 3;
  for (const double phi : {1e-9, 0.3, 1.7, 3.1}) {
    const Matrix3 R = exp_so3(phi * e);
    CHECK(error(RotationVector::parameters(R), phi * e) < 1e-15);
    Eigen::Vector4d q;
    q << std::cos(phi / 2), std::sin(phi / 2) * e;
    CHECK(error(UnitQuaternion::parameters(R), q) < 1e-15);
    const Vector3 g = std::tan(phi / 2) * e, c = 4 * std::tan(phi / 4) * e;
    CHECK(error(RodriguesVector::parameters(R), g) < 1e-15 * (1 + g.squaredNorm()));
    CHECK(error(ConformalVector::parameters(R), c) < 2e-15);
  }
}

TEST_CASE("angles are those of turns about the axes one after the other") {
  Random random(1);
  for (int k = 0; k < 20; ++k) {
    const Vector3 a = random.vector3(4);
    CHECK(error(EulerAngles::rotation(a), about(2, a[0]) * about(0, a[1]) * about(2, a[2])) < 1e-15);
    CHECK(error(BryantAngles::rotation(a), about(0, a[0]) * about(1, a[1]) * about(2, a[2])) < 1e-15);
  }
}

TEST_CASE("the conformal rotation vector agrees with its direct formulas") {
  // With c0 = 2 - c.c/8: R = I + (2 c0 c~ + 2 c~^2)/(4 - c0)^2, T = 2/(4 - c0)^2 (c0 I - c~ + c c^T/4).
  Random random(2);
  for (int k = 0; k < 20; ++k) {
    const Vector3 c = random.vector3(6);
    const double c0 = 2 - c.squaredNorm() / 8, m = 4 - c0;
    const Matrix3 s = skew(c);
    CHECK(error(ConformalVector::rotation(c), Matrix3::Identity() + (2 * c0 * s + 2 * s * s) / (m * m)) < 2e-15);
    CHECK(error(ConformalVector::tangent(c), 2 / (m * m) * (c0 * Matrix3::Identity() - s + 0.25 * c * c.transpose())) <
          2e-15);
  }
}

TEST_CASE("R T = T^T for vectors along the axis of rotation") {
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    const Vector3 p = random.vector3(3);
    const auto check = [&](auto parametrisation) {
      using P = decltype(parametrisation);
      const Matrix3 T = P::tangent(p);
      CHECK(error(P::rotation(p) * T, T.transpose()) < 2e-15);
    };
    check(RotationVector{});
    check(RodriguesVector{});
    check(ConformalVector{});
  }
}

TEST_CASE("determinants of T tell where each parametrisation is singular") {
  Random random(4);
  for (int k = 0; k < 20; ++k) {
    const Vector3 p = random.vector3(2.5);
    const double phi = p.norm(), g = p.squaredNorm();
    CHECK_THAT(RotationVector::tangent(p).determinant(), Catch::WithinAbs(2 * (1 - std::cos(phi)) / g, 2e-15));
    CHECK_THAT(RodriguesVector::tangent(p).determinant(), Catch::WithinRel(8 / ((1 + g) * (1 + g)), 1e-14));
    CHECK_THAT(ConformalVector::tangent(p).determinant(), Catch::WithinRel(std::pow(1 / (1 + g / 16), 3), 1e-14));
    CHECK_THAT(EulerAngles::tangent(p).determinant(), Catch::WithinAbs(-std::sin(p[1]), 1e-15));
    CHECK_THAT(BryantAngles::tangent(p).determinant(), Catch::WithinAbs(std::cos(p[1]), 1e-15));
  }
}

TEST_CASE("the rotation vector's rates are refused at full turns, and its principal value is regular there") {
  const Vector3 e = Vector3(1, 2, 2) / 3;
  for (const int turns : {1, 2, 5}) {
    const Vector3 psi = 2 * M_PI * turns * e;
    CHECK_THROWS_WITH(RotationVector::tangent_inverse(psi), Contains("full turn"));
    CHECK_THROWS_AS(RotationVector::tangent_inverse_derivative(psi, e), ComputationError);
    CHECK(RotationVector::principal(psi).norm() < 1e-14);
    const Vector3 beyond = (2 * M_PI * turns + 1.3) * e;
    CHECK(error(RotationVector::principal(beyond), 1.3 * e) < 1e-14);
    CHECK(error(RotationVector::tangent(beyond) * RotationVector::tangent_inverse(beyond), Matrix3::Identity()) <
          1e-13);
  }
  CHECK_THROWS_AS(RotationVector::tangent_inverse(Vector3::Constant(NAN)), ComputationError);
}

TEST_CASE("half turns have no Rodrigues vector") {
  for (int k = 0; k < 3; ++k) {
    CHECK_THROWS_WITH(RodriguesVector::parameters(about(k, M_PI)), Contains("half turn"));
    CHECK_THROWS_WITH(RodriguesVector::compose(Vector3::Unit(k), Vector3::Unit(k)), Contains("half turn"));
  }
  // Just before, the vector is long and has lost digits, but stands for the right rotation.
  const Matrix3 R = exp_so3((M_PI - 1e-9) * Vector3(0.6, 0, -0.8));
  CHECK(RodriguesVector::parameters(R).norm() > 1e9);
  CHECK(error(RodriguesVector::rotation(RodriguesVector::parameters(R)), R) < 2e-15);
  CHECK(RodriguesVector::rotation(Vector3(1e200, 0, 0)).allFinite());
  CHECK_THROWS_AS(RodriguesVector::rotation(Vector3::Constant(INFINITY)), ComputationError);
}

TEST_CASE("with its shadow the conformal rotation vector turns for ever") {
  // Ten turns about an axis, rates from the constant angular velocity, rescaled where the ball is left: the rotation
  // and the angular velocity continue across the jump.
  const Vector3 e = Vector3(2, 3, 6) / 7;
  const double step = 0.01;
  int jumps = 0;
  for (double phi = 0; phi < 20 * M_PI; phi += step) {
    const Matrix3 R = exp_so3(phi * e);
    const Vector3 c = ConformalVector::parameters(R);
    CHECK(c.norm() <= 4 * (1 + 1e-15));
    const Vector3 rate = parameter_rate<ConformalVector>(c, e);
    const Vector3 ahead = c + 2 * step * rate;  // outside of the ball near half turns
    const Vector3 shadow = ConformalVector::principal(ahead);
    if (shadow == ahead) continue;
    ++jumps;
    CHECK(shadow.norm() < 4);
    CHECK(error(ConformalVector::rotation(shadow), ConformalVector::rotation(ahead)) < 2e-15);
    const Vector3 Omega = angular_velocity<ConformalVector>(ahead, rate);
    CHECK(error(angular_velocity<ConformalVector>(shadow, parameter_rate<ConformalVector>(shadow, Omega)), Omega) <
          1e-14);
  }
  CHECK(jumps >= 10);
  CHECK_THROWS_AS(ConformalVector::principal(Vector3::Constant(INFINITY)), ComputationError);
  // However long, it stands for a rotation: all but a full turn.
  for (const double size : {1e8, 1e160, 1e300}) {
    CHECK(error(ConformalVector::rotation(size * e), Matrix3::Identity()) < 1e-6);
    CHECK(ConformalVector::rotation(size * e).allFinite());
    CHECK(error(ConformalVector::principal(size * e), -16 / size * e) < 1e-15 * 16 / size + 1e-300);
  }
}

TEST_CASE("locked angles: the rotation comes back with the last angle zero, and rates are refused") {
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const double first = random.uniform(-3, 3), last = random.uniform(-3, 3);
    for (const double b : {0.0, M_PI}) {
      const Matrix3 R = about(2, first) * about(0, b) * about(2, last);
      const Vector3 p = EulerAngles::parameters(R);
      CHECK(p[2] == 0);
      CHECK_THAT(p[1], Catch::WithinAbs(b, 1e-15));
      CHECK(error(EulerAngles::rotation(p), R) < 2e-15);
      CHECK_THROWS_WITH(EulerAngles::tangent_inverse(p), Contains("sin b = 0"));
    }
    for (const double b : {M_PI / 2, -M_PI / 2}) {
      // cos(pi/2) is 6e-17, not zero: such angles count as locked.
      const Matrix3 R = about(0, first) * about(1, b) * about(2, last);
      const Vector3 p = BryantAngles::parameters(R);
      CHECK(p[2] == 0);
      CHECK_THAT(p[1], Catch::WithinAbs(b, 1e-15));
      CHECK(error(BryantAngles::rotation(p), R) < 2e-15);
      CHECK_THROWS_WITH(BryantAngles::tangent_inverse(p), Contains("cos b = 0"));
    }
  }
}

TEST_CASE("quaternions of any length stand for a rotation, but for zero") {
  const Eigen::Vector4d p(0.5, -0.5, 0.5, 0.5);
  CHECK(error(UnitQuaternion::principal(-7 * p), p) < 1e-15);
  CHECK(error(UnitQuaternion::rotation(3 * p), UnitQuaternion::rotation(p)) < 1e-15);
  CHECK_THROWS_AS(UnitQuaternion::rotation(Eigen::Vector4d::Zero()), ComputationError);
  CHECK_THROWS_AS(UnitQuaternion::tangent(Eigen::Vector4d::Zero()), ComputationError);
  CHECK_THROWS_AS(UnitQuaternion::principal(Eigen::Vector4d::Constant(NAN)), ComputationError);
  // Rates from an angular velocity keep the length.
  CHECK(std::abs(p.dot(parameter_rate<UnitQuaternion>(p, Vector3(1, 2, 3)))) < 1e-15);
}

namespace {

/// The complement is another set of parameters of the same rotation, and the complement of that is the first one.
template <class P>
void check_complement(const typename P::Parameters& p) {
  CAPTURE(p.transpose());
  const typename P::Parameters other = P::complement(p);
  CHECK(error(P::rotation(other), P::rotation(p)) < 3e-15);
  CHECK((other - p).norm() > 0.1);
  CHECK(error(P::complement(other), p) < 3e-15 * (1 + p.norm()));
}

}  // namespace

TEST_CASE("a rotation has other parameters besides the principal ones") {
  Random random(7);
  for (int k = 0; k < 20; ++k) {
    const Matrix3 R = exp_so3(random.vector3(1.5));
    check_complement<RotationVector>(RotationVector::parameters(R));
    check_complement<UnitQuaternion>(UnitQuaternion::parameters(R));
    check_complement<ConformalVector>(ConformalVector::parameters(R));
    check_complement<EulerAngles>(EulerAngles::parameters(R));
    check_complement<BryantAngles>(BryantAngles::parameters(R));
  }
}

TEST_CASE("complements take over where the others end") {
  const Vector3 e = Vector3(2, -1, 2) / 3;
  CHECK(error(RotationVector::complement(M_PI * e), -M_PI * e) < 1e-15);
  CHECK(error(RotationVector::complement(6 * e), (6 - 2 * M_PI) * e) < 1e-15);
  CHECK(error(ConformalVector::complement(4 * e), -4 * e) < 2e-15);
  CHECK(error(EulerAngles::complement(Vector3(0.3, 0.1, -0.2)), Vector3(0.3 - M_PI, -0.1, M_PI - 0.2)) < 1e-15);
  CHECK(error(BryantAngles::complement(Vector3(0.3, 1.5, -0.2)), Vector3(0.3 - M_PI, M_PI - 1.5, M_PI - 0.2)) < 1e-15);
  CHECK_THROWS_WITH(RotationVector::complement(Vector3::Zero()), Contains("no complement"));
  CHECK_THROWS_WITH(ConformalVector::complement(Vector3::Zero()), Contains("infinite"));
  CHECK_THROWS_WITH(RodriguesVector::complement(e), Contains("only one"));
}
