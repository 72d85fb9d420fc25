// Models written as text and how sessions run them.
#pragma once

#include <string>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

namespace bielle::test {

inline mechanism::Model model_of(const std::string& text) {
  return mechanism::read_mechanism_text(text, "model.yaml").model;
}

inline mechanism::Session session_of(const std::string& text) { return mechanism::Session(model_of(text)); }

/// @param tolerance  tolerance of adaptive steps that begin with h
inline mechanism::DynamicsOptions steps_of(double duration, double h, double tolerance = 0) {
  mechanism::DynamicsOptions options;
  options.duration = duration;
  options.stepping.size = h;
  options.stepping.tolerance = tolerance;
  return options;
}

inline mechanism::DynamicsOptions steps_of(double duration, double h, mechanism::ConstraintForm form) {
  mechanism::DynamicsOptions options = steps_of(duration, h);
  options.form = form;
  return options;
}

}  // namespace bielle::test
