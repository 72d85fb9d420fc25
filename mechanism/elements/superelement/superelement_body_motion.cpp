#include "mechanism/elements/superelement/superelement_body_motion.hpp"

#include <Eigen/Geometry>

#include "reduce/dense/dense_products.hpp"

namespace bielle::mechanism {

Vector3 load_direction(const ActingLoad& load, const Matrix3& R_0, int k) {
  return load.follows ? Vector3(Vector3::Unit(k)) : Vector3(R_0.row(k).transpose());
}

void SuperelementMotion::set_motion(const SuperelementMatrices& body, const CorotatedFrame& frame,
                                    const LocalState& state) {
  frame.solve(state, geometry);
  coordinates.solve(body, geometry.q);
  set_node_motion(frame, state);
  set_coordinates(body);
}

void SuperelementMotion::set_node_motion(const CorotatedFrame& body_frame, const LocalState& state) {
  const auto& points = body_frame.points();
  const Eigen::Index n = geometry.q.size(), modes = state.slots().amplitudes;
  const Matrix3 R_0t = geometry.frame.R.transpose();
  for (VectorX* vector : {&w, &w_rel, &a, &a_rel, &eps_rate, &eps_acceleration}) vector->resize(n);

  // They first contain D w and b, then qdot and qddot.
  VectorX &q_rate = eps_rate, &q_acceleration = eps_acceleration;
  w.tail(modes) = state.amplitude_rate();
  a.tail(modes) = state.amplitude_acceleration();
  q_rate.tail(modes) = w.tail(modes);
  q_acceleration.tail(modes) = a.tail(modes);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const NodeState& node = state.node(static_cast<int>(k));
    const int u = points[k].u, theta = points[k].theta;
    w.segment<3>(u) = R_0t * node.v;
    a.segment<3>(u) = R_0t * (node.a - state.environment().gravity);
    q_rate.segment<3>(u) = w.segment<3>(u);
    if (theta < 0) continue;
    const Matrix3 Q = R_0t * node.R;
    w.segment<3>(theta) = Q * node.Omega;
    a.segment<3>(theta) = Q * node.Omegadot;
    q_rate.segment<3>(theta) = geometry.D[k] * w.segment<3>(theta);
  }
  nu.noalias() = geometry.Sigma * q_rate;
  q_rate.noalias() -= geometry.V * nu;
  const Vector3 v_0 = nu.head<3>(), Om_0 = nu.tail<3>();

  w_rel = w;
  a_rel = a;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const int u = points[k].u, theta = points[k].theta;
    w_rel.segment<3>(u) -= v_0 + Om_0.cross(geometry.y[k]);
    a_rel.segment<3>(u) -= Om_0.cross(w.segment<3>(u) + w_rel.segment<3>(u));
    q_acceleration.segment<3>(u) = a_rel.segment<3>(u);
    if (theta < 0) continue;
    w_rel.segment<3>(theta) -= Om_0;
    a_rel.segment<3>(theta) -= Om_0.cross(w.segment<3>(theta));
    const Vector3 turning = w_rel.segment<3>(theta);
    q_acceleration.segment<3>(theta) = geometry.D[k] * a_rel.segment<3>(theta) +
                                       points[k].rotation.differential_rate(geometry.E[k], turning) * turning;
  }
  nu_rate.noalias() = geometry.Sigma * q_acceleration;
  q_acceleration.noalias() -= geometry.V * nu_rate;
  for (std::size_t k = 0; k < points.size(); ++k) {
    a_rel.segment<3>(points[k].u) -= nu_rate.head<3>() + Vector3(nu_rate.tail<3>()).cross(geometry.y[k]);
    if (points[k].theta >= 0) a_rel.segment<3>(points[k].theta) -= nu_rate.tail<3>();
  }
}

void SuperelementMotion::set_coordinates(const SuperelementMatrices& body) {
  const Eigen::Index b = coordinates.rows();
  if (b == 0) return;
  coordinates.multiply(eps_rate);
  rate_gradient.resize(eps_rate.size(), b);
  body.multiply_load_stiffness(eps_rate, rate_gradient);
  eps_acceleration.head(b).noalias() += rate_gradient.transpose() * eps_rate;
  coordinates.multiply(eps_acceleration);
}

void SuperelementMotion::set_products(const SuperelementMatrices& body) {
  const VectorX& eps = coordinates.eps();
  const Eigen::Index n = eps.size();
  s = eps_rate;
  s.noalias() += body.U * nu;
  s_rate = eps_acceleration;
  s_rate.noalias() += body.U * nu_rate;

  const Eigen::Index first = body.stacked_G();
  eps_products.setZero(first + 3 * n);
  add_product(eps_products, body.stacked.topRows(first + 3 * n), eps);
  elastic_force = eps_products.head(n);
  Heps = Eigen::Map<const MatrixX6>(eps_products.data() + n, n, 6);
  if (body.stiffened_by_spin()) spin_eps = Eigen::Map<const MatrixX6>(eps_products.data() + 7 * n, n, 6);
  Geps = Eigen::Map<const MatrixX3>(eps_products.data() + first, n, 3);
  s_products.setZero(4 * n);
  add_product(s_products, body.stacked.bottomRows(4 * n), s);
  Gs = Eigen::Map<const MatrixX3>(s_products.data(), n, 3);
  Geps_rate.setZero(n, 3);
  add_product(Eigen::Map<VectorX>(Geps_rate.data(), 3 * n), body.stacked.middleRows(first, 3 * n), eps_rate);
}

void SuperelementMotion::set_forces(const SuperelementMatrices& body, const MatrixX& damping) {
  const VectorX& eps = coordinates.eps();
  const Vector3 v_0 = nu.head<3>(), Om_0 = nu.tail<3>(), Om_rate = nu_rate.tail<3>();
  set_products(body);
  p = s_products.tail(eps.size());
  p.noalias() += Geps * Om_0;
  p_rate.noalias() = body.M * s_rate;
  p_rate.noalias() += Geps * Om_rate;
  p_rate.noalias() += Geps_rate * Om_0;
  if (body.stiffened_by_spin()) add_spin_momentum(body);
  pi.noalias() = body.U.transpose() * p;
  pi_rate.noalias() = body.U.transpose() * p_rate;

  r = p_rate + elastic_force;
  r.noalias() += Gs * Om_0;
  if (body.stiffened_by_spin()) r.noalias() += spin_force * Om_mean;
  r.noalias() += damping * eps_rate;
  for (int k = 0; k < 3; ++k) {
    double moment = s.dot(Geps.col(k));
    double moment_rate = s_rate.dot(Geps.col(k)) + s.dot(Geps_rate.col(k));
    for (int l = 0; l < 3; ++l) {
      const auto Heps_kl = Heps.col(pair_index(k, l));
      r -= (Om_0[k] * Om_0[l]) * Heps_kl;
      const double eps_H_eps = eps.dot(Heps_kl);
      moment += Om_0[l] * eps_H_eps;
      moment_rate += Om_rate[l] * eps_H_eps + 2 * Om_0[l] * eps_rate.dot(Heps_kl);
    }
    pi[3 + k] += moment;
    pi_rate[3 + k] += moment_rate;
  }

  set_loads(body);
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

void SuperelementMotion::add_spin_momentum(const SuperelementMatrices& body) {
  const VectorX& eps = coordinates.eps();
  Om_mean.noalias() = body.mean_turning * s;
  Om_mean_rate.noalias() = body.mean_turning * s_rate;
  spin_force.setZero(eps.size(), 3);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const auto column = spin_eps.col(pair_index(k, l));
      spin_force.col(k) += Om_mean[l] * column;
      kappa(k, l) = eps.dot(column);
      kappa_rate(k, l) = 2 * eps_rate.dot(column);
    }
  p.noalias() -= body.mean_turning.transpose() * (kappa * Om_mean);
  p_rate.noalias() -= body.mean_turning.transpose() * (kappa_rate * Om_mean + kappa * Om_mean_rate);
}

void SuperelementMotion::set_loads(const SuperelementMatrices& body) {
  load.setZero(coordinates.eps().size());
  rigid_load.setZero();
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
  phi = r;
  coordinates.multiply_transposed(phi);
  Vector6 rest = e;
  rest.noalias() -= geometry.V.transpose() * phi;
  force = phi;
  force.noalias() += geometry.Sigma.transpose() * rest;
  node_force = force;
  for (std::size_t k = 0; k < body.points.size(); ++k)
    if (const int theta = body.points[k].theta; theta >= 0)
      node_force.segment<3>(theta) = geometry.D[k].transpose() * force.segment<3>(theta);
}

double SuperelementMotion::kinetic_energy(const SuperelementMatrices& body) const {
  const Vector3 Om_0 = nu.tail<3>();
  double energy = 0.5 * s.dot(s_products.tail(s.size())) + s.dot(Geps * Om_0);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) energy += 0.5 * Om_0[k] * Om_0[l] * coordinates.eps().dot(Heps.col(pair_index(k, l)));
  return body.stiffened_by_spin() ? energy - 0.5 * Om_mean.dot(kappa * Om_mean) : energy;
}

}  // namespace bielle::mechanism
