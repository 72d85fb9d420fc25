#include "mechanism/elements/superelement/recovery/stress_recovery.hpp"

#include <algorithm>

#include <Eigen/LU>
#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

StressRecovery::StressRecovery(const Superelement& body)
    : matrix(body.stress_recovery), nodes(body.stress_nodes), material_of(body.stress_origin.material_of) {
  if (matrix.rows() == 0)
    throw InputError(
        fmt::format("the superelement '{}' holds nothing to recover stress from; reduce it with `recovery: {{stress: "
                    "surface}}`, or "
                    "`all`; that of another program's matrices comes from their file",
                    body.name));
  points = body.mesh.points(Eigen::all, nodes);
  for (const StressMaterial& material : body.stress_origin.materials)
    compliance.push_back(material.elasticity.inverse());
  for (const auto& [name, rows] : body.stress_origin.groups) {
    groups.push_back(name);
    group_rows.push_back(rows);
  }
}

StressRecovery StressRecovery::alone(int row) const {
  StressRecovery one;
  const auto place = static_cast<std::size_t>(row);
  one.matrix = matrix.middleRows<6>(6 * row);
  one.nodes = {nodes[place]};
  one.points = points.col(row);
  if (!compliance.empty()) {
    one.compliance = {compliance[static_cast<std::size_t>(material_of[place])]};
    one.material_of = {0};
  }
  return one;
}

int StressRecovery::nearest(const Vector3& point) const {
  Eigen::Index row = 0;
  const double distance = std::sqrt((points.colwise() - point).colwise().squaredNorm().minCoeff(&row));
  Eigen::VectorXd others = (points.colwise() - Vector3(points.col(row))).colwise().squaredNorm();
  others[row] = others.maxCoeff();
  const double spacing = std::sqrt(others.minCoeff());
  // Largest distance in units of the spacing of nodes, which is half an edge in second-order cells.
  constexpr double cell = 4;
  if (distance > cell * spacing)
    throw InputError(fmt::format(
        "the nearest node where stress is kept is {:.3g} m away: node {} at [{:.6g}, {:.6g}, {:.6g}] m, where nodes "
        "are "
        "{:.3g} m apart; points are given in the axes of the mesh, and `recovery: {{stress: surface}}` keeps no stress "
        "inside the body",
        distance, nodes[static_cast<std::size_t>(row)], points(0, row), points(1, row), points(2, row), spacing));
  return static_cast<int>(row);
}

int StressRecovery::place_of(int node) const {
  const auto found = std::find(nodes.begin(), nodes.end(), node);
  if (found == nodes.end())
    throw InputError(
        fmt::format("the superelement keeps no stress at node {} of its mesh, counted from 0; it does at "
                    "{} nodes",
                    node, nodes.size()));
  return static_cast<int>(found - nodes.begin());
}

}  // namespace bielle::mechanism
