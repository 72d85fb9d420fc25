#include "reduce/reduction/reduced_matrices.hpp"

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/elasticity.hpp"

namespace bielle::reduce {

namespace {

/// Returns a_k^T b_l, where a_k consists of every `stride`-th row of a from row k on.
Eigen::MatrixXd strided_product(const RowMatrix& a, int k, const RowMatrix& b, int l, int stride) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  if (result.size() > 0 && a.rows() > 0) {
    // A row-major block is the transpose of a block stored by columns.
    const Eigen::Index rows = a.rows() / stride;
    add_dense_product({a.data() + k * a.cols(), a.cols(), rows, stride * a.cols(), false},
                      {b.data() + l * b.cols(), rows, b.cols(), stride * b.cols(), true}, result.data(), result.rows());
  }
  return result;
}

}  // namespace

Eigen::MatrixXd inner_products(const RowMatrix& a, const RowMatrix& b) { return strided_product(a, 0, b, 0, 1); }

std::array<Eigen::MatrixXd, 6> inertia_components(const RowMatrix& shapes, const BodyMatrices& matrices) {
  const RowMatrix products = matrices.mesh_mass_times(shapes);
  std::array<Eigen::MatrixXd, 6> result;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto [k, l] = voigt_pairs[s];
    result[s] = strided_product(shapes, k, products, l, 3);
    if (k == l) {
      result[s] = Eigen::MatrixXd(result[s] + result[s].transpose()) / 2;
    }
  }
  matrices.masses().add_inertia_components(shapes, result);
  return result;
}

FreeModes free_modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, const Eigen::MatrixXd& rigid) {
  const Eigen::Index n = mass.rows(), r = rigid.cols();
  // Coordinates scaled to unit masses: amplitudes, displacements and angles become comparable.
  const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd m = scale.asDiagonal() * mass * scale.asDiagonal();
  const Eigen::MatrixXd k = scale.asDiagonal() * stiffness * scale.asDiagonal();
  const Eigen::MatrixXd u = scale.cwiseInverse().asDiagonal() * rigid;
  // Elastic modes are M~-orthogonal to U: they lie in the complement of M~ U.
  Eigen::MatrixXd complement = Eigen::MatrixXd::Identity(n, n);
  if (r > 0) {
    const Eigen::MatrixXd momenta = product(m, u);
    complement = orthogonal_basis(momenta).rightCols(n - r);
  }
  FreeModes result;
  if (complement.cols() == 0) {
    result.omega.resize(0);
    result.vectors.resize(n, 0);
    return result;
  }
  const Eigen::MatrixXd reduced_mass = congruent(m, complement);
  const Eigen::MatrixXd reduced_stiffness = congruent(k, complement);
  const auto modes = symmetric_eigenpairs((reduced_stiffness + reduced_stiffness.transpose()) / 2,
                                          (reduced_mass + reduced_mass.transpose()) / 2);
  if (!scale.allFinite() || !modes) {
    throw ComputationError("the mass matrix of the reduced body is not positive definite");
  }
  result.omega = modes->values.cwiseMax(0).cwiseSqrt();
  result.vectors = scale.asDiagonal() * product(complement, modes->vectors);
  return result;
}

Eigen::MatrixXd modal_damping(const FreeModes& modes, const Eigen::MatrixXd& mass, const std::vector<double>& ratios) {
  if (ratios.empty()) {
    return Eigen::MatrixXd::Zero(mass.rows(), mass.cols());
  }
  const Eigen::Index elastic = modes.omega.size();
  if (static_cast<Eigen::Index>(ratios.size()) > std::max<Eigen::Index>(elastic, 1)) {
    throw InputError(fmt::format("damping.ratio: {} for a reduced body with {}", counted(ratios.size(), "value"),
                                 counted(elastic, "elastic mode")));
  }
  Eigen::VectorXd coefficients(elastic);
  for (Eigen::Index k = 0; k < elastic; ++k) {
    const double ratio = k < static_cast<Eigen::Index>(ratios.size()) ? ratios[k] : ratios.back();
    coefficients(k) = 2 * ratio * modes.omega(k);
  }
  const Eigen::MatrixXd momenta = product(mass, modes.vectors);
  const Eigen::MatrixXd damping = product(momenta, coefficients.asDiagonal() * momenta.transpose());
  return (damping + damping.transpose()) / 2;
}

}  // namespace bielle::reduce
