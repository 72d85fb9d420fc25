#include "reduce/matrices/rigid_split.hpp"

#include <algorithm>
#include <cmath>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

constexpr double thin_body = 1e-6;       // relative to the largest principal P
constexpr double known_direction = 0.5;  // share of the energy of a motion from which on its directions count as known

/// Returns A^+ of a semidefinite matrix: a line of mass has no inertia about itself.
Eigen::MatrixXd semidefinite_inverse(const Eigen::MatrixXd& A) {
  const Eigen::VectorXd scale = A.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(scale.asDiagonal() * A * scale.asDiagonal());
  const double least = 1e-9 * pairs.values.maxCoeff();
  const Eigen::VectorXd inverse = (pairs.values.array() > least).select(pairs.values.cwiseInverse(), 0.0);
  const Eigen::MatrixXd vectors = scale.asDiagonal() * pairs.vectors;
  return vectors * inverse.asDiagonal() * vectors.transpose();
}

/// Returns the rate of u_k along x_l of the rigid part, for each coordinate.
Eigen::RowVectorXd rigid_gradient(const RigidSplit& split, int k, int l) {
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(split.rates.cols());
  for (int a = 0; a < 3; ++a) result += skew(Eigen::Vector3d::Unit(a))(k, l) * split.rates.row(3 + a);
  return result;
}

/// Returns symmetric moments: the rest has no angular momentum, so that N_kl = N_lk. If they differ, the mean has
/// weights by which that with the shorter arm counts most: a line of mass has no N_kl along l across it.
RestMoments symmetric_moments(const RestMoments& found, const RigidSplit& split) {
  const Eigen::Vector3d& P = split.principal;
  RestMoments result = turned_moments(found, split.axes);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < k; ++l) {
      const double Pk = P(static_cast<Eigen::Index>(k)), Pl = P(static_cast<Eigen::Index>(l));
      const double weight = Pk > 0 ? Pk / (Pk + Pl) : 0;  // both zero: `linear_part` drops the moments
      result[k][l] = Eigen::RowVectorXd(weight * result[k][l] + (1 - weight) * result[l][k]);
      result[l][k] = result[k][l];
    }
  return turned_moments(result, split.axes.transpose());
}

/// Returns S_kl for any k and l from the six.
Eigen::MatrixXd component(const std::array<Eigen::MatrixXd, 6>& S, int k, int l) {
  const Eigen::MatrixXd& stored = S[static_cast<std::size_t>(voigt(k, l))];
  return k <= l ? stored : Eigen::MatrixXd(stored.transpose());
}

/// Returns S_kl of rigid part and rest.
std::array<Eigen::MatrixXd, 6> joined(const RigidSplit& split, const RestMoments& moments,
                                      const std::array<Eigen::MatrixXd, 6>& rest) {
  const Eigen::Index n = split.rates.cols();
  std::array<Eigen::MatrixXd, 3> gradient, moment;  // rows l = 0, 1, 2 of the direction k
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    gradient[at].resize(3, n);
    moment[at].resize(3, n);
    for (int l = 0; l < 3; ++l) {
      gradient[at].row(l) = rigid_gradient(split, k, l);
      moment[at].row(l) = moments[at][static_cast<std::size_t>(l)];
    }
  }
  std::array<Eigen::MatrixXd, 6> result;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto k = static_cast<std::size_t>(voigt_pairs[s][0]), l = static_cast<std::size_t>(voigt_pairs[s][1]);
    result[s] = rest[s];
    result[s] += split.mass * split.rates.row(static_cast<Eigen::Index>(k)).transpose() *
                 split.rates.row(static_cast<Eigen::Index>(l));
    result[s] += transposed_product(gradient[k], split.second * gradient[l]);
    result[s] += transposed_product(gradient[k], moment[l]);
    result[s] += transposed_product(moment[k], gradient[l]);
  }
  return result;
}

/// Returns the gradients of the linear fields nearest to the rest, times the roots of P, in the axes of the body: rows
/// (3,N) of u_k in principal axes. Moments across a thin body are dropped. @param moments  in principal axes; changed
/// accordingly
std::array<Eigen::MatrixXd, 3> linear_part(const RigidSplit& split, RestMoments& moments) {
  const Eigen::Vector3d& P = split.principal;
  const Eigen::Index n = moments[0][0].size();
  const double least = thin_body * P.maxCoeff();
  std::array<Eigen::MatrixXd, 3> result;
  for (Eigen::MatrixXd& rows : result) rows.setZero(3, n);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const double Pa = P(static_cast<Eigen::Index>(a)), Pb = P(static_cast<Eigen::Index>(b));
      if (std::min(Pa, Pb) <= least) moments[a][b].setZero();
      if (Pb <= least) continue;
      for (int k = 0; k < 3; ++k)
        result[static_cast<std::size_t>(k)].row(static_cast<Eigen::Index>(b)) +=
            split.axes(k, static_cast<Eigen::Index>(a)) / std::sqrt(Pb) * moments[a][b];
    }
  return result;
}

/// Returns X with X^T M X = R, for R between 0 and M.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& R, const Eigen::MatrixXd& mass) {
  const auto pairs = symmetric_eigenpairs((R + R.transpose()) / 2, mass);
  if (!pairs) throw ComputationError("the mass matrix of the reduced body is not positive definite");
  return product(pairs->vectors * pairs->values.cwiseMax(0).cwiseSqrt().asDiagonal(),
                 transposed_product(pairs->vectors, mass));
}

}  // namespace

RigidSplit split_rigid(const Eigen::MatrixXd& mass, const MassProperties& body, const Eigen::MatrixXd& rigid) {
  RigidSplit result;
  result.rigid = rigid;
  result.mass = body.mass;
  result.second = body.inertia.trace() / 2 * Eigen::Matrix3d::Identity() - body.inertia;
  const SymmetricEigenpairs principal = symmetric_eigenpairs(result.second);
  result.axes = principal.vectors;
  result.principal = principal.values.cwiseMax(0);
  result.rates = product(semidefinite_inverse(congruent(mass, rigid)), transposed_product(rigid, mass));
  result.rest = Eigen::MatrixXd::Identity(mass.rows(), mass.cols()) - product(rigid, result.rates);
  return result;
}

RestMoments turned_moments(const RestMoments& moments, const Eigen::Matrix3d& axes) {
  RestMoments result;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      Eigen::RowVectorXd& row = result[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)];
      row.setZero(moments[0][0].size());
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          row += axes(i, k) * axes(j, l) * moments[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  return result;
}

bool is_semidefinite(const std::array<Eigen::MatrixXd, 6>& components) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::VectorXd values = symmetric_eigenpairs(components[k]).values;
    if (values.minCoeff() < -1e-9 * values.cwiseAbs().maxCoeff()) return false;
  }
  return true;
}

RestInertia rest_inertia(const std::array<Eigen::MatrixXd, 6>& components, const Eigen::MatrixXd& mass,
                         const RigidSplit& split) {
  const Eigen::Index n = mass.rows();
  if (!is_semidefinite(components)) {
    std::array<Eigen::MatrixXd, 6> none;
    none.fill(Eigen::MatrixXd::Zero(n, n));
    return rest_inertia(none, mass, split);
  }
  RestInertia result;
  const Eigen::MatrixXd sum = congruent(components[0] + components[1] + components[2], split.rest);
  const auto pairs = symmetric_eigenpairs((sum + sum.transpose()) / 2, mass);
  if (!pairs) throw ComputationError("the mass matrix of the reduced body is not positive definite");
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(n), missing = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double found = pairs->values(k);
    if (found > known_direction)
      scale(k) = 1 / std::sqrt(found);
    else if (found > 0)
      missing(k) = 1 - found;
    else
      scale(k) = 0, missing(k) = 1;
  }
  const Eigen::MatrixXd momenta = product(mass, pairs->vectors);  // per unit amplitude
  const Eigen::MatrixXd scaled =
      product(split.rest, product(pairs->vectors * scale.asDiagonal(), transposed_product(momenta, split.rest)));
  result.open = congruent(momenta * missing.asDiagonal() * momenta.transpose(), split.rest);
  for (std::size_t s = 0; s < 6; ++s) {
    result.components[s] = congruent(components[s], scaled);
    if (s < 3) {
      result.components[s] += result.open / 3;
      result.components[s] = Eigen::MatrixXd((result.components[s] + result.components[s].transpose()) / 2);
    }
  }
  // In the rotation about a the body moves along k by x_j, up to the sign e = (k, a, j): N_lj = e S_kl(rotation a, d).
  RestMoments found;
  for (int l = 0; l < 3; ++l)
    for (int j = 0; j < 3; ++j) {
      Eigen::RowVectorXd& row = found[static_cast<std::size_t>(l)][static_cast<std::size_t>(j)];
      row.setZero(n);
      for (const int k : {(j + 1) % 3, (j + 2) % 3}) {
        const int a = 3 - j - k;
        const double e = skew(Eigen::Vector3d::Unit(a))(k, j);
        row += e / 2 * (split.rigid.col(3 + a).transpose() * component(components, k, l)) * scaled;
      }
    }
  result.moments = symmetric_moments(found, split);
  return result;
}

std::array<Eigen::MatrixXd, 6> joined_inertia(const RigidSplit& split, const RestInertia& rest,
                                              const Eigen::MatrixXd& mass) {
  RestMoments moments = turned_moments(rest.moments, split.axes);
  const std::array<Eigen::MatrixXd, 3> linear = linear_part(split, moments);
  Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(mass.rows(), mass.cols());
  for (const Eigen::MatrixXd& rows : linear) energy += transposed_product(rows, rows);
  double scale = 1;
  if (const auto pairs = symmetric_eigenpairs(energy, mass); pairs && pairs->values.maxCoeff() > 1)
    scale = 1 / std::sqrt(pairs->values.maxCoeff());
  for (auto& rows : moments)
    for (Eigen::RowVectorXd& row : rows) row *= scale;
  const Eigen::MatrixXd remaining = root_of(congruent(mass, split.rest) - scale * scale * energy, mass);
  std::array<Eigen::MatrixXd, 6> deformed;
  for (std::size_t s = 0; s < 6; ++s) {
    const auto k = static_cast<std::size_t>(voigt_pairs[s][0]), l = static_cast<std::size_t>(voigt_pairs[s][1]);
    deformed[s] = congruent(rest.components[s], remaining) + scale * scale * transposed_product(linear[k], linear[l]);
  }
  return joined(split, turned_moments(moments, split.axes.transpose()), deformed);
}

std::array<Eigen::MatrixXd, 6> normalised_inertia(const std::array<Eigen::MatrixXd, 6>& components,
                                                  const Eigen::MatrixXd& mass) {
  const auto pairs = symmetric_eigenpairs(components[0] + components[1] + components[2], mass);
  if (!pairs) throw ComputationError("the mass matrix of the reduced body is not positive definite");
  const Eigen::MatrixXd scaled = product(pairs->vectors * pairs->values.cwiseSqrt().cwiseInverse().asDiagonal(),
                                         transposed_product(pairs->vectors, mass));
  std::array<Eigen::MatrixXd, 6> result;
  for (std::size_t s = 0; s < 6; ++s) result[s] = congruent(components[s], scaled);
  return result;
}

}  // namespace bielle::reduce
