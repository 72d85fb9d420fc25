// Inputs and outputs of a mechanism with a turning part, for the equations of its harmonics
// (solvers/linearised/harmonic_equations.hpp).
//
// An input exp(s t) acts at each azimuth psi by its own derivatives of the residual, r(psi); the equations of the
// harmonics have its means with the functions e_p. An output is the mean over a turn of its variation: the part that
// has the frequency of the input. Inputs and outputs on the turning part, and unequal blades, also modulate the motion
// with the exponents s + i k rate, k = +-1, +-2, ..; these parts are omitted. (N. M. Wereley, S. R. Hall, Proc. 29th
// IEEE Conf. Decision and Control (1990) 3650: the harmonic transfer function of order 0.)
#pragma once

#include "mechanism/analyses/steady_response.hpp"
#include "mechanism/analyses/turning_equations.hpp"
#include "mechanism/solvers/linearised/azimuth_equations.hpp"

namespace bielle::mechanism {

class TurningResponse final : public LinearResponse {
 public:
  /// @param about  mean state in the steady rotation @param harmonics  h. All arguments but the last must outlive this
  /// object.
  TurningResponse(const System& system, const StandingState& about, const TurningEquations& turning,
                  const LinearisedEquations& equations, int harmonics);

  const LinearisedEquations& equations() const override { return equations_; }
  Eigen::VectorXcd values(const std::vector<ResponseOutput>& outputs, const LinearMotion& motion) const override;
  double direct(const ResponseOutput& output, const ResponseInput& input) const override;
  std::string units(const ResponseOutput& output) const override { return responses_.front().units(output); }

 private:
  VectorX right_side(const ResponseInput& input) const override;
  double azimuth(std::size_t k) const;
  /// Returns the motion in the unknowns of the system at an azimuth.
  LinearMotion at_azimuth(std::size_t k, const LinearMotion& motion) const;

  const PeriodicEquations& periodic_;
  const LinearisedEquations& equations_;
  int harmonics_;
  std::vector<Azimuth> azimuths_;
  std::vector<SteadyResponse> responses_;  ///< for each azimuth
};

}  // namespace bielle::mechanism
