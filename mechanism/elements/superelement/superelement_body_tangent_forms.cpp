// The forms M_*, C_*, K_* of the forces in (nu_0, eps), their rates and accelerations (superelement_body_tangent.hpp).
#include <array>

#include "mechanism/elements/superelement/superelement_body_tangent.hpp"
#include "mechanism/elements/superelement/superelement_body_tangent_view.hpp"
#include "reduce/dense/dense_products.hpp"

namespace bielle::mechanism {

/// Computes the products of the body's matrices that the residual does not need one by one.
void SuperelementTangent::set_products(const View& v) {
  const SuperelementMotion& m = v.motion;
  const auto G = v.body.stacked.bottomRows(3 * v.n);
  s_rate_ = m.eps_acceleration;
  s_rate_.noalias() += v.body.U * m.nu_rate;
  Geps_rate_.setZero(v.n, 3);
  add_product(Eigen::Map<VectorX>(Geps_rate_.data(), 3 * v.n), G, m.eps_rate);
  Gs_ = Geps_rate_;
  for (int k = 0; k < 3; ++k) Gs_.col(k).noalias() += v.body.GU[static_cast<std::size_t>(k)] * m.nu;
  Gs_rate_.setZero(v.n, 3);
  add_product(Eigen::Map<VectorX>(Gs_rate_.data(), 3 * v.n), G, s_rate_);
  Heps_rate_.setZero(v.n, 6);
  add_product(Eigen::Map<VectorX>(Heps_rate_.data(), 6 * v.n), v.body.stacked.middleRows(v.n, 6 * v.n), m.eps_rate);
  if (!v.body.stiffened_by_spin()) return;
  const auto spin_eps = m.spin_eps();
  spin_force_.setZero(v.n, 3);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) spin_force_.col(k) += m.Om_mean[l] * spin_eps.col(pair_index(k, l));
}

void SuperelementTangent::set_mass_form(const View& v) {
  const SuperelementMotion& m = v.motion;
  M_nn_ = v.body.rigid;
  M_nn_.rightCols<3>() += m.UGeps;
  M_nn_.bottomRows<3>() += m.UGeps.transpose();
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) M_nn_(3 + k, 3 + l) += m.eps_forms[1 + pair_index(k, l)];
  M_nq_ = v.body.MU.transpose();
  M_nq_.bottomRows<3>() += m.Geps().transpose();
  MQ_ = v.body.M;
  if (v.body.stiffened_by_spin()) add_spin_to_mass_form(v);
  M_qq_ = MQ_;
  six_ = M_nq_.transpose();
  reduce_both_sides(v, M_nn_, M_nq_, six_, MQ_);
}

/// M~ <- M~ - Lambda^T kappa Lambda: a term of K_sigma, which depends on nu_0 through s, with Lambda U = [0, I].
void SuperelementTangent::add_spin_to_mass_form(const View& v) {
  turning_.noalias() = v.motion.kappa * v.body.mean_turning;
  add_transposed_product(MQ_, v.body.mean_turning, turning_, -1);
  M_nq_.bottomRows<3>() -= turning_;
  M_nn_.bottomRightCorner<3, 3>() -= v.motion.kappa;
}

/// Computes J G(epsdot) and J G(eps'').
void SuperelementTangent::set_coordinate_changes(const View& v) {
  const Eigen::Index b = v.excess.rows();
  rate_change_.resize(b, v.n);
  acceleration_change_.resize(b, v.n);
  if (b == 0) return;
  v.body.multiply_load_stiffness(v.motion.eps_rate, gradient_);
  v.motion.coordinates.multiply_gradient(gradient_, rate_change_);
  v.body.multiply_load_stiffness(v.motion.eps_acceleration, gradient_);
  v.motion.coordinates.multiply_gradient(gradient_, acceleration_change_);
}

void SuperelementTangent::set_rate_form(const View& v) {
  const SuperelementMotion& m = v.motion;
  CQ_ = v.damping;
  std::array<WeightedMatrix, 3> gyroscopic;
  for (std::size_t k = 0; k < 3; ++k) gyroscopic[k] = {&v.body.G[k], 2 * v.Om[static_cast<int>(k)]};
  add_weighted(CQ_, gyroscopic);
  six_.setZero(v.n, 6);
  more_rows_.noalias() = v.ad * M_nq_;
  Matrix6 X_nn = v.ad * M_nn_;
  const auto all_Heps = m.Heps();
  for (int k = 0; k < 3; ++k) {
    const auto index = static_cast<std::size_t>(k);
    six_ += v.Om[k] * v.body.GU[index];
    six_.col(3 + k) += Geps_rate_.col(k) + Gs_.col(k);
    more_rows_ -= v.Om[k] * v.body.GU[index].transpose();
    more_rows_.row(3 + k) += (Geps_rate_.col(k) - Gs_.col(k)).transpose();
    const Vector6 UG_rate = v.body.U.transpose() * Geps_rate_.col(k);
    X_nn.col(3 + k) += UG_rate;
    X_nn.row(3 + k) += UG_rate.transpose();
    for (int l = 0; l < 3; ++l) {
      const auto Heps = all_Heps.col(pair_index(k, l));
      six_.col(3 + k) -= (2 * v.Om[l]) * Heps;
      more_rows_.row(3 + k) += (2 * v.Om[l]) * Heps.transpose();
      X_nn(3 + k, 3 + l) += 2 * m.eps_rate.dot(Heps);
    }
  }
  const Matrix3 pi_v = skew(m.pi.head<3>()), pi_O = skew(m.pi.tail<3>());
  X_nn.topRightCorner<3, 3>() -= pi_v;
  X_nn.bottomLeftCorner<3, 3>() -= pi_v;
  X_nn.bottomRightCorner<3, 3>() -= pi_O;
  if (v.body.stiffened_by_spin()) add_spin_to_rate_form(v, X_nn);
  add_rate_changes(v);
  reduce_both_sides(v, X_nn, more_rows_, six_, CQ_);
}

void SuperelementTangent::add_spin_to_rate_form(const View& v, Matrix6& X_nn) {
  const auto& Lambda = v.body.mean_turning;
  const MatrixX3& Phi = spin_force_;
  // dp' = -Lambda^T (kappa' Lambda ds + 2 Phi^T depsdot), d(K_sigma(Om_m) eps) = 2 Phi Lambda ds
  turning_.noalias() = -v.motion.kappa_rate * Lambda;
  X_nn.bottomRightCorner<3, 3>() -= v.motion.kappa_rate;
  six_.rightCols<3>() += turning_.transpose() + 2 * Phi;
  turning_.noalias() -= 2 * Phi.transpose();
  more_rows_.bottomRows<3>() += turning_;
  add_transposed_product(CQ_, Lambda, turning_);
  add_product(CQ_, Phi, Lambda, 2);
}

/// Adds the terms due to the change of J to the forms of the rates (CQ_, more_rows_) and of the coordinates (KQ_,
/// K_nq_).
void SuperelementTangent::add_rate_changes(const View& v) {
  const Eigen::Index b = v.excess.rows();
  KQ_.setZero(v.n, v.n);
  K_nq_.setZero(6, v.n);
  if (b == 0) return;
  const auto M = M_qq_.leftCols(b);
  add_product(CQ_, M, rate_change_, 2);
  add_product(more_rows_, M_nq_.leftCols(b), rate_change_, 2);
  add_product(KQ_, CQ_.leftCols(b), rate_change_);
  add_product(KQ_, M, acceleration_change_);
  add_product(K_nq_, more_rows_.leftCols(b), rate_change_);
  add_product(K_nq_, M_nq_.leftCols(b), acceleration_change_);
}

void SuperelementTangent::set_position_form(const View& v) {
  const SuperelementMotion& m = v.motion;
  if (v.excess.rows() > 0) v.body.add_load_stiffness(m.phi.head(v.excess.rows()), KQ_);
  add_stiffnesses(v);
  add_momentum_changes(v);
  for (const ActingLoad& load : m.loads)
    for (int k = 0; k < 3; ++k) {
      const Matrix3 direction = skew(load.factor * load_direction(load, v.geometry.frame.R, k));
      K_nq_.bottomRows<3>().noalias() += direction * load.pattern->middleCols<3>(3 * k).transpose();
    }
  multiply_by_J_both_sides(v, KQ_);
  multiply_by_J(v, K_nq_);
  add_transposed_product(K_nq_, v.geometry.V, KQ_, -1);
  add_transposed_product(KQ_, v.geometry.Sigma, K_nq_);
}

/// Adds to KQ_ the terms that do not depend on the rest of the state.
void SuperelementTangent::add_stiffnesses(const View& v) {
  const Vector3& Om_mean = v.motion.Om_mean;
  std::array<WeightedMatrix, 16> terms;
  std::size_t count = 0;
  terms[count++] = {&v.body.K, 1};
  for (int k = 0; k < 3; ++k) {
    terms[count++] = {&v.body.G[static_cast<std::size_t>(k)], v.Om_rate[k]};
    for (int l = k; l < 3; ++l) {
      const auto i = static_cast<std::size_t>(pair_index(k, l));
      const double twice = k == l ? 1 : 2;
      terms[count++] = {&v.body.H[i], -twice * v.Om[k] * v.Om[l]};
      if (v.body.stiffened_by_spin()) terms[count++] = {&v.body.spin[i], twice * Om_mean[k] * Om_mean[l]};
    }
  }
  add_weighted(KQ_, {terms.data(), count});
}

/// K_nq_ += d(pi' + ad pi)/d eps
void SuperelementTangent::add_momentum_changes(const View& v) {
  const SuperelementMotion& m = v.motion;
  const auto Heps = m.Heps();
  rows_.setZero(6, v.n);  // d pi / d eps
  for (int k = 0; k < 3; ++k) {
    const MatrixX6& GU = v.body.GU[static_cast<std::size_t>(k)];
    rows_ -= v.Om[k] * GU.transpose();
    K_nq_ -= v.Om_rate[k] * GU.transpose();
  }
  for (int k = 0; k < 3; ++k) {
    rows_.row(3 + k) -= Gs_.col(k).transpose();
    K_nq_.row(3 + k) -= Gs_rate_.col(k).transpose();
    for (int l = 0; l < 3; ++l) {
      const int i = pair_index(k, l);
      rows_.row(3 + k) += (2 * v.Om[l]) * Heps.col(i).transpose();
      K_nq_.row(3 + k) += 2 * (v.Om_rate[l] * Heps.col(i) + v.Om[l] * Heps_rate_.col(i)).transpose();
    }
  }
  if (v.body.stiffened_by_spin()) add_spin_to_position_form(v);
  K_nq_.noalias() += v.ad * rows_;
}

/// Adds to KQ_ and K_nq_, and to d pi / d eps in rows_.
void SuperelementTangent::add_spin_to_position_form(const View& v) {
  const SuperelementMotion& m = v.motion;
  const auto spin_eps = m.spin_eps();
  left_.setZero(v.n, 6);  // K_sigma,kl epsdot
  add_product(Eigen::Map<VectorX>(left_.data(), 6 * v.n), v.body.stacked.middleRows(7 * v.n, 6 * v.n), m.eps_rate);
  turning_.setZero(3, v.n);  // Om_m,l K_sigma,kl epsdot + Om_m,l' K_sigma,kl eps
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const int i = pair_index(k, l);
      turning_.row(k) += (m.Om_mean[l] * left_.col(i) + m.Om_mean_rate[l] * spin_eps.col(i)).transpose();
    }
  rows_.bottomRows<3>() -= 2 * spin_force_.transpose();
  K_nq_.bottomRows<3>() -= 2 * turning_;
  add_transposed_product(KQ_, v.body.mean_turning, turning_, -2);
}

}  // namespace bielle::mechanism
