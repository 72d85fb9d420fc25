// Dry friction of sliding surfaces, in joints, contacts and bearings: the force as a function of the sliding velocity v
// and the normal force N.
//
//     mu(s) = mu_k + (mu_s - mu_k) exp(-(s/v_s)^2),   s = |v|           Stribeck's curve; mu_s = mu_k without v_s
// `coulomb`, regularised:   F = -N [mu(s) tanh(s/v_0)/s + sigma_2] v
//     Smooth at rest, where it is a damper N mu_s/v_0: sticking surfaces creep. A fraction f < 1 of mu_s N is reached
//     at the speed v_0 atanh(f) (v_0 much smaller than v_s).
// `lugre`, bristles of deflection z [m] (a vector, as v):
//     zdot = v - sigma_0 |v| z/mu(s),   F = -N [sigma_0 z + sigma_1(s) zdot + sigma_2 v]
//     Surfaces stick under a steady force: z and v tend to z = F/(N sigma_0), v = 0. An oscillating force makes
//     them drift. sigma_1(s) = sigma_1/sqrt(1 + (sigma_1 s/(4 mu_k))^2) stays below 4 mu/s, where bristles of constant
//     N always dissipate energy, at any deflection:
//         sigma_0^2 |v| z^2/mu + sigma_1 v . zdot >= 0   if   sigma_1 <= 4 mu/|v|.
// `stick_slip`: Coulomb's law without regularisation; the surfaces stick by a constraint until |F| = mu_s N, and slip
// with -N mu(s) v/s. Units: mu none, sigma_0 [1/m], sigma_1, sigma_2 [s/m], all per unit of N. References: C. Canudas
// de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, A new model for control of systems with friction, IEEE Trans.
// Automatic Control 40 (1995) 419-425; H. Olsson, Control systems with friction, Lund (1996), for its dissipation.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct FrictionLaw {
  enum class Model { coulomb, lugre, stick_slip };
  Model model = Model::coulomb;
  double kinetic = 0;            ///< kinetic coefficient mu_k
  double sticking = 0;           ///< static coefficient mu_s
  double stribeck_velocity = 0;  ///< v_s [m/s]; 0: none
  double viscous = 0;            ///< sigma_2 [s/m]
  double velocity = 0;           ///< v_0 [m/s], for `coulomb`
  double bristle_stiffness = 0;  ///< sigma_0 [1/m], for `lugre`
  double bristle_damping = 0;    ///< sigma_1 [s/m], for `lugre`

  /// The coefficient mu(s), and mu'(s)/s, which is finite at rest.
  struct Level {
    double mu, slope_over_speed;
  };
  Level level(double speed) const;

  /// For `coulomb`: h with F = -N h v, and h'(s)/s: dF = -N (h I + (h'/s) v v^T) dv. Both are even functions of s,
  /// smooth at 0.
  struct Sliding {
    double h, slope_over_speed;
  };
  Sliding sliding(double speed) const;

  /// For `lugre`: sigma_1(s), and its slope divided by s.
  Level bristle_damping_at(double speed) const;

  /// Removes sticking from the law. Call it if nothing sticks, or if the sticking part has no lever arm: bristles and
  /// sticking then have no effect, all models are equal, and this law becomes the simplest of them.
  void forget_dry_friction();

  /// Describes the law in words, for --check.
  std::string describe() const;
};

/// Returns the keys of a law, for the table of the map that holds them, which may have further ones.
/// @param models  models that the caller supports; the first is the default
std::vector<Key> keys_of_friction_law(const std::vector<std::string>& models);
/// Returns their names.
const std::vector<std::string>& friction_law_keys();

/// @param models  models that the caller supports; the first is the default
/// @throws InputError if a key is missing, out of range, or belongs to another model
FrictionLaw read_friction_law(const YamlValue& entry, const std::vector<std::string>& models);

}  // namespace bielle::mechanism
