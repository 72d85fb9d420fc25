// A drive whose force or torque is determined by inverse dynamics: `torque: sought`, `force: sought`.
//
// It acts on the coordinate like a force drive. Its value u is stored in its memory, where the solver sets it
// (solvers/constraints/sought_efforts.hpp) such that the supports of nodes have no reaction along the `motion` that
// they prescribe.
#pragma once

#include "mechanism/joints/actions/drive.hpp"
#include "mechanism/model/sought_effort.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

class SoughtDrive final : public Drive, public SoughtEffort {
 public:
  /// @param moves  nodes that it moves instead of their supports; if empty, all nodes that have a `motion`
  SoughtDrive(std::string name, const Joint& joint, std::size_t coordinate, std::vector<int> moves)
      : Drive(std::move(name), joint, coordinate), moves_(std::move(moves)) {}
  void declare(Declaration& declaration) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  std::unique_ptr<StepRecorder> make_step_recorder() const override;
  Sought sought() const override;
  double force(const LocalState& state) const override { return state.memory()[own_memory()]; }

 private:
  void add_kinks(std::vector<double>& /*times*/) const override {}
  LawText law_text() const override;
  std::vector<int> moves_;
};

}  // namespace bielle::mechanism
