#include "mechanism/joints/friction/friction_reader.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "mechanism/joints/friction/bristle_friction.hpp"
#include "mechanism/joints/friction/creeping_friction.hpp"
#include "mechanism/joints/friction/stick_slip_friction.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& joint_friction_keys() {
  using namespace keys;
  static const KeyTable table{
      "`friction`", "Friction of the sliding surfaces of a joint, which follows the joint's own reaction.",
      joined({keys_of_friction_law({"coulomb", "lugre", "stick_slip"}),
              {{"radius", number("m").non_negative(), optional,
                "Radius of the surface, which turning joints need: the speed v is the radius times the rate."},
               {"arm", number("m").positive(), optional,
                "Length over which a moment across the motion acts, half the length of a guide or bearing; without it "
                "moments cause no friction."},
               {"preload", number("N").non_negative(), otherwise("0"),
                "Normal force of the surfaces besides the reaction."}}})};
  return table;
}

bool bears_moments(const Joint& joint) {
  Declaration declaration;
  joint.declare(declaration);
  const auto is_moment = [](const Declaration::Scalar& row) { return row.units == "N m"; };
  return std::any_of(declaration.multipliers.begin(), declaration.multipliers.end(), is_moment);
}

FrictionSurface read_surface(const YamlValue& entry, const Joint& joint, const SlidingSurface& slides) {
  const auto turns = [&](std::size_t k) { return joint.coordinates()[k].kind != JointCoordinate::Kind::displacement; };
  const bool any_turns = std::any_of(slides.coordinates.begin(), slides.coordinates.end(), turns);
  const auto radius = entry.find("radius");
  if (radius && !any_turns)
    radius->fail(fmt::format("a {} joint does not turn: it rubs without a radius", joint.type()));
  if (!radius && any_turns)
    entry.fail(fmt::format("a {} joint turns: give the `radius` of the surface that rubs [m]", joint.type()));
  // The normal force of a thread contains the torque divided by the radius, which must therefore not be zero.
  const double r = radius ? radius->number() : 0;
  if (slides.lead != 0 && r == 0) radius->fail("expected a number greater than 0, found 0");
  FrictionSurface surface;
  for (const std::size_t k : slides.coordinates)
    surface.parts.push_back({k, static_cast<int>(surface.parts.size()), turns(k) ? r : 1.0});
  surface.components = static_cast<int>(surface.parts.size());
  if (slides.lead != 0) {  // the surfaces slide along the helix
    const double c = std::hypot(r, slides.lead);
    for (FrictionSurface::Part& part : surface.parts) {
      part.component = 0;
      part.arm = turns(part.coordinate) ? r * r / c : slides.lead / c;
    }
    surface.components = 1;
    surface.thread_radius = r;
  }
  if (slides.roller != 0) {  // the roller slides on its pin, which has the radius r
    for (FrictionSurface::Part& part : surface.parts) {
      part.component = 0;
      part.arm = turns(part.coordinate) ? -r : r / slides.roller;
    }
    surface.components = 1;
  }
  if (const auto arm = entry.find("arm")) {
    if (!bears_moments(joint)) arm->fail(fmt::format("a {} joint bears no moment that could press", joint.type()));
    surface.moment_arm = arm->number();
  }
  surface.preload = entry.at("preload").number();
  return surface;
}

void add_friction(const YamlValue& entry, const Joint& joint, const SlidingSurface& slides, Model& model) {
  FrictionSurface surface = read_surface(entry, joint, slides);
  FrictionLaw law = read_friction_law(entry);
  const auto has_arm = [](const FrictionSurface::Part& part) { return part.arm != 0; };
  if (std::none_of(surface.parts.begin(), surface.parts.end(), has_arm)) law.forget_dry_friction();
  std::unique_ptr<Component> friction;
  switch (law.model) {
    case FrictionLaw::Model::coulomb:
      friction = std::make_unique<CreepingFriction>(joint, std::move(surface), law);
      break;
    case FrictionLaw::Model::lugre:
      friction = std::make_unique<BristleFriction>(joint, std::move(surface), law);
      break;
    case FrictionLaw::Model::stick_slip:
      if (surface.components > 1)
        entry.at("model").fail(
            fmt::format("`stick_slip` is for joints that slide along one coordinate; a {} joint slides along {} at "
                        "once: take `lugre`, which sticks too",
                        joint.type(), surface.components));
      friction = std::make_unique<StickSlipFriction>(joint, std::move(surface), law);
      break;
  }
  model.add(std::move(friction), Entry{Section::joints, joint.name()});
}

}  // namespace

KeyForms joint_friction_forms() {
  return {keys::nested(joint_friction_keys), keys::entries("coordinate", {keys::nested(joint_friction_keys)})};
}

void read_joint_friction(const YamlValue& value, const Joint& joint, Model& model) {
  const std::vector<SlidingSurface> surfaces = joint.sliding_surfaces();
  if (surfaces.empty()) value.fail(fmt::format("a {} joint has no friction", joint.type()));
  if (!value.is_map()) value.fail("expected a map: {coefficient: 0.1, ..}");
  std::vector<std::string> names;
  if (surfaces.size() > 1)
    for (const SlidingSurface& each : surfaces) names.push_back(joint.coordinates()[each.coordinates.front()].name);
  const auto is_named = [&](const std::string& name) { return value.has(name); };
  if (std::any_of(names.begin(), names.end(), is_named)) {
    value.check_keys(names, "`friction` by coordinates");
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      if (const auto entry = value.find(names[k]))
        add_friction(entry->keyed(joint_friction_keys()), joint, surfaces[k], model);
    return;
  }
  for (const JointCoordinate& each : joint.coordinates())
    if (value.has(each.name))
      value.at(each.name).fail(
          fmt::format("the coordinates of a {} joint slide at one surface: give one law for all", joint.type()));
  const YamlValue entry = value.keyed(joint_friction_keys());
  for (const SlidingSurface& each : surfaces) add_friction(entry, joint, each, model);
}

}  // namespace bielle::mechanism
