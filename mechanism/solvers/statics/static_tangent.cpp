#include "mechanism/solvers/statics/static_tangent.hpp"

#include <array>
#include <cmath>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

const TangentWeights tangent_at_rest{1, 0, 0, 0, 1, true};

/// Returns the mean stiffness of each kind of unknown (dofs); a kind without stiffness takes that of the others by the
/// model's length.
VectorX mean_stiffness(const System& system, const NewtonMatrix& linear, const State& state) {
  std::array<double, kind_count> sum{}, count{};
  for (int i = 0; i < system.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system.kind(i));
    sum[kind] += std::abs(linear.diagonal(i));
    count[kind] += 1;
  }
  const auto mean = [&](Kind kind) {
    const auto k = static_cast<std::size_t>(kind);
    return count[k] > 0 ? sum[k] / count[k] : 0.0;
  };
  const double length = model_extent(state) > 0 ? model_extent(state) : 1;
  double translation = mean(Kind::translation);
  if (!(translation > 0)) translation = mean(Kind::rotation) / (length * length);
  if (!(translation > 0)) translation = linear.scale();
  VectorX result(system.dofs());
  for (int i = 0; i < system.dofs(); ++i) {
    const double own = mean(system.kind(i));
    result[i] = own > 0 ? own : system.kind(i) == Kind::rotation ? translation * length * length : translation;
  }
  return result;
}

}  // namespace

void StaticTangent::look_for_loose(const State& state, const Environment& environment) {
  constexpr double e = 1e-9;
  if (linear_.try_factor(state, environment, tangent_at_rest, nullptr) && !linear_.nearly_singular()) return;
  held_ = e * mean_stiffness(system_, linear_, state);
}

void StaticTangent::factor(const State& state, const Environment& environment, double inertia, const VectorX* dq) {
  TangentWeights weights = tangent_at_rest;
  weights.mass = inertia;
  if (!linear_.try_factor(state, environment, weights, dq, held())) linear_.throw_singular(state.time);
}

bool StaticTangent::try_factor(const State& state, const Environment& environment) {
  return linear_.try_factor(state, environment, tangent_at_rest, nullptr, held());
}

bool StaticTangent::runs_loose(const VectorX& delta) const {
  constexpr double most = 0.5;
  if (!held()) return false;
  const Eigen::Index n = held_.size();
  VectorX load = VectorX::Zero(system_.size()), loose(system_.size());
  load.head(n) = -held_.cwiseProduct(delta.head(n));
  linear_.solve(load, loose);
  const double all = std::sqrt(held_.dot(delta.head(n).cwiseAbs2()));
  return !(std::sqrt(held_.dot(loose.head(n).cwiseAbs2())) <= most * all);
}

std::string moves_most(const System& system, const VectorX& motion, const State& state) {
  const double length = model_extent(state) > 0 ? model_extent(state) : 1;
  int most = 0;
  double largest = -1;
  for (int i = 0; i < system.dofs(); ++i) {
    const double size = std::abs(motion[i]) / (system.kind(i) == Kind::translation ? length : 1);
    if (size <= largest) continue;
    largest = size;
    most = i;
  }
  return system.unknown_name(most);
}

std::string loose_unknown(const System& system, const Environment& environment, const State& state) {
  NewtonMatrix linear(system);
  TangentWeights weights;
  weights.acceleration_level = true;
  if (!linear.try_factor(state, environment, weights, nullptr))
    return linear.singular_unknown() >= 0 ? system.unknown_name(linear.singular_unknown()) : "an unknown";
  if (!linear.nearly_singular()) return {};
  // A solution for arbitrary forces is along indifferent motions.
  VectorX motion(system.size());
  linear.solve(VectorX::LinSpaced(system.size(), 1, 2), motion);
  return moves_most(system, motion, state);
}

}  // namespace bielle::mechanism
