#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/mesh/quadrature.hpp"
#include "reduce/mesh/shape_functions.hpp"

using namespace bielle::reduce;

namespace {

std::vector<CellType> all_types() {
  std::vector<CellType> types;
  for (const CellInfo& cell : cell_table()) types.push_back(cell.type);
  return types;
}

double factorial(int n) { return std::tgamma(n + 1.0); }

}  // namespace

TEST_CASE("Shape functions are one at their node and zero at the others, and gradients are their derivatives") {
  const CellType type = GENERATE(from_range(all_types()));
  CAPTURE(cell_name(type));
  const Eigen::MatrixXd nodes = local_nodes(type);
  for (int a = 0; a < node_count(type); ++a) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(node_count(type), a);
    CHECK((shape_values(type, nodes.col(a)) - unit).cwiseAbs().maxCoeff() < 1e-15);
  }
  Eigen::VectorXd xi(3);
  xi << 0.21, 0.34, 0.17;
  xi.conservativeResize(dimension(type));
  CHECK(shape_values(type, xi).sum() == Approx(1).epsilon(1e-14));
  CHECK(shape_gradients(type, xi).colwise().sum().norm() < 1e-14);
  const double h = 1e-5;
  for (Eigen::Index k = 0; k < xi.size(); ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(xi.size(), k);
    const Eigen::VectorXd difference = (shape_values(type, xi + step) - shape_values(type, xi - step)) / (2 * h);
    CHECK((difference - shape_gradients(type, xi).col(k)).norm() < 1e-8);
  }
}

TEST_CASE("Shape functions interpolate polynomials of their order exactly") {
  const CellType type = GENERATE(from_range(all_types()));
  CAPTURE(cell_name(type));
  const CellInfo& cell = cell_info(type);
  const Eigen::MatrixXd nodes = local_nodes(type);
  const auto monomial = [&](const Eigen::VectorXd& x, int i, int j) { return (i < 0 ? 1 : x(i)) * (j < 0 ? 1 : x(j)); };
  Eigen::VectorXd xi(3);
  xi << -0.11, 0.34, 0.27;
  xi.conservativeResize(cell.dimension);
  for (int i = -1; i < cell.dimension; ++i)
    for (int j = -1; j < cell.dimension; ++j) {
      if (cell.order == 1 && i >= 0 && j >= 0) continue;
      Eigen::VectorXd values(cell.nodes);
      for (int a = 0; a < cell.nodes; ++a) values(a) = monomial(nodes.col(a), i, j);
      CHECK(shape_values(type, xi).dot(values) == Approx(monomial(xi, i, j)).margin(1e-14));
    }
}

TEST_CASE("Faces of solid cells point outward, and two of them meet at each edge") {
  for (const CellInfo& cell : cell_table()) {
    CAPTURE(cell.name);
    const Eigen::MatrixXd nodes = local_nodes(cell.type);
    std::map<std::pair<int, int>, int> ends;
    for (const CellFace& face : cell.faces) {
      CHECK(static_cast<int>(face.nodes.size()) == node_count(face.type));
      const Eigen::Vector3d middle = nodes.leftCols(cell.vertices).rowwise().mean();
      const Eigen::Vector3d a = nodes.col(face.nodes[0]), b = nodes.col(face.nodes[1]), c = nodes.col(face.nodes[2]);
      CHECK((b - a).cross(c - a).dot(a - middle) > 0);
      // Nodes of the face are at the places of its own reference cell.
      const Eigen::MatrixXd of_face = local_nodes(face.type);
      Eigen::MatrixXd corners(3, vertex_count(face.type));
      for (int k = 0; k < corners.cols(); ++k) corners.col(k) = nodes.col(face.nodes[static_cast<std::size_t>(k)]);
      const CellType linear = corners.cols() == 3 ? CellType::tri3 : CellType::quad4;
      for (std::size_t k = 0; k < face.nodes.size(); ++k)
        CHECK((nodes.col(face.nodes[k]) - corners * shape_values(linear, of_face.col(static_cast<Eigen::Index>(k))))
                  .norm() < 1e-15);
      for (int k = 0; k < corners.cols(); ++k) {
        const int from = face.nodes[static_cast<std::size_t>(k)],
                  to = face.nodes[static_cast<std::size_t>((k + 1) % corners.cols())];
        ++ends[{from, to}];
      }
    }
    if (cell.dimension == 3)
      CHECK(ends.size() == 2 * cell.edges.size());  // two faces run along an edge in opposite directions
    for (const auto& [edge, count] : ends) CHECK(count == 1);
  }
}

TEST_CASE("Rules of all types integrate the volume of the reference cell and its shape functions") {
  const std::map<std::string, double> sizes = {
      {"tri3", 0.5}, {"quad4", 4},   {"tet4", 1.0 / 6},      {"hex8", 8},        {"wedge6", 1}, {"pyramid5", 4.0 / 3},
      {"hex20", 8},  {"wedge15", 1}, {"pyramid13", 4.0 / 3}, {"tet10", 1.0 / 6}, {"hex27", 8},  {"quad9", 4}};
  for (const auto& [name, size] : sizes)
    for (const CellInfo& cell : cell_table())
      if (cell.name == name) {
        CAPTURE(name);
        const Quadrature rule = cell_quadrature(cell.type, 4), finer = cell_quadrature(cell.type, 8);
        CHECK(rule.weights.minCoeff() > 0);
        CHECK(rule.weights.sum() == Approx(size).epsilon(1e-14));
        Eigen::MatrixXd coarse = Eigen::MatrixXd::Zero(cell.nodes, cell.nodes), fine = coarse;
        for (const auto& [of, sum] : {std::pair(&rule, &coarse), std::pair(&finer, &fine)})
          for (Eigen::Index p = 0; p < of->weights.size(); ++p) {
            const Eigen::VectorXd n = shape_values(cell.type, of->points.col(p));
            *sum += of->weights(p) * n * n.transpose();
          }
        CHECK((coarse - fine).norm() < 1e-13 * fine.norm());
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
