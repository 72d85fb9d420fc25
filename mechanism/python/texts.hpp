// Sentences of readers, for users who have no file before them.
#pragma once

#include <string>

namespace bielle::python {

/// Stands at the end of the name of a text that the user has not seen, a dictionary made into YAML.
constexpr char unseen = '\x01';

/// A sentence without the lines of such texts: "model: joints.main: 'dampng' is not a key of a hinge; ..".
std::string without_unseen_lines(const std::string& sentence);

/// A sentence on a parameter that `--set` would give, in the words of Python: "parameters: speed=5x: ..".
std::string of_parameters(const std::string& sentence);

}  // namespace bielle::python
