// The unknowns x of a control block, and their rates: the term x' of x' - f(x, u, t) = 0. A StateEquation adds the
// function f.
//
// These are two components, because a formula may use any state: f refers to the unknowns of other blocks, which have
// no references, so that blocks may be coupled in a circle.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class StateUnknowns final : public Component {
 public:
  /// @param type    name of the type for the user: "filter" @param names  names of the unknowns, for messages: "value",
  ///                "x2"
  /// @param start   start value of each unknown @param units  units of all unknowns @param scale  their typical size,
  /// in their units
  StateUnknowns(std::string type, std::string name, std::vector<std::string> names, VectorX start, std::string units,
                double scale);
  Eigen::Index size() const { return start_.size(); }
  const VectorX& start() const { return start_; }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;

 private:
  std::vector<std::string> names_;
  VectorX start_;
  std::string units_;
  double scale_;
};

}  // namespace bielle::mechanism
