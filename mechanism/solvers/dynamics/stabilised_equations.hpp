// The equations of a step in the stabilised form of index 2 (Gear, Gupta and Leimkuhler): the increment of a step is Dq
// = u + eta. The part u belongs to velocities and accelerations (v = gamma' u + ..., a = beta' u + ...), and eta
// corrects the positions such that they satisfy their constraints,
//     W eta = B_n^T mu,   so that both   Phi(q) = 0   and   dPhi/dt = B v + c = 0   hold at the end of the step.
// Here B_n is taken at the start of the step, and W is the diagonal of the mass matrix, with a minimum. The matrix for
// (u, y, lambda | eta, mu) is
//     [ J       J_q     0    ]     J the step's tangent, rows of dofs, y and Phi
//     [ 0       W      -B_n^T ]    J_q its part by positions alone
//     [ J_v     N T     0    ]     J_v = gamma' B + N T, N = d(B v)/dq
// C. W. Gear, B. Leimkuhler, G. K. Gupta, J. Comput. Appl. Math. 12 (1985) 77; M. Arnold, O. Bruls, A. Cardona, Numer.
// Math. 129 (2015) 149 (with generalised-alpha).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mechanism/solvers/dynamics/step_equations.hpp"

namespace bielle::mechanism {

/// The order of rows and unknowns is: those of the system, eta, mu.
class StabilisedEquations final : public StepEquations {
 public:
  explicit StabilisedEquations(const System& system);
  ~StabilisedEquations() override;

  int size() const override { return system_.size() + system_.dofs() + system_.multipliers(); }
  /// Computes B_n and W at the start of a step. Dofs without mass get a minimum mass.
  void begin(const State& state, const Environment& environment) override;
  /// Computes the rows after those of the system: W eta - B_n^T mu, and dPhi/dt.
  void calc_residual(const State& trial, const Environment& environment, VectorX& r,
                     ResidualScale& scale) const override;
  void factor(const SchemeStep& step, const Environment& environment) override;
  void solve(const VectorX& r, VectorX& delta) const override;
  void move(SchemeStep& step, const VectorX& delta, double part) override;
  void follow(SchemeStep& step) const override { step.follow(&eta_); }
  /// The rates of constraints are judged by their effect on the constraints within a step.
  const VectorX& judged(const VectorX& r, double h) override;
  StepCosts costs() const override;
  void choose_pivots_anew() override;

 private:
  struct LargeMatrix;
  bool holds(int multiplier) const { return active_[static_cast<std::size_t>(multiplier)]; }
  void put_values();

  std::vector<bool> holonomic_;  ///< multipliers of position constraints that are not set aside permanently
  std::vector<bool> active_;     ///< those of them in the equations of the present step
  std::vector<std::pair<int, int>> constraint_entries_;  ///< multiplier and dof of each entry of B_n, by columns
  std::unique_ptr<LargeMatrix> large_;
  VectorX eta_, mu_;  ///< values of the trial
  VectorX weight_, scale_, judged_;
  std::vector<double> constraint_;  ///< B_n, in the order of its entries
  std::vector<double> position_, velocity_, velocity_position_, values_;
};

}  // namespace bielle::mechanism
