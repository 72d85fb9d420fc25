#include "mechanism/elements/superelement/superelement_body_motion.hpp"

#include <Eigen/Geometry>

#include "reduce/dense/dense_products.hpp"

namespace bielle::mechanism {

Vector3 load_direction(const ActingLoad& load, const Matrix3& R_0, int k) {
  return load.follows ? Vector3(Vector3::Unit(k)) : Vector3(R_0.row(k).transpose());
}

void SuperelementMotion::set_positions(const SuperelementMatrices& body, const CorotatedFrame& frame,
                                       const LocalState& state) {
  frame.solve(state, geometry);
  coordinates.solve(body, geometry.q);
}

void SuperelementMotion::set_velocities(const SuperelementMatrices& body, const CorotatedFrame& frame,
                                        const LocalState& state) {
  const auto& points = frame.points();
  const Eigen::Index n = geometry.q.size(), modes = state.slots().amplitudes, rows = n - modes;
  const Matrix3 R_0t = geometry.frame.R.transpose();
  w.resize(n);
  eps_rate.resize(n);
  VectorX& q_rate = eps_rate;  // first D w, then qdot
  w.tail(modes) = state.amplitude_rate();
  q_rate.tail(modes) = w.tail(modes);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const NodeState& node = state.node(static_cast<int>(k));
    const int u = points[k].u, theta = points[k].theta;
    w.segment<3>(u) = R_0t * node.v;
    q_rate.segment<3>(u) = w.segment<3>(u);
    if (theta < 0) continue;
    w.segment<3>(theta) = R_0t * (node.R * node.Omega);
    q_rate.segment<3>(theta) = geometry.D[k] * w.segment<3>(theta);
  }
  nu.noalias() = geometry.Sigma * q_rate;
  q_rate.head(rows).noalias() -= geometry.V.topRows(rows) * nu;
  const Vector3 v_0 = nu.head<3>(), Om_0 = nu.tail<3>();
  w_rel = w;
  for (std::size_t k = 0; k < points.size(); ++k) {
    w_rel.segment<3>(points[k].u) -= v_0 + Om_0.cross(geometry.y[k]);
    if (points[k].theta >= 0) w_rel.segment<3>(points[k].theta) -= Om_0;
  }
  coordinates.multiply(eps_rate);
  s = eps_rate;
  s.head(rows).noalias() += body.U.topRows(rows) * nu;
}

void SuperelementMotion::set_accelerations(const SuperelementMatrices& body, const CorotatedFrame& frame,
                                           const LocalState& state) {
  const auto& points = frame.points();
  const Eigen::Index n = geometry.q.size(), modes = state.slots().amplitudes, rows = n - modes;
  const Matrix3 R_0t = geometry.frame.R.transpose();
  const Vector3 Om_0 = nu.tail<3>();
  a.resize(n);
  eps_acceleration.resize(n);
  VectorX& q_acceleration = eps_acceleration;  // first b, then qddot
  a.tail(modes) = state.amplitude_acceleration();
  q_acceleration.tail(modes) = a.tail(modes);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const NodeState& node = state.node(static_cast<int>(k));
    a.segment<3>(points[k].u) = R_0t * (node.a - state.environment().gravity);
    if (points[k].theta >= 0) a.segment<3>(points[k].theta) = R_0t * (node.R * node.Omegadot);
  }
  a_rel = a;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const int u = points[k].u, theta = points[k].theta;
    a_rel.segment<3>(u) -= Om_0.cross(w.segment<3>(u) + w_rel.segment<3>(u));
    q_acceleration.segment<3>(u) = a_rel.segment<3>(u);
    if (theta < 0) continue;
    a_rel.segment<3>(theta) -= Om_0.cross(w.segment<3>(theta));
    const Vector3 turning = w_rel.segment<3>(theta);
    q_acceleration.segment<3>(theta) = geometry.D[k] * a_rel.segment<3>(theta) +
                                       points[k].rotation.differential_rate(geometry.E[k], turning) * turning;
  }
  nu_rate.noalias() = geometry.Sigma * q_acceleration;
  q_acceleration.head(rows).noalias() -= geometry.V.topRows(rows) * nu_rate;
  for (std::size_t k = 0; k < points.size(); ++k) {
    a_rel.segment<3>(points[k].u) -= nu_rate.head<3>() + Vector3(nu_rate.tail<3>()).cross(geometry.y[k]);
    if (points[k].theta >= 0) a_rel.segment<3>(points[k].theta) -= nu_rate.tail<3>();
  }
  if (coordinates.rows() == 0) return;
  body.add_load_stiffness_forms(eps_rate, entries_, eps_acceleration.head(rows));
  coordinates.multiply(eps_acceleration);
}

void SuperelementMotion::set_products(const SuperelementMatrices& body) {
  const VectorX& eps = coordinates.eps();
  const Eigen::Index n = eps.size(), rows = body.interface_rows();
  products.setZero(n, body.products());
  add_product(Eigen::Map<VectorX>(products.data(), products.size()), body.stacked, eps);
  eps_forms.setZero(products.cols());
  add_transposed_product(eps_forms, products, eps);
  UGeps.noalias() = body.U.topRows(rows).transpose() * Geps().topRows(rows);
  if (!body.stiffened_by_spin()) return;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) kappa(k, l) = eps_forms[7 + pair_index(k, l)];
}

void SuperelementMotion::set_mean_turning(const SuperelementMatrices& body) {
  rates_of_rigid_.setZero();
  add_transposed_product(rates_of_rigid_, body.rigid_columns, eps_rate);
  rate_forms_.setZero(products.cols());
  add_transposed_product(rate_forms_, products, eps_rate);
  // Lambda U = [0, I]
  Om_mean = nu.tail<3>() + rates_of_rigid_.segment<3>(6);
}

void SuperelementMotion::set_momentum(const SuperelementMatrices& body) {
  const Vector3 Om_0 = nu.tail<3>(), Om_rate = nu_rate.tail<3>();
  const Eigen::Index first_G = products.cols() - 3;
  accelerations_of_rigid_.setZero();
  add_transposed_product(accelerations_of_rigid_, body.rigid_columns.leftCols(9), eps_acceleration);
  Om_mean_rate = Om_rate + accelerations_of_rigid_.segment<3>(6);
  pi = body.rigid * nu + rates_of_rigid_.head<6>() + UGeps * Om_0;
  pi_rate = body.rigid * nu_rate + accelerations_of_rigid_.head<6>() + UGeps * Om_rate;
  const Vector3 accelerations = Geps().transpose() * eps_acceleration;
  for (int k = 0; k < 3; ++k) {
    const Vector6 UG_rate = -rates_of_rigid_.segment<6>(9 + 6 * k);  // U^T G_k epsdot
    pi_rate += Om_0[k] * UG_rate;
    // s.G_k eps and its rate; epsdot.G_k epsdot = 0
    double moment = nu.dot(UGeps.col(k)) + rate_forms_[first_G + k];
    double moment_rate = nu_rate.dot(UGeps.col(k)) + accelerations[k] + nu.dot(UG_rate);
    for (int l = 0; l < 3; ++l) {
      const int i = 1 + pair_index(k, l);
      moment += Om_0[l] * eps_forms[i];
      moment_rate += Om_rate[l] * eps_forms[i] + 2 * Om_0[l] * rate_forms_[i];
    }
    pi[3 + k] += moment;
    pi_rate[3 + k] += moment_rate;
  }
  if (!body.stiffened_by_spin()) return;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) kappa_rate(k, l) = 2 * rate_forms_[7 + pair_index(k, l)];
  pi.tail<3>() -= kappa * Om_mean;
  pi_rate.tail<3>() -= kappa_rate * Om_mean + kappa * Om_mean_rate;
}

void SuperelementMotion::set_forces(const SuperelementMatrices& body, const MatrixX& damping) {
  const Eigen::Index n = eps_rate.size(), rows = body.interface_rows();
  const Vector3 v_0 = nu.head<3>(), Om_0 = nu.tail<3>(), Om_rate = nu_rate.tail<3>();
  set_momentum(body);

  // M s' + G(Om_0) (epsdot + s)
  four_.resize(4 * n);
  four_.head(n) = eps_acceleration;
  four_.head(rows).noalias() += body.U.topRows(rows) * nu_rate;
  for (int k = 0; k < 3; ++k) four_.segment((k + 1) * n, n) = Om_0[k] * (eps_rate + s);
  r.setZero(n);
  add_product(r, body.in_a_row, four_);
  // (K - H(Om_0) + K_sigma(Om_m) + G(Om_0')) eps
  weights_.resize(products.cols());
  weights_[0] = 1;
  for (int k = 0; k < 3; ++k)
    for (int l = k; l < 3; ++l) {
      const int i = pair_index(k, l);
      const double twice = k == l ? 1 : 2;
      weights_[1 + i] = -twice * Om_0[k] * Om_0[l];
      if (body.stiffened_by_spin()) weights_[7 + i] = twice * Om_mean[k] * Om_mean[l];
    }
  weights_.tail<3>() = Om_rate;
  add_product(r, products, weights_);
  add_product(r, damping, eps_rate);
  if (body.stiffened_by_spin())
    r.noalias() -= body.mean_turning.transpose() * (kappa_rate * Om_mean + kappa * Om_mean_rate);
  r -= load;

  e = pi_rate - rigid_load;
  if (attached_force.size() > 0) {
    r -= attached_force;
    e -= attached_wrench;
  }
  e.head<3>() += Om_0.cross(pi.head<3>());
  e.tail<3>() += Om_0.cross(pi.tail<3>()) + v_0.cross(pi.head<3>());
  set_node_force(body);
}

void SuperelementMotion::set_loads(const SuperelementMatrices& body) {
  load.setZero(coordinates.eps().size());
  rigid_load.setZero();
  if (loads.empty()) return;
  for (const ActingLoad& acting : loads)
    for (int k = 0; k < 3; ++k) {
      const Vector3 direction = load_direction(acting, geometry.frame.R, k);
      const auto component = acting.pattern->middleCols<3>(3 * k);
      load.noalias() += component * (acting.factor * direction);
      const Vector3 displaced = component.transpose() * coordinates.eps();
      rigid_load.tail<3>() += acting.factor * displaced.cross(direction);
    }
  rigid_load.noalias() += body.U.transpose() * load;
}

void SuperelementMotion::set_node_force(const SuperelementMatrices& body) {
  const Eigen::Index rows = body.interface_rows();
  phi = r;
  coordinates.multiply_transposed(phi);
  Vector6 rest = e;
  rest.noalias() -= geometry.V.topRows(rows).transpose() * phi.head(rows);
  force = phi;
  force.noalias() += geometry.Sigma.transpose() * rest;
  node_force = force;
  for (std::size_t k = 0; k < body.points.size(); ++k)
    if (const int theta = body.points[k].theta; theta >= 0)
      node_force.segment<3>(theta) = geometry.D[k].transpose() * force.segment<3>(theta);
}

double SuperelementMotion::kinetic_energy(const SuperelementMatrices& body) {
  const Vector3 Om_0 = nu.tail<3>();
  entries_.setZero(s.size());
  add_product(entries_, body.M, s);
  double energy = 0.5 * s.dot(entries_);
  for (int k = 0; k < 3; ++k) {
    energy += Om_0[k] * (nu.dot(UGeps.col(k)) + rate_forms_[products.cols() - 3 + k]);
    for (int l = 0; l < 3; ++l) energy += 0.5 * Om_0[k] * Om_0[l] * eps_forms[1 + pair_index(k, l)];
  }
  return body.stiffened_by_spin() ? energy - 0.5 * Om_mean.dot(kappa * Om_mean) : energy;
}

double SuperelementMotion::dissipation(const MatrixX& damping) {
  entries_.setZero(eps_rate.size());
  add_product(entries_, damping, eps_rate);
  return eps_rate.dot(entries_);
}

}  // namespace bielle::mechanism
