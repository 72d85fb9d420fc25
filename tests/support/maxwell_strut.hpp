// A spring and a damper in series between two nodes: the smallest component with a first-order unknown. Its equation
// couples a rate of its own with velocities of nodes, and it acts on them itself, like the pressure in a cylinder.
//
//   dN/dt + N/tau - k dl/dt = 0,   N the tension [N], l the distance of the nodes, u its direction
//   forces on the nodes: +-N u
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::test {

class MaxwellStrut : public mechanism::Component {
 public:
  /// @param stiffness  [N/m]. @param relaxation  tau [s]. @param tension  at the start [N]
  MaxwellStrut(std::string name, int node_a, int node_b, double stiffness, double relaxation, double tension);

  void declare(mechanism::Declaration& declaration) const override;
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override;
  void add_tangent(const mechanism::LocalState& state, mechanism::LocalTangent& tangent) const override;
  void add_energy(const mechanism::LocalState& state, mechanism::Energy& energy) const override;

 private:
  int node_a_, node_b_;
  double stiffness_, relaxation_, tension_;
};

}  // namespace bielle::test
