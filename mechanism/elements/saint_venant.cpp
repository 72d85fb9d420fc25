#include "mechanism/elements/saint_venant.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>

namespace bielle::mechanism {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;

/// Quadratic shape functions of [0, 1] with nodes 0, 1/2, 1, and their derivatives.
Vector3 shape(double t) { return {(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)}; }
Vector3 shape_slope(double t) { return {4 * t - 3, 4 - 8 * t, 4 * t - 1}; }

/// Products of functions of y and of z; node 3 j + i stands at the i-th place along y and the j-th along z.
Vector9 product(const Vector3& along_y, const Vector3& along_z) {
  Vector9 all;
  for (int j = 0; j < 3; ++j) all.segment<3>(3 * j) = along_z[j] * along_y;
  return all;
}

/// Grid lines from a to b, fine at both ends. @param first  size of the cells there
void add_lines(double a, double b, double first, double growth, std::vector<double>& lines) {
  std::vector<double> from_end{0};
  double size = first;
  while (from_end.back() + size < 0.5 * (b - a)) {
    from_end.push_back(from_end.back() + size);
    size *= growth;
  }
  // The middle takes what is left; two cells there where it is long.
  const double rest = (b - a) - 2 * from_end.back();
  for (double x : from_end) lines.push_back(a + x);
  if (rest > size) lines.push_back(0.5 * (a + b));
  for (auto x = from_end.rbegin(); x != from_end.rend(); ++x)
    if (*x > 0) lines.push_back(b - *x);
}

std::vector<double> grid_lines(std::vector<double> edges, double first, double growth, double tolerance) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end(), [&](double a, double b) { return b - a < tolerance; }),
              edges.end());
  std::vector<double> lines;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const double size = std::min(first, 0.25 * (edges[k + 1] - edges[k]));
    add_lines(edges[k], edges[k + 1], size, growth, lines);
  }
  lines.push_back(edges.back());
  return lines;
}

const double gauss = std::sqrt(0.6);
const std::array<double, 3> gauss_place{0.5 - 0.5 * gauss, 0.5, 0.5 + 0.5 * gauss},
    gauss_weight{5.0 / 18, 8.0 / 18, 5.0 / 18};

}  // namespace

SaintVenant::SaintVenant(std::vector<SectionRectangle> rectangles, const SectionGrid& grid) {
  for (const SectionRectangle& r : rectangles) {
    const double part = (r.y1 - r.y0) * (r.z1 - r.z0);
    area_ += part;
    centroid_ += part * 0.5 * Vector2(r.y0 + r.y1, r.z0 + r.z1);
  }
  centroid_ /= area_;
  for (SectionRectangle& r : rectangles)
    r = {r.y0 - centroid_.x(), r.y1 - centroid_.x(), r.z0 - centroid_.y(), r.z1 - centroid_.y()};
  integrate_area(rectangles);
  make_grid(rectangles, grid);
  solve();
}

void SaintVenant::integrate_area(const std::vector<SectionRectangle>& rectangles) {
  for (const SectionRectangle& r : rectangles) {
    const double b = r.y1 - r.y0, h = r.z1 - r.z0, y = 0.5 * (r.y0 + r.y1), z = 0.5 * (r.z0 + r.z1);
    I_(0, 0) += b * h * (b * b / 12 + y * y);
    I_(1, 1) += b * h * (h * h / 12 + z * z);
    I_(0, 1) += b * h * y * z;
  }
  I_(1, 0) = I_(0, 1);
}

void SaintVenant::make_grid(const std::vector<SectionRectangle>& rectangles, const SectionGrid& grid) {
  std::vector<double> ys, zs;
  double thinnest = INFINITY;
  for (const SectionRectangle& r : rectangles) {
    ys.insert(ys.end(), {r.y0, r.y1});
    zs.insert(zs.end(), {r.z0, r.z1});
    thinnest = std::min({thinnest, r.y1 - r.y0, r.z1 - r.z0});
  }
  tolerance_ = 1e-9 * std::sqrt(area_);
  ys = grid_lines(ys, grid.first * thinnest, grid.growth, tolerance_);
  zs = grid_lines(zs, grid.first * thinnest, grid.growth, tolerance_);
  std::map<std::pair<std::size_t, std::size_t>, int> number;
  for (std::size_t j = 0; j + 1 < zs.size(); ++j)
    for (std::size_t i = 0; i + 1 < ys.size(); ++i) {
      const double y = 0.5 * (ys[i] + ys[i + 1]), z = 0.5 * (zs[j] + zs[j + 1]);
      const auto holds = [&](const SectionRectangle& r) { return r.y0 < y && y < r.y1 && r.z0 < z && z < r.z1; };
      if (std::none_of(rectangles.begin(), rectangles.end(), holds)) continue;
      Cell cell{ys[i], ys[i + 1], zs[j], zs[j + 1], {}};
      for (std::size_t q = 0; q < 3; ++q)
        for (std::size_t p = 0; p < 3; ++p)
          cell.node[3 * q + p] =
              number.try_emplace({2 * j + q, 2 * i + p}, static_cast<int>(number.size())).first->second;
      cells_.push_back(cell);
    }
  nodes_ = static_cast<int>(number.size());
}

// Weak forms, v any test function:   int grad Phi_i . grad v = int c_i.(y,z) v,   int grad omega . grad v = int (z v_y
// - y v_z)
void SaintVenant::solve() {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(81 * cells_.size());
  field_.resize(nodes_, 3);
  Eigen::Matrix<double, Eigen::Dynamic, 3> right = Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(nodes_, 3);
  const Matrix2 c = I_.inverse();
  for (const Cell& cell : cells_) {
    const double b = cell.y1 - cell.y0, h = cell.z1 - cell.z0;
    Eigen::Matrix<double, 9, 9> K = Eigen::Matrix<double, 9, 9>::Zero();
    Eigen::Matrix<double, 9, 3> f = Eigen::Matrix<double, 9, 3>::Zero();
    for (std::size_t q = 0; q < 3; ++q)
      for (std::size_t p = 0; p < 3; ++p) {
        const double u = gauss_place[p], w = gauss_place[q], weight = b * h * gauss_weight[p] * gauss_weight[q];
        const Vector9 v = product(shape(u), shape(w)), v_y = product(shape_slope(u), shape(w)) / b,
                      v_z = product(shape(u), shape_slope(w)) / h;
        const Vector2 place(cell.y0 + u * b, cell.z0 + w * h);
        K += weight * (v_y * v_y.transpose() + v_z * v_z.transpose());
        f.leftCols<2>() += weight * v * (c * place).transpose();
        f.col(2) += weight * (place.y() * v_y - place.x() * v_z);
      }
    for (int i = 0; i < 9; ++i) {
      const int row = cell.node[static_cast<std::size_t>(i)];
      right.row(row) += f.row(i);
      for (int j = 0; j < 9; ++j) entries.emplace_back(row, cell.node[static_cast<std::size_t>(j)], K(i, j));
    }
  }
  Eigen::SparseMatrix<double> K(nodes_, nodes_);
  K.setFromTriplets(entries.begin(), entries.end());
  // Functions are free up to a constant: held at one node, where the right sides (which add up to zero) leave nothing.
  Eigen::SparseMatrix<double> held = K;
  held.coeffRef(0, 0) *= 2;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(held);
  field_ = factors.solve(right);

  const Eigen::Matrix<double, Eigen::Dynamic, 3> image = K * field_;
  F_ = field_.leftCols<2>().transpose() * image.leftCols<2>();
  // J = int |tau|^2, a sum of squares: I_y + I_z - int |grad omega|^2 is a small difference for thin walls.
  for (const Cell& cell : cells_) J_ += cell_torsion(cell);
  // Torque of the flexural stresses about the centroid: int (y Phi_z - z Phi_y) = -right_omega . Phi.
  const Vector2 torque = -field_.leftCols<2>().transpose() * right.col(2);
  shear_centre_ = {torque[1], -torque[0]};
}

double SaintVenant::cell_torsion(const Cell& cell) const {
  const double b = cell.y1 - cell.y0, h = cell.z1 - cell.z0;
  double sum = 0;
  for (std::size_t q = 0; q < 3; ++q)
    for (std::size_t p = 0; p < 3; ++p) {
      const double u = gauss_place[p], w = gauss_place[q];
      const Vector2 tau = gradient(cell, u, w).col(2) + Vector2(-(cell.z0 + w * h), cell.y0 + u * b);
      sum += b * h * gauss_weight[p] * gauss_weight[q] * tau.squaredNorm();
    }
  return sum;
}

Eigen::Matrix<double, 2, 3> SaintVenant::gradient(const Cell& cell, double u, double w) const {
  const Vector9 v_y = product(shape_slope(u), shape(w)) / (cell.y1 - cell.y0),
                v_z = product(shape(u), shape_slope(w)) / (cell.z1 - cell.z0);
  Eigen::Matrix<double, 2, 3> sum = Eigen::Matrix<double, 2, 3>::Zero();
  for (int k = 0; k < 9; ++k) {
    const auto values = field_.row(cell.node[static_cast<std::size_t>(k)]);
    sum.row(0) += v_y[k] * values;
    sum.row(1) += v_z[k] * values;
  }
  return sum;
}

bool SaintVenant::holds(const Cell& c, const Vector2& p) const {
  return p.x() >= c.y0 - tolerance_ && p.x() <= c.y1 + tolerance_ && p.y() >= c.z0 - tolerance_ &&
         p.y() <= c.z1 + tolerance_;
}

bool SaintVenant::contains(const Vector2& point) const {
  return std::any_of(cells_.begin(), cells_.end(), [&](const Cell& cell) { return holds(cell, point); });
}

Eigen::Matrix<double, 2, 3> SaintVenant::shear_stress(const Vector2& point) const {
  Eigen::Matrix<double, 2, 3> sum = Eigen::Matrix<double, 2, 3>::Zero();
  int count = 0;
  for (const Cell& cell : cells_) {
    if (!holds(cell, point)) continue;
    sum += gradient(cell, (point.x() - cell.y0) / (cell.y1 - cell.y0), (point.y() - cell.z0) / (cell.z1 - cell.z0));
    ++count;
  }
  if (count == 0) throw std::domain_error("a stress point lies outside of its section");
  sum /= count;
  sum.col(2) = (sum.col(2) + Vector2(-point.y(), point.x())) / J_;
  return sum;
}

}  // namespace bielle::mechanism
