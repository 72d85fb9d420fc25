// When a Newton iteration is good enough: per kind of equation, independent of units.
//
// An equation of forces is satisfied when its residual is small beside the largest contribution of any component to the
// equations of its kind, or has reached what rounding of the unknowns makes of it (sum_j |J_ij| s_j eps). A constraint
// is satisfied when it would change the forces by no more than that: |Phi| k <= tolerance * forces, k the tangent's
// size.
#pragma once

#include "mechanism/solvers/linear_step.hpp"

namespace bielle::mechanism {

struct NewtonOptions {
  double tolerance = 1e-9;  ///< relative, see the head of this file
  int iterations = 20;      ///< at most
};

class Convergence {
 public:
  Convergence(const System& system, const NewtonOptions& options)
      : system_(system), options_(options), floor_(VectorX::Zero(system.size())) {}

  /// Renews the rounding floor from the last tangent. Once per step is enough.
  void measure_rounding(const LinearStep& linear, const State& state);
  /// @param r  residual (size) with its scale
  bool reached(const Eigen::Ref<const VectorX>& r, const ResidualScale& scale);
  /// The equation that was farthest from its tolerance in the last call of `reached`: "moment z at node 'pin' (3.2e+04
  /// N m)".
  std::string worst() const;
  double worst_ratio() const { return worst_ratio_; }  ///< residual over tolerance

 private:
  const System& system_;
  NewtonOptions options_;
  VectorX floor_, unknown_scale_;
  double scale_ = 1;
  int worst_ = -1;
  double worst_residual_ = 0, worst_ratio_ = 0;
};

}  // namespace bielle::mechanism
