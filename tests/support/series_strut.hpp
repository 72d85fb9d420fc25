// Two springs in series between two nodes, a damper parallel to both, and no mass between the springs: the elongation y
// of the first one follows from the balance of forces there. It is an algebraic first-order unknown, or is eliminated.
//
//   N(y) = k_1 y + c y^3,    0 = N(y) - k_2 (l - l_0 - y) - d dl/dt,    l the distance of the nodes
//   forces on the nodes: +-N u
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::test {

class SeriesStrut : public mechanism::Component {
 public:
  struct Law {
    double k_1, c, k_2, d, l_0;
    double force(double y) const { return k_1 * y + c * y * y * y; }
    double stiffness(double y) const { return k_1 + 3 * c * y * y; }
    double solve(double l, double rate) const;  ///< y
  };
  /// @param start  start value of y [m]
  SeriesStrut(std::string name, int node_a, int node_b, const Law& law, bool eliminated, double start = 0);

  void declare(mechanism::Declaration& declaration) const override;
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override;
  void add_tangent(const mechanism::LocalState& state, mechanism::LocalTangent& tangent) const override;

 private:
  int node_a_, node_b_;
  Law law_;
  bool eliminated_;
  double start_;
};

}  // namespace bielle::test
