// The body with every kept direction of its interfaces held: one factorisation of its inside, on which constraint
// modes, fixed-boundary modes and inertia relief all rest.
//
// Inside coordinates z: the displacements of the points that no interface carries, then the released directions of
// rigid ties. With average ties the inside is not held by missing freedoms but by conditions C z = q_a with multipliers
// lambda:
//     K_ii z + C^T lambda = f,   C z = q_a.
// K_ii may then be singular: N spans its rigid motions (r of them). Held at r freedoms chosen for the purpose, it is
// positive definite and factorised; K+ is the solution with these freedoms at zero. In general
//     z = K+ (f - C^T lambda) + N alpha,   [C K+ C^T  -C N; N^T C^T  0] [lambda; alpha] = [C K+ f - q_a; N^T f]:
// the second row makes the load self-equilibrated, so that the held freedoms carry no force and K_ii z + C^T lambda = f
// there too. (The two-field form of FETI: C. Farhat, F.-X. Roux, IJNME 32 (1991) 1205.)
#pragma once

#include <memory>
#include <optional>

#include "reduce/reduction/body_matrices.hpp"
#include "reduce/reduction/held_freedoms.hpp"

namespace bielle::reduce {

class HeldBody {
 public:
  /// @param freedoms  those of this solid with these ties
  /// @param solid     in one piece
  /// @param matrices  its own
  /// @param threads   of its own products; solutions are the same for the same number
  /// @throws ComputationError when a part of the mesh hangs on by a point or an edge only: where
  HeldBody(HeldFreedoms freedoms, const Solid& solid, const BodyMatrices& matrices, const Ties& ties, int threads);
  ~HeldBody();

  Eigen::Index size() const { return freedoms_.size; }  ///< of z
  const FactorStatistics& statistics() const;
  Eigen::Index supports() const { return freedoms_.rigid.cols(); }  ///< r

  /// Displacements (3 points, k) of all points: tied points follow the released directions, points outside are at rest.
  RowMatrix expand(const Eigen::MatrixXd& z) const;
  /// The transposed: forces on points become forces on z.
  Eigen::MatrixXd restrict(const RowMatrix& forces) const;

  /// Forces on z of the inertia of accelerations z.
  Eigen::MatrixXd inertia(const BodyMatrices& matrices, const Eigen::MatrixXd& z) const;

  /// z under the loads f (size,k), the averages at q_a (averages,k); none: at zero.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& averages = {}) const;

  /// How many modes lie below an eigenvalue omega^2 [rad^2/s^2], counted by the pivots of K - omega^2 M: what it takes
  /// is another factorisation. @returns nothing where signs cannot be counted
  std::optional<PivotSigns> count_below(const BodyMatrices& matrices, double eigenvalue) const;

 private:
  void factorise(const BodyMatrices& matrices, const Solid& solid);
  void close_conditions(const Ties& ties);
  Eigen::MatrixXd pseudo_solve(const Eigen::MatrixXd& f) const;  // K+ f

  int threads_ = 1;
  HeldFreedoms freedoms_;
  std::unique_ptr<Factor> factor_;  // of K_ii without the supports; none when nothing is left
  FactorStatistics no_statistics_;
  Eigen::MatrixXd corrections_;  // K+ C^T, then -N: what lambda and alpha take away
  Eigen::MatrixXd small_;        // inverse of the matrix of lambda and alpha
};

}  // namespace bielle::reduce
