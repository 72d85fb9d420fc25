// Amplitudes on a node that moves along x, all coupled by constant matrices:  M z'' + K z = 0, z = (x - x_0, q).
#pragma once

#include <string>
#include <utility>

#include <fmt/format.h>

#include "mechanism/model/component.hpp"

namespace bielle::test {

class LinearAmplitudes : public mechanism::Component {
 public:
  /// @param K,M  (1 + amplitudes)
  LinearAmplitudes(std::string name, int node, double x_0, mechanism::MatrixX K, mechanism::MatrixX M)
      : Component("linear_amplitudes", std::move(name)), node_(node), x_0_(x_0), K_(std::move(K)), M_(std::move(M)) {}
  void declare(mechanism::Declaration& declaration) const override {
    declaration.nodes = {node_};
    for (Eigen::Index k = 1; k < K_.rows(); ++k) declaration.amplitudes.push_back({fmt::format("q{}", k), "m"});
    declaration.stiffness = declaration.mass = true;
  }
  void add_residual(const mechanism::LocalState& state, Eigen::Ref<mechanism::VectorX> r) const override {
    mechanism::VectorX z(K_.rows()), rate(K_.rows());
    z << state.node(0).x[0] - x_0_, state.amplitude();
    rate << state.node(0).a[0], state.amplitude_acceleration();
    const mechanism::VectorX f = K_ * z + M_ * rate;
    r[0] += f[0];
    r.tail(f.size() - 1) += f.tail(f.size() - 1);
  }
  void add_tangent(const mechanism::LocalState&, mechanism::LocalTangent& tangent) const override {
    if (tangent.wants_K) add(K_, tangent.K.dense());
    if (tangent.wants_M) add(M_, tangent.M.dense());
  }

 private:
  static void add(const mechanism::MatrixX& A, mechanism::LocalMatrix::Dense to) {
    const Eigen::Index n = A.rows() - 1;
    to(0, 0) += A(0, 0);
    to.block(0, 6, 1, n) += A.topRightCorner(1, n);
    to.block(6, 0, n, 1) += A.bottomLeftCorner(n, 1);
    to.bottomRightCorner(n, n) += A.bottomRightCorner(n, n);
  }
  int node_;
  double x_0_;
  mechanism::MatrixX K_, M_;
};

}  // namespace bielle::test
