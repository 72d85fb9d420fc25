// Eigenpairs of the linearised equations next to a shift, without those that are known.
//
// States that are known span an invariant subspace of T (shifted_operator.hpp), whatever the shift: with an orthonormal
// basis Q of it, (1 - Q Q^T) T has the other eigenvalues, and an eigenvector z of it belongs to the eigenvector
//     x = z + Q c,      (mu - Q^T T Q) c = Q^T T z.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "mechanism/solvers/linearised/shifted_operator.hpp"

namespace bielle::mechanism {

struct Eigenpair {
  std::complex<double> s;
  Eigen::VectorXcd x;  ///< state [u; w]
  Eigen::VectorXcd z;  ///< its part that, with what is known, spans an invariant subspace
  double residual;     ///< |T x - mu x| / |mu x|, of scaled states
};

/// Nearest to the shift first, and how far around it all are known.
struct EigenpairsNearby {
  std::vector<Eigenpair> pairs;
  bool rejected = false;  ///< some belonged to infinite eigenvalues, or to ones too large for the shift to show
  double radius = 0;      ///< |s - sigma|; infinite where all are there
};

class EigenpairsAround {
 public:
  /// @param dense  systems of up to so many independent states are solved densely; 0: none
  EigenpairsAround(const LinearisedEquations& equations, Eigen::Index dense) : e_(equations), dense_(dense) {}

  /// Leaves out states that span an invariant subspace with those before, from the next shift on. @param (states, any)
  void keep_out(const MatrixX& states);
  Eigen::Index kept_out() const { return known_.cols(); }
  /// Makes the operator, at a shift next to this one where it is an eigenvalue. @throws SingularEquations
  void set_shift(std::complex<double> shift);
  const ShiftedOperator& T() const { return *operator_; }

  enum class Look { roughly, exactly };
  /// At least so many, as far as there are so many. @throws ComputationError where ARPACK does not converge
  EigenpairsNearby look(Eigen::Index count, Look how) const;

 private:
  bool dense() const;
  Eigen::VectorXcd recovered(std::complex<double> mu, const Eigen::VectorXcd& z) const;

  const LinearisedEquations& e_;
  Eigen::Index dense_;
  MatrixX known_;
  std::unique_ptr<ShiftedOperator> operator_;
  MatrixX Q_;            ///< (states, known), scaled
  Eigen::MatrixXcd TQ_;  ///< Q^T T Q
  MatrixX basis_;        ///< of the states to search densely
};

}  // namespace bielle::mechanism
