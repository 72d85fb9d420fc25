#include "reduce/superelement/point_weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/LU>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle {

namespace {

using Eigen::Index, Eigen::Matrix3d, Eigen::Matrix3Xd, Eigen::Matrix4Xd, Eigen::Vector3d, Eigen::VectorXd;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t neighbours = 15;
/// A node counts alone if it is nearer than its neighbours by this factor.
constexpr double closeness = 1e-2;
/// Nodes lie in a plane if their extent across it is less than this share of that along it.
constexpr double flatness = 1e-6;

/// Returns a~, with a~ b = a x b.
Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d s;
  s << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return s;
}

/// Returns the mesh nodes nearest to a point, ascending in distance.
std::vector<Index> nodes_around(const Matrix3Xd& points, const Vector3d& point) {
  std::vector<Index> nodes(static_cast<std::size_t>(points.cols()));
  std::iota(nodes.begin(), nodes.end(), Index{0});
  const std::size_t count = std::min(neighbours, nodes.size());
  std::partial_sort(
      nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(count), nodes.end(),
      [&](Index a, Index b) { return (points.col(a) - point).squaredNorm() < (points.col(b) - point).squaredNorm(); });
  nodes.resize(count);
  return nodes;
}

/// Returns displacement and gradient rows of the nearest linear field: u(x) = c_0 + c_j (x_j - point_j), weights of the
/// nodes (4,k).
Matrix4Xd linear_weights(const Matrix3Xd& arms, const VectorXd& weight) {
  Matrix4Xd rows(4, arms.cols());
  rows.row(0).setOnes();
  rows.bottomRows<3>() = arms;
  const Matrix4Xd weighted = rows * weight.asDiagonal();
  return solve_symmetric(product(weighted, rows.transpose()), weighted);
}

/// Tells whether nodes span space about their mean.
bool in_space(const Matrix3Xd& arms) {
  const Matrix3Xd spread = arms.colwise() - Vector3d(arms.rowwise().mean());
  const Matrix3d moment = product(spread, spread.transpose());
  return moment.determinant() > flatness * std::pow(moment.trace() / 3, 3);
}

/// Sets the rows of the nearest linear field. @param size  size of the arms [m], for numbers of order 1
void set_rows_of_linear_field(const Matrix3Xd& arms, const VectorXd& weight, double size, PointWeights& result) {
  const Matrix4Xd field = linear_weights(arms / size, weight);
  Eigen::MatrixXd& rows = result.rows;
  rows.resize(6, 3 * arms.cols());
  for (Index k = 0; k < arms.cols(); ++k) {
    rows.block<3, 3>(0, 3 * k) = field(0, k) * Matrix3d::Identity();
    const Vector3d gradient = field.col(k).tail<3>() / size;
    rows.block<3, 3>(3, 3 * k) = 0.5 * cross_matrix(gradient);
    auto strain = result.strains.block<6, 3>(0, 3 * k);
    strain.topRows<3>() = gradient.asDiagonal();
    strain.bottomRows<3>() << 0, gradient.z(), gradient.y(), gradient.z(), 0, gradient.x(), gradient.y(), gradient.x(),
        0;
  }
}

/// Returns the rows of the nearest rigid motion: u = c + theta x arm.
Eigen::MatrixXd rows_of_rigid_motion(const Matrix3Xd& arms, const VectorXd& weight) {
  Matrix6 normal = Matrix6::Zero();
  Eigen::MatrixXd right(6, 3 * arms.cols());
  for (Index k = 0; k < arms.cols(); ++k) {
    Eigen::Matrix<double, 3, 6> motion;
    motion << Matrix3d::Identity(), -cross_matrix(arms.col(k));
    normal += weight[k] * motion.transpose() * motion;
    right.middleCols<3>(3 * k) = weight[k] * motion.transpose();
  }
  return solve_symmetric(normal, right);
}

}  // namespace

double distance_from_mesh(const Matrix3Xd& nodes, const Vector3d& point) {
  if (nodes.cols() == 0) return std::numeric_limits<double>::infinity();
  return std::sqrt((nodes.colwise() - point).colwise().squaredNorm().minCoeff());
}

PointWeights point_weights(const Matrix3Xd& nodes, const Vector3d& point, const std::string& body) {
  PointWeights result;
  result.nodes = nodes_around(nodes, point);
  const auto count = static_cast<Index>(result.nodes.size());
  Matrix3Xd arms(3, count);
  for (Index k = 0; k < count; ++k) arms.col(k) = nodes.col(result.nodes[static_cast<std::size_t>(k)]) - point;
  const double nearest = arms.col(0).norm(), spacing = count > 1 ? (arms.col(1) - arms.col(0)).norm() : 0;
  if (nearest > 3 * spacing)
    throw InputError(
        fmt::format("stands {:.3g} m away from the nearest node of the mesh of '{}', whose nodes are {:.3g} m "
                    "apart there; the position is in the axes of the mesh",
                    nearest, body, spacing));
  const double size = arms.colwise().norm().maxCoeff();
  result.weights = (arms.colwise().squaredNorm().array() / (size * size) + closeness * closeness)
                       .square()
                       .inverse()
                       .matrix()
                       .transpose();
  result.strains = Eigen::MatrixXd::Zero(6, 3 * count);
  if (in_space(arms))
    set_rows_of_linear_field(arms, result.weights, size, result);
  else
    result.rows = rows_of_rigid_motion(arms, result.weights);
  return result;
}

}  // namespace bielle
