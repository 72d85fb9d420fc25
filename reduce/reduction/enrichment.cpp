#include "reduce/reduction/enrichment.hpp"

#include <algorithm>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/checks.hpp"

namespace bielle::reduce {

namespace {

constexpr double dependent = 1e-8;  // energy of a shape that the others leave, relative to its own

constexpr double equal_frequencies = 1e-2;

/// Returns the share of each of the first unit vectors in the eigenvectors x of nearly one frequency that have most of
/// it.
Eigen::VectorXd assurance_of(const Eigen::MatrixXd& mass, const EnrichedModes& modes, const Eigen::MatrixXd& x) {
  const Eigen::MatrixXd momenta = product(mass, x);
  const Eigen::VectorXd masses = x.cwiseProduct(momenta).colwise().sum().transpose();
  Eigen::VectorXd result(x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Eigen::VectorXd shares = momenta.row(i).transpose().cwiseAbs2().cwiseQuotient(masses) / mass(i, i);
    Eigen::Index best = 0;
    shares.maxCoeff(&best);
    const Eigen::ArrayXd ratios = (modes.eigenvalues.array() / modes.eigenvalues(best)).sqrt();
    result(i) = std::min(1.0, ((ratios - 1).abs() < equal_frequencies).select(shares.array(), 0).sum());
  }
  return result;
}

/// Returns the lowest modes of K x = mu M x, from M y = y / mu with y^T K y = 1: M may be singular.
EnrichedModes lowest_modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, Eigen::Index count) {
  const Eigen::VectorXd scale =
      (stiffness.diagonal().array() > 0).select(stiffness.diagonal().array().rsqrt(), 0).matrix();
  const SymmetricEigenpairs energies = symmetric_eigenpairs(scale.asDiagonal() * stiffness * scale.asDiagonal());
  const Eigen::Index kept = (energies.values.array() > dependent).count();
  const Eigen::MatrixXd unit = scale.asDiagonal() * energies.vectors.rightCols(kept) *
                               energies.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd of_unit_energy = congruent(mass, unit);
  const SymmetricEigenpairs flexibility = symmetric_eigenpairs(of_unit_energy);
  EnrichedModes result;
  result.eigenvalues = flexibility.values.tail(count).reverse().cwiseInverse();
  result.assurance =
      assurance_of(mass, result, product(unit, flexibility.vectors.rightCols(count).rowwise().reverse()));
  return result;
}

}  // namespace

EnrichedModes enriched_modes(const FullModel& model, const Superelement& body, const FreeModes& free,
                             const RowMatrix& shapes, Eigen::Index count) {
  const Eigen::Index old = free.omega.size(), more = shapes.cols();
  const RowMatrix forces = model.matrices.stiffness_times(shapes), momenta = model.matrices.mass_times(shapes);
  const Eigen::MatrixXd coupling_forces = inner_products(model.basis.shapes, forces);
  const Eigen::MatrixXd coupling_momenta = inner_products(model.basis.shapes, momenta);
  // Free modes have no rigid part; the rigid part of the added shapes moves without energy.
  const Eigen::MatrixXd rigid = rigid_coordinates(body, body.centre);
  const Eigen::MatrixXd rigid_mass = congruent(body.mass, rigid);
  const Eigen::MatrixXd rigid_momenta = transposed_product(rigid, coupling_momenta);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(old + more, old + more);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(old + more, old + more);
  stiffness.topLeftCorner(old, old) = free.omega.cwiseAbs2().asDiagonal();
  stiffness.topRightCorner(old, more) = transposed_product(free.vectors, coupling_forces);
  stiffness.bottomRightCorner(more, more) = inner_products(shapes, forces);
  mass.topRightCorner(old, more) = transposed_product(free.vectors, coupling_momenta);
  mass.bottomRightCorner(more, more) =
      inner_products(shapes, momenta) - transposed_product(rigid_momenta, solve_symmetric(rigid_mass, rigid_momenta));
  stiffness.bottomLeftCorner(more, old) = stiffness.topRightCorner(old, more).transpose();
  mass.bottomLeftCorner(more, old) = mass.topRightCorner(old, more).transpose();
  return lowest_modes(stiffness, mass, count);
}

}  // namespace bielle::reduce
