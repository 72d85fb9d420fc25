#include "reduce/reduction/mode_turns.hpp"

#include <algorithm>
#include <vector>

#include "reduce/superelement/point_weights.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index most_places = 24;

/// Columns of points, each as far as possible from those before it.
std::vector<Eigen::Index> spread_over(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d middle = points.rowwise().mean();
  std::vector<Eigen::Index> places;
  Eigen::RowVectorXd distance = (points.colwise() - middle).colwise().squaredNorm();
  for (Eigen::Index k = 0; k < std::min(most_places, points.cols()); ++k) {
    Eigen::Index farthest = 0;
    distance.maxCoeff(&farthest);
    const Eigen::RowVectorXd from_here = (points.colwise() - points.col(farthest)).colwise().squaredNorm();
    distance = k == 0 ? from_here : distance.cwiseMin(from_here);
    places.push_back(farthest);
  }
  return places;
}

}  // namespace

Eigen::MatrixXd mode_turns(const Solid& solid, const RowMatrix& shapes, Eigen::Index first, const std::string& body) {
  const Eigen::Index modes = shapes.cols() - first;
  if (modes == 0) return {};
  const std::vector<bool> in_solid = points_of_solid(solid);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index a = 0; a < solid.points(); ++a)
    if (in_solid[static_cast<std::size_t>(a)]) inside.push_back(a);
  const Eigen::Matrix3Xd points = solid.mesh.points(Eigen::all, inside);
  const std::vector<Eigen::Index> places = spread_over(points);
  Eigen::MatrixXd turns = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(places.size()), modes);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const PointWeights weights = point_weights(points, points.col(places[k]), body);
    for (std::size_t a = 0; a < weights.nodes.size(); ++a)
      turns.middleRows<3>(3 * static_cast<Eigen::Index>(k)) +=
          weights.rows.block<3, 3>(3, 3 * static_cast<Eigen::Index>(a)) *
          shapes.block(3 * inside[static_cast<std::size_t>(weights.nodes[a])], first, 3, modes);
  }
  return turns;
}

}  // namespace bielle::reduce
