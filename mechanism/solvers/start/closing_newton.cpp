#include "mechanism/solvers/start/closing_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bielle::mechanism {
namespace {

using Gaps = ClosingEquations::Gaps;

constexpr double satisfied = 1e-13;   // relative to the constraint's size
constexpr double relaxed = 1e-7;      // motion of the last iteration relative to the mechanism's size
constexpr double most_turn = 0.3;     // [rad] rotation of a node per iteration
constexpr double near_by = 1e-4;      // gaps relative to the mechanism's size that a step may open temporarily
constexpr double floor_part = 1e-10;  // parts with a slenderness of 1e4 rotate rather than bend
constexpr int most_iterations = 150, most_halvings = 5;
// Values of the damping C, relative to the stiffness and weight of each row.
constexpr double least_damping = 1e-2, first_damping = 1e4, most_damping = 1e14;

/// Largest rotation of a step, and its largest displacement relative to the mechanism's size.
struct StepSize {
  double turn = 0, displacement = 0;
};

StepSize size_of(const System& system, const VectorX& dq, double extent) {
  StepSize size;
  for (int i = 0; i < system.dofs(); ++i) {
    if (system.kind(i) == Kind::rotation) size.turn = std::max(size.turn, std::abs(dq[i]));
    if (system.kind(i) == Kind::translation) size.displacement = std::max(size.displacement, std::abs(dq[i]) / extent);
  }
  return size;
}

State moved(const System& system, const State& state, const VectorX& dq, const VectorX& dy, double part) {
  State result = state;
  system.displace(result, state, part * dq);
  for (const int k : system.algebraic()) result.first_order[k] += part * dy[k];
  return result;
}

VectorX compliance_of(const ClosingEquations& equations, double damping) {
  VectorX compliance(equations.rows());
  for (int k = 0; k < equations.rows(); ++k) compliance[k] = damping / (equations.stiffness() * equations.weight(k));
  return compliance;
}

class ClosingNewton {
 public:
  ClosingNewton(ClosingEquations& equations, State& state)
      : equations_(equations), state_(state), known_(VectorX::Zero(equations.rows())) {}

  bool run() {
    double motion = 0;
    constexpr int patience = 3;
    int stagnant = 0;  // iterations since the largest gap was last halved
    double reached = std::numeric_limits<double>::infinity();
    for (int iteration = 0;; ++iteration) {
      gaps_ = equations_.measure(state_);
      if (!std::isfinite(gaps_.worst)) return false;
      stagnant = gaps_.worst < 0.5 * reached ? 0 : stagnant + 1;
      reached = std::min(reached, gaps_.worst);
      const bool together = gaps_.worst <= satisfied || (stagnant >= patience && gaps_.worst <= 1e3 * satisfied);
      if (together && (iteration == 0 || motion <= relaxed || iteration == most_iterations)) return true;
      if (iteration == most_iterations || stands_still()) return false;
      equations_.assemble(state_);
      if (!step(motion)) return false;
    }
  }

 private:
  /// Returns whether large gaps have hardly decreased over the last iterations.
  bool stands_still() {
    constexpr std::size_t iterations = 15;
    constexpr double hardly = 0.98;
    history_.push_back(gaps_.squared);
    const double small = near_by * equations_.half_extent();
    return history_.size() > iterations && gaps_.squared > small * small &&
           gaps_.squared > hardly * history_[history_.size() - 1 - iterations];
  }

  /// Moves the state. @param motion  receives the size of the full step @returns false if no step reduces the gaps
  bool step(double& motion) {
    for (; damping_ <= most_damping; damping_ = std::max(first_damping, 1e3 * damping_)) {
      const VectorX compliance = compliance_of(equations_, damping_);
      if (!equations_.factor(compliance, floor_part)) continue;
      if (damping_ > least_damping) known_.setZero();
      VectorX dq, dy, mu;
      equations_.solve(gaps_.values + compliance.cwiseProduct(known_), dq, dy, mu);
      if (!dq.allFinite()) continue;
      const StepSize size = size_of(equations_.system(), dq, 2 * equations_.half_extent());
      double part = size.turn > most_turn ? most_turn / size.turn : 1;
      for (int halving = 0; halving <= most_halvings; ++halving, part /= 2) {
        State trial = moved(equations_.system(), state_, dq, dy, part);
        const Gaps gaps = equations_.measure(trial);
        const VectorX linear = (1 - part) * gaps_.values + part * compliance.cwiseProduct(VectorX(mu - known_));
        if (!accepted(gaps, linear)) continue;
        state_ = std::move(trial);
        motion = std::max(size.turn, size.displacement);
        // Rigid bodies need no known multipliers, and redundant constraints are disturbed by them.
        const bool holds = equations_.any_stiffness() && part == 1 && damping_ == least_damping;
        known_ = holds ? mu : VectorX::Zero(mu.size());
        if (halving == 0) damping_ = damping_ > first_damping ? damping_ / 30 : least_damping;
        return true;
      }
    }
    return false;
  }

  /// Returns whether gaps decrease by a fraction of the prediction of the linear equations, or are small anyway.
  bool accepted(const Gaps& gaps, const VectorX& linear) const {
    constexpr double part = 0.1;
    if (!std::isfinite(gaps.squared)) return false;
    const double small = near_by * equations_.half_extent();
    if (gaps.squared <= small * small) return true;
    double promised = 0;
    for (int k = 0; k < equations_.rows(); ++k) promised += equations_.weight(k) * linear[k] * linear[k];
    return gaps.squared < gaps_.squared && gaps_.squared - gaps.squared >= part * (gaps_.squared - promised);
  }

  ClosingEquations& equations_;
  State& state_;
  Gaps gaps_;
  VectorX known_;  ///< known multipliers
  std::vector<double> history_;
  double damping_ = least_damping;
};

}  // namespace

bool is_closed(const Gaps& gaps) { return gaps.worst <= satisfied; }

bool close_gaps(ClosingEquations& equations, State& state) { return ClosingNewton(equations, state).run(); }

VectorX gather_gaps(ClosingEquations& equations, const std::vector<bool>& soft, State& state) {
  constexpr double softness = 1e6, done = 1e-10;
  constexpr int iterations = 100;
  const System& system = equations.system();
  VectorX compliance, forces;
  // The energy of the rows as springs is half the sum of squared gaps, each times its stiffness.
  const auto energy = [&](const Gaps& gaps) { return 0.5 * gaps.values.cwiseAbs2().cwiseQuotient(compliance).sum(); };
  double floor = floor_part;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const Gaps gaps = equations.measure(state);
    if (compliance.size() == 0) {
      equations.assemble(state);
      compliance = compliance_of(equations, 1);
      for (int k = 0; k < equations.rows(); ++k)
        if (soft[static_cast<std::size_t>(k)]) compliance[k] *= softness;
    }
    forces = gaps.values.cwiseQuotient(compliance);
    const double before = energy(gaps);
    bool found = false;
    double motion = 0;
    // With the geometric stiffness this is Newton's method; if it increases the energy, the geometric stiffness is
    // omitted, and steps are damped.
    for (bool geometric = true; !found && floor < 1e4; geometric = false) {
      equations.assemble(state, geometric ? &forces : nullptr);
      VectorX dq, dy, mu;
      if (equations.factor(compliance, floor)) {
        equations.solve(gaps.values, dq, dy, mu);
        const StepSize size = size_of(system, dq, 2 * equations.half_extent());
        // B dq = C mu - Phi: the slope of the energy along the step.
        const double slope = forces.dot(VectorX(compliance.cwiseProduct(mu) - gaps.values));
        double part = size.turn > most_turn ? most_turn / size.turn : 1;
        for (int halving = 0; dq.allFinite() && slope < 0 && halving <= most_halvings; ++halving, part /= 2) {
          State trial = moved(system, state, dq, dy, part);
          const double after = energy(equations.measure(trial));
          if (!(after <= before + 1e-4 * part * slope)) continue;
          state = std::move(trial);
          motion = std::max(size.turn, size.displacement);
          found = true;
          if (geometric) floor = std::max(floor_part, floor / 100);
          break;
        }
      }
      if (!found && !geometric) floor *= 100;
    }
    if (!found || motion < done) break;
  }
  return equations.measure(state).values.cwiseQuotient(compliance);
}

}  // namespace bielle::mechanism
