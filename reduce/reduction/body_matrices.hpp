// The mesh's matrices, and the factor of what is held of them, wherever they are kept: in this process, or in parts in
// several (reduce/distributed). Fields on the mesh are whole, in the process that reduces.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "reduce/fe/node_graph.hpp"
#include "reduce/fe/solid.hpp"
#include "reduce/reduction/inside_graph.hpp"
#include "reduce/spectral/eigenpairs.hpp"
#include "reduce/spectral/symmetric_factor.hpp"

namespace bielle::reduce {

/// K of the inside, factorised.
class InsideFactor {
 public:
  virtual ~InsideFactor() = default;
  virtual const FactorStatistics& statistics() const = 0;
  /// K^-1 f for a block of right-hand sides (size,k).
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& f) const = 0;
  /// As SymmetricFactor::count_signs; nothing where that cannot be done.
  virtual std::optional<PivotSigns> count_signs(SymmetricMatrix /*matrix*/,
                                                const std::vector<double>& /*scale*/) const {
    return std::nullopt;
  }
};

/// K [N/m] and M [kg] of all points of a solid, unknowns x y z of point 0, of point 1, ...
class BodyMatrices {
 public:
  virtual ~BodyMatrices() = default;

  virtual RowMatrix stiffness_times(const RowMatrix& u) const = 0;
  virtual Eigen::VectorXd stiffness_diagonal() const = 0;
  /// M is m (x) I3. @param rows_per_node  rows of u that each point owns: 3, or 1 for the product with m
  virtual RowMatrix mass_times(const RowMatrix& u, int rows_per_node = 3) const = 0;
  /// K and m where this process has all of them: products may then go on in several threads; nullptr elsewhere.
  virtual const SymmetricMatrix* stiffness_here() const { return nullptr; }
  virtual const NodeMatrix* mass_here() const { return nullptr; }
  /// As fe/geometric_stiffness.hpp.
  virtual std::vector<Eigen::MatrixXd> geometric_stiffness(const RowMatrix& fields, const RowMatrix& shapes) const = 0;

  /// P^T K P.
  /// @returns nothing where no unknown is left
  /// @throws NotPositiveDefinite; ComputationError when memory does not suffice
  virtual std::unique_ptr<InsideFactor> factorise(const InsideUnknowns& inside) const = 0;
  /// How eigenpairs are found where `shift_invert_eigenpairs` would iterate; none: as it does.
  virtual EigenIteration eigen_iteration() const { return {}; }
};

/// Makes the matrices of a solid, which they may refer to.
/// @param inside   what will be factorised: it can be prepared meanwhile. Something else may be
/// @param threads  >= 1
using MatrixMaker =
    std::function<std::unique_ptr<BodyMatrices>(const Solid& solid, const InsideUnknowns& inside, int threads)>;

/// All in this process. While one thread finds the structure of the factor, the others assemble.
/// @throws ComputationError as assemble_stiffness, and when memory does not suffice
std::unique_ptr<BodyMatrices> assembled_matrices(const Solid& solid, const InsideUnknowns& inside, int threads);

/// As BodyMatrices::factorise, of a stiffness that is here.
/// @param structure  made for the inside; none: it is found now
std::unique_ptr<InsideFactor> factorise_inside(const SymmetricMatrix& stiffness, const InsideUnknowns& inside,
                                               std::shared_ptr<const FactorStructure> structure, int threads);

}  // namespace bielle::reduce
