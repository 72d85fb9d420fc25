#include "mechanism/elements/superelement_body_tangent.hpp"

namespace bielle::mechanism {

struct SuperelementTangent::View {
  const SuperelementMatrices& body;
  const SuperelementMotion& motion;
  const CorotatedGeometry& geometry;
  const LocalState& state;
  Eigen::Index n;
  Vector3 v_0, Om, Om_rate;
  Matrix6 ad;  // e = pi' + ad pi
};

void SuperelementTangent::add(const SuperelementMatrices& body, const SuperelementMotion& motion,
                              const LocalState& state, LocalTangent& tangent) {
  View v{body,
         motion,
         motion.geometry,
         state,
         body.size(),
         motion.nu.head<3>(),
         motion.nu.tail<3>(),
         motion.nu_rate.tail<3>(),
         Matrix6::Zero()};
  v.ad << skew(v.Om), Matrix3::Zero(), skew(v.v_0), skew(v.Om);

  set_rate_blocks(v);
  set_mass_form(v);
  if (tangent.wants_M) {
    multiply_by_D(v, MQ_);
    multiply_by_D_transposed(v);
    add_to(v, tangent.M);
  }
  if (!tangent.wants_C && !tangent.wants_K) return;
  set_rate_form(v);
  six_.noalias() = MQ_ * H_0_;
  if (tangent.wants_C) {
    multiply_by_D(v, CQ_);
    add_blocks(v, MQ_, H_w_u_, &RotationBlocks::H_w);
    result_.noalias() += six_ * Sigma_D_;
    multiply_by_D_transposed(v);
    add_to(v, tangent.C);
  }
  if (!tangent.wants_K) return;
  set_position_form(v);
  multiply_by_D(v, KQ_);
  add_blocks(v, CQ_, A_v_u_, &RotationBlocks::A_v);
  add_blocks(v, MQ_, A_a_u_, &RotationBlocks::A_a);
  result_.noalias() += six_ * Sigma_A_v_;
  const Matrix6 Sigma_B_v = v.geometry.Sigma * B_v_;
  left_.noalias() = six_ * Sigma_B_v;
  left_.noalias() += CQ_ * B_v_;
  left_.noalias() += MQ_ * B_a_;
  left_.noalias() -= KQ_ * v.geometry.V;
  add_load_turning(v);
  result_.noalias() += left_ * Sigma_D_;
  multiply_by_D_transposed(v);
  add_map_change(v);
  add_to(v, tangent.K);
}

void SuperelementTangent::set_rate_blocks(const View& v) {
  const auto& points = v.body.points;
  const SuperelementMotion& m = v.motion;
  rotation_.resize(points.size());
  B_v_.setZero(v.n, 6);
  B_a_.setZero(v.n, 6);
  H_0_.setZero(v.n, 6);
  Sigma_D_ = v.geometry.Sigma;
  Sigma_A_v_.setZero(6, v.n);

  const Matrix3 Om = skew(v.Om), squared = skew(v.Om_rate) - Om * Om;
  A_v_u_ = -Om;
  A_a_u_ = -squared;
  H_w_u_ = -2 * Om;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const int u = points[k].u, theta = points[k].theta;
    const Matrix3 y = skew(v.geometry.y[k]);
    const Matrix3 w = skew(m.w.segment<3>(u)), w_rel = skew(m.w_rel.segment<3>(u)), a = skew(m.a.segment<3>(u));
    B_v_.block<3, 3>(u, 0) = Om;
    B_v_.block<3, 3>(u, 3) = w - Om * y;
    B_a_.block<3, 3>(u, 0) = squared;
    B_a_.block<3, 3>(u, 3) = a - 2 * Om * w - squared * y;
    H_0_.block<3, 3>(u, 0) = Om;
    H_0_.block<3, 3>(u, 3) = w + w_rel - Om * y;
    Sigma_A_v_.middleCols<3>(u).noalias() = v.geometry.Sigma.middleCols<3>(u) * A_v_u_;
    if (theta < 0) continue;

    const InterfaceRotation& rotation = points[k].rotation;
    const Matrix3& E = v.geometry.E[k];
    const Vector3 r = m.w_rel.segment<3>(theta);
    RotationBlocks& block = rotation_[k];
    block.D = v.geometry.D[k];
    block.Z = rotation.transpose_gradient(E, m.force.segment<3>(theta));
    // D' r depends on r through K_r and on E through the rate gradient.
    const Matrix3 D_gradient = rotation.gradient(E, r);
    const Matrix3 K_r = D_gradient + rotation.differential_rate(E, r);
    const Matrix3 turning = skew(m.w.segment<3>(theta)), a_turning = skew(m.a.segment<3>(theta));
    block.A_v = D_gradient - block.D * turning;
    block.A_a = rotation.gradient(E, m.a_rel.segment<3>(theta)) + rotation.rate_gradient(E, r) - K_r * turning -
                block.D * (a_turning - Om * turning);
    block.H_w = K_r - block.D * Om;
    B_v_.block<3, 3>(theta, 3) = -block.A_v;
    B_a_.block<3, 3>(theta, 3) = -block.A_a;
    H_0_.block<3, 3>(theta, 3) = block.D * turning - K_r;
    const auto Sigma = v.geometry.Sigma.middleCols<3>(theta);
    Sigma_D_.middleCols<3>(theta).noalias() = Sigma * block.D;
    Sigma_A_v_.middleCols<3>(theta).noalias() = Sigma * block.A_v;
  }
}

/// X_qq <- L^T [X_nn X_nq; X_qn X_qq] L
void SuperelementTangent::reduce_both_sides(const View& v, const Matrix6& X_nn, const Matrix6X& X_nq,
                                            const MatrixX6& X_qn, MatrixX& X_qq) {
  const MatrixX6& V = v.geometry.V;
  const Matrix6X& Sigma = v.geometry.Sigma;
  left_ = X_qn;
  left_.noalias() -= X_qq * V;
  Matrix6 corner = X_nn;
  corner.noalias() -= X_nq * V;
  corner.noalias() -= V.transpose() * left_;
  rows_ = X_nq;
  rows_.noalias() -= V.transpose() * X_qq;
  rows_.noalias() += corner * Sigma;
  X_qq.noalias() += left_ * Sigma;
  X_qq.noalias() += Sigma.transpose() * rows_;
}

void SuperelementTangent::set_mass_form(const View& v) {
  const SuperelementMotion& m = v.motion;
  const Eigen::Matrix<double, 6, 3> UGq = v.body.U.transpose() * m.Gq;
  M_nn_.noalias() = v.body.U.transpose() * v.body.A;
  M_nn_.rightCols<3>() += UGq;
  M_nn_.bottomRows<3>() += UGq.transpose();
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) M_nn_(3 + k, 3 + l) += v.geometry.q.dot(m.Hq.col(pair_index(k, l)));
  M_nq_ = v.body.A.transpose();
  M_nq_.bottomRows<3>() += m.Gq.transpose();
  MQ_ = v.body.M;
  six_ = M_nq_.transpose();
  reduce_both_sides(v, M_nn_, M_nq_, six_, MQ_);
}

void SuperelementTangent::set_rate_form(const View& v) {
  const SuperelementMotion& m = v.motion;
  CQ_ = v.body.C;
  six_.setZero(v.n, 6);
  more_rows_.noalias() = v.ad * M_nq_;
  Matrix6 X_nn = v.ad * M_nn_;
  for (int k = 0; k < 3; ++k) {
    const auto index = static_cast<std::size_t>(k);
    CQ_ += (2 * v.Om[k]) * v.body.G[index];
    six_ += v.Om[k] * v.body.GU[index];
    six_.col(3 + k) += m.Gq_rate.col(k) + m.Gs.col(k);
    more_rows_ -= v.Om[k] * v.body.GU[index].transpose();
    more_rows_.row(3 + k) += (m.Gq_rate.col(k) - m.Gs.col(k)).transpose();
    const Vector6 UGq_rate = v.body.U.transpose() * m.Gq_rate.col(k);
    X_nn.col(3 + k) += UGq_rate;
    X_nn.row(3 + k) += UGq_rate.transpose();
    for (int l = 0; l < 3; ++l) {
      const auto Hq = m.Hq.col(pair_index(k, l));
      six_.col(3 + k) -= (2 * v.Om[l]) * Hq;
      more_rows_.row(3 + k) += (2 * v.Om[l]) * Hq.transpose();
      X_nn(3 + k, 3 + l) += 2 * m.q_rate.dot(Hq);
    }
  }
  const Matrix3 pi_v = skew(m.pi.head<3>()), pi_O = skew(m.pi.tail<3>());
  X_nn.topRightCorner<3, 3>() -= pi_v;
  X_nn.bottomLeftCorner<3, 3>() -= pi_v;
  X_nn.bottomRightCorner<3, 3>() -= pi_O;
  reduce_both_sides(v, X_nn, more_rows_, six_, CQ_);
}

void SuperelementTangent::set_position_form(const View& v) {
  const SuperelementMotion& m = v.motion;
  KQ_ = m.stiffness;
  for (int k = 0; k < 3; ++k) {
    KQ_ += v.Om_rate[k] * v.body.G[static_cast<std::size_t>(k)];
    for (int l = k; l < 3; ++l)
      KQ_ -= ((k == l ? 1 : 2) * v.Om[k] * v.Om[l]) * v.body.H[static_cast<std::size_t>(pair_index(k, l))];
  }
  // rows_: d pi / dq, more_rows_: d e / dq
  Gs_rate_.resize(v.n, 3);
  Hq_rate_.resize(v.n, 6);
  for (int k = 0; k < 3; ++k) Gs_rate_.col(k).noalias() = v.body.G[static_cast<std::size_t>(k)] * m.s_rate;
  for (int i = 0; i < 6; ++i) Hq_rate_.col(i).noalias() = v.body.H[static_cast<std::size_t>(i)] * m.q_rate;
  rows_.setZero(6, v.n);
  more_rows_.setZero(6, v.n);
  for (int k = 0; k < 3; ++k) {
    const MatrixX6& GU = v.body.GU[static_cast<std::size_t>(k)];
    rows_ -= v.Om[k] * GU.transpose();
    more_rows_ -= v.Om_rate[k] * GU.transpose();
  }
  for (int k = 0; k < 3; ++k) {
    rows_.row(3 + k) -= m.Gs.col(k).transpose();
    more_rows_.row(3 + k) -= Gs_rate_.col(k).transpose();
    for (int l = 0; l < 3; ++l) {
      const int i = pair_index(k, l);
      rows_.row(3 + k) += (2 * v.Om[l]) * m.Hq.col(i).transpose();
      more_rows_.row(3 + k) += 2 * (v.Om_rate[l] * m.Hq.col(i) + v.Om[l] * Hq_rate_.col(i)).transpose();
    }
  }
  more_rows_.noalias() += v.ad * rows_;
  for (const ActingLoad& load : m.loads)
    for (int k = 0; k < 3; ++k) {
      const Matrix3 direction = skew(load.factor * load_direction(load, v.geometry.frame.R, k));
      more_rows_.bottomRows<3>().noalias() += direction * load.pattern->middleCols<3>(3 * k).transpose();
    }
  more_rows_.noalias() -= v.geometry.V.transpose() * KQ_;
  KQ_.noalias() += v.geometry.Sigma.transpose() * more_rows_;
}

/// Loads fixed in space turn relative to the body with its frame: columns dphi_0 of L^T d(e; r).
void SuperelementTangent::add_load_turning(const View& v) {
  for (const ActingLoad& load : v.motion.loads) {
    if (load.follows) continue;
    three_.setZero(v.n, 3);
    Eigen::Matrix<double, 6, 3> rigid = Eigen::Matrix<double, 6, 3>::Zero();
    for (int k = 0; k < 3; ++k) {
      const auto component = load.pattern->middleCols<3>(3 * k);
      const Matrix3 turned = skew(load.factor * load_direction(load, v.geometry.frame.R, k));
      three_.noalias() -= component * turned;
      const Vector3 displaced = component.transpose() * v.geometry.q;
      rigid.bottomRows<3>() -= skew(displaced) * turned;
    }
    rigid.noalias() += v.body.U.transpose() * three_;
    rigid.noalias() -= v.geometry.V.transpose() * three_;
    left_.rightCols<3>() += three_;
    left_.rightCols<3>().noalias() += v.geometry.Sigma.transpose() * rigid;
  }
}

/// result += K^
void SuperelementTangent::add_map_change(const View& v) {
  const VectorX& F = v.motion.node_force;
  three_.setZero(v.n, 3);
  Y_.setZero(3, v.n);
  Matrix6 Y_U = Matrix6::Zero();
  for (std::size_t k = 0; k < v.body.points.size(); ++k) {
    const int u = v.body.points[k].u, theta = v.body.points[k].theta;
    const Matrix3 F_u = skew(F.segment<3>(u));
    three_.middleRows<3>(u) = F_u;
    Y_.middleCols<3>(u) = -F_u;
    Y_U.topLeftCorner<3, 3>() -= F_u;
    Y_U.topRightCorner<3, 3>() += F_u * skew(v.geometry.y[k]);
    if (theta < 0) continue;
    const Matrix3& Z = rotation_[k].Z;
    const Matrix3 own = skew(F.segment<3>(theta)) + Z;
    result_.block<3, 3>(theta, theta) += own;
    three_.middleRows<3>(theta) = own;
    Y_.middleCols<3>(theta) = Z;
    Y_U.topRightCorner<3, 3>() += Z;
  }
  Y_.noalias() -= Y_U.topRows<3>() * Sigma_D_;
  const auto B_0 = Sigma_D_.bottomRows<3>();
  result_.noalias() -= three_ * B_0;
  result_.noalias() -= B_0.transpose() * Y_;
}

/// result = X D
void SuperelementTangent::multiply_by_D(const View& v, const MatrixX& X) {
  result_ = X;
  for (std::size_t k = 0; k < v.body.points.size(); ++k)
    if (const int theta = v.body.points[k].theta; theta >= 0)
      result_.middleCols<3>(theta).noalias() = X.middleCols<3>(theta) * rotation_[k].D;
}

/// result += X blockdiag(u_block, theta_block, 0)
void SuperelementTangent::add_blocks(const View& v, const MatrixX& X, const Matrix3& u_block,
                                     Matrix3 RotationBlocks::*theta_block) {
  for (std::size_t k = 0; k < v.body.points.size(); ++k) {
    const int u = v.body.points[k].u, theta = v.body.points[k].theta;
    result_.middleCols<3>(u).noalias() += X.middleCols<3>(u) * u_block;
    if (theta >= 0) result_.middleCols<3>(theta).noalias() += X.middleCols<3>(theta) * (rotation_[k].*theta_block);
  }
}

/// result = D^T result
void SuperelementTangent::multiply_by_D_transposed(const View& v) {
  for (std::size_t k = 0; k < v.body.points.size(); ++k)
    if (const int theta = v.body.points[k].theta; theta >= 0) {
      const Matrix3 Dt = rotation_[k].D.transpose();
      for (Eigen::Index j = 0; j < v.n; ++j) {
        const Vector3 column = result_.block<3, 1>(theta, j);
        result_.block<3, 1>(theta, j) = Dt * column;
      }
    }
}

/// target += Q^T result Q, with the component's rows and columns.
void SuperelementTangent::add_to(const View& v, Eigen::Ref<MatrixX> target) {
  const auto& points = v.body.points;
  const Eigen::Index modes = v.body.modes, amplitudes = v.state.slots().amplitude_row();
  const Matrix3 R_0t = v.geometry.frame.R.transpose();
  const auto for_each_triad = [&](const auto& act) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto local = static_cast<Eigen::Index>(6 * k);
      act(points[k].u, local, R_0t);
      if (points[k].theta >= 0) act(points[k].theta, local + 3, Matrix3(R_0t * v.state.node(static_cast<int>(k)).R));
    }
  };
  for_each_triad([&](int column, Eigen::Index local_column, const Matrix3& Q) {
    three_.noalias() = result_.middleCols<3>(column) * Q;
    for_each_triad([&](int row, Eigen::Index local_row, const Matrix3& Q_row) {
      target.block<3, 3>(local_row, local_column).noalias() += Q_row.transpose() * three_.middleRows<3>(row);
    });
    target.block(amplitudes, local_column, modes, 3) += three_.bottomRows(modes);
  });
  for_each_triad([&](int row, Eigen::Index local_row, const Matrix3& Q) {
    target.block(local_row, amplitudes, 3, modes).noalias() +=
        Q.transpose() * result_.block(row, v.n - modes, 3, modes);
  });
  target.block(amplitudes, amplitudes, modes, modes) += result_.bottomRightCorner(modes, modes);
}

}  // namespace bielle::mechanism
