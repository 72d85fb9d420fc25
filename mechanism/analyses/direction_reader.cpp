#include "mechanism/analyses/direction_reader.hpp"

namespace bielle::mechanism {

KeyForms direction_forms() {
  using namespace keys;
  return {word({"x", "y", "z"}, "a direction (x, y, z or a vector)"), direction().as_vector().in_inertial_axes()};
}

Vector3 read_direction(const YamlValue& value) {
  return value.is_sequence() ? Vector3(value.direction()) : Vector3::Unit(value.word()[0] - 'x');
}

}  // namespace bielle::mechanism
