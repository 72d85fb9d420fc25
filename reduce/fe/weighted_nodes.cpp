#include "reduce/fe/weighted_nodes.hpp"

#include <utility>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

/// Nodes that are less than 1e-4 as wide as long stand in one line: coordinates of decks may have five digits.
constexpr double thinnest = 1e-8;

/// @param name  "nodes of RBE2 12"
void check_not_in_line(const SurfaceIntegrals& nodes, const std::string& name) {
  const char* remedy = "an interface, or a mass, needs three nodes that span an area";
  if (nodes.nodes.size() < 3)
    throw InputError(fmt::format("the {} are {} of the solid: {}", name, counted(nodes.nodes.size(), "node"), remedy));
  const SymmetricEigenpairs moments = symmetric_eigenpairs(nodes.second_moment);
  if (moments.values(1) > thinnest * moments.values(2)) return;
  throw InputError(
      fmt::format("the {} {} stand in one line along {}, and a tie of them does not hold the rotation about it: {}",
                  nodes.nodes.size(), name, direction_name(moments.vectors.col(2)), remedy));
}

}  // namespace

SurfaceIntegrals sum_over_nodes(const Mesh& mesh, std::vector<int> nodes, const Eigen::VectorXd& weights) {
  SurfaceIntegrals result;
  Eigen::Index heaviest = 0;  // origin of the sums, for accuracy: its distance from the centroid may be tiny, and its
                              // weight huge
  weights.maxCoeff(&heaviest);
  const Eigen::Vector3d origin = mesh.points.col(nodes[static_cast<std::size_t>(heaviest)]);
  const Eigen::Matrix3Xd from_origin = mesh.points(Eigen::all, nodes).colwise() - origin;
  result.nodes = std::move(nodes);
  result.weights = weights;
  result.area = weights.sum();
  const Eigen::Vector3d centroid = from_origin * weights / result.area;
  result.centroid = origin + centroid;
  const Eigen::Matrix3Xd arms = from_origin.colwise() - centroid;
  result.first_moments = arms * weights.asDiagonal();
  result.second_moment = result.first_moments * arms.transpose();
  result.normals = Eigen::Matrix3Xd::Zero(3, weights.size());
  return result;
}

SurfaceIntegrals integrate_tied(const Mesh& mesh, const std::string& name) {
  const auto found = mesh.groups.find(name);
  if (found == mesh.groups.end() || found->second.dimension != 0) return integrate_surface(mesh, name);
  const Group& group = found->second;
  const auto count = static_cast<Eigen::Index>(group.nodes.size());
  if (count == 0) throw InputError(fmt::format("the {} are none of the solid", name));
  SurfaceIntegrals nodes =
      sum_over_nodes(mesh, group.nodes, Eigen::Map<const Eigen::VectorXd>(group.weights.data(), count));
  check_not_in_line(nodes, name);
  return nodes;
}

}  // namespace bielle::reduce
