#include "mechanism/analyses/rotation_reader.hpp"

namespace bielle::mechanism {

SteadyRotation read_rotation(const YamlValue& entry) {
  entry.check_keys({"rate", "axis", "position"}, "`rotation`");
  SteadyRotation rotation;
  const double rate = entry.at("rate").number();
  if (rate == 0) entry.at("rate").fail("expected a rate other than 0: without rotation, leave the key out");
  rotation.omega = rate * Vector3(entry.at("axis").direction());
  if (const auto position = entry.find("position")) rotation.through = position->vector3();
  return rotation;
}

}  // namespace bielle::mechanism
