// The normal force between two bodies that penetrate each other by p [m], with pdot > 0 while they approach:
//
//     F = k p^n (1 + d pdot) >= 0 for p > 0, else 0                             (Hunt and Crossley)
// Force and damping are continuous at p = 0, and F has n - 1 continuous derivatives there. For an impact with speed v_i
// on a mass,
//     d v_i (1 + e) = ln((1 + d v_i)/(1 - e d v_i)),
// Here e is the coefficient of restitution, for any k, n and mass, because m v dv = -F dp and the integral of v/(1 + d
// v) from v_i to -e v_i is zero. For slow impacts e = 1 - (2/3) d v_i + ..; it decreases with the speed. If
// `restitution` is given instead of the damping, d = delta(e)/v_i follows from the speed at the beginning of contact: e
// is then the same at every speed.
// Reference: K. H. Hunt, F. R. E. Crossley, Coefficient of restitution interpreted as damping in vibroimpact, J.
// Applied Mechanics 42 (1975) 440-445.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns delta(e) = d v_i. @param restitution  in (0, 1]; the damping is infinite at 0
double damping_for_restitution(double restitution);

/// Returns the restitution e. @param damping_times_speed  d v_i >= 0
double restitution_for_damping(double damping_times_speed);

struct NormalLaw {
  double stiffness = 0;  ///< k [N/m^n]
  double exponent = 1.5;
  double damping = 0;      ///< d [s/m], if no restitution is given
  double restitution = 0;  ///< e; 0: not given
  /// Impact speeds below this value are replaced by it [m/s], including contact at zero speed.
  double slowest_impact = 1e-3;

  /// Returns the damping d after the beginning of contact. @param speed  approach speed of the bodies [m/s]
  double damping_after(double speed) const;

  struct Force {
    double F = 0;                  ///< force [N]
    double by_p = 0, by_rate = 0;  ///< dF/dp, dF/d(pdot)
  };
  /// @param p  penetration; not positive: no force @param d  damping [s/m]
  Force force(double p, double rate, double d) const;
  double energy(double p) const;  ///< k p^(n+1)/(n+1) for p > 0 [J]

  std::string describe() const;
};

/// Returns the keys of a law, for the table of the map that holds them, which may have further ones.
std::vector<Key> keys_of_normal_law();
/// Returns their names.
const std::vector<std::string>& normal_law_keys();

/// @param exponent   default if the entry gives none @param stiffness  its value if it is known otherwise (materials,
/// radii): the entry then has none @throws InputError
NormalLaw read_normal_law(const YamlValue& entry, double exponent, std::optional<double> stiffness = {});

}  // namespace bielle::mechanism
