#include "mechanism/solvers/constraints/sought_efforts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/direction_words.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {

void refuse_sought_efforts(const Model& model, const char* analysis) {
  for (const Member& member : model.members())
    if (const auto* effort = dynamic_cast<const SoughtEffort*>(member.component.get()))
      throw InputError(
          fmt::format("{} cannot seek {}, which `inverse_dynamics` and `kinematic` do: give drive '{}' a formula or a "
                      "motion",
                      analysis, effort->sought().name, member.component->name()));
}

SoughtEfforts::SoughtEfforts(const System& system) : system_(system), read_(system) {
  const Model& model = system.model();
  bool all = false;
  for (std::size_t m = 0; m < model.members().size(); ++m)
    if (const auto* effort = dynamic_cast<const SoughtEffort*>(model.members()[m].component.get())) {
      SoughtEffort::Sought sought = effort->sought();
      nodes_.insert(nodes_.end(), sought.moves.begin(), sought.moves.end());
      all = all || sought.moves.empty();
      efforts_.push_back({static_cast<std::size_t>(system.slots()[m].memory_begin + sought.place), std::move(sought)});
    }
  if (!any()) return;
  if (all) {
    nodes_.clear();
    for (int i = 0; i < static_cast<int>(model.nodes().size()); ++i) nodes_.push_back(i);
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  find_directions();
}

/// Finds the prescribed directions of the nodes, and the supports that compute their forces.
void SoughtEfforts::find_directions() {
  const Model& model = system_.model();
  const auto is_moved = [&](int node) {
    const auto& freedom = model.node(node).freedom;
    return std::find(freedom.begin(), freedom.end(), Freedom::prescribed) != freedom.end();
  };
  std::erase_if(nodes_, [&](int node) { return !is_moved(node); });
  std::vector<std::string> names;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    for (int axis = 0; axis < 6; ++axis)
      if (model.node(nodes_[k]).freedom[static_cast<std::size_t>(axis)] == Freedom::prescribed) {
        directions_.push_back({k, axis});
        names.push_back(name_of(directions_.back()));
      }
  if (directions_.size() != efforts_.size())
    throw InputError(
        fmt::format("{} sought, and {} prescribed by the `motion` of nodes{}{}: inverse dynamics needs equal numbers "
                    "of both (`moves` of a drive names the nodes that are meant, `fixed` holds a direction)",
                    counted(static_cast<int>(efforts_.size()), "effort is", "efforts are"),
                    counted(static_cast<int>(directions_.size()), "direction is", "directions are"),
                    names.empty() ? "" : ": ", fmt::join(names, ", ")));
  holders_.assign(nodes_.size(), {nullptr, 0});
  for (std::size_t m = 0; m < model.members().size(); ++m)
    if (const auto* support = dynamic_cast<const NodeSupport*>(model.members()[m].component.get()))
      if (const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), support->node());
          found != nodes_.end() && *found == support->node())
        holders_[static_cast<std::size_t>(found - nodes_.begin())] = {support, m};
}

std::string SoughtEfforts::name_of(const Direction& direction) const {
  return fmt::format("{} of node '{}'", direction_words[direction.axis],
                     system_.model().node(nodes_[direction.node]).name);
}

VectorX SoughtEfforts::values(const State& state) const {
  VectorX values(count());
  for (Eigen::Index k = 0; k < count(); ++k)
    values[k] = state.memory[static_cast<Eigen::Index>(efforts_[static_cast<std::size_t>(k)].memory)];
  return values;
}

void SoughtEfforts::set(State& state, const VectorX& values) const {
  for (Eigen::Index k = 0; k < count(); ++k)
    state.memory[static_cast<Eigen::Index>(efforts_[static_cast<std::size_t>(k)].memory)] = values[k];
}

MatrixX SoughtEfforts::reactions(const Environment& environment, const State& state) const {
  MatrixX all = MatrixX::Zero(6, static_cast<Eigen::Index>(nodes_.size()));
  State balanced = state;
  read_.balance(environment, balanced);
  for (std::size_t k = 0; k < holders_.size(); ++k)
    if (holders_[k].support)
      all.col(static_cast<Eigen::Index>(k)) =
          holders_[k].support->reaction(LocalState(balanced, system_.slots()[holders_[k].member], environment));
  return all;
}

VectorX SoughtEfforts::along(const State& state, const MatrixX& reactions) const {
  VectorX forces(count());
  for (std::size_t j = 0; j < directions_.size(); ++j) {
    const auto [node, axis] = directions_[j];
    const auto row = static_cast<Eigen::Index>(j), column = static_cast<Eigen::Index>(node);
    if (axis < 3) {
      forces[row] = reactions(axis, column);
      continue;
    }
    // R = exp(psi) R_start rotates by T^T dpsi, inertial components.
    const Node& moved = system_.model().node(nodes_[node]);
    const Vector3 psi = state.motion_factor *
                        Vector3(moved.motion[3](state.time), moved.motion[4](state.time), moved.motion[5](state.time));
    forces[row] = (tangent(psi) * reactions.col(column).tail<3>())[axis - 3];
  }
  return forces;
}

MatrixX SoughtEfforts::columns(const Environment& environment, const State& state) const {
  MatrixX columns(system_.size(), count());
  VectorX with(system_.size()), without(system_.size());
  State moved = state;
  const VectorX none = VectorX::Zero(count());
  set(moved, none);
  system_.residual(moved, environment, without);
  for (Eigen::Index k = 0; k < count(); ++k) {
    set(moved, VectorX::Unit(count(), k));
    system_.residual(moved, environment, with);
    columns.col(k) = with - without;
  }
  return columns;
}

MatrixX SoughtEfforts::direct(const Environment& environment, const State& state) const {
  MatrixX direct(count(), count());
  State moved = state;
  set(moved, VectorX::Zero(count()));
  const VectorX without = along(state, reactions(environment, moved));
  for (Eigen::Index k = 0; k < count(); ++k) {
    set(moved, VectorX::Unit(count(), k));
    direct.col(k) = along(state, reactions(environment, moved)) - without;
  }
  return direct;
}

double SoughtEfforts::ratio(const VectorX& forces, const ResidualScale& scale) const {
  double largest = 0;
  for (std::size_t j = 0; j < directions_.size(); ++j) {
    const double force = std::abs(forces[static_cast<Eigen::Index>(j)]);
    if (force > 0)
      largest = std::max(largest, force / scale[directions_[j].axis < 3 ? Kind::translation : Kind::rotation]);
  }
  return largest;
}

MatrixX SoughtEfforts::inverse_of(const MatrixX& S, const State& state) const {
  constexpr double nothing = 1e-8;  // relative to an arm of the mechanism's size; the differences are exact to 1e-10
  const double length = std::max(model_extent(state), 1e-30);
  MatrixX scaled = S;
  for (Eigen::Index j = 0; j < count(); ++j) {
    if (directions_[static_cast<std::size_t>(j)].axis >= 3) scaled.row(j) /= length;
    if (efforts_[static_cast<std::size_t>(j)].sought.turns) scaled.col(j) *= length;
  }
  const std::string time = fmt::format("t = {:.6g} s: ", state.time);
  for (Eigen::Index k = 0; k < count(); ++k) {
    const Direction& direction = directions_[static_cast<std::size_t>(k)];
    if (!(scaled.col(k).cwiseAbs().maxCoeff() > nothing))
      throw ComputationError(fmt::format("{}{} moves nothing that has a `motion` here: it cannot be sought", time,
                                         efforts_[static_cast<std::size_t>(k)].sought.name));
    if (!(scaled.row(k).cwiseAbs().maxCoeff() > nothing))
      throw ComputationError(fmt::format("{}none of the sought efforts moves {} here", time, name_of(direction)));
  }
  const std::optional<MatrixX> inverse = regular_inverse(scaled);
  if (!inverse || !(inverse->cwiseAbs().maxCoeff() < 1 / nothing)) {
    std::vector<std::string> names;
    for (const Direction& direction : directions_) names.push_back(name_of(direction));
    throw ComputationError(
        fmt::format("{}the sought efforts do not move {} independently of each other (a singular position): other "
                    "joints, or a motion that keeps away from it, would",
                    time, fmt::join(names, ", ")));
  }
  MatrixX result = *inverse;
  for (Eigen::Index j = 0; j < count(); ++j) {
    if (directions_[static_cast<std::size_t>(j)].axis >= 3) result.col(j) /= length;
    if (efforts_[static_cast<std::size_t>(j)].sought.turns) result.row(j) *= length;
  }
  return result;
}

void EffortResponse::linearise(const SoughtEfforts& efforts, const Environment& environment, const State& state,
                               const Solve& solve, const Answer& answer) {
  const MatrixX W = efforts.columns(environment, state);
  Z_.resize(W.rows(), W.cols());
  MatrixX S = efforts.direct(environment, state);
  VectorX step(W.rows());
  for (Eigen::Index k = 0; k < W.cols(); ++k) {
    solve(W.col(k), step);
    Z_.col(k) = step;
    S.col(k) += answer(step);
  }
  inverse_ = efforts.inverse_of(S, state);
}

}  // namespace bielle::mechanism
