// The two ways in which a program of Bielle fails, and the sentence that goes with each.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace bielle {

/// The user's input is wrong: exit status 1. The message names file, line, key, what was expected and the nearest valid
/// name, e.g. `crank.yaml:17: joints.main: 'dampng' is not a key of a hinge; did you mean 'damping'?`.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A correct input led to a computation that failed: exit status 2. The message names the cause in the user's terms:
/// which joint, which element, which time.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate closest to `name` by edit distance (insertions, deletions, exchanges, swaps; case ignored); empty when
/// none is close enough to be a likely slip (more than a third of the letters differ).
std::string nearest_name(const std::string& name, std::span<const std::string> candidates);

/// "; did you mean 'damping'?" or, when nothing is near, "; expected one of 'a', 'b', 'c'" (at most 12 shown).
std::string did_you_mean(const std::string& name, std::span<const std::string> candidates);

}  // namespace bielle
