#include "reduce/mesh/shape_functions.hpp"

#include <array>
#include <stdexcept>

#include "reduce/common/autodiff.hpp"

namespace bielle::reduce {

namespace {

// Formulas are templates of their number: with AutoDiff they give gradients.
template <class Number>
using Point = std::array<Number, 3>;
template <class Number>
using Values = std::vector<Number>;

/// Returns the functions of a simplex by barycentric coordinates l: l_a or l_a (2 l_a - 1) at vertices, 4 l_a l_b on
/// edges.
template <class Number>
Values<Number> of_simplex(const CellInfo& cell, const Point<Number>& x) {
  std::vector<Number> l(1, Number(1.0));
  for (int k = 0; k < cell.dimension; ++k) {
    l[0] -= x[static_cast<std::size_t>(k)];
    l.push_back(x[static_cast<std::size_t>(k)]);
  }
  Values<Number> n;
  for (const Number& each : l) n.push_back(cell.order == 1 ? each : each * (2.0 * each - 1.0));
  if (cell.order == 2)
    for (const auto& [a, b] : cell.edges)
      n.push_back(4.0 * l[static_cast<std::size_t>(a)] * l[static_cast<std::size_t>(b)]);
  return n;
}

/// Returns the functions on [-1, 1]^d without nodes inside: products of 1 + s x at vertices, with 1 - x^2 along the
/// edge of a mid-side node; at vertices of order 2 times (sum of s x) + 1 - d.
template <class Number>
Values<Number> of_serendipity_cube(const CellInfo& cell, const Eigen::MatrixXd& local, const Point<Number>& x) {
  Values<Number> n;
  for (int a = 0; a < cell.nodes; ++a) {
    Number product(1.0), sum(1.0 - cell.dimension);
    for (int k = 0; k < cell.dimension; ++k) {
      const double s = local(k, a);
      const Number& z = x[static_cast<std::size_t>(k)];
      product *= s == 0 ? 1.0 - z * z : 0.5 * (1.0 + s * z);
      sum += s * z;
    }
    n.push_back(cell.order == 2 && a < cell.vertices ? product * sum : product);
  }
  return n;
}

/// Returns the functions on [-1, 1]^d with all nodes of the grid of three by three (by three): products of quadratic
/// Lagrange polynomials.
template <class Number>
Values<Number> of_full_cube(const CellInfo& cell, const Eigen::MatrixXd& local, const Point<Number>& x) {
  Values<Number> n;
  for (int a = 0; a < cell.nodes; ++a) {
    Number product(1.0);
    for (int k = 0; k < cell.dimension; ++k) {
      const double s = local(k, a);
      const Number& z = x[static_cast<std::size_t>(k)];
      product *= s == 0 ? 1.0 - z * z : 0.5 * z * (z + s);
    }
    n.push_back(product);
  }
  return n;
}

template <class Number>
Values<Number> of_wedge(const CellInfo& cell, const Eigen::MatrixXd& local, const Point<Number>& x) {
  const std::array<Number, 3> l = {1.0 - x[0] - x[1], x[0], x[1]};
  const Number& z = x[2];
  Values<Number> n;
  for (int a = 0; a < 6; ++a) {
    const Number& of_triangle = l[static_cast<std::size_t>(a % 3)];
    const Number along = 1.0 + local(2, a) * z;
    n.push_back(cell.order == 1 ? 0.5 * of_triangle * along
                                : 0.5 * of_triangle * ((2.0 * of_triangle - 1.0) * along - (1.0 - z * z)));
  }
  if (cell.order == 2)
    for (const auto& [a, b] : cell.edges) {
      const Number product = l[static_cast<std::size_t>(a % 3)] * l[static_cast<std::size_t>(b % 3)];
      n.push_back(a % 3 == b % 3 ? l[static_cast<std::size_t>(a % 3)] * (1.0 - z * z)
                                 : 2.0 * product * (1.0 + local(2, a) * z));
    }
  return n;
}

template <class Number>
Values<Number> of_pyramid(const CellInfo& cell, const Eigen::MatrixXd& local, const Point<Number>& x) {
  const Number &r = x[0], &s = x[1], &t = x[2], left = 1.0 - t;
  const auto corner = [&](int a) { return (left + local(0, a) * r) * (left + local(1, a) * s) / left; };
  Values<Number> n;
  for (int a = 0; a < 4; ++a)
    n.push_back(cell.order == 1 ? 0.25 * corner(a) : 0.25 * corner(a) * (local(0, a) * r + local(1, a) * s - 1.0));
  n.push_back(cell.order == 1 ? t : t * (2.0 * t - 1.0));
  if (cell.order == 2)
    for (const auto& [a, b] : cell.edges) {
      if (b == 4) {
        n.push_back(t * corner(a));
        continue;
      }
      const int along = local(0, a) != local(0, b) ? 0 : 1;
      const Number &moving = x[static_cast<std::size_t>(along)], &held = x[static_cast<std::size_t>(1 - along)];
      n.push_back(0.5 * (left * left - moving * moving) * (left + local(1 - along, a) * held) / left);
    }
  return n;
}

template <class Number>
Values<Number> shape_functions(CellType type, const Point<Number>& x) {
  const CellInfo& cell = cell_info(type);
  switch (type) {
    case CellType::tri3:
    case CellType::tri6:
    case CellType::tet4:
    case CellType::tet10:
      return of_simplex(cell, x);
    case CellType::quad4:
    case CellType::quad8:
    case CellType::hex8:
    case CellType::hex20:
      return of_serendipity_cube(cell, local_nodes(type), x);
    case CellType::quad9:
    case CellType::hex27:
      return of_full_cube(cell, local_nodes(type), x);
    case CellType::wedge6:
    case CellType::wedge15:
      return of_wedge(cell, local_nodes(type), x);
    case CellType::pyramid5:
    case CellType::pyramid13:
      return of_pyramid(cell, local_nodes(type), x);
  }
  throw std::logic_error("an unknown type of cell");
}

Eigen::MatrixXd local_vertices(const CellInfo& cell) {
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(cell.dimension, cell.vertices);
  const Eigen::Matrix<double, 2, 4> square = (Eigen::Matrix<double, 2, 4>() << -1, 1, 1, -1, -1, -1, 1, 1).finished();
  if (cell.vertices == cell.dimension + 1) {
    x.rightCols(cell.dimension).setIdentity();
  } else if (cell.dimension == 2) {
    x = square;
  } else if (cell.vertices == 8) {
    x.topRows(2) << square, square;
    x.row(2) << -1, -1, -1, -1, 1, 1, 1, 1;
  } else if (cell.vertices == 6) {
    x.row(0) << 0, 1, 0, 0, 1, 0;
    x.row(1) << 0, 0, 1, 0, 0, 1;
    x.row(2) << -1, -1, -1, 1, 1, 1;
  } else {
    x.topLeftCorner(2, 4) = square;
    x(2, 4) = 1;
  }
  return x;
}

}  // namespace

Eigen::MatrixXd local_nodes(CellType type) {
  const CellInfo& cell = cell_info(type);
  const Eigen::MatrixXd vertices = local_vertices(cell);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(cell.dimension, cell.nodes);  // the last one of quad9, hex27: the middle
  x.leftCols(cell.vertices) = vertices;
  if (cell.order == 1) return x;
  int node = cell.vertices;
  for (const auto& [a, b] : cell.edges) x.col(node++) = (vertices.col(a) + vertices.col(b)) / 2;
  if (type == CellType::hex27)
    for (const CellFace& face : cell.faces)
      for (int corner = 0; corner < 4; ++corner) x.col(face.nodes[8]) += vertices.col(face.nodes[corner]) / 4;
  return x;
}

Eigen::VectorXd shape_values(CellType type, const Eigen::VectorXd& xi) {
  if (cell_info(type).vertices == 5 && xi(2) == 1) return Eigen::VectorXd::Unit(node_count(type), 4);  // the apex
  Point<double> x{};
  for (Eigen::Index k = 0; k < xi.size(); ++k) x[static_cast<std::size_t>(k)] = xi(k);
  const Values<double> values = shape_functions(type, x);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd shape_gradients(CellType type, const Eigen::VectorXd& xi) {
  using Number = AutoDiff<3, 1>;
  Point<Number> x{};
  for (Eigen::Index k = 0; k < xi.size(); ++k) x[static_cast<std::size_t>(k)] = Number(xi(k), Eigen::Vector3d::Unit(k));
  const Values<Number> values = shape_functions(type, x);
  Eigen::MatrixXd gradients(static_cast<Eigen::Index>(values.size()), xi.size());
  for (Eigen::Index a = 0; a < gradients.rows(); ++a)
    gradients.row(a) = values[static_cast<std::size_t>(a)].gradient.head(xi.size()).transpose();
  return gradients;
}

}  // namespace bielle::reduce
