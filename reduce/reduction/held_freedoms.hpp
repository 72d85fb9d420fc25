// Which freedoms a body has while every kept direction of its interfaces is held, and what holds it: known from the
// geometry alone, before any stiffness.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/fe/solid.hpp"
#include "reduce/reduction/body_matrices.hpp"
#include "reduce/reduction/ties.hpp"

namespace bielle::reduce {

/// Inside coordinates z, and the symbols, as in held_body.hpp.
struct HeldFreedoms {
  Eigen::Index size = 0;               ///< of z
  std::vector<std::int64_t> free;      ///< unknowns x y z of the points that are neither tied nor outside, ascending
  std::vector<std::int64_t> not_free;  ///< the others
  SparseRows carry_released;
  std::vector<Eigen::Index> supports;      ///< held freedoms, numbers in z, ascending
  std::vector<Eigen::Index> not_supports;  ///< the other numbers in z
  Eigen::MatrixXd rigid;                   ///< N (size, r)
  Eigen::MatrixXd conditions;              ///< C^T (size, averages)

  /// @param solid  in one piece
  /// @throws InputError when the body can still move with all kept directions held: how
  HeldFreedoms(const Solid& solid, const Ties& ties);

  /// What is factorised: all but the supports.
  InsideUnknowns inside() const;
  /// Displacements of z. @param u  (3 points, k)
  void expand_into(const Eigen::Ref<const Eigen::MatrixXd>& z, RowMatrix& u, int threads) const;
  /// The transposed: forces on points become forces on z. @param f  (size, k): of the first k columns of the forces
  void restrict_into(const RowMatrix& forces, Eigen::Ref<Eigen::MatrixXd> f, int threads) const;
  /// Columns without the rows of the supports, and with zeros there.
  void leave_supports_out(const Eigen::MatrixXd& f, Eigen::MatrixXd& inside, int threads) const;
  void put_supports_in(const Eigen::MatrixXd& inside, Eigen::MatrixXd& z, int threads) const;

 private:
  template <class Work>
  void for_stretches(const Work& work) const;
  void find_rigid_motions(const Solid& solid, const Ties& ties, const std::vector<bool>& inside);
  void choose_supports();
};

}  // namespace bielle::reduce
