// One battery of identities over all parametrisations of rotations: at rest, close to it, at random angles, around half
// turns and beyond, and around each one's own singularities; derivatives against finite differences.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/math/rotation_parameters.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::ComputationError;
using bielle::test::derivative;
using bielle::test::error;
using bielle::test::Random;

#define ALL_PARAMETRISATIONS RotationVector, UnitQuaternion, RodriguesVector, ConformalVector, EulerAngles, BryantAngles

namespace test_rotation_parameters {
namespace {

constexpr double rounding = 3e-15;    // products of a few 3x3 matrices with entries up to 1
constexpr double difference = 2e-11;  // see finite_difference.hpp

const double angles[] = {0,           1e-12,       1e-8,        1e-4, 0.1,         1,           2,          3,
                         M_PI - 1e-3, M_PI - 1e-6, M_PI - 1e-9, M_PI, M_PI + 1e-9, M_PI + 1e-3, M_PI + 1.2, 6.2};

/// Rotations by every angle about random axes and about the coordinate axes, where the angles' own singularities lie.
std::vector<Matrix3> rotations() {
  Random random(11);
  std::vector<Matrix3> all;
  for (const double angle : angles) {
    all.push_back(exp_so3(random.vector_of_length(angle)));
    for (int k = 0; k < 3; ++k) all.push_back(exp_so3(angle * Vector3::Unit(k)));
  }
  // Middle angles at and around 0, pi/2 and pi, with random first and last ones.
  for (const double middle : {0.0, M_PI / 2, M_PI, -M_PI / 2})
    for (const double off : {0.0, 1e-14, 1e-9, -1e-7, 1e-3})
      for (const auto rotation : {&EulerAngles::rotation, &BryantAngles::rotation})
        all.push_back(rotation({random.uniform(-3, 3), middle + off, random.uniform(-3, 3)}));
  return all;
}

bool is_half_turn(const Matrix3& R) { return quaternion_of(R)[0] < 4e-16; }

template <class P>
constexpr bool is_rodrigues = std::is_same_v<P, RodriguesVector>;

/// Returns the parameters, or nothing where the parametrisation has none.
template <class P>
std::vector<typename P::Parameters> parameters_of(const Matrix3& R) {
  if (is_rodrigues<P> && is_half_turn(R)) {
    CHECK_THROWS_AS(P::parameters(R), ComputationError);
    return {};
  }
  return {P::parameters(R)};
}

/// Returns random parameters of moderate size, also beyond the principal domain, where T is well away from singular.
template <class P>
typename P::Parameters regular(Random& random) {
  for (;;) {
    const typename P::Parameters p = random.vector(P::Parameters::RowsAtCompileTime, 3);
    const Matrix3 TTt = P::tangent(p) * P::tangent(p).transpose();
    if (p.norm() > 0.3 && p.norm() < 5 && TTt.determinant() > 0.01) return p;
  }
}

/// Returns the size of the numbers that T and T^-1 bring into a product.
template <class P>
double condition(const typename P::Parameters& p) {
  return 1 + P::tangent(p).cwiseAbs().maxCoeff() * P::tangent_inverse(p).cwiseAbs().maxCoeff();
}

/// Returns a fifth of the length on which the rotation varies: 1, but where Rodrigues vectors are long.
template <class P>
double scale(const typename P::Parameters& p) {
  return 0.2 * (is_rodrigues<P> ? std::max(1.0, p.norm()) : 1.0);
}

/// Returns whether T^-1 exists; where it is refused, T must be singular, or nearly.
template <class P>
bool has_inverse(const typename P::Parameters& p) {
  try {
    P::tangent_inverse(p);
    return true;
  } catch (const ComputationError& e) {
    CHECK(std::string(e.what()).size() > 40);
    CHECK((P::tangent(p) * P::tangent(p).transpose()).determinant() < 1e-14);
    return false;
  }
}

}  // namespace

TEMPLATE_TEST_CASE("parameters of a rotation give it back, everywhere that they exist", "", ALL_PARAMETRISATIONS) {
  using P = TestType;
  for (const Matrix3& R : rotations())
    for (const auto& p : parameters_of<P>(R)) {
      CAPTURE(R, p);
      CHECK(p.allFinite());
      CHECK(error(P::rotation(p), R) < rounding);
      CHECK(error(P::rotation(P::principal(p)), R) < rounding);
    }
}

TEMPLATE_TEST_CASE("parameters in the principal domain are found again", "", ALL_PARAMETRISATIONS) {
  using P = TestType;
  Random random(12);
  for (int k = 0; k < 200; ++k) {
    const auto p = regular<P>(random);
    CAPTURE(p);
    const auto principal = P::principal(p);
    CHECK(error(P::rotation(principal), P::rotation(p)) < rounding);
    // Lost digits: those that the rotation does not determine (near half turns for Rodrigues, locked angles, ...).
    CHECK(error(P::parameters(P::rotation(p)), principal) < rounding * 10 * condition<P>(principal));
    CHECK(error(P::principal(principal), principal) < rounding * condition<P>(principal));
  }
}

TEMPLATE_TEST_CASE("composition is the product of rotations", "", ALL_PARAMETRISATIONS) {
  using P = TestType;
  Random random(13);
  for (const Matrix3& A : rotations())
    for (const auto& p : parameters_of<P>(A)) {
      const Matrix3 B = exp_so3(random.vector_of_length(2));
      CAPTURE(A, B);
      CHECK(error(P::rotation(P::compose(p, P::parameters(B))), A * B) < 3 * rounding);
      CHECK(error(P::rotation(P::compose(P::parameters(B), p)), B * A) < 3 * rounding);
      // A rotation and its inverse.
      for (const auto& inverse : parameters_of<P>(A.transpose()))
        CHECK(error(P::rotation(P::compose(p, inverse)), Matrix3::Identity()) < 3 * rounding);
    }
}

TEMPLATE_TEST_CASE("T maps rates to the body angular velocity and T^-1 back", "", ALL_PARAMETRISATIONS) {
  using P = TestType;
  Random random(14);
  const auto check = [&](const typename P::Parameters& p) {
    CAPTURE(p);
    const typename P::Parameters rate = random.vector(p.size(), scale<P>(p));
    const Matrix3 Rdot = derivative([&](double s) { return P::rotation(p + s * rate); });
    CHECK(error(P::rotation(p).transpose() * Rdot, skew(angular_velocity<P>(p, rate))) < difference);
    if (!has_inverse<P>(p)) return;
    CHECK(error(P::tangent(p) * P::tangent_inverse(p), Matrix3::Identity()) < rounding * condition<P>(p));
    const Vector3 Omega = random.vector3();
    CHECK(error(angular_velocity<P>(p, parameter_rate<P>(p, Omega)), Omega) < rounding * condition<P>(p));
  };
  for (const Matrix3& R : rotations())
    for (const auto& p : parameters_of<P>(R)) check(p);
  for (int k = 0; k < 50; ++k) check(regular<P>(random));
}

TEMPLATE_TEST_CASE("derivatives of T and T^-1 are those of finite differences", "", ALL_PARAMETRISATIONS) {
  using P = TestType;
  Random random(15);
  const auto check = [&](const typename P::Parameters& p) {
    CAPTURE(p);
    const typename P::Parameters u = random.vector(p.size(), scale<P>(p));
    using Tangent = typename P::Tangent;
    using Inverse = typename P::Inverse;
    const Tangent DT = P::tangent_derivative(p, u);
    CHECK(error(DT, derivative([&](double s) -> Tangent { return P::tangent(p + s * u); })) < difference);
    if (!has_inverse<P>(p)) return;
    // T T^-1 = I holds along u.
    const Inverse DTinv = P::tangent_inverse_derivative(p, u);
    const double size = P::tangent(p).norm() * DTinv.norm() + DT.norm() * P::tangent_inverse(p).norm();
    CHECK(error(P::tangent(p) * DTinv + DT * P::tangent_inverse(p), Matrix3::Zero()) < rounding * (1 + size));
  };
  for (const Matrix3& R : rotations())
    for (const auto& p : parameters_of<P>(R)) check(p);
  for (int k = 0; k < 50; ++k) {
    const auto p = regular<P>(random);
    check(p);
    using Inverse = typename P::Inverse;
    const typename P::Parameters u = random.vector(p.size(), 0.1);
    const Inverse D = derivative([&](double s) -> Inverse { return P::tangent_inverse(p + s * u); });
    const Inverse DTinv = P::tangent_inverse_derivative(p, u);
    CHECK(error(DTinv, D) < difference * (1 + D.norm()));
  }
}

TEMPLATE_TEST_CASE("accelerations of the parameters give the angular acceleration and come back", "",
                   ALL_PARAMETRISATIONS) {
  using P = TestType;
  Random random(16);
  const auto check = [&](const typename P::Parameters& p) {
    CAPTURE(p);
    const typename P::Parameters rate = random.vector(p.size(), scale<P>(p)),
                                 acceleration = random.vector(p.size(), scale<P>(p));
    const Vector3 Omegadot = derivative([&](double t) -> Vector3 {
      return angular_velocity<P>(p + t * rate + 0.5 * t * t * acceleration, rate + t * acceleration);
    });
    CHECK(error(angular_acceleration<P>(p, rate, acceleration), Omegadot) < difference);
    // The rotation itself, twice differentiated: R^T Rddot = Omegadot~ + Omega~ Omega~.
    const Vector3 Omega = angular_velocity<P>(p, rate);
    const Matrix3 Rddot = derivative([&](double t) -> Matrix3 {
      const typename P::Parameters q = p + t * rate + 0.5 * t * t * acceleration;
      return P::rotation(q) * skew(angular_velocity<P>(q, rate + t * acceleration));
    });
    const Matrix3 expected = skew(angular_acceleration<P>(p, rate, acceleration)) + skew(Omega) * skew(Omega);
    CHECK(error(P::rotation(p).transpose() * Rddot, expected) < difference);
    if (!has_inverse<P>(p)) {
      CHECK_THROWS_AS(parameter_acceleration<P>(p, Omega, Omegadot), ComputationError);
      return;
    }
    const Vector3 Omega_given = random.vector3(), alpha = random.vector3();
    const auto pdot = parameter_rate<P>(p, Omega_given);
    const auto pddot = parameter_acceleration<P>(p, Omega_given, alpha);
    // Digits lost: products of T with pddot and of its derivative with pdot twice.
    const double size = P::tangent(p).norm() * pddot.norm() + P::tangent_derivative(p, pdot).norm() * pdot.norm();
    CHECK(error(angular_acceleration<P>(p, pdot, pddot), alpha) < rounding * (condition<P>(p) + size));
  };
  for (const Matrix3& R : rotations())
    for (const auto& p : parameters_of<P>(R)) check(p);
  for (int k = 0; k < 50; ++k) check(regular<P>(random));
}

TEST_CASE("all parametrisations describe one motion") {
  // A body turns as R(t) = exp(psi(t)); each set of parameters must see the same Omega and Omegadot.
  Random random(17);
  for (int k = 0; k < 20; ++k) {
    const Vector3 psi = random.vector_of_length(random.uniform(0.3, 2.5)), rate = random.vector3(),
                  acceleration = random.vector3();
    const Vector3 Omega = angular_velocity<RotationVector>(psi, rate);
    const Vector3 Omegadot = angular_acceleration<RotationVector>(psi, rate, acceleration);
    const auto check = [&](auto parametrisation) {
      using P = decltype(parametrisation);
      using Parameters = typename P::Parameters;
      const auto at = [&](double t) -> Parameters {
        return P::parameters(exp_so3(psi + t * rate + 0.5 * t * t * acceleration));
      };
      const Parameters p = at(0);
      if ((P::tangent(p) * P::tangent(p).transpose()).determinant() < 0.05) return;  // differences would be coarse
      const double h = 2e-3;
      const double tolerance = 1e-9 * (1 + p.squaredNorm());  // rounding over h, and over h^2 of a second difference
      CHECK(error(derivative(at, h), parameter_rate<P>(p, Omega)) < tolerance);
      const Parameters second = derivative(
          [&](double t) -> Parameters { return derivative([&](double s) -> Parameters { return at(t + s); }, h); }, h);
      CHECK(error(second, parameter_acceleration<P>(p, Omega, Omegadot)) < 1e3 * tolerance);
    };
    check(RotationVector{});
    check(UnitQuaternion{});
    check(RodriguesVector{});
    check(ConformalVector{});
    check(EulerAngles{});
    check(BryantAngles{});
  }
}

}  // namespace test_rotation_parameters
