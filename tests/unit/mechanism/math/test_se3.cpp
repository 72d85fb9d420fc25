// One battery of identities for rigid motions; derivatives against finite differences; one check
// number (tests/references/rigid_motions.py).
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <unsupported/Eigen/MatrixFunctions>

#include "mechanism/math/se3.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/random.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using bielle::test::derivative;
using bielle::test::Random;

namespace test_se3 {
namespace {

const double angles[] = {
    0,   1e-16,       1e-12,       1e-8,        1e-5,        1e-3, 0.3, 1, 2.5, series_angle - 1e-9, series_angle,
    3.1, M_PI - 1e-3, M_PI - 1e-6, M_PI - 1e-9, M_PI - 1e-13};

constexpr double rounding = 1e-14;    // products of 6x6 matrices with entries up to ~3
constexpr double difference = 2e-11;  // see finite_difference.hpp

using bielle::test::error;
double error(const Frame& A, const Frame& B) { return std::max(error(A.x, B.x), error(A.R, B.R)); }

Vector6 motion(Random& random, double angle) {
  Vector6 d;
  d << random.vector3(2), random.vector_of_length(angle);
  return d;
}

}  // namespace

TEST_CASE("frames compose, invert, and transform velocities by the adjoint") {
  Random random(1);
  const Frame A = exp_se3(motion(random, 1.0)), B = exp_se3(motion(random, 2.0)), C = exp_se3(motion(random, 3.0));
  CHECK(error((A * B) * C, A * (B * C)) < rounding);
  CHECK(error(A * inverse(A), Frame{}) < rounding);
  CHECK(error(adjoint(A * B), adjoint(A) * adjoint(B)) < rounding);
  const Vector6 d = motion(random, 0.7);
  const Vector6 Ad_d = adjoint(A) * d;
  CHECK(error(A * exp_se3(d) * inverse(A), exp_se3(Ad_d)) < rounding);
}

TEST_CASE("the exponential of a rigid motion is undone by the logarithm") {
  Random random(2);
  for (double angle : angles) {
    CAPTURE(angle);
    const Vector6 d = motion(random, angle);
    const Frame H = exp_se3(d);
    CHECK(error(log_se3(H), d) < rounding);
    CHECK(error(H * exp_se3(-d), Frame{}) < rounding);
    CHECK(error(exp_se3(0.5 * d) * exp_se3(0.5 * d), H) < rounding);
  }
  Vector6 d;
  d << 1.1, 0.1, -0.05, 0.2, -0.3, 0.4;
  CHECK(error(exp_se3(d).x, bielle::test::ReferenceTable("rigid_motions").vector("exponential")) < 1e-10);
}

TEST_CASE("the logarithm of half turns gives them back, up to the sign of the axis") {
  Random random(8);
  std::vector<Vector3> axes{Vector3::UnitX(), -Vector3::UnitY(), Vector3::UnitZ(), Vector3(1, 1, 0).normalized(),
                            Vector3(1, -1, 1).normalized()};
  for (int k = 0; k < 10; ++k) axes.push_back(random.vector_of_length(1));
  for (const Vector3& axis : axes)
    for (const double off : {0.0, 1e-15, -1e-15, 1e-9, 1e-3}) {
      CAPTURE(axis.transpose(), off);
      Vector6 d;
      d << random.vector3(2), (M_PI + off) * axis;
      const Frame H = exp_se3(d);
      const Vector6 log = log_se3(H);
      CHECK(log.tail<3>().norm() <= M_PI * (1 + 1e-15));
      CHECK(error(exp_se3(log), H) < rounding);
      // Beyond pi it is the shorter way round.
      CHECK_THAT(log.tail<3>().norm(), Catch::WithinAbs(M_PI - std::abs(off), 1e-14));
    }
}

TEST_CASE("tangents of rigid motions are regular at half turns and beyond, up to full turns") {
  Random random(9);
  for (const double angle : {M_PI, M_PI + 1e-9, M_PI + 1e-3, 4.0, 5.5, 6.2}) {
    CAPTURE(angle);
    const Vector6 d = motion(random, angle), e = random.vector(6), f = random.vector(6);
    const Matrix6 T = tangent_se3(d), Tinv = tangent_se3_inverse(d);
    const double size = 1 + T.norm() * Tinv.norm();
    CHECK(error(T * Tinv, Matrix6::Identity()) < rounding * size);
    CHECK(error(T, adjoint(exp_se3(-d)) * tangent_se3(-d)) < rounding);
    CHECK(error(tangent_se3_derivative(d, e), derivative([&](double s) { return tangent_se3(d + s * e); })) <
          difference);
    // The inverse has its pole at full turns: steps shorten on the way there.
    const double h = bielle::test::difference_step * std::min(1.0, 2 * M_PI - angle);
    const MatrixX G = bielle::test::jacobian(
        [&](const VectorX& s) -> VectorX { return tangent_se3_inverse(d + s).transpose() * f; }, 6, h);
    const Matrix6 exact = inverse_transpose_gradient_se3(d, f);
    CHECK(error(exact, G) < difference * (1 + exact.norm() / (2 * M_PI - angle)));
  }
}

TEST_CASE("Ad of the exponential is the matrix exponential of ad, and T6 its series") {
  Random random(3);
  for (double angle : angles) {
    CAPTURE(angle);
    const Vector6 d = motion(random, angle);
    const Matrix6 ad = little_adjoint(d);
    const Matrix6 expm = ad.exp();
    CHECK(error(adjoint(exp_se3(d)), expm) < 1e-13);
    Matrix6 T6 = Matrix6::Zero(), term = Matrix6::Identity();
    for (int k = 0; k < 40; ++k) {
      T6 += term;
      term = -term * ad / (k + 2);
    }
    CHECK(error(tangent_se3(d), T6) < 1e-13);
    CHECK(error(tangent_se3(-d), adjoint(exp_se3(d)) * tangent_se3(d)) < rounding);
    CHECK(error(tangent_se3(d) * tangent_se3_inverse(d), Matrix6::Identity()) < rounding);
    CHECK(error(tangent_se3_inverse(d) * d, d) < rounding);
  }
}

TEST_CASE("T6 maps the rate of the coordinates to the body velocity") {
  Random random(4);
  for (double angle : angles) {
    CAPTURE(angle);
    const Vector6 d = motion(random, angle), rate = random.vector(6);
    const Frame H = exp_se3(d);
    const Vector3 v = H.R.transpose() * derivative([&](double s) -> Vector3 { return exp_se3(d + s * rate).x; });
    const Matrix3 W = H.R.transpose() * derivative([&](double s) -> Matrix3 { return exp_se3(d + s * rate).R; });
    Vector6 velocity;
    velocity << v, skew_vector(W);
    CHECK(error(velocity, tangent_se3(d) * rate) < difference);
  }
}

TEST_CASE("gradients of the inverse tangent operator are those of finite differences") {
  Random random(5);
  for (double angle : angles) {
    CAPTURE(angle);
    const Vector6 d = motion(random, angle), f = random.vector(6);
    const Matrix6 G = inverse_transpose_gradient_se3(d, f), D = tangent_se3_inverse_gradient(d, f);
    const MatrixX G_difference = bielle::test::jacobian(
        [&](const VectorX& s) -> VectorX { return tangent_se3_inverse(d + s).transpose() * f; }, 6);
    const MatrixX D_difference =
        bielle::test::jacobian([&](const VectorX& s) -> VectorX { return tangent_se3_inverse(d + s) * f; }, 6);
    CHECK(error(G, G_difference) < difference);
    CHECK(error(D, D_difference) < difference);
  }
}

TEST_CASE("derivatives of T6 and its inverse are those of finite differences") {
  Random random(6);
  for (double angle : angles) {
    CAPTURE(angle);
    const Vector6 d = motion(random, angle), e = random.vector(6), f = random.vector(6);
    const Matrix6 D = tangent_se3_derivative(d, e), Dinv = tangent_se3_inverse_derivative(d, e);
    CHECK(error(D, derivative([&](double s) { return tangent_se3(d + s * e); })) < difference);
    CHECK(error(Dinv, derivative([&](double s) { return tangent_se3_inverse(d + s * e); })) < difference);
    // The gradient by d at fixed w contains the same derivatives in another order.
    CHECK(error(Dinv * f, tangent_se3_inverse_gradient(d, f) * e) < 1e-13);
    // Compatibility of velocities and variations (Maurer-Cartan): D[e] f - D[f] e = ad of the two body velocities.
    const Vector6 left = D * f - tangent_se3_derivative(d, f) * e;
    CHECK(error(left, -little_adjoint(tangent_se3(d) * e) * (tangent_se3(d) * f)) < 1e-13);
  }
}

TEST_CASE("ad is the rate of Ad, antisymmetric, and obeys Jacobi's identity") {
  Random random(7);
  const Vector6 a = random.vector(6), b = random.vector(6), c = random.vector(6);
  CHECK(error(little_adjoint(a), derivative([&](double s) { return adjoint(exp_se3(s * a)); })) < difference);
  CHECK(error(little_adjoint(a) * b, -little_adjoint(b) * a) < 1e-15);
  const Matrix6 A = little_adjoint(a), B = little_adjoint(b);
  CHECK(error(little_adjoint(A * b), A * B - B * A) < rounding);
  CHECK(error(little_adjoint(a) * (B * c) + B * (little_adjoint(c) * a) + little_adjoint(c) * (A * b),
              VectorX::Zero(6)) < rounding);
}

}  // namespace test_se3
