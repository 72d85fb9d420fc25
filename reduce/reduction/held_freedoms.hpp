// The degrees of freedom of a body while every kept direction of its interfaces is held, and its supports. They follow
// from the geometry alone, without the stiffness.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/fe/solid.hpp"
#include "reduce/reduction/body_matrices.hpp"
#include "reduce/reduction/ties.hpp"

namespace bielle::reduce {

/// Interior coordinates z and symbols are as in fixed_interface_body.hpp.
struct HeldFreedoms {
  Eigen::Index size = 0;               ///< number of coordinates z
  std::vector<std::int64_t> free;      ///< unknowns x y z of the points that are neither tied nor outside, ascending
  std::vector<std::int64_t> not_free;  ///< the others
  SparseRows carry_released;
  std::vector<Eigen::Index> supports;      ///< held freedoms, numbers in z, ascending
  std::vector<Eigen::Index> not_supports;  ///< the other numbers in z
  Eigen::MatrixXd rigid;                   ///< N (size, r)
  Eigen::MatrixXd conditions;              ///< C^T (size, averages)

  /// @param solid  in one piece
  /// @throws InputError if the body can still move with all kept directions held: the motion
  HeldFreedoms(const Solid& solid, const Ties& ties);

  /// Returns the unknowns that are factorised: all but the supports.
  InteriorUnknowns interior() const;
  /// Displacements of points from z. @param u  (3 points, k)
  void expand_into(const Eigen::Ref<const Eigen::MatrixXd>& z, RowMatrix& u, int threads) const;
  /// The transposed operation: it maps forces on points to forces on z. @param f  (size, k): results for the first k
  /// columns of the forces
  void restrict_into(const RowMatrix& forces, Eigen::Ref<Eigen::MatrixXd> f, int threads) const;
  /// Copies columns without the rows of the supports, and with zeros there.
  void leave_supports_out(const Eigen::MatrixXd& f, Eigen::MatrixXd& inside, int threads) const;
  void put_supports_in(const Eigen::MatrixXd& inside, Eigen::MatrixXd& z, int threads) const;

 private:
  template <class Work>
  void for_stretches(const Work& work) const;
  void find_rigid_motions(const Solid& solid, const Ties& ties, const std::vector<bool>& inside);
  void choose_supports();
};

}  // namespace bielle::reduce
