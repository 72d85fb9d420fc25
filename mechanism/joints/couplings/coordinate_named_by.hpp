// Coordinates of joints as the entries of other joints name them.
#pragma once

#include <optional>

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

struct NamedCoordinate {
  const Joint* joint;
  std::size_t index;
  const JointCoordinate& coordinate() const { return joint->coordinates()[index]; }
};

/// The coordinate that a value names: `main`, a joint with one coordinate (or with one of the wanted kind);
/// `main.angle`; or `{joint: main, coordinate: angle}`. Components of rotation vectors are none that can be coupled.
/// Call when all joints are read (Model::Stage::connections). @throws InputError
NamedCoordinate coordinate_named_by(const YamlValue& value, Model& model,
                                    std::optional<JointCoordinate::Kind> wanted = {});

}  // namespace bielle::mechanism
