#include "reduce/fe/weighted_nodes.hpp"

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

/// Nodes that are less than 1e-4 as wide as long stand in one line: coordinates of decks may have five digits.
constexpr double thinnest = 1e-8;

void check_not_in_line(const SurfaceIntegrals& nodes) {
  const char* remedy = "an interface needs three nodes that span an area";
  if (nodes.nodes.size() < 3)
    throw InputError(fmt::format("it ties {} of the solid: {}", counted(nodes.nodes.size(), "node"), remedy));
  const SymmetricEigenpairs moments = symmetric_eigenpairs(nodes.second_moment);
  if (moments.values(1) > thinnest * moments.values(2)) return;
  throw InputError(
      fmt::format("its {} stand in one line along {}, and a tie of them does not hold the rotation about it: {}",
                  counted(nodes.nodes.size(), "node"), direction_name(moments.vectors.col(2)), remedy));
}

}  // namespace

SurfaceIntegrals sum_over_nodes(const Mesh& mesh, const Group& nodes) {
  SurfaceIntegrals result;
  result.nodes = nodes.nodes;
  const auto count = static_cast<Eigen::Index>(nodes.nodes.size());
  result.weights = Eigen::Map<const Eigen::VectorXd>(nodes.weights.data(), count);
  result.area = result.weights.sum();
  const Eigen::Matrix3Xd points = mesh.points(Eigen::all, nodes.nodes);
  result.centroid = points * result.weights / result.area;
  const Eigen::Matrix3Xd arms = points.colwise() - result.centroid;
  result.first_moments = arms * result.weights.asDiagonal();
  result.second_moment = result.first_moments * arms.transpose();
  result.normals = Eigen::Matrix3Xd::Zero(3, count);
  check_not_in_line(result);
  return result;
}

SurfaceIntegrals integrate_tied(const Mesh& mesh, const std::string& group) {
  const auto found = mesh.groups.find(group);
  return found != mesh.groups.end() && found->second.dimension == 0 ? sum_over_nodes(mesh, found->second)
                                                                    : integrate_surface(mesh, group);
}

}  // namespace bielle::reduce
