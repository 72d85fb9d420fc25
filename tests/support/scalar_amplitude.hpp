// One amplitude by itself on a hardening spring, with or without mass:
//   m q'' + d q' + k q (1 + (q/b)^2) = k b (1 + sin(w t))
#pragma once

#include "mechanism/model/component.hpp"

namespace bielle::test {

class ScalarAmplitude : public mechanism::Component {
 public:
  struct Law {
    double m, d, k, b, w;
  };
  ScalarAmplitude(std::string name, mechanism::Declaration::Scalar unknown, const Law& law)
      : Component("scalar_amplitude", std::move(name)), unknown_(std::move(unknown)), law_(law) {}

  void declare(mechanism::Declaration& declaration) const override;
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override;
  void add_tangent(const mechanism::LocalState& state, mechanism::LocalTangent& tangent) const override;

 private:
  mechanism::Declaration::Scalar unknown_;
  Law law_;
};

}  // namespace bielle::test
