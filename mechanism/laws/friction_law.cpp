#include "mechanism/laws/friction_law.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

constexpr double usual_width = 1e-3;  // v_0 [m/s]

/// Returns tanh(x)/x and the derivative of that divided by x, both even in x.
FrictionLaw::Level tanh_over(double x) {
  if (std::abs(x) < 0.02) {  // omitted terms are below 1e-16
    const double y = x * x;
    return {1 - y * (1. / 3 - y * (2. / 15 - y * (17. / 315 - y * 62. / 2835))),
            -2. / 3 + y * (8. / 15 - y * (34. / 105 - y * 496. / 2835))};
  }
  const double t = std::tanh(x);
  return {t / x, ((1 - t * t) - t / x) / (x * x)};
}

}  // namespace

FrictionLaw::Level FrictionLaw::level(double speed) const {
  if (stribeck_velocity == 0 || sticking == kinetic) return {kinetic, 0};
  const double x = speed / stribeck_velocity, rise = (sticking - kinetic) * std::exp(-x * x);
  return {kinetic + rise, -2 * rise / (stribeck_velocity * stribeck_velocity)};
}

FrictionLaw::Sliding FrictionLaw::sliding(double speed) const {
  const auto [mu, mu_slope] = level(speed);
  const auto [t, t_slope] = tanh_over(speed / velocity);
  return {mu * t / velocity + viscous, mu_slope * t / velocity + mu * t_slope / (velocity * velocity * velocity)};
}

FrictionLaw::Level FrictionLaw::bristle_damping_at(double speed) const {
  const double c = bristle_damping / (4 * kinetic), root = std::sqrt(1 + c * c * speed * speed);
  return {bristle_damping / root, -bristle_damping * c * c / (root * root * root)};
}

void FrictionLaw::forget_dry_friction() {
  if (model != Model::coulomb) velocity = usual_width;
  model = Model::coulomb;
  stribeck_velocity = 0;
}

std::string FrictionLaw::describe() const {
  std::string text = fmt::format("friction {:.6g}", kinetic);
  if (sticking != kinetic) text += fmt::format(", {:.6g} at rest", sticking);
  if (stribeck_velocity > 0) text += fmt::format(", falling over {:.6g} m/s", stribeck_velocity);
  if (viscous > 0) text += fmt::format(", viscous {:.6g} s/m", viscous);
  if (model == Model::coulomb) text += fmt::format(", smooth within {:.6g} m/s: creeps at rest", velocity);
  if (model == Model::stick_slip) text += ", sticks at rest";
  if (model == Model::lugre)
    text +=
        fmt::format(", bristles of stiffness {:.6g} 1/m and damping {:.6g} s/m", bristle_stiffness, bristle_damping);
  return text;
}

std::vector<Key> keys_of_friction_law(const std::vector<std::string>& models) {
  using namespace keys;
  return {
      {"coefficient", number().non_negative(), required,
       "Coefficient of sliding friction mu_k; with 0, also at rest, there is no dry friction, whatever the `model`."},
      {"static", number().non_negative(), computed("as `coefficient`"), "Coefficient of friction at rest mu_s."},
      {"stribeck_velocity", number("m/s").non_negative(), optional,
       "Speed v_s over which the coefficient falls from `static` to `coefficient`: mu(v) = mu_k + (mu_s - mu_k) "
       "exp(-(v/v_s)^2)."},
      {"viscous", number("s/m").non_negative(), otherwise("0"),
       "Viscous friction: it adds N `viscous` v to the force, N the normal force."},
      {"model", word(models, "a model of friction"), otherwise(models.front()), "Model of friction near rest."},
      {"velocity", number("m/s").positive(), computed("a tenth of `stribeck_velocity`, or 1 mm/s"),
       "Speed within which `coulomb` makes the force smooth: mu tanh(v/`velocity`)."},
      {"bristle_stiffness", number("1/m").positive(), optional,
       "Stiffness of the bristles of `lugre` per normal force, which that model needs."},
      {"bristle_damping", number("s/m").non_negative(), otherwise("0"),
       "Damping of the bristles of `lugre` per normal force."}};
}

FrictionLaw read_friction_law(const YamlValue& entry) {
  FrictionLaw law;
  const std::string name = entry.at("model").word();
  law.model = name == "lugre"        ? FrictionLaw::Model::lugre
              : name == "stick_slip" ? FrictionLaw::Model::stick_slip
                                     : FrictionLaw::Model::coulomb;
  law.kinetic = entry.at("coefficient").number();
  law.sticking = law.kinetic;
  if (const auto at_rest = entry.find("static")) {
    law.sticking = at_rest->number();
    if (law.sticking < law.kinetic) at_rest->fail("friction at rest is no smaller than when it slides (`coefficient`)");
  }
  const bool falls = law.sticking > law.kinetic && law.model != FrictionLaw::Model::stick_slip;
  if (const auto speed = entry.find("stribeck_velocity")) {
    if (!entry.has("static")) speed->fail("is where friction falls from `static`, which is missing");
    law.stribeck_velocity = speed->number();
    if (falls && law.stribeck_velocity == 0) speed->fail("expected a number greater than 0, found 0");
  } else if (falls) {
    entry.at("static").fail("say over which speed friction falls to `coefficient`: `stribeck_velocity` [m/s]");
  }
  law.viscous = entry.at("viscous").number();

  const auto only_for = [&](const char* key, FrictionLaw::Model of, const char* of_name) {
    if (const auto value = entry.find(key); value && law.model != of)
      value->fail(fmt::format("belongs to `model: {}`; this is {}", of_name, name));
  };
  only_for("velocity", FrictionLaw::Model::coulomb, "coulomb");
  only_for("bristle_stiffness", FrictionLaw::Model::lugre, "lugre");
  only_for("bristle_damping", FrictionLaw::Model::lugre, "lugre");
  if (law.model == FrictionLaw::Model::coulomb) {
    const auto width = entry.find("velocity");
    law.velocity = width ? width->number() : law.stribeck_velocity > 0 ? law.stribeck_velocity / 10 : usual_width;
    if (width && law.stribeck_velocity > 0 && law.velocity >= law.stribeck_velocity)
      width->fail("the force is made smooth within far less than `stribeck_velocity`: a tenth of it, say");
  }
  if (law.model == FrictionLaw::Model::lugre) {
    law.bristle_stiffness = entry.at("bristle_stiffness").number();
    law.bristle_damping = entry.at("bristle_damping").number();
    if (law.kinetic == 0 && law.sticking > 0)
      entry.at("coefficient")
          .fail("expected a number greater than 0: bristles that are to let go slide against friction");
  }
  if (law.sticking == 0) law.forget_dry_friction();
  return law;
}

}  // namespace bielle::mechanism
