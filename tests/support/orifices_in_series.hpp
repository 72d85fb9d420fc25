// A chamber that empties through two orifices in series; the junction between them has no volume.
//
//   chamber:   C dp/dt + Q(c_1, p - y) = 0            p a first-order unknown [Pa], C = volume over bulk modulus
//   junction:  Q(c_1, p - y) - Q(c_2, y) = 0          y an algebraic one
//   Q(c, s) = c s/(s^2 + s_0^2)^(1/4)                 sqrt(s) but near zero
// With s_0 = 0:  y = p c_1^2/(c_1^2 + c_2^2),  C dp/dt = -c sqrt(p),  1/c^2 = 1/c_1^2 + 1/c_2^2.
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::test {

class OrificesInSeries : public mechanism::Component {
 public:
  struct Law {
    double capacity;  ///< C [m^3/Pa]
    double c_1, c_2;  ///< [m^3/s/Pa^0.5]
    double s_0;       ///< [Pa]
  };
  /// @param pressure  pressure of the chamber at the start [Pa]. @param guess  start value of the junction's pressure
  /// [Pa]
  OrificesInSeries(std::string name, const Law& law, double pressure, double guess);

  void declare(mechanism::Declaration& declaration) const override;
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override;
  void add_tangent(const mechanism::LocalState& state, mechanism::LocalTangent& tangent) const override;

 private:
  Law law_;
  double pressure_, guess_;
};

}  // namespace bielle::test
