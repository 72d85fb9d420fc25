// Models with states, and how they are run: for the tests of states.
#pragma once

#include <string>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

namespace bielle::test {

inline mechanism::Session session_of(const std::string& text) {
  return mechanism::Session(mechanism::read_mechanism_text(text, "model.yaml").model);
}

inline mechanism::DynamicsOptions steps_of(double duration, double h) {
  mechanism::DynamicsOptions options;
  options.duration = duration;
  options.stepping.size = h;
  return options;
}

/// A rotor of 0.5 kg m^2 about the z axis, with whatever else is written below it.
inline std::string rotor(const std::string& more) {
  return R"yaml(
nodes: {rotor: {position: [0, 0, 0]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {main: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1]}}
)yaml" + more;
}

}  // namespace bielle::test
