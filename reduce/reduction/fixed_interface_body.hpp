// The body with every kept direction of its interfaces held: constraint modes, fixed-boundary modes and inertia relief
// all use one factorisation of its interior.
//
// Interior coordinates z: the displacements of the points that no interface carries, then the released directions of
// rigid ties. With average ties the interior is not held by removed degrees of freedom but by conditions C z = q_a with
// multipliers lambda:
//     K_ii z + C^T lambda = f,   C z = q_a.
// K_ii may then be singular: N spans its rigid motions (r of them). It is held at r suitable degrees of freedom; then
// it is positive definite and can be factorised. K+ is the solution with these degrees of freedom at zero. In general
//     z = K+ (f - C^T lambda) + N alpha,   [C K+ C^T  -C N; N^T C^T  0] [lambda; alpha] = [C K+ f - q_a; N^T f]:
// the second row makes the load self-equilibrated, so that the held degrees of freedom carry no force and K_ii z + C^T
// lambda = f holds there too. (The two-field form of FETI: C. Farhat, F.-X. Roux, IJNME 32 (1991) 1205.)
#pragma once

#include <memory>
#include <optional>

#include "reduce/reduction/body_matrices.hpp"
#include "reduce/reduction/held_freedoms.hpp"

namespace bielle::reduce {

class FixedInterfaceBody {
 public:
  /// @param freedoms  degrees of freedom of this solid with these ties
  /// @param solid     in one piece
  /// @param matrices  its own
  /// @param threads   threads for its own products; solutions do not vary between runs with the same number
  /// @throws ComputationError if a part of the mesh is connected by a point or an edge only: the place
  FixedInterfaceBody(HeldFreedoms freedoms, const Solid& solid, const BodyMatrices& matrices, const Ties& ties,
                     int threads);
  ~FixedInterfaceBody();

  Eigen::Index size() const { return freedoms_.size; }  ///< number of unknowns z
  const FactorStatistics& statistics() const;
  Eigen::Index supports() const { return freedoms_.rigid.cols(); }  ///< r, the number of rigid motions

  /// Displacements (3 points, k) of all points: tied points follow the released directions, and points outside the
  /// solid are at rest.
  RowMatrix expand(const Eigen::MatrixXd& z) const;
  /// The transposed operation: it maps forces on points to forces on z.
  Eigen::MatrixXd restrict(const RowMatrix& forces) const;

  /// Inertia forces on z for accelerations z.
  Eigen::MatrixXd inertia(const BodyMatrices& matrices, const Eigen::MatrixXd& z) const;

  /// Solves for z under the loads f (size,k), with the averages at q_a (averages,k); without q_a they are zero.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& averages = {}) const;

  /// Number of modes below an eigenvalue omega^2 [rad^2/s^2], counted by the pivots of K - omega^2 M, which requires
  /// another factorisation. @returns nothing if signs cannot be counted
  std::optional<PivotSigns> count_below(const BodyMatrices& matrices, double eigenvalue) const;

 private:
  void factorise(const BodyMatrices& matrices, const Solid& solid);
  void close_conditions(const Ties& ties);
  Eigen::MatrixXd pseudo_solve(const Eigen::MatrixXd& f) const;  // K+ f

  int threads_ = 1;
  HeldFreedoms freedoms_;
  std::unique_ptr<Factor> factor_;  // factor of K_ii without the supports; null if no unknown is left
  FactorStatistics no_statistics_;
  Eigen::MatrixXd corrections_;  // K+ C^T, then -N: the columns that lambda and alpha multiply
  Eigen::MatrixXd small_;        // inverse of the matrix of lambda and alpha
};

}  // namespace bielle::reduce
