#include "mechanism/analyses/rotation_reader.hpp"

#include "mechanism/reading/names.hpp"
#include "mechanism/solvers/linearised/turning_part.hpp"

namespace bielle::mechanism {
namespace {

Key rate_key(const char* about) { return {"rate", keys::number("rad/s"), keys::required, about}; }

const KeyTable& joint_rotation_keys() {
  static const KeyTable table{
      "`rotation` behind a joint",
      "Steady rotation of the part behind a joint; the rest stands still.",
      {turning_joint_key(), rate_key("Rate of the joint's angle, other than 0."), turning_state_key()}};
  return table;
}

const KeyTable& rotation_keys() {
  using namespace keys;
  static const KeyTable table{
      "`rotation`",
      "Steady rotation of all free parts about an axis, into which the mechanism is brought first.",
      {rate_key("Angular velocity about the axis, other than 0."),
       {"axis", direction().as_axial().in_inertial_axes(), required, "Direction of the axis, in inertial components."},
       {"position", vector3("m").as_point().in_inertial_axes(), otherwise("[0, 0, 0]"), "A point of the axis."}},
      {{"joint", "", joint_rotation_keys}}};
  return table;
}

}  // namespace

Key rotation_key() {
  return {"rotation", keys::nested(rotation_keys), keys::optional,
          "Steady rotation into which the mechanism is brought first; small motions are about it."};
}

Key turning_joint_key() {
  return {"joint", keys::name_of("joint"), keys::required, "Joint with one angle, behind which a part turns."};
}

Key turning_state_key() {
  using namespace keys;
  return {
      "state", word({"periodic", "mean"}, "a state"), otherwise("periodic"),
      "State that small motions are about: with the vibrations that gravity across the axis and unbalance excite, or "
      "their mean over a turn."};
}

bool read_mean(const YamlValue& rotation) { return rotation.at("state").word() == "mean"; }

std::string read_turning_joint(const YamlValue& name, const Model& model) {
  component_named_by(Section::joints, name, model);  // refuses other names
  const std::size_t joint = model.members_of({Section::joints, name.text()}).front();
  if (const std::string reason = no_turning_joint(model.members()[joint]); !reason.empty()) name.fail(reason);
  return name.text();
}

SteadyRotation read_rotation(const YamlValue& entry, const Model& model) {
  SteadyRotation rotation;
  const double rate = entry.at("rate").number();
  if (rate == 0) entry.at("rate").fail("expected a rate other than 0: without rotation, leave the key out");
  if (const auto joint = entry.find("joint")) {
    rotation.joint = model.members_of({Section::joints, read_turning_joint(*joint, model)}).front();
    rotation.rate = rate;
    rotation.mean = read_mean(entry);
    return rotation;
  }
  rotation.omega = rate * Vector3(entry.at("axis").direction());
  rotation.through = entry.at("position").vector3();
  return rotation;
}

}  // namespace bielle::mechanism
