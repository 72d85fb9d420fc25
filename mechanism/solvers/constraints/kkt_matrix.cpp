#include "mechanism/solvers/constraints/kkt_matrix.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {

VectorX small_diagonal(const System& system, const NewtonMatrix& linear, const State& state, double fraction) {
  std::array<double, kind_count> mean{}, count{};
  for (int i = 0; i < system.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system.kind(i));
    mean[kind] += std::abs(linear.diagonal(i));
    count[kind] += 1;
  }
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (count[kind] > 0) mean[kind] /= count[kind];
  double &translation = mean[static_cast<std::size_t>(Kind::translation)],
         &rotation = mean[static_cast<std::size_t>(Kind::rotation)];
  const double area = model_length(state) * model_length(state);
  if (translation == 0) translation = rotation > 0 ? rotation / area : 1;
  if (rotation == 0) rotation = translation * area;
  VectorX diagonal(system.dofs());
  for (int i = 0; i < system.dofs(); ++i) {
    const double own = mean[static_cast<std::size_t>(system.kind(i))];
    diagonal[i] = fraction * (own > 0 ? own : 1.0);
  }
  return diagonal;
}

void throw_massless(const std::string& what, const char* lack) {
  const bool turns = what.rfind("rotation", 0) == 0;
  throw ComputationError(fmt::format(
      "{}: it has no mass, and nothing holds it; hold it (`fixed`), join it, or give it a body with {}{}", what, lack,
      turns ? " (a rod between two spherical joints turns about itself: a `universal` joint in place of one "
              "holds it, or the rod is a `spherical_spherical` joint)"
            : ""));
}

void KktMatrix::factor(const Environment& environment, const State& state) {
  serves_ = false;
  const TangentWeights weights{0, 0, 1, 1, 1, true};
  const auto regular = [&](const VectorX* extra) {
    return linear_.try_factor(state, environment, weights, nullptr, extra) && !linear_.nearly_singular();
  };
  serves_ = true;
  floor_ = VectorX::Zero(system_.dofs());
  if (regular(nullptr)) return;
  serves_ = false;
  // Any small mass gives the same multipliers up to its own size. The existing masses are unchanged, if that is
  // sufficient.
  constexpr double floor = 1e-12;
  const VectorX everywhere = small_diagonal(system_, linear_, state, floor);
  floor_ = everywhere;
  for (int i = 0; i < system_.dofs(); ++i)
    if (linear_.diagonal(i) > 0) floor_[i] = 0;
  // A dof without mass, stiffness, damping and constraint has no equation.
  linear_.try_factor(state, environment, TangentWeights{1, 1, 1, 1, 1}, nullptr);
  VectorX sums(system_.size());
  linear_.row_sums(VectorX::Ones(system_.size()), sums);
  for (int i = 0; i < system_.dofs(); ++i)
    if (sums[i] == 0) throw_massless(system_.unknown_name(i), system_.kind(i) == Kind::rotation ? "inertia" : "mass");
  if (!linear_.try_factor(state, environment, weights, nullptr, &floor_)) {
    floor_ = everywhere;
    if (!linear_.try_factor(state, environment, weights, nullptr, &everywhere)) linear_.throw_singular(state.time);
  }
  serves_ = true;
}

bool KktMatrix::factor_with_reactions(const Environment& environment, const State& state) {
  serves_ = false;
  TangentWeights weights{0, 0, 1, 1, 1, true};
  weights.reactions = true;
  return linear_.try_factor(state, environment, weights, nullptr, &floor_);
}

}  // namespace bielle::mechanism
