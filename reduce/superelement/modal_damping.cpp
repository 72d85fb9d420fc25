#include "reduce/superelement/modal_damping.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd rigid_motions(const Superelement& body) {
  MatrixXd U = MatrixXd::Zero(body.size(), 6);
  Index row = 0;
  for (const Interface& interface : body.interfaces)
    for (std::size_t d = 0; d < 6; ++d) {
      if (!interface.kept[d]) continue;
      const Eigen::Vector3d axis = interface.rotation.col(static_cast<Index>(d % 3));
      if (d < 3) {
        // axis . (v + Om x X)
        U.block<1, 3>(row, 0) = axis.transpose();
        U.block<1, 3>(row, 3) = interface.position.cross(axis).transpose();
      } else {
        U.block<1, 3>(row, 3) = axis.transpose();
      }
      ++row;
    }
  return U;
}

MatrixXd modal_damping(const Superelement& body, const std::vector<double>& ratios) {
  const Index n = body.size(), elastic = n - 6;
  if (ratios.empty() || static_cast<Index>(ratios.size()) > elastic)
    throw InputError(fmt::format("expected 1 to {} damping ratios, one for each elastic mode of '{}', found {}",
                                 elastic, body.name, ratios.size()));
  // Coordinates scaled to unit masses: displacements, angles and amplitudes become comparable. Elastic modes lie in the
  // complement of M~ U, which excludes the rigid motions exactly.
  const VectorXd scale = body.mass.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd M = scale.asDiagonal() * body.mass * scale.asDiagonal();
  const MatrixXd K = scale.asDiagonal() * body.stiffness * scale.asDiagonal();
  const MatrixXd momenta = product(M, scale.cwiseInverse().asDiagonal() * rigid_motions(body));
  const MatrixXd basis = orthogonal_basis(momenta).rightCols(elastic);
  const MatrixXd M_elastic = congruent(M, basis), K_elastic = congruent(K, basis);
  const auto modes =
      symmetric_eigenpairs(0.5 * (K_elastic + K_elastic.transpose()), 0.5 * (M_elastic + M_elastic.transpose()));
  if (!modes) throw ComputationError(fmt::format("the mass matrix of '{}' is not positive definite", body.name));
  VectorXd coefficients(elastic);
  for (Index k = 0; k < elastic; ++k) {
    const auto index = std::min(static_cast<std::size_t>(k), ratios.size() - 1);
    coefficients[k] = 2 * ratios[index] * std::sqrt(std::max(0.0, modes->values[k]));
  }
  const MatrixXd Mv = scale.cwiseInverse().asDiagonal() * product(M, product(basis, modes->vectors));
  const MatrixXd C = product(Mv, coefficients.asDiagonal() * Mv.transpose());
  return 0.5 * (C + C.transpose());
}

MatrixXd rayleigh_damping(const Superelement& body, double alpha, double beta) {
  return alpha * body.mass + beta * body.stiffness;
}

}  // namespace bielle
