// Coordinates of joints: what drives, springs, stops, couplings and measures act on, whatever the type of the joint.
//
// A coordinate c has a value and a rate, each with its derivatives over the joint's local layout (nodes and scalars):
//     dc = g . dz,   dg = S dz,        rate = w . v,   dw = W dz.
// For displacements and angles w = g. The components of a rotation vector are no such pair: their rates are those of
// the relative angular velocity (quasi-coordinates), w != g. A generalised force Q that derives from a potential of c
// adds Q g to the residual; one that is defined by its power Q * rate adds Q w.
#pragma once

#include <string>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// What a coordinate is: a displacement along an axis of the joint's frame, an angle about its z axis, or a component
/// of the rotation vector of J_B relative to J_A (principal value; its rate is the relative angular velocity); or a
/// displacement or angle that the joint's type defines.
struct JointCoordinate {
  enum class Kind { displacement, angle, rotation };
  static constexpr int by_type = -1;  ///< in place of an axis
  std::string name;                   ///< "angle", "displacement", "x", ...
  Kind kind = Kind::displacement;
  int axis = 2;  ///< 0 x, 1 y, 2 z, or by_type
  const char* units() const { return kind == Kind::displacement ? "m" : "rad"; }
  const char* rate_units() const { return kind == Kind::displacement ? "m/s" : "rad/s"; }
  const char* force_units() const { return kind == Kind::displacement ? "N" : "N m"; }
};

/// A coordinate with its rate.
struct CoordinateRate {
  double value = 0;  ///< angles are counted over turns
  double rate = 0;
};

/// A coordinate with all its derivatives, see the head of this file. Reused from call to call: takes memory only when
/// it grows.
class CoordinateDerivatives {
 public:
  double value = 0;      ///< angles are counted over turns
  double principal = 0;  ///< an angle in (-pi, pi], to full accuracy after any number of turns; otherwise the value
  double rate = 0;

  using VectorMap = Eigen::Map<VectorX>;
  using MatrixMap = Eigen::Map<MatrixX>;
  /// Sets all derivatives to zero. @param size  of the joint's local layout
  void prepare(int size) {
    size_ = size;
    const auto n = static_cast<std::size_t>(size);
    for (std::vector<double>* vector : {&g_, &w_}) vector->assign(n, 0.0);
    for (std::vector<double>* matrix : {&S_, &W_}) matrix->assign(n * n, 0.0);
  }
  VectorMap g() { return {g_.data(), size_}; }
  VectorMap w() { return {w_.data(), size_}; }
  MatrixMap S() { return {S_.data(), size_, size_}; }
  MatrixMap W() { return {W_.data(), size_, size_}; }

 private:
  int size_ = 0;
  std::vector<double> g_, w_, S_, W_;
};

}  // namespace bielle::mechanism
