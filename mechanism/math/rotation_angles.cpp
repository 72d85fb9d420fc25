// Three angles about axes: Euler z-x-z and Bryant x-y-z.
//
//   z-x-z:  T = [sb sc, cc, 0; sb cc, -sc, 0; cb, 0, 1]        det T = -sb
//   x-y-z:  T = [cb cc, sc, 0; -cb sc, cc, 0; sb, 0, 1]        det T =  cb
// Here s and c are sine and cosine of the angle that follows. The angles computed from R reproduce R to rounding error
// even near the singularity: the first angle is computed from R, the last one after R has been turned back by the
// first.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mechanism/math/rotation_parameters.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

// Below this sine (cosine) of the middle angle, first and last angle cannot be distinguished.
constexpr double smallest_sine = 4e-16;
// Below this determinant, less than half of the digits of T^-1 would be left.
constexpr double smallest_determinant = 1e-9;

struct SineCosine {
  double s, c;
  explicit SineCosine(double angle) : s(std::sin(angle)), c(std::cos(angle)) {}
};

[[noreturn]] void throw_locked(const char* angles, const char* where, const Vector3& a) {
  throw ComputationError(fmt::format(
      "the {} angles ({:.6g}, {:.6g}, {:.6g}) rad are singular at {}: their rates are not determined by the angular "
      "velocity",
      angles, a[0], a[1], a[2], where));
}

/// Returns the angle plus or minus half a turn, towards zero [rad].
double half_turn_from(double angle) { return angle > 0 ? angle - std::numbers::pi : angle + std::numbers::pi; }

/// Returns D(T^-1)[u] = -T^-1 DT[u] T^-1
Matrix3 inverse_derivative(const Matrix3& inverse, const Matrix3& derivative) {
  return -(inverse * derivative * inverse);
}

}  // namespace

// -- Euler z-x-z

Matrix3 EulerAngles::rotation(const Vector3& angles) {
  const SineCosine a(angles[0]), b(angles[1]), c(angles[2]);
  Matrix3 R;
  R << a.c * c.c - a.s * b.c * c.s, -a.c * c.s - a.s * b.c * c.c, a.s * b.s,  //
      a.s * c.c + a.c * b.c * c.s, -a.s * c.s + a.c * b.c * c.c, -a.c * b.s,  //
      b.s * c.s, b.s * c.c, b.c;
  return R;
}

Vector3 EulerAngles::parameters(const Matrix3& R) {
  const double sine = std::hypot(R(0, 2), R(1, 2));
  const double b = std::atan2(sine, R(2, 2));
  if (sine < smallest_sine) return {std::atan2(R(1, 0), R(0, 0)), b, 0};
  const double a = std::atan2(R(0, 2), -R(1, 2));
  const SineCosine t(a);
  return {a, b, std::atan2(-(t.c * R(0, 1) + t.s * R(1, 1)), t.c * R(0, 0) + t.s * R(1, 0))};
}

Vector3 EulerAngles::principal(const Vector3& angles) { return parameters(rotation(angles)); }

Vector3 EulerAngles::complement(const Vector3& angles) {
  return {half_turn_from(angles[0]), -angles[1], half_turn_from(angles[2])};
}

Vector3 EulerAngles::compose(const Vector3& angles, const Vector3& second) {
  return parameters(rotation(angles) * rotation(second));
}

Matrix3 EulerAngles::tangent(const Vector3& angles) {
  const SineCosine b(angles[1]), c(angles[2]);
  Matrix3 T;
  T << b.s * c.s, c.c, 0, b.s * c.c, -c.s, 0, b.c, 0, 1;
  return T;
}

Matrix3 EulerAngles::tangent_inverse(const Vector3& angles) {
  const SineCosine b(angles[1]), c(angles[2]);
  if (!(std::abs(b.s) > smallest_determinant)) throw_locked("Euler z-x-z", "sin b = 0", angles);
  Matrix3 inverse;
  inverse << c.s / b.s, c.c / b.s, 0, c.c, -c.s, 0, -b.c * c.s / b.s, -b.c * c.c / b.s, 1;
  return inverse;
}

Matrix3 EulerAngles::tangent_derivative(const Vector3& angles, const Vector3& u) {
  const SineCosine b(angles[1]), c(angles[2]);
  Matrix3 D;
  D << b.c * c.s * u[1] + b.s * c.c * u[2], -c.s * u[2], 0,  //
      b.c * c.c * u[1] - b.s * c.s * u[2], -c.c * u[2], 0,   //
      -b.s * u[1], 0, 0;
  return D;
}

Matrix3 EulerAngles::tangent_inverse_derivative(const Vector3& angles, const Vector3& u) {
  return inverse_derivative(tangent_inverse(angles), tangent_derivative(angles, u));
}

// -- Bryant x-y-z

Matrix3 BryantAngles::rotation(const Vector3& angles) {
  const SineCosine a(angles[0]), b(angles[1]), c(angles[2]);
  Matrix3 R;
  R << b.c * c.c, -b.c * c.s, b.s,                                           //
      a.c * c.s + a.s * b.s * c.c, a.c * c.c - a.s * b.s * c.s, -a.s * b.c,  //
      a.s * c.s - a.c * b.s * c.c, a.s * c.c + a.c * b.s * c.s, a.c * b.c;
  return R;
}

Vector3 BryantAngles::parameters(const Matrix3& R) {
  const double cosine = std::hypot(R(1, 2), R(2, 2));
  const double b = std::atan2(R(0, 2), cosine);
  if (cosine < smallest_sine) return {std::atan2(R(2, 1), R(1, 1)), b, 0};
  const double a = std::atan2(-R(1, 2), R(2, 2));
  const SineCosine t(a);
  return {a, b, std::atan2(t.c * R(1, 0) + t.s * R(2, 0), t.c * R(1, 1) + t.s * R(2, 1))};
}

Vector3 BryantAngles::principal(const Vector3& angles) { return parameters(rotation(angles)); }

Vector3 BryantAngles::complement(const Vector3& angles) {
  return {half_turn_from(angles[0]), std::numbers::pi - angles[1], half_turn_from(angles[2])};
}

Vector3 BryantAngles::compose(const Vector3& angles, const Vector3& second) {
  return parameters(rotation(angles) * rotation(second));
}

Matrix3 BryantAngles::tangent(const Vector3& angles) {
  const SineCosine b(angles[1]), c(angles[2]);
  Matrix3 T;
  T << b.c * c.c, c.s, 0, -b.c * c.s, c.c, 0, b.s, 0, 1;
  return T;
}

Matrix3 BryantAngles::tangent_inverse(const Vector3& angles) {
  const SineCosine b(angles[1]), c(angles[2]);
  if (!(std::abs(b.c) > smallest_determinant)) throw_locked("Bryant x-y-z", "cos b = 0", angles);
  Matrix3 inverse;
  inverse << c.c / b.c, -c.s / b.c, 0, c.s, c.c, 0, -b.s * c.c / b.c, b.s * c.s / b.c, 1;
  return inverse;
}

Matrix3 BryantAngles::tangent_derivative(const Vector3& angles, const Vector3& u) {
  const SineCosine b(angles[1]), c(angles[2]);
  Matrix3 D;
  D << -b.s * c.c * u[1] - b.c * c.s * u[2], c.c * u[2], 0,  //
      b.s * c.s * u[1] - b.c * c.c * u[2], -c.s * u[2], 0,   //
      b.c * u[1], 0, 0;
  return D;
}

Matrix3 BryantAngles::tangent_inverse_derivative(const Vector3& angles, const Vector3& u) {
  return inverse_derivative(tangent_inverse(angles), tangent_derivative(angles, u));
}

}  // namespace bielle::mechanism
