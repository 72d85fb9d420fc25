// The mesh's matrices, and the factor of their held part, wherever they are stored: in this process, or in parts in
// several (reduce/distributed). Fields on the mesh are complete in the process that reduces.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "reduce/fe/solid.hpp"
#include "reduce/reduction/added_masses.hpp"
#include "reduce/reduction/interior_graph.hpp"
#include "reduce/sparse/factor.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle::reduce {

/// The interior's K - sigma M with the rows that the factor leaves out at its border, for the signs of its pivots.
struct BorderedShift {
  std::vector<std::int64_t> kept;  ///< unknowns x y z of points, ascending: all that is factorised but carried ones
  double eigenvalue = 0;           ///< sigma = omega^2 [rad^2/s^2]
  Eigen::MatrixXd border, corner;  ///< B (kept,c), C (c,c): [K - sigma M, B; B^T, C]
  std::vector<double> scale;       ///< absolute value of the diagonal entry of each row
};

/// K [N/m] and M [kg] of all points of a solid, unknowns x y z of point 0, of point 1, ... Masses on the body belong to
/// this process, wherever the mesh's matrices are.
class BodyMatrices {
 public:
  virtual ~BodyMatrices() = default;

  virtual RowMatrix stiffness_times(const RowMatrix& u) const = 0;
  virtual Eigen::VectorXd stiffness_diagonal() const = 0;
  /// M u, with the masses on the body.
  RowMatrix mass_times(const RowMatrix& u) const;
  /// The mesh's part of M is m (x) I3. @param rows_per_node  rows of u per point: 3, or 1 for the product with m
  virtual RowMatrix mesh_mass_times(const RowMatrix& u, int rows_per_node = 3) const = 0;
  const AddedMasses& masses() const { return masses_; }
  void put_on(AddedMasses masses) { masses_ = std::move(masses); }
  /// See fe/geometric_stiffness.hpp.
  virtual std::vector<Eigen::MatrixXd> geometric_stiffness(const RowMatrix& fields, const RowMatrix& shapes) const = 0;

  /// P^T K P.
  /// @returns nothing if there are no unknowns
  /// @throws NotPositiveDefinite; ComputationError when memory does not suffice
  virtual std::unique_ptr<Factor> factorise(const InteriorUnknowns& interior) const = 0;
  /// See shift_invert_eigenpairs: the pencil is that of the interior; its solution may include any conditions.
  virtual Eigenpairs eigenpairs(const ShiftInvertProblem& problem, int count, const EigenpairOptions& options) const {
    return shift_invert_eigenpairs(problem, count, options);
  }
  virtual bool can_count_signs() const { return false; }
  /// Signs of the pivots of the elimination in the order of the factor, without those of the masses, which are
  /// positive. @param shifted  its border and corner hold the masses already @returns nothing if they cannot be counted
  std::optional<PivotSigns> count_signs(const Factor& factor, const BorderedShift& shifted) const;

 protected:
  virtual std::optional<PivotSigns> count_mesh_signs(const Factor& /*factor*/, const BorderedShift& /*shifted*/) const {
    return std::nullopt;
  }

 private:
  AddedMasses masses_;
};

/// Makes the matrices of a solid; they may refer to it.
/// @param interior   the unknowns that will be factorised, for preparation during the assembly. Other unknowns may be
/// factorised instead
/// @param threads  >= 1
using MatrixMaker =
    std::function<std::unique_ptr<BodyMatrices>(const Solid& solid, const InteriorUnknowns& interior, int threads)>;

/// All matrices are in this process. One thread finds the structure of the factor while the others assemble.
/// @throws ComputationError as assemble_stiffness, and if memory does not suffice
std::unique_ptr<BodyMatrices> assembled_matrices(const Solid& solid, const InteriorUnknowns& interior, int threads);

}  // namespace bielle::reduce
