// Dry friction of surfaces that slide: how the force follows the sliding velocity v and the normal force N, in joints,
// contacts and bearings alike.
//
//     mu(s) = mu_k + (mu_s - mu_k) exp(-(s/v_s)^2),   s = |v|           Stribeck's curve; mu_s = mu_k without v_s
// `coulomb`, regularised:   F = -N [mu(s) tanh(s/v_0)/s + sigma_2] v
//     Smooth at rest, where it is a damper N mu_s/v_0: surfaces that stick creep. A fraction f < 1 of mu_s N is carried
//     at the speed v_0 atanh(f) (v_0 much smaller than v_s).
// `lugre`, bristles of deflection z [m] (a vector, as v):
//     zdot = v - sigma_0 |v| z/mu(s),   F = -N [sigma_0 z + sigma_1(s) zdot + sigma_2 v]
//     Surfaces stick truly under a steady force: z and v settle at z = F/(N sigma_0), v = 0. A force that swings makes
//     them drift. sigma_1(s) = sigma_1/sqrt(1 + (sigma_1 s/(4 mu_k))^2) stays below 4 mu/s, where bristles of constant
//     N only take power from the motion, at any deflection:
//         sigma_0^2 |v| z^2/mu + sigma_1 v . zdot >= 0   if   sigma_1 <= 4 mu/|v|.
// `stick_slip`: Coulomb's law itself; the surfaces stick by a constraint until |F| = mu_s N, and slip by -N mu(s) v/s.
// Units: mu none, sigma_0 [1/m], sigma_1, sigma_2 [s/m], all per unit of N.
// References: C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, A new model for control of systems with
// friction, IEEE Trans. Automatic Control 40 (1995) 419-425; H. Olsson, Control systems with friction, Lund (1996),
// for its dissipation.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct FrictionLaw {
  enum class Model { coulomb, lugre, stick_slip };
  Model model = Model::coulomb;
  double kinetic = 0;            ///< mu_k
  double sticking = 0;           ///< mu_s
  double stribeck_velocity = 0;  ///< v_s [m/s]; 0: none
  double viscous = 0;            ///< sigma_2 [s/m]
  double velocity = 0;           ///< v_0 [m/s], of `coulomb`
  double bristle_stiffness = 0;  ///< sigma_0 [1/m], of `lugre`
  double bristle_damping = 0;    ///< sigma_1 [s/m], of `lugre`

  /// mu(s), and mu'(s)/s, which is finite at rest.
  struct Level {
    double mu, slope_over_speed;
  };
  Level level(double speed) const;

  /// Of `coulomb`: h with F = -N h v, and h'(s)/s: dF = -N (h I + (h'/s) v v^T) dv. Even functions of s, smooth at 0.
  struct Sliding {
    double h, slope_over_speed;
  };
  Sliding sliding(double speed) const;

  /// Of `lugre`: sigma_1(s), and its slope over s.
  Level bristle_damping_at(double speed) const;

  /// To be called when nothing sticks, or when whatever sticks has no arm: bristles and sticking have no part in it
  /// then, all models are the same, and this becomes the plainest of them.
  void forget_dry_friction();

  /// The law in words, for --check.
  std::string describe() const;
};

/// The keys of a law: coefficient, static, stribeck_velocity, viscous, model, velocity, bristle_stiffness,
/// bristle_damping. Who reads more from the same map checks the keys with them.
const std::vector<std::string>& friction_law_keys();

/// @param models  those that the caller has, the first is the default
/// @throws InputError  a key is missing, out of range, or of another model. Unknown keys are the caller's to check.
FrictionLaw read_friction_law(const YamlValue& entry, const std::vector<std::string>& models);

}  // namespace bielle::mechanism
