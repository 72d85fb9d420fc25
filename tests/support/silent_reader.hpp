// A component that refers to another and adds only zeros: the equations do not change, but their unknowns are coupled.
#pragma once

#include <string>
#include <utility>

#include "mechanism/model/component.hpp"

namespace bielle::test {

class SilentReader : public mechanism::Component {
 public:
  /// @param passive  set if it takes no part in the equations, like a measure
  SilentReader(std::string name, const mechanism::Component& other, bool passive = false)
      : Component("silent_reader", std::move(name)), other_(other), passive_(passive) {}
  void declare(mechanism::Declaration& declaration) const override {
    declaration.references = {&other_};
    declaration.stiffness = true;
    declaration.passive = passive_;
  }
  void add_residual(const mechanism::LocalState&, Eigen::Ref<mechanism::VectorX>) const override {}
  void add_tangent(const mechanism::LocalState&, mechanism::LocalTangent&) const override {}

 private:
  const mechanism::Component& other_;
  bool passive_;
};

}  // namespace bielle::test
