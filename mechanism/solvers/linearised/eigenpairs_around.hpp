// Eigenpairs of the linearised equations next to a shift, without the known ones.
//
// Known states span an invariant subspace of T (shifted_operator.hpp), for any shift: with an orthonormal basis Q of
// it, (1 - Q Q^T) T has the other eigenvalues, and an eigenvector z of it belongs to the eigenvector
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
  Eigen::VectorXcd z;  ///< its part that spans an invariant subspace together with the known states
  double residual;     ///< |T x - mu x| / |mu x|, for scaled states
};

/// Eigenpairs, nearest to the shift first, and the radius within which all are known.
struct EigenpairsNearby {
  std::vector<Eigenpair> pairs;
  bool rejected = false;  ///< some eigenvalues were infinite, or too large to be resolved by the shift
  double radius = 0;      ///< |s - sigma|; infinite if all are known
};

class EigenpairsAround {
 public:
  /// @param dense  systems of up to this number of independent states are solved densely; 0: none
  EigenpairsAround(const LinearisedEquations& equations, Eigen::Index dense) : e_(equations), dense_(dense) {}

  /// Excludes states that span an invariant subspace together with the earlier ones, from the next shift on. @param
  /// (states, any)
  void keep_out(const MatrixX& states);
  Eigen::Index kept_out() const { return known_.cols(); }
  /// Creates the operator, at a slightly different shift if this one is an eigenvalue. @throws SingularEquations
  void set_shift(std::complex<double> shift);
  const ShiftedOperator& T() const { return *operator_; }

  /// `roughly` and `without_copies` may miss copies of a multiple eigenvalue; `roughly` is less accurate.
  enum class Look { roughly, without_copies, exactly };
  /// Finds at least `count` eigenpairs, or all if there are fewer. @throws ComputationError if ARPACK does not converge
  EigenpairsNearby look(Eigen::Index count, Look how) const;

 private:
  bool dense() const;
  Eigen::VectorXcd recovered(std::complex<double> mu, const Eigen::VectorXcd& z) const;
  void make_real(std::vector<Eigenpair>& pairs) const;

  const LinearisedEquations& e_;
  Eigen::Index dense_;
  MatrixX known_;
  std::unique_ptr<ShiftedOperator> operator_;
  MatrixX Q_;            ///< (states, known), scaled
  Eigen::MatrixXcd TQ_;  ///< Q^T T Q
  MatrixX basis_;        ///< basis of the states for the dense search
};

}  // namespace bielle::mechanism
