#include "mechanism/analyses/state_space.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/analyses/delay_loops.hpp"
#include "mechanism/analyses/response_equations.hpp"
#include "mechanism/solvers/linearised/finite_states.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using MatrixXc = Eigen::MatrixXcd;

class StateSpaceBuilder {
 public:
  StateSpaceBuilder(const ResponseEquations& equations, const StateSpaceOptions& options, const ShiftedOperator& T)
      : response_(equations.response()),
        e_(equations.equations()),
        rows_(equations.rows()),
        options_(options),
        T_(T),
        finite_(e_, T) {}

  StateSpace build() {
    StateSpace result;
    const auto states = finite_.size(), inputs = static_cast<Eigen::Index>(options_.inputs.size()),
               outputs = static_cast<Eigen::Index>(options_.outputs.size());
    rights_ = response_.right_sides(options_.inputs, options_.outputs);
    result.E = finite_.Tf();
    result.A = MatrixX::Identity(states, states) + T_.shift().real() * finite_.Tf();
    result.B = MatrixX::Zero(states, inputs);
    for (Eigen::Index j = 0; j < inputs; ++j) {
      const LinearMotion answer = response_.answer(T_, rights_[static_cast<std::size_t>(j)]);
      VectorX x(e_.states());
      x << answer.u.real(), answer.rate.head(e_.dofs).real();
      result.B.col(j) = -finite_.coordinates(VectorX(x.cwiseQuotient(T_.scale())));
    }
    result.C = outputs_of_states(outputs);
    // At the shift, C (shift E - A)^-1 = -C.
    const MatrixX CB = result.C * result.B, sizes = result.C.cwiseAbs() * result.B.cwiseAbs();
    const MatrixXc H = exact(T_);
    result.D = H.real() + CB;
    constexpr double rounding = 1e-12;
    for (Eigen::Index i = 0; i < outputs; ++i)
      for (Eigen::Index j = 0; j < inputs; ++j)
        if (std::abs(result.D(i, j)) <= rounding * (sizes(i, j) + std::abs(H(i, j)))) result.D(i, j) = 0;
    result.unknowns.resize(static_cast<Eigen::Index>(rows_.size()), states);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      result.unknowns.row(static_cast<Eigen::Index>(i)) = T_.scale()[rows_[i]] * finite_.V().row(rows_[i]);
    for (const ResponseOutput& output : options_.outputs) result.output_units.push_back(response_.units(output));
    check(result);
    return result;
  }

 private:
  /// Returns C: displacements and velocities follow from the states directly, multipliers and rates of first-order
  /// unknowns from T_f.
  MatrixX outputs_of_states(Eigen::Index outputs) const {
    const int n = e_.unknowns(), m = e_.constraints();
    const auto states = finite_.size();
    MatrixX multipliers(m, states);
    for (Eigen::Index k = 0; k < states; ++k) multipliers.col(k) = T_.multipliers(VectorX(finite_.V().col(k)));
    multipliers = finite_.times_inverse(multipliers);
    const MatrixX x = T_.scale().asDiagonal() * finite_.V();
    const MatrixX y = x.middleRows(e_.dofs, n - e_.dofs);
    const MatrixX y_rates = finite_.times_inverse(y) + T_.shift().real() * y;
    MatrixX C(outputs, states);
    for (Eigen::Index k = 0; k < states; ++k) {
      LinearMotion motion{x.col(k).head(n).cast<Complex>(), Eigen::VectorXcd(n), multipliers.col(k).cast<Complex>()};
      motion.rate << x.col(k).tail(e_.dofs).cast<Complex>(), y_rates.col(k).cast<Complex>();
      C.col(k) = response_.values(options_.outputs, motion).real();
    }
    return C;
  }

  /// Computes the response from the original equations.
  MatrixXc exact(const ShiftedOperator& D) const { return response_.at(D, options_.inputs, options_.outputs, rights_); }

  /// Compares the responses at a second point; they differ if an output depends on derivatives of an input.
  void check(const StateSpace& found) const {
    const double s = 2.3 * T_.shift().real();
    const ShiftedOperator D(e_, s);
    if (!D.regular()) return;
    const MatrixXc H = exact(D);
    MatrixX answers(found.E.rows(), found.B.cols());
    if (answers.size() > 0) {
      LUFactors factors;
      factors.compute(MatrixX(s * found.E - found.A));
      factors.solve(found.B, answers);
    }
    const MatrixX ours = found.C * answers + found.D, sizes = found.C.cwiseAbs() * answers.cwiseAbs();
    constexpr double agrees = 1e-6, rounding = 1e-12;
    for (Eigen::Index i = 0; i < H.rows(); ++i)
      for (Eigen::Index j = 0; j < H.cols(); ++j)
        if (!(std::abs(H(i, j) - ours(i, j)) <=
              agrees * (std::abs(H(i, j)) + sizes(i, j)) + rounding * found.C.row(i).norm() * answers.col(j).norm()))
          throw ComputationError(fmt::format(
              "a state space cannot have the output '{}' of the input '{}': it follows the input's derivatives, as "
              "reactions and velocities do where an input prescribes a motion (`frequency_response` can)",
              options_.outputs[static_cast<std::size_t>(i)].name, options_.inputs[static_cast<std::size_t>(j)].name));
  }

  const LinearResponse& response_;
  const LinearisedEquations& e_;
  const std::vector<int>& rows_;
  const StateSpaceOptions& options_;
  const ShiftedOperator& T_;
  FiniteStates finite_;
  std::vector<VectorX> rights_;
};

/// Returns |s| of the slowest mode that is not rigid.
double slowest_motion(const LinearisedEquations& equations) {
  ModeOptions few;
  few.count = 1;
  for (const Mode& mode : find_modes(equations, few).modes)
    if (mode.kind != ModeKind::rigid) return std::abs(mode.s);
  return slowest_rate(equations);
}

}  // namespace

StateSpace compute_state_space(Session& session, const StateSpaceOptions& options) {
  const ResponseEquations response(session, options.inputs, options.outputs, options.rotation);
  const LinearisedEquations& equations = response.equations();
  constexpr int most = 4000;  // largest number of states, because the matrices are dense
  if (equations.states() > most)
    throw ComputationError(fmt::format(
        "a state space of {} states is too large (at most {}): reduce the bodies, or ask for a frequency response",
        equations.states(), most));
  // The shift is between the slowest and the fastest mode, so that both are accurate.
  const double slowest = slowest_motion(equations), fastest = std::max(slowest, fastest_rate(equations));
  constexpr double factors[] = {1, 1.0137, 13.7};
  for (const double factor : factors) {
    const ShiftedOperator T(equations, factor * std::sqrt(slowest * fastest));
    if (!T.regular()) continue;
    StateSpace result = StateSpaceBuilder(response, options, T).build();
    static_cast<LinearisedSetting&>(result) = response.setting();
    result.delays = describe_delays(session.model());
    return result;
  }
  throw ComputationError("the linearised equations are singular at every frequency (`eigen` names the cause)");
}

}  // namespace bielle::mechanism
