// Efforts (forces and torques along coordinates of joints) are determined such that the supports of nodes have no
// reaction along the motions that they prescribe: the efforts then cause the motion.
//
// The supports' forces s_j, where j counts the prescribed directions, depend on the efforts u_k directly and through
// the other unknowns. At a state whose other unknowns x have the equations r(x, u) = 0, with J = dr/dx factorised,
//     S = ds/du - ds/dx J^-1 dr/du,     du = -S^-1 s,
// For rigid parts this is the principle of virtual power, S_jk = -d(coordinate k)/d(direction j), and exact. The number
// of efforts equals the number of directions. S is singular if the efforts do not move the directions independently.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/model/sought_effort.hpp"
#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Throws if a model has sought efforts, for an analysis that does not support them. @param analysis  "a static
/// analysis"
void refuse_sought_efforts(const Model& model, const char* analysis);

class SoughtEfforts {
 public:
  /// @throws InputError if the number of efforts differs from the number of directions of motion
  explicit SoughtEfforts(const System& system);

  const System& system() const { return system_; }
  bool any() const { return !efforts_.empty(); }
  Eigen::Index count() const { return static_cast<Eigen::Index>(efforts_.size()); }
  VectorX values(const State& state) const;
  void set(State& state, const VectorX& values) const;

  /// Force and moment of each moved node's support (6, nodes), in inertial components.
  MatrixX reactions(const Environment& environment, const State& state) const;
  /// Components of the reactions along the moved directions at a state's time (count).
  VectorX along(const State& state, const MatrixX& reactions) const;
  /// Derivatives of the residual by the efforts (size, count).
  MatrixX columns(const Environment& environment, const State& state) const;
  /// Direct derivatives of the supports' forces by the efforts at rest, with all other unknowns fixed (count, count).
  MatrixX direct(const Environment& environment, const State& state) const;

  const std::vector<int>& nodes() const { return nodes_; }  ///< their supports must have no reaction
  /// Ratio of the largest of the supports' forces to the forces of its kind in a residual. The equations are satisfied
  /// if the ratio is below `accurate`, or if Newton's method does not improve it and it is below `rounding`.
  double ratio(const VectorX& forces, const ResidualScale& scale) const;
  static constexpr double accurate = 1e-11, rounding = 1e-8;
  /// Throws if S is singular, naming the motion that the efforts do not affect. @returns S^-1
  MatrixX inverse_of(const MatrixX& S, const State& state) const;

 private:
  struct Effort {
    std::size_t memory;  ///< index in the state's memory
    SoughtEffort::Sought sought;
  };
  struct Direction {
    std::size_t node;  ///< index in nodes_
    int axis;          ///< axis: x y z rx ry rz
  };
  void find_directions();
  std::string name_of(const Direction& direction) const;
  const System& system_;
  std::vector<Effort> efforts_;
  std::vector<int> nodes_;
  struct Holder {
    const NodeSupport* support;
    std::size_t member;
  };
  std::vector<Holder> holders_;  ///< supports of each node; nullptr: no force acts there
  std::vector<Direction> directions_;
  mutable ReadReactions read_;
};

/// Response of the supports to the efforts at a state.
class EffortResponse {
 public:
  using Solve = std::function<void(const VectorX& r, VectorX& step)>;  ///< step = -J^-1 r (size)
  using Answer = std::function<VectorX(const VectorX& step)>;          ///< ds/dx step (count)
  void linearise(const SoughtEfforts& efforts, const Environment& environment, const State& state, const Solve& solve,
                 const Answer& answer);
  /// Returns the change of the efforts that removes given forces of the supports. @param forces  (count)
  VectorX change(const VectorX& forces) const { return -(inverse_ * forces); }
  /// Returns the change of the other unknowns due to it (size).
  VectorX step(const VectorX& change) const { return Z_ * change; }

 private:
  MatrixX Z_, inverse_;
};

}  // namespace bielle::mechanism
