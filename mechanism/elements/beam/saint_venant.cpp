#include "mechanism/elements/beam/saint_venant.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include "mechanism/math/gauss.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Fields = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Returns the quadratic shape functions of [0, 1] with nodes 0, 1/2, 1.
Vector3 shape(double t) { return {(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)}; }
Vector3 shape_slope(double t) { return {4 * t - 3, 4 - 8 * t, 4 * t - 1}; }

/// Returns the products of functions of y and of z; node 3 j + i is at the i-th position along y and the j-th along z.
Vector9 product(const Vector3& along_y, const Vector3& along_z) {
  Vector9 all;
  for (int j = 0; j < 3; ++j) all.segment<3>(3 * j) = along_z[j] * along_y;
  return all;
}

/// Shape functions of a cell at a position (u, w) in [0, 1]^2, and their derivatives by u and w.
struct ShapeValues {
  double u, w;
  Vector9 v, v_u, v_w;
  ShapeValues(double u_place, double w_place)
      : u(u_place),
        w(w_place),
        v(product(shape(u), shape(w))),
        v_u(product(shape_slope(u), shape(w))),
        v_w(product(shape(u), shape_slope(w))) {}
};

struct GaussPoint {
  ShapeValues at;
  double weight;
};

/// Returns the nine Gauss points of a cell.
const std::vector<GaussPoint>& gauss_points() {
  static const std::vector<GaussPoint> all = [] {
    std::vector<GaussPoint> points;
    for (std::size_t q = 0; q < 3; ++q)
      for (std::size_t p = 0; p < 3; ++p)
        points.push_back({{Gauss3::place[p], Gauss3::place[q]}, Gauss3::weight[p] * Gauss3::weight[q]});
    return points;
  }();
  return all;
}

/// Adds grid lines from a to b, with fine cells at both ends. @param first  size of the cells there
void add_lines(double a, double b, double first, double growth, std::vector<double>& lines) {
  const double largest = 0.08 * (b - a);  // keeps the error of the parabolic shear stress of a web below 1e-3
  std::vector<double> from_end{0};
  double size = first;
  while (from_end.back() + size < 0.5 * (b - a)) {
    from_end.push_back(from_end.back() + size);
    size = std::min(size * growth, largest);
  }
  // The rest is divided in the middle, into two cells if it is long.
  const double rest = (b - a) - 2 * from_end.back();
  for (double x : from_end) lines.push_back(a + x);
  if (rest > size) lines.push_back(0.5 * (a + b));
  for (auto x = from_end.rbegin(); x != from_end.rend(); ++x)
    if (*x > 0) lines.push_back(b - *x);
}

void sort_edges(std::vector<double>& edges, double tolerance) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end(), [&](double a, double b) { return b - a < tolerance; }),
              edges.end());
}

std::vector<double> grid_lines(std::vector<double> edges, double first, double growth, double tolerance) {
  sort_edges(edges, tolerance);
  std::vector<double> lines;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const double size = std::min(first, 0.25 * (edges[k + 1] - edges[k]));
    add_lines(edges[k], edges[k + 1], size, growth, lines);
  }
  lines.push_back(edges.back());
  return lines;
}

}  // namespace

RectangleArea::RectangleArea(std::vector<SectionRectangle> parts) : rectangles(std::move(parts)) {
  for (const SectionRectangle& r : rectangles) {
    const double part = (r.y1 - r.y0) * (r.z1 - r.z0);
    area += part;
    centroid += part * 0.5 * Vector2(r.y0 + r.y1, r.z0 + r.z1);
  }
  centroid /= area;
  for (SectionRectangle& r : rectangles) {
    r = {r.y0 - centroid.x(), r.y1 - centroid.x(), r.z0 - centroid.y(), r.z1 - centroid.y()};
    const double b = r.y1 - r.y0, h = r.z1 - r.z0, y = 0.5 * (r.y0 + r.y1), z = 0.5 * (r.z0 + r.z1);
    I(0, 0) += b * h * (b * b / 12 + y * y);
    I(1, 1) += b * h * (h * h / 12 + z * z);
    I(0, 1) += b * h * y * z;
  }
  I(1, 0) = I(0, 1);
}

double RectangleArea::tolerance() const { return 1e-9 * std::sqrt(area); }

bool RectangleArea::contains(const Vector2& p) const {
  const double slack = tolerance();
  return std::any_of(rectangles.begin(), rectangles.end(), [&](const SectionRectangle& r) {
    return p.x() >= r.y0 - slack && p.x() <= r.y1 + slack && p.y() >= r.z0 - slack && p.y() <= r.z1 + slack;
  });
}

double RectangleArea::thinnest_part() const {
  double least = INFINITY, size = 0;
  for (const SectionRectangle& r : rectangles)  // sort_edges() below merges the two edges of a very thin rectangle
    least = std::min({least, r.y1 - r.y0, r.z1 - r.z0});
  for (const bool along_y : {true, false}) {
    std::vector<double> edges;
    for (const SectionRectangle& r : rectangles) {
      edges.push_back(along_y ? r.y0 : r.z0);
      edges.push_back(along_y ? r.y1 : r.z1);
    }
    sort_edges(edges, tolerance());
    size = std::max(size, edges.back() - edges.front());
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) least = std::min(least, edges[k + 1] - edges[k]);
  }
  return least / size;
}

SaintVenant::SaintVenant(const RectangleArea& area, const SectionGrid& grid) : tolerance_(area.tolerance()) {
  make_grid(area, grid);
  solve(area);
}

void SaintVenant::make_grid(const RectangleArea& area, const SectionGrid& grid) {
  std::vector<double> ys, zs;
  double thinnest = INFINITY;
  for (const SectionRectangle& r : area.rectangles) {
    ys.insert(ys.end(), {r.y0, r.y1});
    zs.insert(zs.end(), {r.z0, r.z1});
    thinnest = std::min({thinnest, r.y1 - r.y0, r.z1 - r.z0});
  }
  ys = grid_lines(ys, grid.first * thinnest, grid.growth, tolerance_);
  zs = grid_lines(zs, grid.first * thinnest, grid.growth, tolerance_);
  std::map<std::pair<std::size_t, std::size_t>, int> number;
  for (std::size_t j = 0; j + 1 < zs.size(); ++j)
    for (std::size_t i = 0; i + 1 < ys.size(); ++i) {
      const double y = 0.5 * (ys[i] + ys[i + 1]), z = 0.5 * (zs[j] + zs[j + 1]);
      const auto holds = [&](const SectionRectangle& r) { return r.y0 < y && y < r.y1 && r.z0 < z && z < r.z1; };
      if (std::none_of(area.rectangles.begin(), area.rectangles.end(), holds)) continue;
      Cell cell{ys[i], ys[i + 1], zs[j], zs[j + 1], {}};
      for (std::size_t q = 0; q < 3; ++q)
        for (std::size_t p = 0; p < 3; ++p)
          cell.node[3 * q + p] =
              number.try_emplace({2 * j + q, 2 * i + p}, static_cast<int>(number.size())).first->second;
      cells_.push_back(cell);
    }
  nodes_ = static_cast<int>(number.size());
}

SaintVenant::Differences SaintVenant::differences(const Cell& cell) const {
  Differences d;
  const auto field = [&](int k) { return field_.row(cell.node[static_cast<std::size_t>(k)]); };
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int k = 3 * j + i;
      d.along_y.row(k) = (field(k) - field(3 * j)).cast<double>();
      d.along_z.row(k) = (field(k) - field(i)).cast<double>();
    }
  return d;
}

SaintVenant::Stresses SaintVenant::stresses(const Cell& cell, const Differences& d, const Vector9& v_u,
                                            const Vector9& v_w, const Vector2& place) {
  Stresses tau;
  tau.row(0) = v_u.transpose() * d.along_y / (cell.y1 - cell.y0);
  tau.row(1) = v_w.transpose() * d.along_z / (cell.z1 - cell.z0);
  tau(0, 2) -= place.y();
  tau(1, 2) += place.x();
  return tau;
}

// Weak forms, with any test function v:
//   int tau_i . grad v = int c_i.(y,z) v   (flexure),    int tau . grad v = 0   (torsion)
// J = int |tau|^2 is a sum of squares: I_y + I_z - int |grad omega|^2 would be a small difference for thin walls.
Eigen::Matrix<double, Eigen::Dynamic, 3> SaintVenant::evaluate(const Matrix2& I_inverse) {
  Fields residual = Fields::Zero(nodes_, 3);
  Matrix3 energy = Matrix3::Zero();
  Vector2 torque = Vector2::Zero();  // torque of the flexural stresses about the centroid: int (y tau_z - z tau_y)
  for (const Cell& cell : cells_) {
    const double b = cell.y1 - cell.y0, h = cell.z1 - cell.z0;
    const Differences values = differences(cell);
    Eigen::Matrix<double, 9, 3> local = Eigen::Matrix<double, 9, 3>::Zero();
    for (const GaussPoint& g : gauss_points()) {
      const Vector2 place(cell.y0 + g.at.u * b, cell.z0 + g.at.w * h);
      const Stresses tau = stresses(cell, values, g.at.v_u, g.at.v_w, place);
      const double dA = g.weight * b * h;
      local.leftCols<2>() += dA * g.at.v * (I_inverse * place).transpose();
      local -= g.weight * (h * g.at.v_u * tau.row(0) + b * g.at.v_w * tau.row(1));
      energy += dA * tau.transpose() * tau;
      torque += dA * (place.x() * tau.row(1) - place.y() * tau.row(0)).head<2>().transpose();
    }
    for (int k = 0; k < 9; ++k) residual.row(cell.node[static_cast<std::size_t>(k)]) += local.row(k);
  }
  F_ = energy.topLeftCorner<2, 2>();
  J_ = energy(2, 2);
  shear_centre_ = {torque[1], -torque[0]};
  return residual;
}

void SaintVenant::solve(const RectangleArea& area) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(81 * cells_.size());
  Eigen::Matrix<double, 9, 9> K_u = Eigen::Matrix<double, 9, 9>::Zero(), K_w = K_u;
  for (const GaussPoint& g : gauss_points()) {
    K_u += g.weight * g.at.v_u * g.at.v_u.transpose();
    K_w += g.weight * g.at.v_w * g.at.v_w.transpose();
  }
  for (const Cell& cell : cells_) {
    const double b = cell.y1 - cell.y0, h = cell.z1 - cell.z0;
    const Eigen::Matrix<double, 9, 9> K = h / b * K_u + b / h * K_w;
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j <= i; ++j) {
        const int row = cell.node[static_cast<std::size_t>(i)], column = cell.node[static_cast<std::size_t>(j)];
        entries.emplace_back(std::max(row, column), std::min(row, column), K(i, j));
      }
  }
  Eigen::SparseMatrix<double> K(nodes_, nodes_);  // lower triangle
  K.setFromTriplets(entries.begin(), entries.end());
  // Functions are determined up to a constant. They are fixed at one node; the sum of the loads is zero, so that this
  // has no effect on the stresses.
  K.coeffRef(0, 0) *= 2;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(K);

  const Matrix2 c = area.I.inverse();
  field_.setZero(nodes_, 3);
  constexpr int most = 12;
  constexpr double enough = 1e-7;  // permitted error of the stresses, by the energy of their correction
  for (int k = 0; k < most; ++k) {
    const Fields r = evaluate(c);
    const Fields correction = factors.solve(r);
    const Vector3 energy(F_(0, 0), F_(1, 1), J_), change = (r.cwiseProduct(correction)).colwise().sum();
    field_ += correction.cast<long double>();
    if ((change.array().abs() > enough * enough * energy.array()).any()) continue;
    evaluate(c);
    return;
  }
  throw ComputationError("rounding spoils the shear stresses of a section: its walls are too thin");
}

Eigen::Matrix<double, 2, 3> SaintVenant::shear_stress(const Vector2& point) const {
  const auto holds = [&](const Cell& c) {
    return point.x() >= c.y0 - tolerance_ && point.x() <= c.y1 + tolerance_ && point.y() >= c.z0 - tolerance_ &&
           point.y() <= c.z1 + tolerance_;
  };
  Stresses sum = Stresses::Zero();
  int count = 0;
  for (const Cell& cell : cells_) {
    if (!holds(cell)) continue;
    const ShapeValues at((point.x() - cell.y0) / (cell.y1 - cell.y0), (point.y() - cell.z0) / (cell.z1 - cell.z0));
    sum += stresses(cell, differences(cell), at.v_u, at.v_w, point);
    ++count;
  }
  if (count == 0) throw std::domain_error("a stress point lies outside of its section");
  sum /= count;
  sum.col(2) /= J_;
  return sum;
}

}  // namespace bielle::mechanism
