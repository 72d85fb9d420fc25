#include "reduce/reduction/point_ties.hpp"

#include <set>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/superelement/point_weights.hpp"

namespace bielle::reduce {

namespace {

/// @param loads  (3 nodes, 6) on the nodes
SparseRows on_points(Eigen::Index points, const std::vector<int>& nodes, const Eigen::MatrixXd& loads) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (int i = 0; i < 3; ++i)
      for (int axis = 0; axis < 6; ++axis)
        entries.emplace_back(3 * nodes[a] + i, axis, loads(3 * static_cast<Eigen::Index>(a) + i, axis));
  SparseRows result(3 * points, 6);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

TiedPoint tie_to_surface(const Solid& solid, const PointRequest& request) {
  const SurfaceIntegrals surface = integrate_surface(solid.mesh, request.group);
  check_position(request.position, surface, solid.mesh);
  Interface node;
  node.position = request.position.value_or(surface.centroid);
  return {request, node.position, on_points(solid.points(), surface.nodes, spread_unit_loads(surface, node))};
}

/// Ties a point to the mesh. Points of the mesh outside the solid do not move with it and are not used.
TiedPoint tie_to_mesh(const Solid& solid, const PointRequest& request, const std::string& body) {
  const std::vector<int> inside = nodes_of_solid(solid);
  std::vector<int> nodes;
  const Eigen::Matrix3Xd points = solid.mesh.points(Eigen::all, inside);
  const PointWeights weights = point_weights(points, request.position.value(), body);
  for (const Eigen::Index node : weights.nodes) nodes.push_back(inside[node]);
  return {request, *request.position, on_points(solid.points(), nodes, weights.rows.transpose())};
}

}  // namespace

std::vector<TiedPoint> tie_points(const Solid& solid, const std::vector<PointRequest>& requests,
                                  const std::string& body) {
  std::vector<TiedPoint> result;
  std::set<std::string> names;
  for (const PointRequest& request : requests)
    about(request.subject, [&] {
      if (!names.insert(request.name).second) throw InputError(fmt::format("there are two points '{}'", request.name));
      result.push_back(request.group.empty() ? tie_to_mesh(solid, request, body) : tie_to_surface(solid, request));
    });
  return result;
}

std::map<std::string, NamedPoint> named_points(const std::vector<TiedPoint>& points, const RowMatrix& shapes) {
  std::map<std::string, NamedPoint> result;
  for (const TiedPoint& point : points)
    result[point.request.name] = {point.position, point.spread.transpose() * shapes, point.request.residual};
  return result;
}

}  // namespace bielle::reduce
