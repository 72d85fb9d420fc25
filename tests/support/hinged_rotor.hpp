// A body that turns about a fixed axis.
#pragma once

#include <string>

namespace bielle::test {

/// Returns a rotor of 0.5 kg m^2 about the z axis, followed by further text.
inline std::string rotor(const std::string& more) {
  return R"yaml(
nodes: {rotor: {position: [0, 0, 0]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {main: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1]}}
)yaml" + more;
}

}  // namespace bielle::test
