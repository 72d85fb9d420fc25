// Rotors on supports: a disc; and a rigid hub with lagging blades, also as equations of the tests' own.
#pragma once

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <fmt/format.h>

#include "tests/benchmarks/linearised/modes_of.hpp"
#include "tests/support/eigenvalues.hpp"

namespace bielle::test {

/// Returns a disc on a massless bearing with springs, along z.
inline std::string disc_on_springs(double mass, const std::string& inertia, const std::string& springs) {
  return fmt::format(
      "nodes: {{hub: {{}}, disc: {{}}}}\n"
      "elements: {{disc: {{type: rigid_body, node: disc, mass: {}, inertia: {}}}}}\n"
      "joints:\n  mount: {{type: bushing, nodes: [ground, hub], stiffness: {}}}\n"
      "  shaft: {{type: hinge, nodes: [hub, disc], position: [0, 0, 0], axis: [0, 0, 1]}}\n",
      mass, inertia, springs);
}

/// C. E. Hammond, J. Am. Helicopter Soc. 19 (1974) 14: hub of mass M on springs and dampers in its plane, blades with
/// lag hinges at the radius e, first moment S and inertia J about the hinge, lag dampers c and springs k.
struct LagRotor {
  int blades = 4;
  double M = 8026.6, kx = 1240481.8, ky = 1240481.8, cx = 51078.7, cy = 51078.7;
  double e = 0.3048, m = 94.9, S = 289.1, J = 1084.7;
  std::vector<double> c = {4067.5, 4067.5, 4067.5, 4067.5};
  double k = 0, rate = 25;

  std::string model() const {
    const double r = S / m, own = J - m * r * r;
    std::string text = fmt::format(
        "nodes:\n  hub: {{fixed: [z, rx, ry, rz]}}\n  rotor: {{}}\n{6}"
        "elements:\n  hub: {{type: rigid_body, node: hub, mass: {0}, inertia: [1, 1, 1]}}\n"
        "  rotor: {{type: rigid_body, node: rotor, mass: 1e-3, inertia: [1e-3, 1e-3, 1e-3]}}\n{7}"
        "joints:\n  mount: {{type: bushing, nodes: [ground, hub], stiffness: [{1}, {2}, 0, 0, 0, 0], damping: [{3}, "
        "{4}, "
        "0, 0, 0, 0]}}\n  shaft: {{type: hinge, nodes: [hub, rotor], position: [0, 0, 0], axis: [0, 0, 1]}}\n{8}"
        "drives: {{motor: {{joint: shaft, rate: {5}}}}}\n",
        M, kx, ky, cx, cy, rate, nodes(e + r), bodies(own), hinges());
    return text;
  }

  /// M x'' + C x' + K x = 0 of x = [x, y, zeta_k] at the azimuth psi, by Lagrange's equations of small lag angles.
  struct Matrices {
    Eigen::MatrixXd mass, damping, stiffness;
  };
  Matrices matrices(double psi) const {
    const int n = 2 + blades;
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n), damping = mass, stiffness = mass;
    mass(0, 0) = mass(1, 1) = M + blades * m + 1e-3;
    stiffness.diagonal().head<2>() << kx, ky;
    damping.diagonal().head<2>() << cx, cy;
    for (int b = 0; b < blades; ++b) {
      const double at = psi + 2 * M_PI * b / blades, s = std::sin(at), co = std::cos(at);
      const int i = 2 + b;
      mass(i, i) = J;
      damping(i, i) = c[static_cast<std::size_t>(b)];
      stiffness(i, i) = k + rate * rate * e * S;
      mass(i, 0) = mass(0, i) = -S * s;
      mass(i, 1) = mass(1, i) = S * co;
      // (zeta sin psi)'' = zeta'' sin + 2 Om zeta' cos - Om^2 zeta sin, and likewise for the cosine.
      damping(0, i) = -S * 2 * rate * co;
      damping(1, i) = -S * 2 * rate * s;
      stiffness(0, i) = S * rate * rate * s;
      stiffness(1, i) = -S * rate * rate * co;
    }
    return {mass, damping, stiffness};
  }

  /// z' = A(psi) z with z = [x; x'].
  Eigen::MatrixXd A(double psi) const {
    const auto [mass, damping, stiffness] = matrices(psi);
    const Eigen::Index n = mass.rows();
    const Eigen::MatrixXd inverse = mass.inverse();
    Eigen::MatrixXd first = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    first.topRightCorner(n, n).setIdentity();
    first.bottomLeftCorner(n, n) = -inverse * stiffness;
    first.bottomRightCorner(n, n) = -inverse * damping;
    return first;
  }

  /// Returns the Floquet multipliers of a whole turn, by Runge-Kutta's method of fourth order.
  Eigen::VectorXcd multipliers(int steps) const {
    const double T = two_pi / rate, h = T / steps;
    const int n = 2 * (2 + blades);
    Eigen::MatrixXd Phi = Eigen::MatrixXd::Identity(n, n);
    for (int k0 = 0; k0 < steps; ++k0) {
      const double t = k0 * h;
      const Eigen::MatrixXd A0 = A(rate * t), A1 = A(rate * (t + h / 2)), A2 = A(rate * (t + h));
      const Eigen::MatrixXd k1 = A0 * Phi, k2 = A1 * (Phi + h / 2 * k1), k3 = A1 * (Phi + h / 2 * k2),
                            k4 = A2 * (Phi + h * k3);
      Phi += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return eigenvalues(Phi);
  }

  /// Returns the exponents of the multiblade equations (W. Johnson, Helicopter Theory (1980), 12-4) of equal blades, Im
  /// s > 0.
  std::vector<std::complex<double>> multiblade() const {
    const double K = k + rate * rate * e * S, N = blades, damper = c[0];
    Eigen::Matrix4d mass = Eigen::Matrix4d::Zero(), damping = mass, stiffness = mass;  // x, y, a1, b1
    mass.diagonal() << M + N * m + 1e-3, M + N * m + 1e-3, J, J;
    mass(0, 3) = -S * N / 2;
    mass(1, 2) = S * N / 2;
    mass(2, 1) = S;
    mass(3, 0) = -S;
    damping.diagonal() << cx, cy, damper, damper;
    damping(2, 3) = 2 * rate * J;
    damping(3, 2) = -2 * rate * J;
    stiffness.diagonal() << kx, ky, K - rate * rate * J, K - rate * rate * J;
    stiffness(2, 3) = rate * damper;
    stiffness(3, 2) = -rate * damper;
    const Eigen::Matrix4d inverse = mass.inverse();
    Eigen::MatrixXd first = Eigen::MatrixXd::Zero(8, 8);
    first.topRightCorner(4, 4).setIdentity();
    first.bottomLeftCorner(4, 4) = -inverse * stiffness;
    first.bottomRightCorner(4, 4) = -inverse * damping;
    std::vector<std::complex<double>> found;
    for (const std::complex<double> s : eigenvalues(first))
      if (s.imag() > 0) found.push_back(s);
    // Collective and differential motions do not move the hub.
    for (int k0 = 0; k0 < blades - 2; ++k0)
      found.emplace_back(-damper / (2 * J), std::sqrt(K / J - std::pow(damper / (2 * J), 2)));
    return found;
  }

 private:
  std::string nodes(double radius) const {
    std::string text;
    for (int b = 0; b < blades; ++b)
      text += fmt::format("  blade_{0}: {{position: [{1:.17g}, {2:.17g}, 0], rotation_vector: [0, 0, {3:.17g}]}}\n", b,
                          radius * std::cos(at(b)), radius * std::sin(at(b)), at(b));
    return text;
  }
  std::string bodies(double own) const {
    std::string text;
    for (int b = 0; b < blades; ++b)
      text += fmt::format(
          "  blade_{0}: {{type: rigid_body, node: blade_{0}, mass: {1}, inertia: [{2:.17g}, {2:.17g}, {2:.17g}]}}\n", b,
          m, own);
    return text;
  }
  std::string hinges() const {
    std::string text;
    for (int b = 0; b < blades; ++b)
      text += fmt::format(
          "  lag_{0}: {{type: hinge, nodes: [rotor, blade_{0}], position: [{1:.17g}, {2:.17g}, 0], axis: [0, 0, 1], "
          "stiffness: {3}, damping: {4}}}\n",
          b, e * std::cos(at(b)), e * std::sin(at(b)), k, c[static_cast<std::size_t>(b)]);
    return text;
  }
  double at(int b) const { return two_pi * b / blades; }
};

}  // namespace bielle::test
