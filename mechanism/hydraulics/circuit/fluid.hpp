// The fluid of a hydraulic circuit: the volume of a given amount of it, as a function of pressure.
//
// An amount of fluid is measured by its volume W at the reference pressure p_0 = 101325 Pa (proportional to its mass).
// At a pressure p its volume is W v(p), with air that is entrained but not dissolved (fraction a of the volume at p_0):
//     v(p) = (1 - a) exp(-(p - p_0)/B) + a (p_0/p)^(1/k),       B_eff = -v/v'
// (H. E. Merritt, Hydraulic Control Systems, Wiley 1967, 2.2, for the fraction of air; k = 1 isothermal to 1.4
// adiabatic). Without air (a = 0) B is constant, and vapour fills cavities in the oil:
//     v(p) = exp(-(p - p_0)/B) + sqrt(p_v/p) exp(-p/p_v),       p_v: the vapour pressure.
// p_v = 0 means no vapour: a cavity then has almost no pressure, that of least_vapour.
// Both functions tend to infinity for p -> 0: for any volume there is exactly one pressure, and it is positive.
// Cavitation is therefore no special case.
//
// The work of an amount of fluid at the pressure p, per W, is   h(p) = integral of v from p_a to p (p_a the ambient
// pressure). Its stored energy per W is                    u(p) = h - (p - p_a) v.
//
// Pressures in these formulas are absolute. The user's pressures are absolute too, unless the ambient pressure is 0:
// then they are relative to an atmosphere of 101325 Pa (gauge).
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Fluid {
 public:
  static constexpr double atmosphere = 101325;  ///< p_0 [Pa]
  static constexpr double least_vapour = 1e-3;  ///< p_v of a fluid without vapour [Pa]
  /// The quantity that flows between two places conserve. `volume`: the volume that leaves one place enters the other,
  /// although their pressures differ; this gives V pdot/B = Q - Vdot, as in textbooks. `mass`: flows are volumes at the
  /// reference pressure.
  enum class Conserves { volume, mass };

  double density = 850;           ///< [kg/m^3]
  double viscosity = 0.04;        ///< dynamic viscosity [Pa s]
  double bulk_modulus = 1.4e9;    ///< B [Pa]
  double air_fraction = 0;        ///< air fraction a
  double air_exponent = 1.2;      ///< air exponent k
  double vapour_pressure = 1000;  ///< p_v [Pa], absolute; 0: none
  double ambient = atmosphere;    ///< p_a [Pa]; 0: pressures are gauge
  Conserves conserves = Conserves::volume;

  /// The ratio v and its derivative dv/dp. @param p  the user's pressure [Pa]; positive if absolute
  struct Ratio {
    double v, v_p;
  };
  Ratio ratio(double p) const;
  /// Returns the pressure [Pa] at which v(p) is `v` > 0. @param guess  initial value of the search
  double pressure_of(double v, double guess) const;
  double work(double p) const;                                                    ///< h [Pa]
  double stored(double p) const { return work(p) - (p - ambient) * ratio(p).v; }  ///< u [Pa]
  /// Returns the amount of fluid per volume that flows at a pressure, and the derivative: 1/v if volume is conserved, 1
  /// if mass is. Near vacuum (from 0.5 to 0.1 atmospheres) it becomes 1 as well: the fluid that flows into a cavity is
  /// no vapour.
  struct Content {
    double f, f_p;
  };
  Content content(double p) const;
  /// Head e = h f of a pressure, the work per volume that flows [Pa], and its derivative. For oil at d above the
  /// ambient pressure p_0 it is B (exp(d/B) - 1) if volume is conserved, B (1 - exp(-d/B)) if mass is. For any flows,
  /// the stored energy of a volume grows at the rate Q e, less the power of its walls.
  struct Head {
    double e, e_p;
  };
  Head head(double p) const;
  double effective_modulus(double p) const {
    const Ratio r = ratio(p);
    return -r.v / r.v_p;
  }
  double vacuum() const { return ambient == 0 ? -atmosphere : 0; }  ///< pressure of a vacuum, like the user's [Pa]
  std::string describe() const;

 private:
  double absolute(double p) const { return ambient == 0 ? p + atmosphere : p; }
  double vapour() const { return vapour_pressure > least_vapour ? vapour_pressure : least_vapour; }
};

/// Returns the keys of a fluid: density, viscosity, bulk_modulus, air_fraction, air_exponent, vapour_pressure,
/// conserves.
std::vector<Key> fluid_keys();
/// Returns the key `ambient_pressure`.
Key ambient_pressure_key();
/// Reads the keys of a fluid, without the ambient pressure, from a map that is bound to a table with them.
/// @throws InputError
void read_fluid(const YamlValue& entry, Fluid& fluid);
/// Warns of a pressure at a place that is almost vacuum, or almost zero, because it may be given in bar.
/// @param p  pressure [Pa], like the user's pressures
void warn_of_pressure(const YamlValue& place, double p, const Fluid& fluid);
/// Warns of a set pressure difference that may be given in bar. @param p  pressure difference [Pa]
void warn_of_setting(const YamlValue& place, double p);
/// Reads `ambient_pressure` of a map. @throws InputError
void read_ambient_pressure(const YamlValue& entry, Fluid& fluid);

}  // namespace bielle::mechanism
