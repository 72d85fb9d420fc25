// Moves a model and reads its datasets, for benchmarks of joints.
#pragma once

#include <functional>
#include <string>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

namespace bielle::test {

using Look = std::function<void(const mechanism::Session&)>;

/// Integrates by the generalised-alpha scheme with rho = 0.8 in steps of h.
/// @param look  called after every step; at the start as well with `from_start`
inline void move(const std::string& text, double h, double end, const Look& look, bool from_start = false) {
  const mechanism::MechanismFile file = mechanism::read_mechanism_text(text, "model.yaml");
  mechanism::Session session(file.model);
  mechanism::DynamicsOptions options;
  options.duration = end;
  options.stepping.size = h;
  mechanism::Motion motion = session.dynamics(options);
  if (from_start) look(session);
  while (motion.step()) look(session);
}

/// Integrates in the same way, and calls `look` only once, at the end.
inline void move_to(const std::string& text, double h, double end, const Look& look) {
  const mechanism::MechanismFile file = mechanism::read_mechanism_text(text, "model.yaml");
  mechanism::Session session(file.model);
  mechanism::DynamicsOptions options;
  options.duration = end;
  options.stepping.size = h;
  mechanism::Motion motion = session.dynamics(options);
  motion.finish();
  look(session);
}

}  // namespace bielle::test
