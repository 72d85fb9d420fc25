// The equations of small motions about the present state of a session, with inputs and outputs, at rest, in motion or
// in steady rotation.
#pragma once

#include <memory>
#include <optional>

#include "mechanism/analyses/linear_response.hpp"
#include "mechanism/analyses/turning_equations.hpp"

namespace bielle::mechanism {

class ResponseEquations {
 public:
  /// @throws InputError for names that the model does not have; ComputationError if the rotation is not steady
  ResponseEquations(Session& session, const std::vector<ResponseInput>& inputs,
                    const std::vector<ResponseOutput>& outputs, const std::optional<SteadyRotation>& rotation);
  ResponseEquations(const ResponseEquations&) = delete;
  ResponseEquations& operator=(const ResponseEquations&) = delete;

  const LinearisedSetting& setting() const { return setting_; }
  const LinearisedEquations& equations() const { return equations_; }
  const LinearResponse& response() const { return *response_; }
  /// Number of harmonics of the rotation in the equations; 0: they have constant coefficients.
  int harmonics() const { return harmonics_; }
  /// Rows of the equations of the unknowns of the system; with harmonics, of their means over a turn.
  const std::vector<int>& rows() const { return rows_; }

 private:
  void make_turning(const System& system, const std::vector<ResponseInput>& inputs);

  StandingState about_;
  std::optional<TurningEquations> turning_;
  LinearisedSetting setting_;
  LinearisedEquations equations_;
  int harmonics_ = 0;
  std::vector<int> rows_;
  std::unique_ptr<LinearResponse> response_;
};

}  // namespace bielle::mechanism
