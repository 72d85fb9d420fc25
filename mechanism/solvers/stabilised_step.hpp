// One linear solve of Newton's method for the index-2 stabilised form (Gear, Gupta and Leimkuhler): the increment of a
// step is Dq = u + eta, where u belongs to velocities and accelerations (v = gamma' u + ..., a = beta' u + ...) and eta
// brings the positions back on their constraints,
//     W eta = B_n^T mu,   so that both   Phi(q) = 0   and   dPhi/dt = B v + c = 0   hold at the end of the step.
// B_n at the start of the step, W the diagonal of the mass matrix, with a floor. The matrix of (u, y, lambda | eta,
// mu):
//     [ J       J_q     0    ]     J the step's tangent, rows of dofs, y and Phi
//     [ 0       W      -B_n^T ]    J_q its part by positions alone
//     [ J_v     N T     0    ]     J_v = gamma' B + N T, N = d(B v)/dq
// C. W. Gear, B. Leimkuhler, G. K. Gupta, J. Comput. Appl. Math. 12 (1985) 77; M. Arnold, O. Bruls, A. Cardona, Numer.
// Math. 129 (2015) 149 (with generalised-alpha).
#pragma once

#include <vector>

#include "mechanism/solvers/linear_step.hpp"

namespace bielle::mechanism {

class StabilisedStep {
 public:
  explicit StabilisedStep(const System& system);

  /// Number of unknowns: those of the system, eta and mu. Rows and unknowns come in this order.
  int size() const { return system_.size() + system_.dofs() + system_.multipliers(); }
  /// Takes B_n and W from the start of a step. @throws nothing: what has no mass gets a floor
  void begin(const State& state, const Environment& environment);
  /// Residual rows behind those of the system: W eta - B_n^T mu, and dPhi/dt. @param r (size)
  void add_residual(const State& state, const Environment& environment, const VectorX& eta, const VectorX& mu,
                    Eigen::Ref<VectorX> r) const;
  /// Assembles what J lacks, and factorises. Returns false when singular.
  /// @param step  holds J, assembled with the weights
  bool factor(const LinearStep& step, const State& state, const Environment& environment, const TangentWeights& weights,
              const VectorX& dq);
  /// delta = -(matrix)^-1 r. @param r,delta (size)
  void solve(const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) const;
  void choose_pivots_anew() { factors_.forget(); }

 private:
  /// An entry of the system's pattern with its places in the large one, -1 where it has none.
  struct Places {
    int tangent = -1;                           ///< in J
    int position = -1;                          ///< in J_q
    int velocity = -1, velocity_position = -1;  ///< constraint rows: in J_v and N T
    int constraint = -1;                        ///< constraint rows: in -B_n^T
  };
  bool holds(int multiplier) const { return active_[static_cast<std::size_t>(multiplier)]; }

  const System& system_;
  std::vector<bool> holonomic_;  ///< multipliers of constraints of positions that are not set aside for good
  std::vector<bool> active_;     ///< of these, those in the equations of the present step
  SparsePattern pattern_;
  std::vector<Places> places_;                    ///< of each entry of the system's pattern
  std::vector<int> weight_places_, idle_places_;  ///< diagonals of W, and of mu (put where it has no constraint)
  SparseLU factors_;
  VectorX weight_, scale_;
  std::vector<double> constraint_;  ///< B_n among the values of the system's pattern
  std::vector<double> position_, velocity_, velocity_position_, values_;
};

}  // namespace bielle::mechanism
