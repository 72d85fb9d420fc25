#include "reduce/reduction/cut_effect.hpp"

#include <algorithm>
#include <map>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/dense/symmetric_factors.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Returns the coordinates of the interfaces of `uncut`, in its order, then all others.
std::vector<Index> outer_first(const Superelement& pieces, const Superelement& uncut) {
  std::map<std::string, std::vector<Index>> of_interface;
  Index next = 0;
  for (const Interface& interface : pieces.interfaces)
    for (const bool kept : interface.kept)
      if (kept) of_interface[interface.name].push_back(next++);
  std::vector<Index> order;
  for (const Interface& interface : uncut.interfaces)
    for (const Index k : of_interface.at(interface.name)) order.push_back(k);
  std::vector<bool> placed(static_cast<std::size_t>(pieces.size()), false);
  for (const Index k : order) placed[static_cast<std::size_t>(k)] = true;
  for (Index k = 0; k < pieces.size(); ++k)
    if (!placed[static_cast<std::size_t>(k)]) order.push_back(k);
  return order;
}

/// Returns the static stiffness of the first `outer` coordinates, with the others free (Schur complement).
MatrixXd condensed(const MatrixXd& stiffness, Index outer) {
  const Index inner = stiffness.rows() - outer;
  // Scaled to a unit diagonal: displacements, angles and amplitudes have different units.
  const Eigen::VectorXd scale = stiffness.diagonal().tail(inner).cwiseSqrt().cwiseInverse();
  const MatrixXd inside = scale.asDiagonal() * stiffness.bottomRightCorner(inner, inner) * scale.asDiagonal();
  const MatrixXd coupling = scale.asDiagonal() * stiffness.bottomLeftCorner(inner, outer);
  if (!is_positive_definite(inside))
    throw ComputationError("the pieces do not hold together: their stiffness with all interfaces held is singular");
  const MatrixXd given_way = transposed_product(coupling, solve_symmetric(inside, coupling));
  return stiffness.topLeftCorner(outer, outer) - given_way;
}

}  // namespace

std::vector<double> stiffness_ratios(const Superelement& pieces, const Superelement& uncut) {
  const Index outer = uncut.interface_directions();
  if (outer <= 6) return {};
  const std::vector<Index> order = outer_first(pieces, uncut);
  const MatrixXd sorted = pieces.stiffness(order, order);
  const MatrixXd a = condensed(sorted, outer), b = uncut.stiffness.topLeftCorner(outer, outer);
  // The comparison uses coordinates of unit mass on the complement of the rigid motions.
  const Eigen::VectorXd unit = uncut.mass.diagonal().head(outer).cwiseSqrt();
  const MatrixXd rigid = unit.asDiagonal() * interface_rigid_motions(uncut.interfaces, uncut.centre);
  const MatrixXd elastic = unit.cwiseInverse().asDiagonal() * orthogonal_basis(rigid).rightCols(outer - 6);
  const MatrixXd a_elastic = congruent(a, elastic), b_elastic = congruent(b, elastic);
  const auto pairs =
      symmetric_eigenpairs((a_elastic + a_elastic.transpose()) / 2, (b_elastic + b_elastic.transpose()) / 2);
  if (!pairs) throw ComputationError("the stiffness of the uncut body between its interfaces is singular");
  return {pairs->values.minCoeff(), pairs->values.maxCoeff()};
}

}  // namespace bielle::reduce
