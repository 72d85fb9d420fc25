#include <cmath>

#include <catch2/catch.hpp>

#include "reduce/fe/quadrature.hpp"
#include "reduce/fe/shape_functions.hpp"

using namespace bielle::reduce;

namespace {

Eigen::VectorXd node_place(CellType type, int node) {
  const int d = dimension(type), vertices = vertex_count(type);
  const auto vertex = [&](int v) {
    Eigen::VectorXd xi = Eigen::VectorXd::Zero(d);
    if (v > 0) {
      xi(v - 1) = 1;
    }
    return xi;
  };
  if (node < vertices) {
    return vertex(node);
  }
  const auto edges = edges_of(type);
  return (vertex(edges(0, node - vertices)) + vertex(edges(1, node - vertices))) / 2;
}

double factorial(int n) { return std::tgamma(n + 1.0); }

}  // namespace

TEST_CASE("Shape functions are one at their node and zero at the others, with gradients that are their derivatives") {
  const CellType type = GENERATE(CellType::tri3, CellType::tri6, CellType::tet4, CellType::tet10);
  for (int a = 0; a < node_count(type); ++a) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(node_count(type), a);
    CHECK((shape_values(type, node_place(type, a)) - unit).cwiseAbs().maxCoeff() < 1e-15);
  }
  Eigen::VectorXd xi(3);
  xi << 0.21, 0.34, 0.17;
  xi.conservativeResize(dimension(type));
  CHECK(shape_values(type, xi).sum() == Approx(1).epsilon(1e-15));
  CHECK(shape_gradients(type, xi).colwise().sum().norm() < 1e-14);
  const double h = 1e-6;
  for (Eigen::Index k = 0; k < xi.size(); ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(xi.size(), k);
    // Quadratic functions: the central difference is exact but for rounding, eps / h.
    const Eigen::VectorXd difference = (shape_values(type, xi + step) - shape_values(type, xi - step)) / (2 * h);
    CHECK((difference - shape_gradients(type, xi).col(k)).norm() < 1e-9);
  }
}

TEST_CASE("Quadrature rules integrate every monomial up to their degree") {
  const int degree = GENERATE(0, 1, 2, 3, 4, 5, 6, 7, 8);
  const Quadrature tet = simplex_quadrature(3, degree), triangle = simplex_quadrature(2, degree);
  CHECK(tet.weights.minCoeff() > 0);
  CHECK(triangle.weights.minCoeff() > 0);
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; i + j <= degree; ++j) {
      double sum = 0;
      for (Eigen::Index p = 0; p < triangle.weights.size(); ++p) {
        sum += triangle.weights(p) * std::pow(triangle.points(0, p), i) * std::pow(triangle.points(1, p), j);
      }
      CHECK(sum == Approx(factorial(i) * factorial(j) / factorial(i + j + 2)).epsilon(1e-13));
      for (int k = 0; i + j + k <= degree; ++k) {
        sum = 0;
        for (Eigen::Index p = 0; p < tet.weights.size(); ++p) {
          sum += tet.weights(p) * std::pow(tet.points(0, p), i) * std::pow(tet.points(1, p), j) *
                 std::pow(tet.points(2, p), k);
        }
        CHECK(sum == Approx(factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3)).epsilon(1e-13));
      }
    }
  }
}
