#include "mechanism/analyses/rotation_reader.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& rotation_keys() {
  using namespace keys;
  static const KeyTable table{
      "`rotation`",
      "Steady rotation of all free parts about an axis, into which the mechanism is brought first.",
      {{"rate", number("rad/s"), required, "Angular velocity about the axis, other than 0."},
       {"axis", direction().as_axial().in_inertial_axes(), required, "Direction of the axis, in inertial components."},
       {"position", vector3("m").as_point().in_inertial_axes(), otherwise("[0, 0, 0]"), "A point of the axis."}}};
  return table;
}

}  // namespace

Key rotation_key() {
  return {"rotation", keys::nested(rotation_keys), keys::optional,
          "Steady rotation into which the mechanism is brought first; small motions are about it."};
}

SteadyRotation read_rotation(const YamlValue& entry) {
  SteadyRotation rotation;
  const double rate = entry.at("rate").number();
  if (rate == 0) entry.at("rate").fail("expected a rate other than 0: without rotation, leave the key out");
  rotation.omega = rate * Vector3(entry.at("axis").direction());
  rotation.through = entry.at("position").vector3();
  return rotation;
}

}  // namespace bielle::mechanism
