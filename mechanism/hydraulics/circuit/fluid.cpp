#include "mechanism/hydraulics/circuit/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "mechanism/math/smooth_step.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {
namespace {

constexpr double least = 1e-6;  // smallest absolute pressure [Pa] at which the work is computed
constexpr PlausibleRange plausible_bulk_modulus{1e8, 1e10, "Oils have 1.2e9 to 2e9 Pa, water 2.2e9"};
constexpr PlausibleRange plausible_viscosity{1e-4, 10, "Dynamic, in Pa s: water has 0.001, hydraulic oil 0.01 to 0.1"};
constexpr PlausibleRange plausible_fluid_density{500, 2000, "Oils have 850 kg/m^3, water 1000"};
constexpr double nearly_none = 1000;  // [Pa]: a hundredth of the atmosphere
constexpr double bar = 1e5;           // [Pa]
constexpr PlausibleRange plausible_ambient{1e3, 1e6,
                                           "In Pa; the atmosphere has 101325, and 0 makes all pressures gauge"};

}  // namespace

Fluid::Ratio Fluid::ratio(double p) const {
  const double P = absolute(p), E = std::exp(-(P - atmosphere) / bulk_modulus);
  if (air_fraction > 0) {
    const double air = air_fraction * std::pow(atmosphere / P, 1 / air_exponent), oil = (1 - air_fraction) * E;
    return {oil + air, -oil / bulk_modulus - air / (air_exponent * P)};
  }
  const double p_v = vapour(), cavity = std::sqrt(p_v / P) * std::exp(-P / p_v);
  return {E + cavity, -E / bulk_modulus - cavity * (0.5 / P + 1 / p_v)};
}

// Newton's method is applied to ln v, which is linear in p for oil and in ln p for air. Bounds on both sides are
// maintained.
double Fluid::pressure_of(double v, double guess) const {
  const double shift = ambient == 0 ? atmosphere : 0, wanted = std::log(v);
  const auto excess = [&](double P, double& slope) {
    const Ratio r = ratio(P - shift);
    slope = r.v_p / r.v;
    return std::log(r.v) - wanted;
  };
  double P = std::isfinite(guess) && guess + shift > 0 ? guess + shift : atmosphere, slope = 0;
  double low = P, high = P;
  while (excess(low, slope) < 0 && low > 1e-200) low /= 8;
  while (excess(high, slope) > 0 && high < 1e200) high = 2 * high + atmosphere;
  constexpr int most = 200;
  for (int k = 0; k < most; ++k) {
    const double f = excess(P, slope);
    (f > 0 ? low : high) = P;
    double next = P < atmosphere ? P * std::exp(-f / (slope * P)) : P - f / slope;
    if (!(next >= low && next <= high)) next = high > 2 * low ? std::sqrt(low * high) : 0.5 * (low + high);
    const double step = next - P;
    P = next;
    // The remaining error is the square of the step, or the rounding of ln v.
    if (std::abs(step) <= 1e-15 * P || std::abs(f) < 1e-16) break;
  }
  return P - shift;
}

double Fluid::work(double p) const {
  // Trial states and junctions may have negative pressures. The work is bounded there, because no fluid is left to do
  // more.
  const double P_a = absolute(ambient), away = std::max(p - ambient, least - P_a), B = bulk_modulus;
  double h = -(1 - air_fraction) * B * std::exp(-(P_a - atmosphere) / B) * std::expm1(-away / B);
  if (air_fraction > 0) {
    const double n = 1 - 1 / air_exponent, log_ratio = std::log1p(away / P_a);
    h += air_fraction * atmosphere *
         (n == 0 ? log_ratio : std::pow(P_a / atmosphere, n) * std::expm1(n * log_ratio) / n);
  } else {
    const double p_v = vapour();
    h += p_v * std::sqrt(M_PI) * (std::erfc(std::sqrt(P_a / p_v)) - std::erfc(std::sqrt((P_a + away) / p_v)));
  }
  return h;
}

Fluid::Content Fluid::content(double p) const {
  constexpr double cavity = 0.1 * atmosphere, whole = 0.5 * atmosphere;
  const double P = absolute(p);
  if (conserves == Conserves::mass || P <= cavity) return {1, 0};
  const SmoothStep step = smooth_step((P - cavity) / (whole - cavity));
  const Ratio r = ratio(p);
  return {1 + step.value * (1 / r.v - 1),
          step.slope / (whole - cavity) * (1 / r.v - 1) - step.value * r.v_p / (r.v * r.v)};
}

Fluid::Head Fluid::head(double p) const {
  const double h = work(p), h_p = absolute(p) > least ? ratio(p).v : 0;
  const Content c = content(p);
  return {h * c.f, h_p * c.f + h * c.f_p};
}

std::string Fluid::describe() const {
  std::string text = fmt::format("fluid of density {:.6g} kg/m^3, viscosity {:.6g} Pa s, bulk modulus {:.6g} Pa",
                                 density, viscosity, bulk_modulus);
  if (air_fraction > 0) text += fmt::format(", {:.6g} of it air", air_fraction);
  text += ambient == 0 ? "; pressures are gauge" : fmt::format("; ambient pressure {:.6g} Pa", ambient);
  if (conserves == Conserves::mass) text += "; flows are volumes at 101325 Pa";
  return text;
}

std::vector<Key> fluid_keys() {
  using namespace keys;
  KeyForm share = number().between(0, 1);
  share.below = true;
  return {{"density", number("kg/m^3").positive(), otherwise("850"), "Density of the fluid."},
          {"viscosity", number("Pa s").positive(), otherwise("0.04"), "Dynamic viscosity."},
          {"bulk_modulus", number("Pa").positive(), otherwise("1.4e9"), "Bulk modulus of the fluid without air."},
          {"air_fraction", share, otherwise("0"),
           "Air that is entrained but not dissolved, as a share of the volume at 101325 Pa."},
          {"air_exponent", number().between(1, 1.7), otherwise("1.2"),
           "Exponent of the air's changes of state: 1 is isothermal, 1.4 adiabatic."},
          {"vapour_pressure", number("Pa").between(0, 3500), otherwise("1000"),
           "Absolute vapour pressure of a fluid without air; with 0 cavities have no pressure."},
          {"conserves", word({"volume", "mass"}, "what flows conserve"), otherwise("volume"),
           "Quantity that flows conserve: the `volume`, each place at its own pressure, or the `mass`, with flows as "
           "volumes at 101325 Pa."}};
}

Key ambient_pressure_key() {
  using namespace keys;
  return {"ambient_pressure", number("Pa").non_negative(), otherwise("101325"),
          "Absolute pressure of the surroundings; with 0 all pressures are relative to the atmosphere (gauge)."};
}

void read_fluid(const YamlValue& entry, Fluid& fluid) {
  const auto read = [&](const char* key, const PlausibleRange& range) {
    const YamlValue value = entry.at(key);
    const double number = value.number();
    warn_outside(value, number, range);
    return number;
  };
  fluid.density = read("density", plausible_fluid_density);
  fluid.viscosity = read("viscosity", plausible_viscosity);
  fluid.bulk_modulus = read("bulk_modulus", plausible_bulk_modulus);
  fluid.air_fraction = entry.at("air_fraction").number();
  fluid.air_exponent = entry.at("air_exponent").number();
  fluid.vapour_pressure = entry.at("vapour_pressure").number();
  fluid.conserves = entry.at("conserves").word() == "mass" ? Fluid::Conserves::mass : Fluid::Conserves::volume;
}

void read_ambient_pressure(const YamlValue& entry, Fluid& fluid) {
  const YamlValue ambient = entry.at("ambient_pressure");
  fluid.ambient = ambient.number();
  if (fluid.ambient > 0) warn_outside(ambient, fluid.ambient, plausible_ambient);
}

void warn_of_pressure(const YamlValue& place, double p, const Fluid& fluid) {
  const bool gauge = fluid.ambient == 0;
  if (gauge && (p <= 0 || p >= nearly_none)) return;
  const double least = std::max(fluid.vapour_pressure, nearly_none);
  if (!gauge && p >= least) return;
  place.warn(
      gauge ? fmt::format(
                  "are {:.6g} Pa meant? Pressures are in Pa, relative to the atmosphere; {:.6g} bar are {:.6g} Pa", p,
                  p, p * bar)
            : fmt::format(
                  "are {:.6g} Pa meant? Pressures are in Pa, absolute, and this is {}; {:.6g} bar are {:.6g} Pa", p,
                  fluid.vapour_pressure > p ? fmt::format("below the vapour pressure, {:.6g} Pa", fluid.vapour_pressure)
                                            : std::string("nearly vacuum"),
                  p, p * bar));
}

void warn_of_setting(const YamlValue& place, double p) {
  if (p <= 0 || p >= nearly_none) return;
  place.warn(fmt::format("are {:.6g} Pa meant? Pressures are in Pa; {:.6g} bar are {:.6g} Pa", p, p, p * bar));
}

}  // namespace bielle::mechanism
