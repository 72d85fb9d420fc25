// How well an eigenvalue is known, and what kind of mode that makes it.
#pragma once

#include "mechanism/solvers/linearised/equation_rounding.hpp"
#include "mechanism/solvers/linearised/equation_symmetry.hpp"
#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

class ModeJudgement {
 public:
  /// @param options  with the changes of the equations
  ModeJudgement(const LinearisedEquations& equations, const EquationRounding& rounding, const ModeOptions& options)
      : e_(equations),
        rounding_(rounding),
        symmetry_(equation_symmetry(equations)),
        drift_(options.drift),
        rate_(options.rate) {}

  /// Sets the uncertainty and the kind of a mode that is not rigid. An eigenvalue that is farther from what its vectors
  /// say than its uncertainty is moved there (s -= y^T D x/y^T D' x: y and x stand still to first order).
  void judge(Mode& mode) const;
  /// Whether what rates add along a motion, at s, is less than rounding makes of stiffness.
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
