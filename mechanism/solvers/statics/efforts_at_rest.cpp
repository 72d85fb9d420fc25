#include "mechanism/solvers/statics/efforts_at_rest.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {

void EffortsAtRest::add_forces(const Environment& environment, const State& state, Eigen::Ref<VectorX> /*r*/) {
  environment_ = environment;  // the residual includes the efforts, which are part of the state
  environment_.before = nullptr;
  state_ = state;
  MatrixX reactions = efforts_.reactions(environment_, state_);
  if (push_.size() > 0) reactions += push_;
  gap_ = efforts_.along(state_, reactions);
}

bool EffortsAtRest::reached(const ResidualScale& scale) {
  if (floor_.size() == 0) return false;
  const VectorX beyond = (gap_.cwiseAbs() - floor_).cwiseMax(0);
  const double ratio = efforts_.ratio(beyond, scale), before = before_;
  before_ = ratio;
  return ratio <= SoughtEfforts::accurate || (ratio <= SoughtEfforts::rounding && ratio > 0.5 * before);
}

/// Returns the response to displacements of all unknowns by their rounding errors, with arbitrary signs.
VectorX EffortsAtRest::rounding_floor() const {
  constexpr double several = 40 * std::numeric_limits<double>::epsilon();
  const System& system = efforts_.system();
  const double length = model_length(state_);
  VectorX step = VectorX::Zero(system.size());
  unsigned pseudo_random = 1;
  for (int i = 0; i < system.dofs(); ++i) {
    pseudo_random = 1664525U * pseudo_random + 1013904223U;
    const double size = system.kind(i) == Kind::translation ? length : system.kind(i) == Kind::rotation ? 1 : 0;
    step[i] = (pseudo_random >> 31) != 0 ? size : -size;
  }
  return several * answer(efforts_, environment_, state_, step).cwiseAbs();
}

VectorX EffortsAtRest::answer(const SoughtEfforts& efforts, const Environment& environment, const State& state,
                              const VectorX& step) {
  constexpr double way = 1e-6;  // relative to the extent, or [rad]: small, and so are its square and relative rounding
  constexpr double most = 1e9;  // factor on the step if only forces change
  const System& system = efforts.system();
  const double length = std::max(model_extent(state), 1e-30);
  double size = 0;
  for (int i = 0; i < system.dofs(); ++i)
    size = std::max(size, std::abs(step[i]) / (system.kind(i) == Kind::translation ? length : 1));
  const double part = size > way / most ? way / size : size > 0 ? most : 1;
  const auto forces_after = [&](double by) {
    State moved = state;
    system.displace(moved, state, by * step.head(system.dofs()));
    moved.multiplier += by * step.tail(system.multipliers());
    return efforts.along(moved, efforts.reactions(environment, moved));
  };
  return (forces_after(part) - forces_after(-part)) / (2 * part);
}

EffortResponse EffortsAtRest::response(const SoughtEfforts& efforts, const Environment& environment, const State& state,
                                       const StaticTangent& tangent) {
  EffortResponse response;
  response.linearise(
      efforts, environment, state, [&](const VectorX& r, VectorX& step) { tangent.solve(r, step); },
      [&](const VectorX& step) { return answer(efforts, environment, state, step); });
  return response;
}

void EffortsAtRest::solve(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) {
  tangent.solve(r, delta);
  response_ = response(efforts_, environment_, state_, tangent);
  change_ = response_.change(gap_ + answer(efforts_, environment_, state_, delta));
  floor_ = rounding_floor();
  base_ = efforts_.values(state_);
  delta += response_.step(change_);
}

void EffortsAtRest::move(State& state, double part) { efforts_.set(state, base_ + part * change_); }

void EffortsAtRest::solve_along(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r,
                                Eigen::Ref<VectorX> delta) const {
  tangent.solve(r, delta);
  delta += response_.step(response_.change(answer(efforts_, environment_, state_, delta)));
}

}  // namespace bielle::mechanism
