#include "mechanism/elements/superelement/superelement_body_tangent.hpp"

#include "mechanism/elements/superelement/superelement_body_tangent_view.hpp"
#include "reduce/dense/dense_products.hpp"

namespace bielle::mechanism {

void SuperelementTangent::add(const SuperelementMatrices& body, const MatrixX& damping, SuperelementMotion& motion,
                              const LocalState& state, const std::vector<AttachedPoint>& points,
                              LocalTangent& tangent) {
  motion.coordinates.set_excess();
  View v{body,
         damping,
         motion,
         motion.coordinates.eps(),
         motion.coordinates.excess(),
         motion.geometry,
         state,
         body.size(),
         Vector3::Zero(),
         Vector3::Zero(),
         Vector3::Zero(),
         Matrix6::Zero()};
  set_rotation_blocks(v);
  set_mass_form(v);
  if (tangent.wants_M) {
    multiply_by_D(v, MQ_);
    multiply_by_D_transposed(v);
    add_to(v, tangent.M.dense());
  }
  if (!tangent.wants_C && !tangent.wants_K) return;
  v.v_0 = motion.nu.head<3>();
  v.Om = motion.nu.tail<3>();
  v.Om_rate = motion.nu_rate.tail<3>();
  v.ad << skew(v.Om), Matrix3::Zero(), skew(v.v_0), skew(v.Om);
  set_rate_blocks(v);
  set_products(v);
  set_coordinate_changes(v);
  set_rate_form(v);
  six_.setZero(v.n, 6);
  add_product(six_, MQ_, H_0_);
  if (tangent.wants_C) {
    multiply_by_D(v, CQ_);
    add_blocks(v, MQ_, H_w_u_, &RotationBlocks::H_w);
    add_product(result_, six_, Sigma_D_);
    multiply_by_D_transposed(v);
    add_to(v, tangent.C.dense());
  }
  if (!tangent.wants_K) return;
  set_position_form(v);
  multiply_by_D(v, KQ_);
  add_blocks(v, CQ_, A_v_u_, &RotationBlocks::A_v);
  add_blocks(v, MQ_, A_a_u_, &RotationBlocks::A_a);
  add_product(result_, six_, Sigma_A_v_);
  const Matrix6 Sigma_B_v = v.geometry.Sigma * B_v_;
  left_.setZero(v.n, 6);
  add_product(left_, six_, Sigma_B_v);
  add_product(left_, CQ_, B_v_);
  add_product(left_, MQ_, B_a_);
  add_product(left_, KQ_, v.geometry.V, -1);
  add_load_turning(v);
  add_product(result_, left_, Sigma_D_);
  multiply_by_D_transposed(v);
  add_map_change(v);
  add_to(v, tangent.K.dense());
  if (!points.empty()) add_points(v, points, tangent.K.dense());
}

/// Converts columns of the body's triads and modes to columns of the local unknowns.
void SuperelementTangent::set_local_columns(const View& v, const Matrix6X& X, Matrix6X& local) {
  const auto& points = v.body.points;
  const Matrix3 R_0t = v.geometry.frame.R.transpose();
  local.setZero(6, v.state.slots().size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(6 * k);
    local.middleCols<3>(column).noalias() = X.middleCols<3>(points[k].u) * R_0t;
    if (points[k].theta >= 0)
      local.middleCols<3>(column + 3).noalias() =
          X.middleCols<3>(points[k].theta) * (R_0t * v.state.node(static_cast<int>(k)).R);
  }
  local.middleCols(v.state.slots().amplitude_row(), v.body.modes) = X.rightCols(v.body.modes);
}

void SuperelementTangent::add_points(const View& v, const std::vector<AttachedPoint>& points,
                                     Eigen::Ref<MatrixX> target) {
  const Matrix3 R_0t = v.geometry.frame.R.transpose();
  set_local_columns(v, Sigma_D_, frame_motion_);
  const int first_node = static_cast<int>(v.body.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int node = first_node + static_cast<int>(i);
    node_motion_.setZero(6, v.state.slots().size());
    node_motion_.block<3, 3>(0, 6 * node) = R_0t;
    node_motion_.block<3, 3>(3, 6 * node + 3) = R_0t * v.state.node(node).R;
    // T_P deps = T_P J D (dz^ - U_c dnu_0)
    rows_ = points[i].shapes();
    multiply_by_J(v, rows_);
    point_rows_ = rows_;
    for (std::size_t k = 0; k < v.body.points.size(); ++k)
      if (const int theta = v.body.points[k].theta; theta >= 0)
        point_rows_.middleCols<3>(theta).noalias() = rows_.middleCols<3>(theta) * v.geometry.D[k];
    const Matrix6 carried = rows_ * v.geometry.V;
    point_rows_.noalias() -= carried * Sigma_D_;
    set_local_columns(v, point_rows_, shape_motion_);
    points[i].add_tangent(v.state.slots().multiplier_row() + 6 * static_cast<int>(i), frame_motion_, node_motion_,
                          shape_motion_, target);
  }
}

void SuperelementTangent::set_rotation_blocks(const View& v) {
  const auto& points = v.body.points;
  rotation_.resize(points.size());
  Sigma_D_ = v.geometry.Sigma;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const int theta = points[k].theta; theta >= 0) {
      rotation_[k].D = v.geometry.D[k];
      Sigma_D_.middleCols<3>(theta).noalias() = v.geometry.Sigma.middleCols<3>(theta) * rotation_[k].D;
    }
}

void SuperelementTangent::set_rate_blocks(const View& v) {
  const auto& points = v.body.points;
  const SuperelementMotion& m = v.motion;
  B_v_.setZero(v.n, 6);
  B_a_.setZero(v.n, 6);
  H_0_.setZero(v.n, 6);
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
    Sigma_A_v_.middleCols<3>(theta).noalias() = v.geometry.Sigma.middleCols<3>(theta) * block.A_v;
  }
}

/// X <- X J
void SuperelementTangent::multiply_by_J(const View& v, Matrix6X& X) {
  six_left_ = X.leftCols(v.excess.rows());
  add_product(X, six_left_, v.excess);
}

/// X <- J^T X
void SuperelementTangent::multiply_by_J_transposed(const View& v, MatrixX6& X) {
  six_top_ = X.topRows(v.excess.rows());
  add_transposed_product(X, v.excess, six_top_);
}

/// X <- J^T X J
void SuperelementTangent::multiply_by_J_both_sides(const View& v, MatrixX& X) {
  const Eigen::Index b = v.excess.rows();
  if (b == 0) return;
  interface_columns_ = X.leftCols(b);
  add_product(X, interface_columns_, v.excess);
  interface_rows_ = X.topRows(b);
  add_transposed_product(X, v.excess, interface_rows_);
}

/// X_qq <- L^T [X_nn, X_nq J; J^T X_qn, J^T X_qq J] L
void SuperelementTangent::reduce_both_sides(const View& v, const Matrix6& X_nn, const Matrix6X& X_nq,
                                            const MatrixX6& X_qn, MatrixX& X_qq) {
  const MatrixX6& V = v.geometry.V;
  const Matrix6X& Sigma = v.geometry.Sigma;
  multiply_by_J_both_sides(v, X_qq);
  left_ = X_qn;
  multiply_by_J_transposed(v, left_);
  add_product(left_, X_qq, V, -1);
  rows_ = X_nq;
  multiply_by_J(v, rows_);
  Matrix6 corner = X_nn;
  add_product(corner, rows_, V, -1);
  add_transposed_product(corner, V, left_, -1);
  add_transposed_product(rows_, V, X_qq, -1);
  rows_.noalias() += corner * Sigma;
  add_product(X_qq, left_, Sigma);
  add_transposed_product(X_qq, Sigma, rows_);
}

/// Loads fixed in space rotate relative to the body with its frame: columns dphi_0 of L^T d(e; r).
void SuperelementTangent::add_load_turning(const View& v) {
  for (const ActingLoad& load : v.motion.loads) {
    if (load.follows) continue;
    three_.setZero(v.n, 3);
    Eigen::Matrix<double, 6, 3> rigid = Eigen::Matrix<double, 6, 3>::Zero();
    for (int k = 0; k < 3; ++k) {
      const auto component = load.pattern->middleCols<3>(3 * k);
      const Matrix3 turned = skew(load.factor * load_direction(load, v.geometry.frame.R, k));
      three_.noalias() -= component * turned;
      const Vector3 displaced = component.transpose() * v.eps;
      rigid.bottomRows<3>() -= skew(displaced) * turned;
    }
    add_transposed_product(rigid, v.body.U, three_);
    three_top_ = three_.topRows(v.excess.rows());
    add_transposed_product(three_, v.excess, three_top_);
    add_transposed_product(rigid, v.geometry.V, three_, -1);
    left_.rightCols<3>() += three_;
    add_transposed_product(left_.rightCols<3>(), v.geometry.Sigma, rigid);
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
  add_product(result_, three_, B_0, -1);
  add_transposed_product(result_, B_0, Y_, -1);
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

/// Adds Q^T result Q to target, with the component's rows and columns.
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
