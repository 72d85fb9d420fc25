// A model for tests of sessions: two arms that swing in a plane, a spring and damper, and a push with kinks.
#pragma once

#include <string>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

namespace bielle::test {

/// @param more  further sections of the file
inline mechanism::MechanismFile swinging_arms(const std::string& more = "") {
  return mechanism::read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  upper: {position: [0.5, 0, 0]}
  lower: {position: [1.5, 0, 0], angular_velocity: [0, 30, 0], velocity: [0, 0, -15]}
  wall: {position: [2, 0, 3], fixed: true}
elements:
  upper: {type: rigid_body, node: upper, mass: 2, inertia: [0.01, 0.2, 0.2]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.01, 0.1, 0.1]}
  spring: {type: spring_damper, nodes: [wall, lower], stiffness: 200, damping: 3, length: 1}
joints:
  shoulder: {type: hinge, nodes: [ground, upper], position: [0, 0, 0], axis: [0, 1, 0]}
  elbow: {type: hinge, nodes: [upper, lower], position: [1, 0, 0], axis: [0, 1, 0]}
loads: {push: {node: lower, force: ["20*pulse(t, 0.1234, 0.3)", 0, 0]}}
)yaml" + more,
                                        "arms.yaml");
}

/// @param tolerance  0: fixed steps
inline mechanism::DynamicsOptions swing(double duration, double tolerance = 0) {
  mechanism::DynamicsOptions options;
  options.duration = duration;
  options.stepping.size = 1e-3;
  options.stepping.tolerance = tolerance;
  return options;
}

/// Returns all readable values, one after the other.
inline std::vector<double> all_numbers(const mechanism::Session& session) {
  std::vector<double> all = session.read("time");
  for (const mechanism::ResultsColumn& column : session.datasets()) {
    const std::vector<double> values = session.read(column.dataset);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

}  // namespace bielle::test
