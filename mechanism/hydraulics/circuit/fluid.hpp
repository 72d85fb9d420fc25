// The fluid of a hydraulic circuit: how a given amount of it fills space, by pressure.
//
// An amount of fluid is counted by the volume W that it has at the reference pressure p_0 = 101325 Pa (a measure of its
// mass). At a pressure p it fills W v(p), with air that is entrained but not dissolved (share a of the volume at p_0):
//     v(p) = (1 - a) exp(-(p - p_0)/B) + a (p_0/p)^(1/k),       B_eff = -v/v'
// (H. E. Merritt, Hydraulic Control Systems, Wiley 1967, 2.2, for the share of air; k = 1 isothermal to 1.4 adiabatic).
// Without air (a = 0) B is constant, and vapour fills the space that oil leaves:
//     v(p) = exp(-(p - p_0)/B) + sqrt(p_v/p) exp(-p/p_v),       p_v the vapour pressure.
// p_v = 0 means none: a cavity then has next to no pressure, that of least_vapour.
// Either grows beyond all bounds as p goes to 0: whatever space a volume has, there is one pressure, and it is
// positive. Cavitation needs no case of its own.
//
// Work that an amount of fluid brings to where the pressure is p, per W:   h(p) = integral of v from p_a to p
// (p_a the ambient pressure). What it stores, per W:                       u(p) = h - (p - p_a) v.
//
// Pressures in these formulas are absolute. So are those of the user, unless the ambient pressure is 0: then they are
// relative to an atmosphere of 101325 Pa (gauge).
#pragma once

#include <string>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Fluid {
 public:
  static constexpr double atmosphere = 101325;  ///< p_0 [Pa]
  static constexpr double least_vapour = 1e-3;  ///< p_v of a fluid that is said to have none [Pa]
  /// What flows between two places conserve. `volume`: the volume that leaves the one enters the other, each at its own
  /// pressure: V pdot/B = Q - Vdot, as textbooks have it. `mass`: flows are volumes at the reference pressure.
  enum class Conserves { volume, mass };

  double density = 850;           ///< [kg/m^3]
  double viscosity = 0.04;        ///< dynamic [Pa s]
  double bulk_modulus = 1.4e9;    ///< B [Pa]
  double air_fraction = 0;        ///< a
  double air_exponent = 1.2;      ///< k
  double vapour_pressure = 1000;  ///< p_v [Pa], absolute; 0: none
  double ambient = atmosphere;    ///< p_a [Pa]; 0: pressures are gauge
  Conserves conserves = Conserves::volume;

  /// v and dv/dp. @param p  the user's [Pa]; positive when absolute
  struct Ratio {
    double v, v_p;
  };
  Ratio ratio(double p) const;
  /// The pressure [Pa] at which v(p) is `v` > 0. @param guess  where the search begins
  double pressure_of(double v, double guess) const;
  double work(double p) const;                                                    ///< h [Pa]
  double stored(double p) const { return work(p) - (p - ambient) * ratio(p).v; }  ///< u [Pa]
  /// How much fluid a volume that flows at a pressure is, and the derivative: 1/v where volume is conserved, 1 where
  /// mass is. Towards a vacuum (from 0.5 to 0.1 atmospheres) it becomes 1 as well: what flows into a cavity is no
  /// vapour.
  struct Content {
    double f, f_p;
  };
  Content content(double p) const;
  /// Work per volume that flows at a pressure, [Pa], and its derivative: h f. For oil, at d above the ambient pressure
  /// p_0, it is B (exp(d/B) - 1) if volume is conserved, B (1 - exp(-d/B)) if mass is. The energy that a volume stores
  /// grows by Q e less the work of its walls, however much comes and goes.
  struct Head {
    double e, e_p;
  };
  Head head(double p) const;
  double effective_modulus(double p) const {
    const Ratio r = ratio(p);
    return -r.v / r.v_p;
  }
  double vacuum() const { return ambient == 0 ? -atmosphere : 0; }  ///< the user's pressure of an absolute zero [Pa]
  std::string describe() const;

 private:
  double absolute(double p) const { return ambient == 0 ? p + atmosphere : p; }
  double vapour() const { return vapour_pressure > least_vapour ? vapour_pressure : least_vapour; }
};

/// Keys of a fluid: density, viscosity, bulk_modulus, air_fraction, air_exponent, vapour_pressure, conserves.
const std::vector<std::string>& fluid_keys();
/// Reads those that are there over what `fluid` holds; other keys are the caller's to check. @throws InputError
void read_fluid(const YamlValue& entry, Fluid& fluid);
/// Notes a doubt about a pressure of a place that is nearly vacuum, or nearly none: one that is given in bar.
/// @param p  [Pa], as the user's pressures
void doubt_pressure(const YamlValue& place, double p, const Fluid& fluid);
/// Notes a doubt about a setting, a difference of pressures: one that is given in bar. @param p  [Pa]
void doubt_setting(const YamlValue& place, double p);
/// `ambient_pressure` of a map, if it is there. @throws InputError
void read_ambient_pressure(const YamlValue& entry, Fluid& fluid);

}  // namespace bielle::mechanism
