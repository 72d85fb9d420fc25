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

#include <functional>
#include <memory>
#include <optional>

#include "reduce/reduction/body_matrices.hpp"

namespace bielle::reduce {

class HeldBody {
 public:
  /// @param solid  in one piece
  /// @param threads  of its own products; solutions are the same for the same number
  /// @throws InputError when the body can still move with all kept directions held: how; ComputationError when a part
  /// of
  ///         the mesh hangs on by a point or an edge only: where
  HeldBody(const Solid& solid, const BodyMatrices& matrices, const Ties& ties, int threads = 1);
  /// The same with a stiffness of all points that is here, unknowns x y z of point 0, 1, ...
  HeldBody(const Solid& solid, const SymmetricMatrix& stiffness, const Ties& ties, int threads);
  ~HeldBody();

  Eigen::Index size() const { return size_; }  ///< of z
  const FactorStatistics& statistics() const;
  Eigen::Index supports() const { return rigid_.cols(); }  ///< r

  /// Displacements (3 points, k) of all points: tied points follow the released directions, points outside are at rest.
  RowMatrix expand(const Eigen::MatrixXd& z) const;
  /// The transposed: forces on points become forces on z.
  Eigen::MatrixXd restrict(const RowMatrix& forces) const;

  /// Forces on z of the inertia of accelerations z, a few columns at a time.
  /// @param mass  of all points
  Eigen::MatrixXd inertia(const NodeMatrix& mass, const Eigen::MatrixXd& z, int threads) const;
  Eigen::MatrixXd inertia(const BodyMatrices& matrices, const Eigen::MatrixXd& z, int threads) const;

  /// z under the loads f (size,k), the averages at q_a (averages,k); none: at zero.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& averages = {}) const;

  /// How many modes lie below an eigenvalue omega^2 [rad^2/s^2], counted by the pivots of K - omega^2 M: what it takes
  /// is another factorisation. @returns nothing where the matrices are not in this process
  std::optional<PivotSigns> count_below(const BodyMatrices& matrices, double eigenvalue, int threads) const;

 private:
  /// @param u  (3 points, at least k): the columns of z, then zeros
  void expand_into(const Eigen::Ref<const Eigen::MatrixXd>& z, RowMatrix& u) const;
  /// @param f  (size, k): of the first k columns of the forces
  void restrict_into(const RowMatrix& forces, Eigen::Ref<Eigen::MatrixXd> f) const;
  /// Columns without the rows of the supports, and with zeros there.
  void leave_supports_out(const Eigen::MatrixXd& f, Eigen::MatrixXd& inside) const;
  void put_supports_in(const Eigen::MatrixXd& inside, Eigen::MatrixXd& z) const;
  void find_rigid_motions(const Solid& solid, const Ties& ties);
  void choose_supports();
  using Factorisation =
      std::function<std::unique_ptr<InsideFactor>(const std::vector<std::int64_t>& kept, const SparseRows& carried)>;
  HeldBody(const Solid& solid, const Ties& ties, const Factorisation& factorisation, int threads);
  void factorise(const Factorisation& factorisation);
  void close_conditions(const Ties& ties);
  Eigen::MatrixXd pseudo_solve(const Eigen::MatrixXd& f) const;  // K+ f

  int threads_ = 1;
  Eigen::Matrix3Xd points_;
  Eigen::Index size_ = 0;
  std::vector<std::int64_t> free_;      // unknowns x y z of the points that are neither tied nor outside, ascending
  std::vector<std::int64_t> not_free_;  // the others
  SparseRows carry_released_;
  std::vector<Eigen::Index> supports_;      // held freedoms, numbers in z, ascending
  std::vector<Eigen::Index> not_supports_;  // the other numbers in z
  std::unique_ptr<InsideFactor> factor_;    // of K_ii without the supports; none when nothing is left
  FactorStatistics no_statistics_;
  Eigen::MatrixXd rigid_;        // N (size, r)
  Eigen::MatrixXd conditions_;   // C^T (size, averages)
  Eigen::MatrixXd corrections_;  // K+ C^T, then -N: what lambda and alpha take away
  Eigen::MatrixXd small_;        // inverse of the matrix of lambda and alpha
};

}  // namespace bielle::reduce
