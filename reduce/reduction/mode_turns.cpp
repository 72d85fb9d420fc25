#include "reduce/reduction/mode_turns.hpp"

#include <algorithm>
#include <vector>

#include "reduce/fe/mean_strain.hpp"
#include "reduce/superelement/point_weights.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index most_places = 24;

/// Orders columns of points so that each is as far as possible from those before it.
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

/// Calls act(k, number of places, weights of place k, nodes of the mesh).
template <class Act>
void for_each_place(const Solid& solid, const std::string& body, const Act& act) {
  const std::vector<int> inside = nodes_of_solid(solid);
  const Eigen::Matrix3Xd points = solid.mesh.points(Eigen::all, inside);
  const std::vector<Eigen::Index> places = spread_over(points);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const PointWeights weights = point_weights(points, points.col(places[k]), body);
    std::vector<Eigen::Index> nodes;
    for (const Eigen::Index node : weights.nodes) nodes.push_back(inside[static_cast<std::size_t>(node)]);
    act(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(places.size()), weights, nodes);
  }
}

}  // namespace

Eigen::MatrixXd mode_turns(const Solid& solid, const RowMatrix& shapes, Eigen::Index first, const std::string& body) {
  const Eigen::Index modes = shapes.cols() - first;
  if (modes == 0) return {};
  Eigen::MatrixXd turns;
  for_each_place(
      solid, body,
      [&](Eigen::Index k, Eigen::Index places, const PointWeights& weights, const std::vector<Eigen::Index>& nodes) {
        if (k == 0) turns = Eigen::MatrixXd::Zero(3 * places, modes);
        for (std::size_t a = 0; a < nodes.size(); ++a)
          turns.middleRows<3>(3 * k) += weights.rows.block<3, 3>(3, 3 * static_cast<Eigen::Index>(a)) *
                                        shapes.block(3 * nodes[a], first, 3, modes);
      });
  return turns;
}

Eigen::MatrixXd place_strains(const Solid& solid, const RowMatrix& shapes, const std::string& body) {
  Eigen::MatrixXd strains;
  for_each_place(
      solid, body,
      [&](Eigen::Index k, Eigen::Index places, const PointWeights& weights, const std::vector<Eigen::Index>& nodes) {
        if (k == 0) strains = Eigen::MatrixXd::Zero(6 * (places + 1), shapes.cols());
        for (std::size_t a = 0; a < nodes.size(); ++a)
          strains.middleRows<6>(6 * k) +=
              weights.strains.middleCols<3>(3 * static_cast<Eigen::Index>(a)) * shapes.middleRows(3 * nodes[a], 3);
      });
  strains.bottomRows<6>() = mean_strain(solid, shapes);
  return strains;
}

}  // namespace bielle::reduce
