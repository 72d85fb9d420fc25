// Flow through an orifice, turbulent at large and laminar at small pressure differences.
//
//     Q = C_d A sqrt(2/rho) D / (D^2 + D_t^2)^(1/4),      D = p_a - p_b
// is a smooth transition, with all derivatives, from C_d A sqrt(2 |D|/rho) to a straight line at |D| ~ D_t. At large
// |D| it is less than the turbulent law by the fraction (D_t/D)^2/4. By default D_t is the pressure difference at which
// the Reynolds number of a round hole of the area A is Re_t:
//     D_t = (rho/2) (Re_t nu/(C_d D_h))^2,    D_h = sqrt(4 A/pi),     therefore D_t = kappa/A.
// Reference of the transition: W. Borutzky, B. Barnard, J. Thoma, An orifice flow model for laminar and turbulent
// conditions, Simulation Modelling Practice and Theory 10 (2002) 141-152, which has the same slope at D = 0.
#pragma once

#include <string>
#include <vector>

#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct OrificeLaw {
  double discharge = 0.7;   ///< C_d
  double density = 850;     ///< rho [kg/m^3]
  double transition = 0;    ///< D_t [Pa]; 0: computed from the Reynolds number
  double reynolds = 150;    ///< Re_t
  double viscosity = 0.04;  ///< dynamic viscosity [Pa s]

  struct Flow {
    double Q;    ///< flow [m^3/s]
    double Q_A;  ///< derivative by the area [m/s]
    double Q_D;  ///< derivative by the pressure difference [m^3/(s Pa)]
  };
  /// @param A  area [m^2], not negative @param D  pressure difference [Pa]
  Flow calc(double A, double D) const;
  std::string describe() const;
};

/// Returns `coefficient`, `density`, `transition_pressure`, `transition_reynolds`.
std::vector<Key> orifice_law_keys();
/// @param entry  bound to a table with these keys @param fluid  its density and viscosity are the defaults
/// @throws InputError
OrificeLaw read_orifice_law(const YamlValue& entry, const Fluid& fluid);
/// Returns the keys `area` and `diameter`. @param about  sentence that describes the area
std::vector<Key> area_keys(const KeyForm& area, const std::string& about);
/// Returns the keys `area` and `diameter` of a valve, whose area is a number.
std::vector<Key> valve_area_keys();
/// Reads the number `area` [m^2] or `diameter` [m] and returns the area [m^2]; 0 means no flow. @throws InputError
double read_area(const YamlValue& entry);

}  // namespace bielle::mechanism
