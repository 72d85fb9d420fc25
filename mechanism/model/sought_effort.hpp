// Forces and torques that an analysis determines, and the supports that they replace: the interface for solvers.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

/// A force or torque whose value is stored in the component's memory and set by solvers: the component adds it to the
/// equations, linearly.
class SoughtEffort {
 public:
  struct Sought {
    int place = 0;             ///< index of the value in the component's memory
    bool turns = false;        ///< whether it is a torque
    std::vector<int> moves{};  ///< nodes that it moves instead of their supports; empty: all that have a `motion`
    std::string name{};        ///< "the torque on angle of joint 'shoulder'"
  };
  virtual ~SoughtEffort() = default;
  virtual Sought sought() const = 0;

 protected:
  SoughtEffort() = default;
  SoughtEffort(const SoughtEffort&) = default;
  SoughtEffort& operator=(const SoughtEffort&) = default;
};

/// A support holds or moves a node, and computes its reaction.
class NodeSupport {
 public:
  virtual ~NodeSupport() = default;
  virtual int node() const = 0;
  /// Force and moment about the node that the support exerts on it, inertial components [N], [N m].
  virtual Vector6 reaction(const LocalState& state) const = 0;

 protected:
  NodeSupport() = default;
  NodeSupport(const NodeSupport&) = default;
  NodeSupport& operator=(const NodeSupport&) = default;
};

}  // namespace bielle::mechanism
