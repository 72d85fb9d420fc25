// Realisations of filters and transfer functions against their frequency responses.
#include <complex>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/elements/control/linear_block.hpp"

using namespace bielle::mechanism;
using Complex = std::complex<double>;

namespace {

/// Returns C (s - A)^-1 B + D.
Eigen::VectorXcd response(const LinearBlock& block, Complex s) {
  const Eigen::Index n = block.A.rows();
  const Eigen::MatrixXcd left = s * Eigen::MatrixXcd::Identity(n, n) - block.A.cast<Complex>();
  return block.C.cast<Complex>() * left.partialPivLu().solve(Eigen::MatrixXcd(block.B.cast<Complex>())).col(0) +
         block.D.cast<Complex>().col(0);
}

Complex polynomial(const std::vector<double>& descending, Complex s) {
  Complex value = 0;
  for (const double each : descending) value = value * s + each;
  return value;
}

void check_transfer(const std::vector<double>& numerator, const std::vector<double>& denominator) {
  const LinearBlock block = realisation(numerator, denominator);
  for (const Complex s : {Complex(0.3, 0), Complex(0, 2), Complex(0, 700), Complex(-3, 40)}) {
    const Complex expected = polynomial(numerator, s) / polynomial(denominator, s);
    CAPTURE(s.real(), s.imag());
    CHECK(std::abs(response(block, s)[0] - expected) < 1e-11 * std::abs(expected));
  }
}

}  // namespace

TEST_CASE("a transfer function's realisation has its frequency response") {
  check_transfer({3}, {2, 1});
  check_transfer({2, 1, 3}, {1, 4, 5});            // direct feed-through
  check_transfer({1, 2}, {1, 4, 5, 0});            // an integrator
  check_transfer({7}, {2, 0, 0});                  // nothing but integrators
  check_transfer({1, 0}, {1e-6, 2e-3, 1});         // poles at 1000/s
  check_transfer({5, 4, 3, 2}, {1, 2, 3, 4, -5});  // one pole to the right
}

TEST_CASE("states of a realisation are of the input's size, wherever the poles are") {
  // Poles at 1e5/s: canonical forms in seconds would hold entries of 1e10.
  const LinearBlock block = realisation({1e10}, {1, 1.4e5, 1e10});
  CHECK(block.A.cwiseAbs().maxCoeff() < 2e5);
  const MatrixX rest = *rest_of(block);
  CHECK(rest.cwiseAbs().maxCoeff() == Approx(1));
  CHECK((block.C * rest)(0, 0) == Approx(1));
}

TEST_CASE("filters have their poles and pass what is constant") {
  const LinearBlock first = first_order_filter(0.2);
  const Complex s(-2, 30);
  CHECK(std::abs(response(first, s)[0] - 1.0 / (1.0 + 0.2 * s)) < 1e-14);
  const LinearBlock second = second_order_filter(3, 0.4);
  const double w = 2 * M_PI * 3;
  const Complex expected = w * w / (s * s + 2 * 0.4 * w * s + w * w);
  CHECK(std::abs(response(second, s)[0] - expected) < 1e-13 * std::abs(expected));
  CHECK(std::abs(response(second, s)[1] - s * expected) < 1e-13 * std::abs(s * expected));
  CHECK((second.C * *rest_of(second)).isApprox(Eigen::Vector2d(1, 0), 1e-15));
  CHECK_FALSE(rest_of(integrator()));
}
