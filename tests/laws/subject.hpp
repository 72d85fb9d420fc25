// A sample that has been read: its model, the component under test alone, and states to test it in.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/io/mechanism_file.hpp"
#include "tests/laws/sample.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/random.hpp"

namespace bielle::laws {

using mechanism::MatrixX;
using mechanism::State;
using mechanism::VectorX;
using test::DenseModel;

/// Reads a sample's model. @param text  in place of the sample's own
/// @throws the exceptions of the readers
std::unique_ptr<mechanism::MechanismFile> read_sample(const Sample& sample, const std::string& text);

/// One component named `it`, alone with a state of its own. (A beam has several; one with constraints occurs twice,
/// with both kinds of axes of their rows.)
struct Subject {
  std::shared_ptr<mechanism::MechanismFile> file;
  std::unique_ptr<DenseModel> dense;
  Scales scales;
  bool carried_axes;  ///< kind of axes of its constraint rows, see Slots

  /// Returns the SI value of one unit of each unknown (or of its rate).
  VectorX position_units() const;
  VectorX rate_units() const;
  /// Returns a random state: everything is moved by `size` times the scales. With size = 1 the whole model is also
  /// placed somewhere in space.
  State random_state(double size, unsigned seed) const;
};

std::vector<Subject> subjects(const Sample& sample);

/// The states of the laws: the reference, 1e-8 around it, and anywhere.
struct NamedState {
  std::string name;
  State state;
};
std::vector<NamedState> law_states(const Subject& subject);

/// Returns the state as seen after a rotation Q and a translation of the whole model (the environment's gravity is the
/// caller's).
State moved_rigidly(const State& state, const mechanism::Matrix3& Q, const mechanism::Vector3& translation);

std::string title(const Sample& sample);  ///< "beam (arc, coupled section)"

}  // namespace bielle::laws
