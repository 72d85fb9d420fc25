#include "mechanism/hydraulics/lines/orifice_law.hpp"

#include <cmath>

#include <fmt/format.h>

#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {
namespace {

constexpr PlausibleRange plausible_area{0, 0.1, "Areas are in m^2: a hole of 2 mm has 3.14e-6"};

}  // namespace

OrificeLaw::Flow OrificeLaw::calc(double A, double D) const {
  if (discharge == 0) return {0, 0, 0};
  const double k = discharge * std::sqrt(2 / density);
  if (transition > 0) {
    const double s = D * D + transition * transition, root = std::sqrt(std::sqrt(s));
    const double q = k * D / root;
    return {A * q, q, A * k * (0.5 * D * D + transition * transition) / (s * root)};
  }
  // D_t = kappa/A:  Q = k A^(3/2) D/(A^2 D^2 + kappa^2)^(1/4)
  const double nu = viscosity / density;
  const double kappa = 0.5 * density * reynolds * reynolds * nu * nu * M_PI / (4 * discharge * discharge);
  const double s = A * A * D * D + kappa * kappa, root = std::sqrt(std::sqrt(s)), b = std::sqrt(A);
  const double q = k * b * D / root;  // Q/A
  return {A * q, q * (1.5 - 0.5 * A * A * D * D / s), k * A * b * (0.5 * A * A * D * D + kappa * kappa) / (s * root)};
}

std::string OrificeLaw::describe() const {
  return fmt::format("discharge coefficient {:.6g}, {}", discharge,
                     transition > 0 ? fmt::format("laminar below {:.6g} Pa", transition)
                                    : fmt::format("laminar below a Reynolds number of {:.6g}", reynolds));
}

const std::vector<std::string>& orifice_law_keys() {
  static const std::vector<std::string> keys = {"coefficient", "density", "transition_pressure", "transition_reynolds"};
  return keys;
}

OrificeLaw read_orifice_law(const YamlValue& entry, const Fluid& fluid) {
  OrificeLaw law;
  law.density = fluid.density;
  law.viscosity = fluid.viscosity;
  if (const auto coefficient = entry.find("coefficient")) {
    law.discharge = coefficient->non_negative_number();
    if (law.discharge > 1) coefficient->fail("expected a discharge coefficient up to 1; sharp edges have 0.6 to 0.7");
  }
  if (const auto density = entry.find("density")) law.density = density->positive_number();
  const auto pressure = entry.find("transition_pressure"), reynolds = entry.find("transition_reynolds");
  if (pressure && reynolds) reynolds->fail("give `transition_pressure` or `transition_reynolds`, not both");
  if (pressure) law.transition = pressure->positive_number();
  if (reynolds) law.reynolds = reynolds->positive_number();
  return law;
}

double read_area(const YamlValue& entry) {
  const auto area = entry.find("area"), diameter = entry.find("diameter");
  if (area && diameter) diameter->fail("give `area` or `diameter`, not both");
  if (!area && !diameter) entry.fail("needs an `area` [m^2] or a `diameter` [m]");
  const YamlValue& given = area ? *area : *diameter;
  const double number = given.non_negative_number(), size = area ? number : 0.25 * M_PI * number * number;
  warn_outside(given, size, plausible_area);
  return size;
}

}  // namespace bielle::mechanism
