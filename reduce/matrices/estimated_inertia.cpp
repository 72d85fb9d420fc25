// The estimate of S_kl from M~ (body_inertia.hpp): rigid part, symmetric linear fields, and the rest.
//
// All is computed in the principal axes of P = integral of rho x x^T about the centre. The rest d of a motion has no
// momentum, so that N_kl = N_lk, and the linear field nearest to d has the gradient N P^-1. In the d-part of the
// symmetric field e_kl, the energy is E_kk = P_kk and E_kl = P_kk P_ll / (P_kk + P_ll). The interfaces show the field
// by their positions and without rotation; its rigid part is taken away, and F is the energy of the remainder in M~.
// Then N_kl is the product with it, times min(1, E/F): a thin body has E = 0 and no such moment.
#include <algorithm>
#include <cmath>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/matrices/body_inertia.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

constexpr double thin_body = 1e-6;  // of the largest principal P: below, a body counts as thin in that direction

/// Interface coordinates (N) of the field (e_k x_l + e_l x_k) / 2, or e_k x_k; axes: principal ones -> body axes.
Eigen::VectorXd shown_field(const std::vector<Interface>& interfaces, Eigen::Index size, const Eigen::Vector3d& centre,
                            const Eigen::Matrix3d& axes, int k, int l) {
  const Eigen::Matrix3d gradient = (axes.col(k) * axes.col(l).transpose() + axes.col(l) * axes.col(k).transpose()) / 2;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size);
  Eigen::Index row = 0;
  for (const Interface& interface : interfaces)
    for (int axis = 0; axis < 6; ++axis) {
      if (!interface.kept[static_cast<std::size_t>(axis)]) continue;
      if (axis < 3) result(row) = interface.rotation.col(axis).dot(gradient * (interface.position - centre));
      ++row;
    }
  return result;
}

/// The six symmetric fields in all coordinates, their moments N_kl as rows (N), and how far they are shown.
struct SymmetricFields {
  std::array<Eigen::RowVectorXd, 6> moments;
  std::array<double, 6> energies{};  // E
};

}  // namespace

std::array<Eigen::MatrixXd, 6> estimated_inertia(const std::vector<Interface>& interfaces, const Eigen::MatrixXd& mass,
                                                 const MassProperties& body, const Eigen::MatrixXd& rigid,
                                                 std::array<double, 6>& shown) {
  const Eigen::Index n = mass.rows();
  const Eigen::Matrix3d second = body.inertia.trace() / 2 * Eigen::Matrix3d::Identity() - body.inertia;
  const SymmetricEigenpairs principal = symmetric_eigenpairs(second);
  Eigen::Matrix3d axes = principal.vectors;
  if (axes.determinant() < 0) axes.col(0) = Eigen::Vector3d(-axes.col(0));
  const double least = thin_body * principal.values(2);
  const Eigen::Vector3d P = principal.values.cwiseMax(0);

  // The rigid part of each coordinate, r = (U^T M U)^-1 U^T M, in principal axes about the centre.
  Eigen::MatrixXd turned = rigid;
  turned.leftCols(3) = rigid.leftCols(3) * axes;
  turned.rightCols(3) = rigid.rightCols(3) * axes;
  const Eigen::MatrixXd momenta = transposed_product(turned, mass);  // U^T M~ (6,n)
  const Eigen::Vector3d moment_of_inertia(P(1) + P(2), P(0) + P(2), P(0) + P(1));
  Eigen::MatrixXd r = momenta;
  r.topRows(3) /= body.mass;
  for (int k = 0; k < 3; ++k)
    r.row(3 + k) = moment_of_inertia(k) > least ? Eigen::RowVectorXd(momenta.row(3 + k) / moment_of_inertia(k))
                                                : Eigen::RowVectorXd::Zero(n);

  SymmetricFields fields;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto [k, l] = voigt_pairs[s];
    fields.energies[s] = k == l ? P(k) : P(k) * P(l) / std::max(P(k) + P(l), 1e-300);
    fields.moments[s].setZero(n);
    shown[s] = -1;
    if (fields.energies[s] <= least) continue;
    Eigen::VectorXd field = shown_field(interfaces, n, body.centre, axes, k, l);
    field -= turned * (r * field);
    const Eigen::VectorXd momentum = mass * field;
    const double found = field.dot(momentum);
    shown[s] = std::min(1.0, found / fields.energies[s]);
    if (found <= 1e-12 * fields.energies[s]) continue;
    fields.moments[s] = std::min(1.0, fields.energies[s] / found) * momentum.transpose();
    fields.moments[s] -= (fields.moments[s] * turned) * r;
  }
  // Together they must not have more energy than M~ has.
  Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t s = 0; s < 6; ++s)
    if (fields.energies[s] > least) energy += fields.moments[s].transpose() * fields.moments[s] / fields.energies[s];
  if (const auto pairs = symmetric_eigenpairs(energy, mass); pairs && pairs->values.maxCoeff() > 1)
    for (Eigen::RowVectorXd& moments : fields.moments) moments /= std::sqrt(pairs->values.maxCoeff());

  // The linear field nearest to each coordinate's motion: translation, gradient g_kl of u_k along x_l.
  std::array<Eigen::MatrixXd, 3> linear;  // of u_k: (4,n) constant, along x_0 x_1 x_2; with the roots of mass and P
  const Eigen::Vector3d root = P.cwiseSqrt();
  for (int k = 0; k < 3; ++k) {
    Eigen::MatrixXd& rows = linear[static_cast<std::size_t>(k)];
    rows.setZero(4, n);
    rows.row(0) = std::sqrt(body.mass) * r.row(k);
    for (int l = 0; l < 3; ++l) {
      Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(n);
      for (int j = 0; j < 3; ++j) gradient += skew(Eigen::Vector3d::Unit(j))(k, l) * r.row(3 + j);
      const std::size_t s = k == l ? static_cast<std::size_t>(k) : static_cast<std::size_t>(6 - k - l);
      if (P(l) > least) gradient += fields.moments[s] / P(l);
      rows.row(1 + l) = root(l) * gradient;
    }
  }
  std::array<std::array<Eigen::MatrixXd, 3>, 3> S;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l) S[k][l] = transposed_product(linear[k], linear[l]);
  std::array<Eigen::MatrixXd, 6> result;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto [k, l] = voigt_pairs[s];
    result[s].setZero(n, n);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        result[s] += axes(k, a) * axes(l, b) * S[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  }
  return result;
}

}  // namespace bielle::reduce
