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

std::vector<Key> orifice_law_keys() {
  using namespace keys;
  return {{"coefficient", number().between(0, 1), otherwise("0.7"),
           "Discharge coefficient; sharp edges have 0.6 to 0.7, and with 0 nothing flows."},
          {"density", number("kg/m^3").positive(), computed("the fluid's"), "Density in the law of the orifice."},
          {"transition_pressure", number("Pa").positive(), computed("that of `transition_reynolds`"),
           "Pressure difference below which the flow is laminar."},
          {"transition_reynolds", number().positive(), otherwise("150"),
           "Reynolds number of a round hole below which the flow is laminar, in place of `transition_pressure`."}};
}

std::vector<Key> area_keys(const KeyForm& area, const std::string& about) {
  using namespace keys;
  return {{"area", area, optional, about},
          {"diameter", number("m").non_negative(), optional, "Diameter of a round hole, in place of `area`."}};
}

std::vector<Key> valve_area_keys() {
  return area_keys(keys::number("m^2").non_negative(), "Area at full opening; with 0 nothing flows.");
}

OrificeLaw read_orifice_law(const YamlValue& entry, const Fluid& fluid) {
  OrificeLaw law;
  law.viscosity = fluid.viscosity;
  law.discharge = entry.at("coefficient").number();
  const auto density = entry.find("density"), pressure = entry.find("transition_pressure");
  law.density = density ? density->number() : fluid.density;
  if (pressure && entry.has("transition_reynolds"))
    entry.at("transition_reynolds").fail("give `transition_pressure` or `transition_reynolds`, not both");
  if (pressure) law.transition = pressure->number();
  law.reynolds = entry.at("transition_reynolds").number();
  return law;
}

double read_area(const YamlValue& entry) {
  const auto area = entry.find("area"), diameter = entry.find("diameter");
  if (area && diameter) diameter->fail("give `area` or `diameter`, not both");
  if (!area && !diameter) entry.fail("needs an `area` [m^2] or a `diameter` [m]");
  const YamlValue& given = area ? *area : *diameter;
  const double number = given.number(), size = area ? number : 0.25 * M_PI * number * number;
  warn_outside(given, size, plausible_area);
  return size;
}

}  // namespace bielle::mechanism
