// Force law of a bearing: forces between a shaft and its housing as functions of their relative motion.
//
// The motion has six measures e and their rates v, see shaft_bearing.hpp: x, y, z [m], tilt_x, tilt_y and angle [rad].
// The angle counts turns; its rate is the speed of the shaft relative to the housing. The forces N resist growth of the
// measures.
#pragma once

#include <string>
#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class BearingLaw {
 public:
  struct Force {
    Vector6 N = Vector6::Zero();                             ///< [N], [N m]
    Matrix6 by_e = Matrix6::Zero(), by_v = Matrix6::Zero();  ///< dN/de, dN/dv
  };
  /// The part of the force that has a potential.
  struct Potential {
    double energy = 0;            ///< [J]
    Vector6 N = Vector6::Zero();  ///< its derivative by e
  };

  virtual ~BearingLaw() = default;
  virtual Force calc(const Vector6& e, const Vector6& v) const = 0;
  virtual Potential potential(const Vector6& /*e*/) const { return {}; }
  /// Tells whether forces depend on rates, including the speed of the shaft.
  virtual bool has_rates() const = 0;
  /// Tells whether derivatives of the force by the state have jumps.
  virtual bool has_kinks() const { return false; }
  /// Says in a clause why there is no force at a position; empty if there is one.
  virtual std::string refusal(const Vector6& /*e*/) const { return {}; }
  virtual std::vector<std::string> describe() const = 0;
};

}  // namespace bielle::mechanism
