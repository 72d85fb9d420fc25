#include "mechanism/solvers/statics/static_tangent.hpp"

#include <array>
#include <cmath>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

const TangentWeights tangent_at_rest{1, 0, 0, 0, 1, true};
constexpr double indifference = 1e-9;  // e

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
  if (linear_.try_factor(state, environment, tangent_at_rest, nullptr) && !linear_.nearly_singular()) return;
  held_ = indifference * mean_stiffness(system_, linear_, state);
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
  const bool singular = !linear.try_factor(state, environment, weights, nullptr);
  if (!singular && !linear.nearly_singular()) return {};
  const int without_pivot = singular ? linear.singular_unknown() : -1;
  // The unknown without a pivot may be one that is held, because elimination in another order finds it elsewhere. The
  // motion is therefore found by inverse iteration with K + e D, which lengthens indifferent motions by 1/e and others
  // by about D/K; the constraints are satisfied.
  const VectorX D = mean_stiffness(system, linear, state), held = indifference * D;
  linear.choose_pivots_anew();
  if (!linear.try_factor(state, environment, weights, nullptr, &held))
    return without_pivot >= 0 ? system.unknown_name(without_pivot) : "an unknown";
  constexpr int iterations = 3;
  VectorX load = VectorX::Zero(system.size()), motion = VectorX::Zero(system.size());
  motion.head(system.dofs()).setLinSpaced(1, 2);
  for (int k = 0; k < iterations; ++k) {
    load.head(system.dofs()) = D.cwiseProduct(motion.head(system.dofs())) / motion.head(system.dofs()).norm();
    linear.solve(load, motion);
  }
  return moves_most(system, motion, state);
}

}  // namespace bielle::mechanism
