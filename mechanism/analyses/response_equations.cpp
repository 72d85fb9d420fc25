#include "mechanism/analyses/response_equations.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mechanism/analyses/steady_response.hpp"
#include "mechanism/analyses/turning_response.hpp"

namespace bielle::mechanism {

ResponseEquations::ResponseEquations(Session& session, const std::vector<ResponseInput>& inputs,
                                     const std::vector<ResponseOutput>& outputs,
                                     const std::optional<SteadyRotation>& rotation) {
  const System& system = session.system();
  check_response_names(session.model(), inputs, outputs);
  about_ = standing_state(session, rotation);
  if (rotation && rotation->joint) turning_.emplace(system, about_, *rotation);
  if (turning_ && !turning_->periodic.constant()) {
    make_turning(system, inputs);
    return;
  }
  setting_ = turning_ ? turning_->setting({}) : linearised_setting(system, about_.environment, about_.state, rotation);
  equations_ = turning_ ? turning_->periodic.first()
                        : linearised_equations(system, about_.environment, about_.state, setting_.axes);
  rows_.resize(static_cast<std::size_t>(equations_.unknowns()));
  std::iota(rows_.begin(), rows_.end(), 0);
  response_ = std::make_unique<SteadyResponse>(system, about_.state, about_.environment, equations_);
}

/// The slowest modes determine the number of harmonics of a motion, counted from the harmonic at which the standing
/// part moves. A force on a turning node has the harmonics +-1 in turning axes, and moves the standing part at the
/// harmonics up to +-2; an input of the model may do so too.
void ResponseEquations::make_turning(const System& system, const std::vector<ResponseInput>& inputs) {
  ModeOptions slow;
  slow.count = 10;
  HarmonicModes modes = turning_->search().find_resolved(slow);
  const bool standing = std::all_of(inputs.begin(), inputs.end(), [&](const ResponseInput& input) {
    return input.node >= 0 && !turning_->part.turns(input.node);
  });
  harmonics_ = modes.harmonics + (standing ? 0 : 2);
  setting_ = turning_->setting(modes);
  setting_.turning->harmonics = harmonics_;
  equations_ = standing ? std::move(modes.equations) : turning_->periodic.of_harmonics(harmonics_);
  for (int i = 0; i < turning_->periodic.first().unknowns(); ++i)
    rows_.push_back(turning_->periodic.index(0, i, harmonics_));
  response_ = std::make_unique<TurningResponse>(system, about_, *turning_, equations_, harmonics_);
}

}  // namespace bielle::mechanism
