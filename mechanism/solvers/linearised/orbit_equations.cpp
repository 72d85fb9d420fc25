#include "mechanism/solvers/linearised/orbit_equations.hpp"

#include <cmath>
#include <numbers>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

using Sparse = LinearisedEquations::Sparse;

OrbitEquations::OrbitEquations(const System& system, const Environment& environment, const TurningPart& part,
                               std::vector<Azimuth> mean)
    : system_(system), environment_(environment), part_(part), mean_(std::move(mean)) {
  VectorX r(system.size());
  for (const Azimuth& each : mean_) {
    system.residual(each.state, environment, r);
    VectorX& drives = drives_.emplace_back(VectorX::Zero(constraints()));
    for (int k = 0; k < constraints(); ++k)
      if (const int row = each.equations.multiplier[static_cast<std::size_t>(k)]; part.drives_joint(row))
        drives[k] = r[system.size() - system.multipliers() + row];
  }
}

double OrbitEquations::azimuth(int k) const { return 2 * std::numbers::pi * k / count(); }

State OrbitEquations::state(int k, const PeriodicDeviation& deviation) const {
  const State& from = mean(k).state;
  const Sparse &turned = mean(k).axes, &W = mean_.front().equations.W;
  const double psi = azimuth(k);
  const VectorX q = deviation.at(psi), rate = deviation.rate_at(psi), acceleration = deviation.acceleration_at(psi);
  const VectorX displaced = turned * q, velocity = turned * (rate + W * q),
                second = turned * (acceleration + W * (2 * rate + W * q));
  const int dofs = system_.dofs();
  State state = from;
  system_.displace(state, from, displaced.head(dofs));
  state.first_order = from.first_order + q.tail(system_.first_orders());
  State moving = state;
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    const NodeFreedom& freedom = system_.kinematics().freedom(static_cast<int>(i));
    if (freedom.count == 0 || system_.kinematics().carry(static_cast<int>(i))) continue;
    const NodeState& mean_node = from.nodes[i];
    NodeState& node = moving.nodes[i];
    const int translations = freedom.count - freedom.rotations, first = freedom.begin + translations;
    const auto G = freedom.G.topLeftCorner(3, translations);
    const auto axes = freedom.G.block(3, translations, 3, freedom.rotations);
    node.v = mean_node.v + G * velocity.segment(freedom.begin, translations);
    node.a = mean_node.a + G * second.segment(freedom.begin, translations);
    const Vector3 Theta = axes * q.segment(first, freedom.rotations),
                  Theta_rate = axes * rate.segment(first, freedom.rotations),
                  Theta_second = axes * acceleration.segment(first, freedom.rotations);
    const Matrix3 T = tangent(Theta);
    const Vector3 of_mean = exp_so3(Vector3(-Theta)) * mean_node.Omega, relative = T * Theta_rate;
    node.Omega = of_mean + relative;
    node.Omegadot = T * Theta_second + tangent_derivative(Theta, Theta_rate) * Theta_rate - relative.cross(of_mean);
  }
  const auto amplitudes = state.amplitude.size();
  moving.amplitude_rate = rate.segment(dofs - amplitudes, amplitudes);
  moving.amplitude_acceleration = acceleration.segment(dofs - amplitudes, amplitudes);
  VectorX v(dofs), a(dofs);
  system_.get_rates(moving, v, a);
  system_.set_rates(state, v, a);
  state.first_order_rate = rate.tail(system_.first_orders());
  const VectorX forces = mean(k).rows.transpose() * deviation.multipliers_at(psi);
  for (int j = 0; j < constraints(); ++j)
    state.multiplier[mean(k).equations.multiplier[static_cast<std::size_t>(j)]] += forces[j];
  return state;
}

/// Returns the increments of the unknowns for unit increments in the axes of the mean motion.
Sparse OrbitEquations::axes(int k, const VectorX& q) const {
  Sparse back(q.size(), q.size());
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<char> done(static_cast<std::size_t>(q.size()), 0);
  for (int node = 0; node < static_cast<int>(mean(k).state.nodes.size()); ++node) {
    const NodeFreedom& freedom = system_.kinematics().freedom(node);
    if (freedom.rotations != 3 || system_.kinematics().carry(node)) continue;
    const int first = freedom.begin + freedom.count - 3;
    const Matrix3 turned = exp_so3(Vector3(-q.segment<3>(first)));
    for (int j = 0; j < 3; ++j) {
      done[static_cast<std::size_t>(first + j)] = 1;
      for (int i = 0; i < 3; ++i) entries.emplace_back(first + i, first + j, turned(i, j));
    }
  }
  for (int i = 0; i < static_cast<int>(q.size()); ++i)
    if (done[static_cast<std::size_t>(i)] == 0) entries.emplace_back(i, i, 1);
  back.setFromTriplets(entries.begin(), entries.end());
  return Sparse(mean(k).axes * back);
}

VectorX OrbitEquations::in_mean_axes(int k, const Sparse& axes, const VectorX& r) const {
  const int n = unknowns(), m = constraints();
  VectorX gaps(m);
  for (int j = 0; j < m; ++j) {
    const int row = mean(k).equations.multiplier[static_cast<std::size_t>(j)];
    gaps[j] = r[n + row];
    if (!part_.drives_joint(row)) continue;
    gaps[j] -= drives_[static_cast<std::size_t>(k)][j];
    // The two angles may differ by whole turns.
    if (system_.equation_units(n + row) == "rad") gaps[j] = std::remainder(gaps[j], 2 * std::numbers::pi);
  }
  VectorX result(n + m);
  result << axes.transpose() * r.head(n), mean(k).rows * gaps;
  return result;
}

VectorX OrbitEquations::residual(int k, const PeriodicDeviation& deviation, ResidualScale* scale) const {
  VectorX r(system_.size());
  system_.residual(state(k, deviation), environment_, r, scale);
  return in_mean_axes(k, axes(k, deviation.at(azimuth(k))), r);
}

VectorX OrbitEquations::rates(int k, const PeriodicDeviation& deviation) const {
  const State here = state(k, deviation);
  VectorX v(system_.dofs()), unused(system_.dofs()), rates(unknowns());
  system_.get_rates(here, v, unused);
  rates << v, here.first_order_rate;
  return axes(k, deviation.at(azimuth(k))).transpose() * rates;
}

Azimuth OrbitEquations::linearised(int k, const PeriodicDeviation& deviation) const {
  State here = state(k, deviation);
  const Sparse A = axes(k, deviation.at(azimuth(k))), &rows = mean(k).rows;
  VectorX r(system_.size());
  system_.residual(here, environment_, r);
  LinearisedEquations e =
      linearised_equations(system_, here, ModeAxes::inertial, linearise(system_, environment_, here), r);
  e.W = mean_.front().equations.W;
  e.M = Sparse(A.transpose() * e.M * A);
  e.C = Sparse(A.transpose() * e.C * A) + Sparse(e.M * e.W);
  e.K = Sparse(A.transpose() * e.K * A);
  e.B = Sparse(rows * e.B * A);
  e.S = Sparse(rows * e.S * A);
  e.F = Sparse(A.transpose() * e.F * rows.transpose());
  return {std::move(here), std::move(e), A, rows};
}

}  // namespace bielle::mechanism
