// One battery of identities for finite rotations, at rest, at 1e-8, at random angles, around the series' threshold and
// around pi; derivatives against finite differences.
#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/math/so3.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::derivative;
using bielle::test::error;
using bielle::test::Random;

namespace test_so3 {
namespace {

const double angles[] = {
    0,   1e-12, 1e-8,        1e-5,        1e-4, 1e-3, 0.1, 1, 1.4999, 1.5, series_angle - 1e-9, series_angle,
    2.5, 3.1,   M_PI - 1e-6, M_PI - 1e-9, M_PI};

// Products of a few 3x3 matrices with entries up to ~1: some ten roundings of 1.1e-16.
constexpr double rounding = 3e-15;
// Finite differences: see finite_difference.hpp.
constexpr double difference = 1e-11;

}  // namespace

TEST_CASE("the exponential is a rotation, turns with its axis and is undone by the logarithm") {
  Random random(1);
  for (double angle : angles) {
    CAPTURE(angle);
    for (int k = 0; k < 5; ++k) {
      const Vector3 psi = random.vector_of_length(angle);
      const Matrix3 R = exp_so3(psi);
      CHECK(error(R * R.transpose(), Matrix3::Identity()) < rounding);
      CHECK_THAT(R.determinant(), Catch::WithinAbs(1, rounding));
      CHECK(error(R * psi, psi) < rounding * (1 + angle));
      CHECK(error(R * exp_so3(-psi), Matrix3::Identity()) < rounding);
      CHECK(error(exp_so3(0.5 * psi) * exp_so3(0.5 * psi), R) < rounding);
      // At pi the axis' sign is arbitrary: both vectors are the same rotation.
      const Vector3 back = log_so3(R);
      CHECK(back.norm() <= M_PI + 1e-15);
      CHECK(error(exp_so3(back), R) < rounding);
      if (angle < M_PI) CHECK(error(back, psi) < rounding + 1e-14 * angle);
      if (angle > 0 && angle < 1e-2) CHECK(error(back, psi) < 4e-16 * angle);
    }
  }
}

TEST_CASE("the logarithm beyond pi is the principal value") {
  const Vector3 e = Vector3(1, 2, -2) / 3;
  CHECK(error(log_so3(exp_so3(4.0 * e)), (4.0 - 2 * M_PI) * e) < 1e-14);
  CHECK(log_so3(exp_so3(2 * M_PI * e)).norm() < 1e-14);
  for (int k = 0; k < 3; ++k) {
    // Half turns about the axes: quaternions with w = 0.
    const Vector3 half = log_so3(exp_so3(M_PI * Vector3::Unit(k)));
    CHECK_THAT(std::abs(half[k]), Catch::WithinAbs(M_PI, 1e-15));
    CHECK_THAT(half.norm(), Catch::WithinAbs(M_PI, 1e-15));
  }
}

TEST_CASE("the exponential agrees with the closed form of a turn about a coordinate axis") {
  for (double angle : {1e-9, 0.3, 1.9, 2.1, 3.0, 5.0}) {
    Matrix3 Rz;
    Rz << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
    CHECK(error(exp_so3(Vector3(0, 0, angle)), Rz) < 1e-15);
  }
}

TEST_CASE("quaternions stand for the same rotation whichever component is the largest") {
  Random random(2);
  for (int k = 0; k < 200; ++k) {
    const Matrix3 R = exp_so3(random.vector_of_length(random.uniform(0, M_PI)));
    const Eigen::Vector4d q = quaternion_of(R);
    CHECK_THAT(q.norm(), Catch::WithinAbs(1, 1e-15));
    CHECK(q[0] >= 0);
    CHECK(error(rotation_of_quaternion(q), R) < rounding);
    CHECK(error(rotation_of_quaternion(-3 * q), R) < rounding);
  }
  CHECK_THROWS_AS(rotation_of_quaternion(Eigen::Vector4d::Zero()), bielle::ComputationError);
}

TEST_CASE("the tangent operators are inverse, R T = T^T, and det T = 2 (1 - cos phi)/phi^2") {
  Random random(3);
  for (double angle : angles) {
    CAPTURE(angle);
    const Vector3 psi = random.vector_of_length(angle);
    const Matrix3 T = tangent(psi), R = exp_so3(psi);
    CHECK(error(T * tangent_inverse(psi), Matrix3::Identity()) < rounding);
    CHECK(error(R * T, T.transpose()) < rounding);
    CHECK(error(tangent(-psi), T.transpose()) < rounding);
    CHECK_THAT(T.determinant(), Catch::WithinAbs(2 * ExpCoefficients(angle * angle).a2, rounding));
    CHECK(error(T * psi, psi) < rounding * (1 + angle));
  }
}

TEST_CASE("T maps the rate of the rotation vector to the body angular velocity") {
  Random random(4);
  for (double angle : angles) {
    CAPTURE(angle);
    const Vector3 psi = random.vector_of_length(angle), rate = random.vector3();
    const Matrix3 Rdot = derivative([&](double s) { return exp_so3(psi + s * rate); });
    const Matrix3 Omega = exp_so3(psi).transpose() * Rdot;
    CHECK(error(Omega, skew(tangent(psi) * rate)) < difference);
    CHECK(error(skew_vector(Omega), tangent(psi) * rate) < difference);
  }
}

TEST_CASE("the second derivative of the tangent operator is that of finite differences, and symmetric") {
  Random random(6);
  for (double angle : angles) {
    CAPTURE(angle);
    const Vector3 psi = random.vector_of_length(angle), u = random.vector3(), w = random.vector3();
    const Matrix3 D2T = tangent_second_derivative(psi, u, w);
    CHECK(error(D2T, derivative([&](double s) { return tangent_derivative(psi + s * w, u); })) < difference);
    CHECK(error(D2T, tangent_second_derivative(psi, w, u)) < rounding);
  }
}

TEST_CASE("derivatives of the tangent operators are those of finite differences") {
  Random random(5);
  for (double angle : angles) {
    CAPTURE(angle);
    for (int k = 0; k < 3; ++k) {
      const Vector3 psi = random.vector_of_length(angle), u = random.vector3(), n = random.vector3();
      const Matrix3 DT = tangent_derivative(psi, u), DTinv = tangent_inverse_derivative(psi, u);
      CHECK(error(DT, derivative([&](double s) { return tangent(psi + s * u); })) < difference);
      CHECK(error(DTinv, derivative([&](double s) { return tangent_inverse(psi + s * u); })) < difference);
      const Matrix3 Tinv = tangent_inverse(psi);
      CHECK(error(DTinv, -Tinv * DT * Tinv) < 1e-14);
      const Matrix3 g = inverse_transpose_gradient(psi, n), h = inverse_transpose_hessian(psi, u, n);
      for (int j = 0; j < 3; ++j) {
        const Vector3 e = Vector3::Unit(j);
        const Vector3 g_column =
            derivative([&](double s) -> Vector3 { return tangent_inverse(psi + s * e).transpose() * n; });
        const Vector3 h_column =
            derivative([&](double s) -> Vector3 { return inverse_transpose_gradient(psi + s * e, n) * u; });
        CHECK(error(g.col(j), g_column) < difference);
        CHECK(error(h.col(j), h_column) < difference);
      }
      // h is the second derivative of a potential-like map: d2(T^-T n)[u, w] is symmetric in u and w.
      const Vector3 w = random.vector3();
      CHECK(error(h * w, inverse_transpose_hessian(psi, w, n) * u) < 1e-14);
    }
  }
}

}  // namespace test_so3
