// The two ways in which a program of Bielle fails, and the sentence that goes with each.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace bielle {

/// Whether a message begins with its subject, the key that it is about. A message about a whole section of the input
/// hides its subject if it names keys itself or needs no name.
enum class Subject { shown, hidden };

/// `subject: message`, or the message alone if the subject is empty or hidden.
std::string with_subject(const std::string& subject, const std::string& message, Subject is = Subject::shown);

/// A failure with a message for the user, and the key of the input that it is about.
class Failure : public std::runtime_error {
 public:
  explicit Failure(const std::string& message) : std::runtime_error(message) {}
  /// @param subject  the key of the input that the message is about, as the user knows it: "interfaces.big_end.surface"
  Failure(const std::string& subject, const std::string& message, Subject is = Subject::shown)
      : std::runtime_error(with_subject(subject, message, is)), subject_(subject) {}
  /// Returns the key whose place in the input file the program puts before the message. It is empty if the message
  /// contains the place already, or if it is about no key.
  const std::string& subject() const { return subject_; }

 private:
  std::string subject_;
};

/// The user's input is wrong: exit status 1. The message names file, line, key, what was expected and the nearest valid
/// name, e.g. `crank.yaml:17: joints.main: 'dampng' is not a key of a hinge; did you mean 'damping'?`.
class InputError : public Failure {
 public:
  using Failure::Failure;
};

/// A correct input led to a computation that failed: exit status 2. The message names the cause in the user's terms:
/// which joint, which element, which time.
class ComputationError : public Failure {
 public:
  using Failure::Failure;
};

/// Returns the result of `work`, whose InputErrors get a subject.
template <class Work>
auto about(const std::string& subject, const Work& work, Subject is = Subject::shown) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(subject, error.what(), is);
  }
}

/// Returns the candidate closest to `name` by edit distance (insertions, deletions, exchanges, swaps; case ignored);
/// empty when none is close enough to be a likely slip (more than a third of the letters differ).
std::string nearest_name(const std::string& name, std::span<const std::string> candidates);

/// "; did you mean 'damping'?" or, when nothing is near, "; expected one of 'a', 'b', 'c'" (at most 12 shown).
std::string did_you_mean(const std::string& name, std::span<const std::string> candidates);

}  // namespace bielle
