// Coordinates of joints: drives, springs, stops, couplings and measures act on them, independently of the type of the
// joint.
//
// A coordinate c has a value and a rate, each with its derivatives over the joint's local layout (nodes and scalars):
//     dc = g . dz,   dg = S dz,        rate = w . v,   dw = W dz.
// For displacements and angles w = g. The components of a rotation vector do not satisfy this: their rates are those of
// the relative angular velocity (quasi-coordinates), w != g. A generalised force Q that derives from a potential of c
// adds Q g to the residual; one that is defined by its power Q * rate adds Q w.
#pragma once

#include <string>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Definition of a coordinate: a displacement along an axis of the joint's frame, an angle about its z axis, or a
/// component of the rotation vector of J_B relative to J_A (principal value; its rate is the relative angular
/// velocity); or a displacement or angle that the joint's type defines.
struct JointCoordinate {
  enum class Kind { displacement, angle, rotation };
  static constexpr int by_type = -1;  ///< used instead of an axis
  std::string name;                   ///< name: "angle", "displacement", "x", ...
  Kind kind = Kind::displacement;
  int axis = 2;  ///< 0 x, 1 y, 2 z, or by_type
  const char* units() const { return kind == Kind::displacement ? "m" : "rad"; }
  const char* rate_units() const { return kind == Kind::displacement ? "m/s" : "rad/s"; }
  const char* force_units() const { return kind == Kind::displacement ? "N" : "N m"; }
};

/// A coordinate with its rate.
struct CoordinateRate {
  double value = 0;  ///< value; angles are counted over turns
  double rate = 0;
};

/// A coordinate with its gradients, see the head of this file: enough for residuals. The object is reused from call to
/// call: it allocates memory only when it grows.
class CoordinateSlopes {
 public:
  double value = 0;      ///< value; angles are counted over turns
  double principal = 0;  ///< an angle in (-pi, pi], accurate after any number of turns; otherwise the value
  double rate = 0;

  using VectorMap = Eigen::Map<VectorX>;
  /// Sets the gradients to zero. @param size  size of the joint's local layout
  void prepare(int size) {
    for (std::vector<double>* vector : {&g_, &w_}) vector->assign(static_cast<std::size_t>(size), 0.0);
  }
  int size() const { return static_cast<int>(g_.size()); }
  VectorMap g() { return {g_.data(), size()}; }
  VectorMap w() { return {w_.data(), size()}; }

 private:
  std::vector<double> g_, w_;
};

/// A coordinate with all its derivatives.
class CoordinateDerivatives : public CoordinateSlopes {
 public:
  using MatrixMap = Eigen::Map<MatrixX>;
  /// Sets all derivatives to zero. @param size  size of the joint's local layout
  void prepare(int size) {
    CoordinateSlopes::prepare(size);
    const auto n = static_cast<std::size_t>(size);
    for (std::vector<double>* matrix : {&S_, &W_}) matrix->assign(n * n, 0.0);
  }
  MatrixMap S() { return {S_.data(), size(), size()}; }
  MatrixMap W() { return {W_.data(), size(), size()}; }

 private:
  std::vector<double> S_, W_;
};

}  // namespace bielle::mechanism
