// Accuracy of an eigenvalue, and the kind of mode that follows from it.
#pragma once

#include "mechanism/solvers/linearised/equation_rounding.hpp"
#include "mechanism/solvers/linearised/equation_symmetry.hpp"
#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

class ModeJudgement {
 public:
  /// @param options  options that include the changes of the equations
  ModeJudgement(const LinearisedEquations& equations, const EquationRounding& rounding, const ModeOptions& options)
      : e_(equations),
        rounding_(rounding),
        symmetry_(equation_symmetry(equations)),
        drift_(options.drift),
        rate_(options.rate) {}

  /// Sets the uncertainty and the kind of a mode that is not rigid. If an eigenvalue differs from the value given by
  /// its vectors by more than its uncertainty, it is corrected (s -= y^T D x/y^T D' x: y and x are constant to first
  /// order).
  void judge(Mode& mode) const;
  /// Whether the rate-dependent terms along a motion, at s, are smaller than the rounding errors of the stiffness.
  bool is_nothing(std::complex<double> s, const Eigen::VectorXcd& u) const;

 private:
  Eigen::VectorXcd left(const Mode& mode) const;
  double drift_uncertainty(std::complex<double> s) const;
  const LinearisedEquations& e_;
  const EquationRounding& rounding_;
  EquationSymmetry symmetry_;
  double drift_, rate_;
};

}  // namespace bielle::mechanism
