// The ports of a component with flows: they add its flows to the balances of the connected places.
//
// A flow Q [m^3/s] from a place a to a place b removes f_a Q from a and adds f_b Q to b (with the factor f of each,
// PressureNode::exchange). The power dissipated between them is Q (e_a - e_b), with the head e of the fluid
// (fluid.hpp): a law in which Q has the sign of p_a - p_b cannot create energy.
#pragma once

#include <string>
#include <vector>

#include "mechanism/hydraulics/circuit/pressure_node.hpp"
#include "mechanism/model/measure.hpp"
#include "mechanism/model/references.hpp"

namespace bielle::mechanism {

/// A flow with its derivatives over the local layout of its component. The object is reused from call to call.
struct FlowDerivatives {
  double Q = 0;  ///< [m^3/s]
  MeasureGradient by;
  void prepare(int size) {
    Q = 0;
    by.prepare(size);
  }
};

class Ports {
 public:
  static constexpr int outside = -1;  ///< instead of a port: the fluid leaves the model
  /// @returns the number of the port
  int add(const PressureNode& node, References& references);
  int count() const { return static_cast<int>(ports_.size()); }
  const PressureNode& node(int port) const { return *ports_[static_cast<std::size_t>(port)].node; }

  double pressure(const LocalState& state, int port) const;
  /// Returns the local row of the pressure of a port, which is also its column.
  int pressure_row(const LocalState& state, int port) const;
  /// Adds a flow to the balances of two ports.
  void add_flow(const LocalState& state, int from, int to, double Q, Eigen::Ref<VectorX> r) const;
  void add_tangent(const LocalState& state, int from, int to, FlowDerivatives& flow, LocalTangent& tangent) const;
  /// Adds the rows of the balances of all ports, over all columns, to the pattern.
  void add_pattern(const Slots& slots, LocalPattern& pattern) const;
  /// Returns the power that a flow dissipates between two ports [W]: Q (e_from - e_to); the head of `outside` is zero.
  double power(const LocalState& state, int from, int to, double Q) const;
  double head(const LocalState& state, int port) const;
  /// Returns "from 'pump' to 'tank'".
  std::string describe(int from, int to) const;

 private:
  struct Port {
    const PressureNode* node;
    int reference;
  };
  const Port& at(int port) const { return ports_[static_cast<std::size_t>(port)]; }
  void add_one(const LocalState& state, int port, double Q, Eigen::Ref<VectorX> r) const;
  void add_one_tangent(const LocalState& state, int port, double sign, FlowDerivatives& flow,
                       LocalTangent& tangent) const;
  std::vector<Port> ports_;
};

}  // namespace bielle::mechanism
