// Efforts (forces and torques along coordinates of joints) that are sought such that supports of nodes give nothing
// along the motion that they prescribe: the efforts bring the motion about.
//
// The supports' forces s_j, j the moved directions, depend on the efforts u_k directly and through what answers to
// them. About a state whose other unknowns x have the equations r(x, u) = 0, with J = dr/dx factorised,
//     S = ds/du - ds/dx J^-1 dr/du,     du = -S^-1 s,
// which of rigid parts is the principle of virtual power, S_jk = -d(coordinate k)/d(direction j), and exact. There are
// as many efforts as directions. S is singular where the efforts do not move the directions independently.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/model/sought_effort.hpp"
#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Throws where a model seeks efforts, which the analysis does not. @param analysis  "a static analysis"
void refuse_sought_efforts(const Model& model, const char* analysis);

class SoughtEfforts {
 public:
  /// @throws InputError when there are not as many efforts as directions of motion
  explicit SoughtEfforts(const System& system);

  const System& system() const { return system_; }
  bool any() const { return !efforts_.empty(); }
  Eigen::Index count() const { return static_cast<Eigen::Index>(efforts_.size()); }
  VectorX values(const State& state) const;
  void set(State& state, const VectorX& values) const;

  /// Force and moment of each moved node's support (6, nodes), inertial components.
  MatrixX reactions(const Environment& environment, const State& state) const;
  /// Their parts along the moved directions at a state's time (count).
  VectorX along(const State& state, const MatrixX& reactions) const;
  /// Derivatives of the residual by the efforts (size, count).
  MatrixX columns(const Environment& environment, const State& state) const;
  /// dr/du at rest alone: derivatives of the supports' forces by the efforts, all else as it is (count, count).
  MatrixX direct(const Environment& environment, const State& state) const;

  const std::vector<int>& nodes() const { return nodes_; }  ///< whose supports are to give nothing
  /// The largest of the supports' forces over the forces of its kind in a residual. Equations of them are satisfied
  /// where that is `accurate`, or where Newton's method comes no nearer and it is `rounding`.
  double ratio(const VectorX& forces, const ResidualScale& scale) const;
  static constexpr double accurate = 1e-11, rounding = 1e-8;
  /// Throws where S is singular, naming what does not move. @returns S^-1
  MatrixX inverse_of(const MatrixX& S, const State& state) const;

 private:
  struct Effort {
    std::size_t memory;  ///< among the state's
    SoughtEffort::Sought sought;
  };
  struct Direction {
    std::size_t node;  ///< among nodes_
    int axis;          ///< x y z rx ry rz
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
  std::vector<Holder> holders_;  ///< of each node; nullptr: nothing acts there
  std::vector<Direction> directions_;
  mutable ReadReactions read_;
};

/// How supports answer to the efforts about a state.
class EffortResponse {
 public:
  using Solve = std::function<void(const VectorX& r, VectorX& step)>;  ///< step = -J^-1 r (size)
  using Answer = std::function<VectorX(const VectorX& step)>;          ///< ds/dx step (count)
  void linearise(const SoughtEfforts& efforts, const Environment& environment, const State& state, const Solve& solve,
                 const Answer& answer);
  /// The change of the efforts that takes away forces of the supports. @param forces  (count)
  VectorX change(const VectorX& forces) const { return -(inverse_ * forces); }
  /// The change of the other unknowns by it (size).
  VectorX step(const VectorX& change) const { return Z_ * change; }

 private:
  MatrixX Z_, inverse_;
};

}  // namespace bielle::mechanism
