// Lifetime of the factors of the tangent, decided by counted costs (step_costs.hpp).
//
// Within a step, old factors are used as long as the iterations that are left cost no more than a factorisation and one
// iteration. From step to step they are kept until a step costs more than the average of the steps since they were
// made, their own cost included: from then on the average would grow. This average is compared with the mean cost of
// the last steps that began with new factors. If it is not less, the following steps begin with new factors: one of
// them, then two, four, up to 16 as long as every new attempt to reuse factors has the same result.
#pragma once

#include "mechanism/solvers/dynamics/step_costs.hpp"
#include "mechanism/solvers/newton/convergence.hpp"

namespace bielle::mechanism {

class TangentPolicy {
 public:
  explicit TangentPolicy(Tangent wanted) : wanted_(wanted) {}

  /// Discards all that earlier steps have shown.
  void begin_anew() { *this = TangentPolicy(wanted_); }
  /// Sets the costs with new factors.
  void set_costs(const StepCosts& costs) { costs_ = costs; }
  /// Returns the cost of operations [ns].
  double cost(int evaluations, int solutions, int factorisations) const {
    return evaluations * costs_.evaluation + solutions * costs_.solution + factorisations * costs_.factorisation;
  }
  bool ever_reuses() const { return wanted_ != Tangent::renewed; }
  /// Returns whether the first iteration of the next step needs new factors, although those of an earlier step exist.
  bool renews_at_start() const { return wanted_ == Tangent::renewed || renewals_left_ > 0; }
  /// Returns whether old factors are good enough in a step. @param before,now  the residual before and after an
  /// iteration with them, relative to its tolerance
  bool worthwhile(double before, double now) const;
  /// Judges the factors after a converged step.
  /// @param wasted  cost of the iterations in it before the first factorisation, if there was one; otherwise 0
  /// @param cost    cost of all iterations in it
  /// @returns whether the factors may be used in the next step
  bool judge(double wasted, double cost, int factorisations);

 private:
  static constexpr int most_renewals = 16;
  void end_cycle(double average);
  bool is_renewed_cost_known() const { return renewed_age_ <= most_renewals; }

  Tangent wanted_;
  StepCosts costs_;
  double spent_ = 0;                     ///< cost of the steps since the last factorisation, with its own
  int served_ = 0;                       ///< number of these steps
  double renewed_cost_ = 0;              ///< mean cost of the last steps that began with new factors
  int renewed_age_ = most_renewals + 1;  ///< number of steps since the last one
  int renewals_ = 0;                     ///< number of steps that begin with new factors after the last attempt
  int renewals_left_ = 0;                ///< number of those that are still to come
};

}  // namespace bielle::mechanism
