// Coordinates of joints, as named in entries of other joints.
#pragma once

#include <optional>

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

struct NamedCoordinate {
  const Joint* joint;
  std::size_t index;
  const JointCoordinate& coordinate() const { return joint->coordinates()[index]; }
};

/// Returns the forms of such a name: a joint, `main.angle` as a measure in a formula, or a map.
KeyForms coordinate_forms();

/// Returns the coordinate that a value names: `main`, a joint with one coordinate (or with one of the required kind);
/// `main.angle`; or `{joint: main, coordinate: angle}`. Components of rotation vectors cannot be coupled. Call it after
/// all joints have been read (Model::Stage::connections). @throws InputError
NamedCoordinate coordinate_named_by(const YamlValue& value, Model& model,
                                    std::optional<JointCoordinate::Kind> wanted = {});

}  // namespace bielle::mechanism
