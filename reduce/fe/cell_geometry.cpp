#include "reduce/fe/cell_geometry.hpp"

#include <map>

#include "reduce/mesh/cell_type.hpp"

namespace bielle::reduce {
namespace {

bool has_straight_edges(const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  int node = 4;
  for (const auto& [a, b] : cell_info(CellType::tet10).edges)
    if ((x.col(node++) - (x.col(a) + x.col(b)) / 2).squaredNorm() > 1e-20 * (x.col(b) - x.col(a)).squaredNorm())
      return false;
  return true;
}

/// The linear map that fits the nodes of a type best: x = x_m + A (xi - xi_m), A = (x - x_m) inverse.
struct LinearFit {
  Eigen::Matrix3Xd centred;                          ///< xi - xi_m
  Eigen::Matrix<double, Eigen::Dynamic, 3> inverse;  ///< its pseudo-inverse

  explicit LinearFit(CellType type) : centred(local_nodes(type)) {
    const Eigen::Vector3d middle = centred.rowwise().mean();
    centred.colwise() -= middle;
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    for (const auto& node : centred.colwise()) square += node * node.transpose();
    const Eigen::Matrix3d of_square = square.inverse();
    inverse.resize(centred.cols(), 3);
    for (Eigen::Index a = 0; a < centred.cols(); ++a) inverse.row(a) = (of_square * centred.col(a)).transpose();
  }

  bool maps_to(const Eigen::Ref<const Eigen::Matrix3Xd>& x) const {
    const Eigen::Vector3d middle = x.rowwise().mean();
    Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
    for (Eigen::Index a = 0; a < x.cols(); ++a) map += (x.col(a) - middle) * inverse.row(a);
    double away = 0, size = 0;
    for (Eigen::Index a = 0; a < x.cols(); ++a) {
      const Eigen::Vector3d around = x.col(a) - middle;
      away += (around - map * centred.col(a)).squaredNorm();
      size += around.squaredNorm();
    }
    return away <= 1e-20 * size;
  }
};

/// Returns the fit of a type of solid cells.
const LinearFit& linear_fit(CellType type) {
  static const std::map<CellType, LinearFit> fits = [] {
    std::map<CellType, LinearFit> all;
    for (const CellInfo& info : cell_table())
      if (info.dimension == 3) all.emplace(info.type, info.type);
    return all;
  }();
  return fits.at(type);
}

}  // namespace

bool is_straight(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& x) {
  if (type == CellType::tet4) return true;
  if (type == CellType::tet10) return has_straight_edges(x);
  return linear_fit(type).maps_to(x);
}

}  // namespace bielle::reduce
