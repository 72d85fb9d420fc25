// The force between two bodies that press into each other by p [m], pdot > 0 while they approach:
//
//     F = k p^n (1 + d pdot) >= 0 for p > 0, else 0                             (Hunt and Crossley)
// Force and damping begin and end at zero, and F has n - 1 continuous derivatives there. Over an impact of speed v_i
// against a mass,
//     d v_i (1 + e) = ln((1 + d v_i)/(1 - e d v_i)),
// e the restitution, whatever k, n and the mass: m v dv = -F dp, and the integral of v/(1 + d v) from v_i to -e v_i
// vanishes. For slow impacts e = 1 - (2/3) d v_i + ..; it falls with the speed. With a `restitution` in place of the
// damping, d = delta(e)/v_i follows from the speed at which they touch: e at every speed.
// Reference: K. H. Hunt, F. R. E. Crossley, Coefficient of restitution interpreted as damping in vibroimpact, J.
// Applied Mechanics 42 (1975) 440-445.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// delta(e) = d v_i. @param restitution  in (0, 1]; infinite damping at 0
double damping_for_restitution(double restitution);

/// e. @param damping_times_speed  d v_i >= 0
double restitution_for_damping(double damping_times_speed);

struct NormalLaw {
  double stiffness = 0;  ///< k [N/m^n]
  double exponent = 1.5;
  double damping = 0;      ///< d [s/m], where no restitution is given
  double restitution = 0;  ///< e; 0: not given
  /// Speeds below it are taken for it [m/s]: what touches at no speed is damped as at this one.
  double slowest_impact = 1e-3;

  /// d after a touch. @param speed  at which the bodies approached [m/s]
  double damping_after(double speed) const;

  struct Force {
    double F = 0;                  ///< [N]
    double by_p = 0, by_rate = 0;  ///< dF/dp, dF/d(pdot)
  };
  /// @param p  how far they press into each other; not positive: no force @param d  the damping, [s/m]
  Force force(double p, double rate, double d) const;
  double energy(double p) const;  ///< k p^(n+1)/(n+1) for p > 0 [J]

  std::string describe() const;
};

/// The keys of a law: stiffness, exponent, damping, restitution.
const std::vector<std::string>& normal_law_keys();

/// @param exponent   where the entry gives none @param stiffness  where it is known otherwise (materials, radii): the
/// entry then has none @throws InputError. Unknown keys are the caller's to check.
NormalLaw read_normal_law(const YamlValue& entry, double exponent, std::optional<double> stiffness = {});

}  // namespace bielle::mechanism
