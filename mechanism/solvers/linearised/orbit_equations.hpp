// Equations of a mechanism with a turning part (turning_part.hpp) along a periodic motion: the residual at azimuths of
// a turn, and the linearised equations of small motions about it.
//
// The mean state (azimuth_equations.hpp) is displaced by a periodic deviation. With E(psi) the rotation of the part and
// a node's mean orientation R_m = E R_0, the periodic motion has R = R_m exp(Theta) and the angular velocity
//     Omega = exp(-Theta) Omega_m + T(Theta) Theta'.
// Small motions have increments y in the axes of the mean motion: dx = E y, dTheta = exp(-Theta) y. These axes turn
// steadily, so that dv = axes (s + W) y with the constant W of the mean state, and accelerations follow from
// da = axes (s + W)^2 y, dOmegadot = axes (s + W)^2 y - Omega~ dOmega. All forces act as they are, gravity included.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/azimuth_equations.hpp"
#include "mechanism/solvers/linearised/periodic_deviation.hpp"

namespace bielle::mechanism {

class OrbitEquations {
 public:
  /// @param mean  the mean state at equidistant azimuths (azimuths_over_turn)
  /// All references must outlive this object.
  OrbitEquations(const System& system, const Environment& environment, const TurningPart& part,
                 std::vector<Azimuth> mean);

  int count() const { return static_cast<int>(mean_.size()); }
  int unknowns() const { return mean_.front().equations.unknowns(); }
  int constraints() const { return mean_.front().equations.constraints(); }
  double azimuth(int k) const;
  const Azimuth& mean(int k) const { return mean_[static_cast<std::size_t>(k)]; }

  /// Returns the state at an azimuth, with rates, accelerations and multipliers.
  State state(int k, const PeriodicDeviation& deviation) const;
  /// Returns the residual of the equations of motion in the axes of the mean motion, then of the combined rows of
  /// constraints. A drive or lock of the joint is taken to follow its rotation. @param scale  if given, receives the
  /// largest forces
  VectorX residual(int k, const PeriodicDeviation& deviation, ResidualScale* scale = nullptr) const;
  /// Returns the rates of all dofs and first-order unknowns in the axes of the mean motion.
  VectorX rates(int k, const PeriodicDeviation& deviation) const;
  /// Returns the state with the linearised equations about the motion there.
  Azimuth linearised(int k, const PeriodicDeviation& deviation) const;

 private:
  LinearisedEquations::Sparse axes(int k, const VectorX& q) const;
  VectorX in_mean_axes(int k, const LinearisedEquations::Sparse& axes, const VectorX& r) const;

  const System& system_;
  const Environment& environment_;
  const TurningPart& part_;
  std::vector<Azimuth> mean_;
  std::vector<VectorX> drives_;  ///< for each azimuth, residual of the joint's drives in the mean state
};

}  // namespace bielle::mechanism
