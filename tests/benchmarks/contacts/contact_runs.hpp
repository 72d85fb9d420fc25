// Models of contacts and their runs, for benchmarks.
#pragma once

#include <functional>
#include <string>

#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

namespace bielle::test {

inline constexpr double g = 9.81;  ///< gravity of all models that have it [m/s^2]

/// One body on node `name`: a node entry and a rigid_body entry of the same name.
struct Body {
  std::string name, node;  ///< node: what stands in its braces
  double mass = 1;
  mechanism::Vector3 inertia{0.004, 0.004, 0.004};
};

/// Returns a model of bodies and joints. @param joints  text of the section's entries
inline std::string contact_model(const std::vector<Body>& bodies, const std::string& joints,
                                 const std::string& gravity = "[0, 0, 0]") {
  std::string nodes = "nodes:\n", elements = "elements:\n";
  for (const Body& body : bodies) {
    nodes += fmt::format("  {}: {{{}}}\n", body.name, body.node);
    elements +=
        fmt::format("  {0}: {{type: rigid_body, node: {0}, mass: {1:.17g}, inertia: [{2:.17g}, {3:.17g}, {4:.17g}]}}\n",
                    body.name, body.mass, body.inertia[0], body.inertia[1], body.inertia[2]);
  }
  return "gravity: " + gravity + "\n" + nodes + elements + "joints:\n" + joints;
}

struct ContactRun {
  double h = 1e-3, end = 1;
  double tolerance = 0;  ///< adaptive steps
  double rho = 0.8;
};

/// @param look  called at the start and after every step
inline mechanism::MarchLog run_contact(
    const std::string& text, const ContactRun& run,
    const std::function<void(const mechanism::Session&, const mechanism::Motion&)>& look) {
  const mechanism::MechanismFile file = mechanism::read_mechanism_text(text, "model.yaml");
  mechanism::Session session(file.model);
  mechanism::DynamicsOptions options;
  options.duration = run.end;
  options.stepping.size = run.h;
  options.stepping.tolerance = run.tolerance;
  options.scheme = mechanism::Scheme::generalized_alpha(run.rho);
  mechanism::Motion motion = session.dynamics(options);
  look(session, motion);
  while (motion.step()) look(session, motion);
  return motion.log();
}

/// Returns about half the duration of an impact of F = k p^n without damping [s].
inline double impact_time(double mass, double stiffness, double exponent, double speed) {
  const double depth = std::pow((exponent + 1) * mass * speed * speed / (2 * stiffness), 1 / (exponent + 1));
  return 1.5 * depth / speed;
}

}  // namespace bielle::test
