#include "mechanism/hydraulics/circuit/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/plausible.hpp"

namespace bielle::mechanism {
namespace {

constexpr PlausibleRange plausible_bulk_modulus{1e8, 1e10, "Oils have 1.2e9 to 2e9 Pa, water 2.2e9"};
constexpr PlausibleRange plausible_viscosity{1e-4, 10, "Dynamic, in Pa s: water has 0.001, hydraulic oil 0.01 to 0.1"};
constexpr PlausibleRange plausible_fluid_density{500, 2000, "Oils have 850 kg/m^3, water 1000"};
constexpr PlausibleRange plausible_ambient{0, 1e6, "In Pa; the atmosphere has 101325, and 0 makes all pressures gauge"};

}  // namespace

Fluid::Ratio Fluid::ratio(double p) const {
  const double P = absolute(p), E = std::exp(-(P - atmosphere) / bulk_modulus);
  if (air_fraction > 0) {
    const double air = air_fraction * std::pow(atmosphere / P, 1 / air_exponent), oil = (1 - air_fraction) * E;
    return {oil + air, -oil / bulk_modulus - air / (air_exponent * P)};
  }
  const double vapour = std::sqrt(vapour_pressure / P) * std::exp(-P / vapour_pressure);
  return {E + vapour, -E / bulk_modulus - vapour * (0.5 / P + 1 / vapour_pressure)};
}

// Newton's method on ln v, which is straight in p for oil, and in ln p for air; kept between bounds on either side.
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
    // What is left is the square of the step, or the rounding of ln v.
    if (std::abs(step) <= 1e-15 * P || std::abs(f) < 1e-16) break;
  }
  return P - shift;
}

double Fluid::work(double p) const {
  // A trial pressure may be negative; the work is finite down to 0.
  const double P = std::max(absolute(p), 1e-6), P_a = absolute(ambient), B = bulk_modulus;
  double h = -(1 - air_fraction) * B * std::exp(-(P_a - atmosphere) / B) * std::expm1(-(P - P_a) / B);
  if (air_fraction > 0) {
    const double n = 1 - 1 / air_exponent;
    h += air_fraction * atmosphere *
         (n == 0 ? std::log(P / P_a) : (std::pow(P / atmosphere, n) - std::pow(P_a / atmosphere, n)) / n);
  } else {
    h += vapour_pressure * std::sqrt(M_PI) *
         (std::erfc(std::sqrt(P_a / vapour_pressure)) - std::erfc(std::sqrt(P / vapour_pressure)));
  }
  return h;
}

Fluid::Head Fluid::head(double p) const {
  const double inside = absolute(p) > 1e-6 ? p : p - absolute(p) + 1e-6, h = work(inside);
  const Ratio r = ratio(inside);
  if (conserves == Conserves::mass) return {h, r.v};
  return {h / r.v, 1 - h * r.v_p / (r.v * r.v)};
}

std::string Fluid::describe() const {
  std::string text = fmt::format("fluid of density {:.6g} kg/m^3, viscosity {:.6g} Pa s, bulk modulus {:.6g} Pa",
                                 density, viscosity, bulk_modulus);
  if (air_fraction > 0) text += fmt::format(", {:.6g} of it air", air_fraction);
  text += ambient == 0 ? "; pressures are gauge" : fmt::format("; ambient pressure {:.6g} Pa", ambient);
  if (conserves == Conserves::mass) text += "; flows are volumes at 101325 Pa";
  return text;
}

const std::vector<std::string>& fluid_keys() {
  static const std::vector<std::string> keys = {"density",      "viscosity",       "bulk_modulus", "air_fraction",
                                                "air_exponent", "vapour_pressure", "conserves"};
  return keys;
}

void read_fluid(const YamlValue& entry, Fluid& fluid) {
  const auto read_positive = [&](const char* key, double& value, const PlausibleRange& range) {
    const auto given = entry.find(key);
    if (!given) return;
    value = given->positive_number();
    doubt_outside(*given, value, range);
  };
  read_positive("density", fluid.density, plausible_fluid_density);
  read_positive("viscosity", fluid.viscosity, plausible_viscosity);
  read_positive("bulk_modulus", fluid.bulk_modulus, plausible_bulk_modulus);
  if (const auto air = entry.find("air_fraction")) {
    fluid.air_fraction = air->non_negative_number();
    if (fluid.air_fraction >= 1) air->fail("expected a share of the volume, less than 1");
  }
  if (const auto exponent = entry.find("air_exponent")) {
    fluid.air_exponent = exponent->number();
    if (fluid.air_exponent < 1 || fluid.air_exponent > 1.7)
      exponent->fail("expected 1 (isothermal) to 1.67; air has 1.4 where it has no time to exchange heat");
  }
  if (const auto vapour = entry.find("vapour_pressure")) {
    fluid.vapour_pressure = vapour->positive_number();
    if (fluid.vapour_pressure > 2e4) vapour->fail("expected an absolute pressure well below the atmosphere's");
  }
  if (const auto conserves = entry.find("conserves"))
    fluid.conserves = conserves->word({"volume", "mass"}, "what flows conserve") == "mass" ? Fluid::Conserves::mass
                                                                                           : Fluid::Conserves::volume;
}

void read_ambient_pressure(const YamlValue& entry, Fluid& fluid) {
  const auto ambient = entry.find("ambient_pressure");
  if (!ambient) return;
  fluid.ambient = ambient->non_negative_number();
  doubt_outside(*ambient, fluid.ambient, plausible_ambient);
}

}  // namespace bielle::mechanism
