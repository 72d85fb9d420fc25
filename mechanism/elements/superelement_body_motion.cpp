#include "mechanism/elements/superelement_body_motion.hpp"

#include <Eigen/Geometry>

namespace bielle::mechanism {

Vector3 load_direction(const ActingLoad& load, const Matrix3& R_0, int k) {
  return load.follows ? Vector3(Vector3::Unit(k)) : Vector3(R_0.row(k).transpose());
}

void SuperelementMotion::set_motion(const CorotatedFrame& body_frame, const LocalState& state) {
  body_frame.solve(state, geometry);
  const auto& points = body_frame.points();
  const Eigen::Index n = geometry.q.size(), modes = state.slots().amplitudes;
  const Matrix3 R_0t = geometry.frame.R.transpose();
  for (VectorX* vector : {&w, &w_rel, &a, &a_rel, &q_rate, &q_acceleration}) vector->resize(n);

  // q_rate and q_acceleration first hold D w and b.
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

void SuperelementMotion::set_forces(const SuperelementMatrices& body,
                                    const Eigen::Ref<const VectorX>& interface_force) {
  const VectorX& q = geometry.q;
  const Eigen::Index n = q.size();
  const Vector3 v_0 = nu.head<3>(), Om_0 = nu.tail<3>(), Om_rate = nu_rate.tail<3>();
  s = q_rate;
  s.noalias() += body.U * nu;
  s_rate = q_acceleration;
  s_rate.noalias() += body.U * nu_rate;

  for (MatrixX3* products : {&Gq, &Gs, &Gq_rate}) products->resize(n, 3);
  Hq.resize(n, 6);
  for (int k = 0; k < 3; ++k) {
    const MatrixX& G = body.G[static_cast<std::size_t>(k)];
    Gq.col(k).noalias() = G * q;
    Gs.col(k).noalias() = G * s;
    Gq_rate.col(k).noalias() = G * q_rate;
  }
  for (int i = 0; i < 6; ++i) Hq.col(i).noalias() = body.H[static_cast<std::size_t>(i)] * q;

  p.noalias() = body.M * s;
  p.noalias() += Gq * Om_0;
  p_rate.noalias() = body.M * s_rate;
  p_rate.noalias() += Gq * Om_rate;
  p_rate.noalias() += Gq_rate * Om_0;
  pi.noalias() = body.U.transpose() * p;
  pi_rate.noalias() = body.U.transpose() * p_rate;

  set_stiffness(body, interface_force);
  elastic_force.noalias() = stiffness * q;
  r = p_rate + elastic_force;
  r.noalias() += Gs * Om_0;
  r.noalias() += body.C * q_rate;
  for (int k = 0; k < 3; ++k) {
    double moment = s.dot(Gq.col(k));
    double moment_rate = s_rate.dot(Gq.col(k)) + s.dot(Gq_rate.col(k));
    for (int l = 0; l < 3; ++l) {
      const auto Hq_kl = Hq.col(pair_index(k, l));
      r -= (Om_0[k] * Om_0[l]) * Hq_kl;
      const double qHq = q.dot(Hq_kl);
      moment += Om_0[l] * qHq;
      moment_rate += Om_rate[l] * qHq + 2 * Om_0[l] * q_rate.dot(Hq_kl);
    }
    pi[3 + k] += moment;
    pi_rate[3 + k] += moment_rate;
  }

  load.setZero(n);
  rigid_load.setZero();
  for (const ActingLoad& acting : loads)
    for (int k = 0; k < 3; ++k) {
      const Vector3 direction = load_direction(acting, geometry.frame.R, k);
      const auto component = acting.pattern->middleCols<3>(3 * k);
      load.noalias() += component * (acting.factor * direction);
      const Vector3 displaced = component.transpose() * q;
      rigid_load.tail<3>() += acting.factor * displaced.cross(direction);
    }
  rigid_load.noalias() += body.U.transpose() * load;
  r -= load;

  e = pi_rate - rigid_load;
  e.head<3>() += Om_0.cross(pi.head<3>());
  e.tail<3>() += Om_0.cross(pi.tail<3>()) + v_0.cross(pi.head<3>());

  Vector6 rest = e;
  rest.noalias() -= geometry.V.transpose() * r;
  force = r;
  force.noalias() += geometry.Sigma.transpose() * rest;
  node_force = force;
  for (std::size_t k = 0; k < body.points.size(); ++k)
    if (const int theta = body.points[k].theta; theta >= 0)
      node_force.segment<3>(theta) = geometry.D[k].transpose() * force.segment<3>(theta);
}

void SuperelementMotion::set_stiffness(const SuperelementMatrices& body,
                                       const Eigen::Ref<const VectorX>& interface_force) {
  if (stiffness.size() > 0 && weights_ == interface_force) return;
  stiffness = body.K;
  weights_ = interface_force;
  for (std::size_t j = 0; j < body.load_stiffness.size(); ++j)
    stiffness += weights_[static_cast<Eigen::Index>(j)] * body.load_stiffness[j];
}

double SuperelementMotion::kinetic_energy(const SuperelementMatrices& body) const {
  const Vector3 Om_0 = nu.tail<3>();
  double energy = 0.5 * s.dot(body.M * s) + s.dot(Gq * Om_0);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) energy += 0.5 * Om_0[k] * Om_0[l] * geometry.q.dot(Hq.col(pair_index(k, l)));
  return energy;
}

}  // namespace bielle::mechanism
