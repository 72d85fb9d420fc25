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
  return {{"coefficient", number().non_negative(), required,
           "Coefficient of sliding friction; with 0, also at rest, there is no dry friction."},
          {"static", number().non_negative(), computed("as `coefficient`"), "Coefficient of friction at rest."},
          {"stribeck_velocity", number("m/s").non_negative(), optional,
           "Speed over which the coefficient falls from `static` to `coefficient`."},
          {"viscous", number("s/m").non_negative(), otherwise("0"), "Viscous friction per speed and per normal force."},
          {"model", word(models, "a model of friction"), otherwise(models.front()), "Model of friction near rest."},
          {"velocity", number("m/s").positive(), computed("a tenth of `stribeck_velocity`, or 1 mm/s"),
           "Speed within which `coulomb` makes the force smooth."},
          {"bristle_stiffness", number("1/m").positive(), optional,
           "Stiffness of the bristles of `lugre` per normal force, which that model needs."},
          {"bristle_damping", number("s/m").non_negative(), otherwise("0"),
           "Damping of the bristles of `lugre` per normal force."}};
}

const std::vector<std::string>& friction_law_keys() {
  static const std::vector<std::string> names = keys::names_of(keys_of_friction_law({"coulomb"}));
  return names;
}

FrictionLaw read_friction_law(const YamlValue& entry, const std::vector<std::string>& models) {
  FrictionLaw law;
  const auto model = entry.find("model");
  const std::string name = model ? model->word(models, "a model of friction") : models.front();
  law.model = name == "lugre"        ? FrictionLaw::Model::lugre
              : name == "stick_slip" ? FrictionLaw::Model::stick_slip
                                     : FrictionLaw::Model::coulomb;
  law.kinetic = entry.at("coefficient").non_negative_number();
  law.sticking = law.kinetic;
  if (const auto at_rest = entry.find("static")) {
    law.sticking = at_rest->non_negative_number();
    if (law.sticking < law.kinetic) at_rest->fail("friction at rest is no smaller than when it slides (`coefficient`)");
  }
  if (const auto speed = entry.find("stribeck_velocity")) {
    if (!entry.has("static")) speed->fail("is where friction falls from `static`, which is missing");
    law.stribeck_velocity = law.sticking > law.kinetic && law.model != FrictionLaw::Model::stick_slip
                                ? speed->positive_number()
                                : speed->non_negative_number();
  } else if (law.sticking > law.kinetic && law.model != FrictionLaw::Model::stick_slip) {
    entry.at("static").fail("say over which speed friction falls to `coefficient`: `stribeck_velocity` [m/s]");
  }
  if (const auto viscous = entry.find("viscous")) law.viscous = viscous->non_negative_number();

  const auto only_for = [&](const char* key, FrictionLaw::Model of, const char* of_name) {
    if (const auto value = entry.find(key); value && law.model != of)
      value->fail(fmt::format("belongs to `model: {}`; this is {}", of_name, name));
  };
  only_for("velocity", FrictionLaw::Model::coulomb, "coulomb");
  only_for("bristle_stiffness", FrictionLaw::Model::lugre, "lugre");
  only_for("bristle_damping", FrictionLaw::Model::lugre, "lugre");
  if (law.model == FrictionLaw::Model::coulomb) {
    const auto width = entry.find("velocity");
    if (width && law.stribeck_velocity > 0 && width->number() >= law.stribeck_velocity)
      width->fail("the force is made smooth within far less than `stribeck_velocity`: a tenth of it, say");
    law.velocity = width                       ? width->positive_number()
                   : law.stribeck_velocity > 0 ? law.stribeck_velocity / 10
                                               : usual_width;
  }
  if (law.model == FrictionLaw::Model::lugre) {
    law.bristle_stiffness = entry.at("bristle_stiffness").positive_number();
    law.bristle_damping = entry.has("bristle_damping") ? entry.at("bristle_damping").non_negative_number() : 0;
    if (law.kinetic == 0 && law.sticking > 0)
      entry.at("coefficient")
          .fail("expected a number greater than 0: bristles that are to let go slide against friction");
  }
  if (law.sticking == 0) law.forget_dry_friction();
  return law;
}

}  // namespace bielle::mechanism
