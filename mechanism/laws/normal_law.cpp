#include "mechanism/laws/normal_law.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Returns ln((1 + x)/(1 - e x)) - x (1 + e), x in [0, 1/e): zero at 0 and at delta(e), negative between them.
double imbalance(double x, double e) { return std::log1p(x) - std::log1p(-e * x) - x * (1 + e); }

}  // namespace

// The root is below 1/e, where the logarithm is infinite. It is found by bisection, once for a contact.
double damping_for_restitution(double restitution) {
  if (restitution >= 1) return 0;
  // For e near 1 the imbalance is of third order in x: delta = (3/2)(1 - e) + .. .
  double low = std::min(0.5 * (1 - restitution), 0.25 / restitution), high = (1 - 1e-16) / restitution;
  while (imbalance(low, restitution) > 0) low /= 2;
  for (int k = 0; k < 200 && high - low > 1e-16 * high; ++k) {
    const double middle = 0.5 * (low + high);
    (imbalance(middle, restitution) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double restitution_for_damping(double damping_times_speed) {
  const double x = damping_times_speed;
  if (x < 1e-4) return 1 - 2. / 3 * x + 4. / 9 * x * x;
  // The imbalance grows with e, from ln(1 + x) - x < 0 to infinity at 1/x.
  double low = 0, high = std::min(1.0, 1 / x);
  for (int k = 0; k < 200 && high - low > 1e-16; ++k) {
    const double middle = 0.5 * (low + high);
    const double value = middle * x >= 1 ? 1 : imbalance(x, middle);
    (value < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double NormalLaw::damping_after(double speed) const {
  if (restitution == 0) return damping;
  return damping_for_restitution(restitution) / std::max(speed, slowest_impact);
}

NormalLaw::Force NormalLaw::force(double p, double rate, double d) const {
  const double push = 1 + d * rate;
  if (p <= 0 || push <= 0) return {};
  const double power = std::pow(p, exponent);
  return {stiffness * power * push, stiffness * exponent * power / p * push, stiffness * power * d};
}

double NormalLaw::energy(double p) const { return p > 0 ? stiffness * std::pow(p, exponent + 1) / (exponent + 1) : 0; }

std::string NormalLaw::describe() const {
  std::string text = fmt::format("stiffness {:.6g} N/m^{:.6g}", stiffness, exponent);
  if (restitution > 0) text += fmt::format(", restitution {:.6g} at every speed", restitution);
  if (damping > 0) text += fmt::format(", damping {:.6g} s/m", damping);
  return text;
}

std::vector<Key> keys_of_normal_law() {
  using namespace keys;
  return {{"stiffness", number().positive(), required,
           "Stiffness k of the force k p^n (1 + d pdot) at the depth p, in N/m^n with the `exponent` n."},
          {"exponent", number().at_least(1), otherwise("1.5"),
           "Exponent n of the force over the depth; 1.5 is a Hertzian contact."},
          {"damping", number("s/m").non_negative(), otherwise("0"),
           "Damping d of that force, with which the restitution falls with the speed. Without it and `restitution` "
           "impacts lose no energy."},
          {"restitution", number().positive().at_most(1), optional,
           "Ratio of rebound speed to impact speed of every impact, in place of `damping`: d follows from the speed at "
           "which a pair touches, of at least 1 mm/s, and does not change until it parts."}};
}

NormalLaw read_normal_law(const YamlValue& entry) {
  return read_normal_law(entry, entry.at("stiffness").number(), entry.at("exponent").number());
}

NormalLaw read_normal_law(const YamlValue& entry, double stiffness, double exponent) {
  NormalLaw law;
  law.stiffness = stiffness;
  law.exponent = exponent;
  law.damping = entry.at("damping").number();
  if (const auto restitution = entry.find("restitution")) {
    law.restitution = restitution->number();
    if (const auto damping = entry.find("damping")) damping->fail("give either `damping` or `restitution`");
  }
  return law;
}

}  // namespace bielle::mechanism
