// Adapts messages of readers to users who pass text instead of a file.
#pragma once

#include <string>

namespace bielle::python {

/// Marks the end of the name of a text that the user has not seen, a dictionary converted to YAML.
constexpr char unseen = '\x01';

/// Returns a message without the lines of such texts: "model: joints.main: 'dampng' is not a key of a hinge; ..".
std::string without_unseen_lines(const std::string& sentence);

/// Converts a message on a parameter of `--set` to Python's terms: "parameters: speed=5x: ..".
std::string of_parameters(const std::string& sentence);

}  // namespace bielle::python
