// Law of stops at the ends of a range [lower, upper] of a coordinate: linear spring and damper with unilateral force.
//
//     upper, p = q - upper:   N = max(0, k p + d qdot)  in contact, 0 otherwise;  lower stop similarly.
// Contact begins and ends when p changes its sign: steps end there (events), because the damper's force jumps. The side
// that is in contact stands in the memory of the component that owns the law; at rest only the sign of p matters.
// Reference of the model: linear Kelvin-Voigt contact without adhesion.
#pragma once

#include <string>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

struct StopLaw {
  double lower, upper;  ///< ends [m] or [rad], lower < upper; infinite: no stop
  double stiffness;     ///< [N/m] or [N m/rad]
  double damping;       ///< [N s/m] or [N m s/rad]

  struct Contact {
    double side = 0;         ///< +1 at the upper stop, -1 at the lower one, 0 at neither
    double penetration = 0;  ///< penetration p, positive in contact
    double N = 0;            ///< resisting force along the coordinate, with the sign of `side`
    bool pushes = false;
  };
  /// @param side  the side in contact: +1, -1 or 0   @param v  rate of q
  Contact contact(double side, double q, double v) const;
  /// Returns the side in contact at rest.
  double side_at_rest(double q) const { return q > upper ? 1 : q < lower ? -1 : 0; }
  /// Returns the side in contact just after a discontinuity.
  double side_after(double q, double v) const;

  /// Adds the stored energy and the dissipated power.
  void add_energy(const Contact& contact, double v, Energy& energy) const;

  // Events: one for each end that is finite, the upper one first.
  void declare_events(const std::string& upper_name, const std::string& lower_name, Declaration& declaration) const;
  void calc_event_functions(double q, Eigen::Ref<VectorX> values) const;
};

}  // namespace bielle::mechanism
