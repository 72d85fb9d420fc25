#include "reduce/fe/solid.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/fe/cell_geometry.hpp"

namespace bielle::reduce {

namespace {

template <typename Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> result;
  for (const auto& entry : map) {
    result.push_back(entry.first);
  }
  return result;
}

std::vector<std::string> volume_groups(const Mesh& mesh) {
  std::vector<std::string> result{"all"};
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension == 3) {
      result.push_back(name);
    }
  }
  return result;
}

/// Sums over all points of the rules: visit(weight * Jacobian, x, cell).
template <int N, typename Visitor>
void integrate(const Solid& solid, CellDegrees degrees, const Visitor& visit) {
  const CellRules<N> rules(degrees);
  for (Eigen::Index e = 0; e < solid.cells(); ++e) {
    const CellPoints<N> x = cell_points<N>(solid.mesh.points, solid.nodes, e);
    const CellRule<N>& rule = rules.of(x);
    for (std::size_t p = 0; p < rule.size(); ++p) {
      const Eigen::Matrix3d jacobian = x * rule.local_gradients[p];
      visit(rule.weights(p) * jacobian.determinant(), Eigen::Vector3d(x * rule.values[p]), e);
    }
  }
}

}  // namespace

Solid make_solid(const Mesh& mesh, const std::map<std::string, Material>& materials,
                 const std::map<std::string, std::string>& regions) {
  const CellBlock* block = mesh.block(CellType::tet10) ? mesh.block(CellType::tet10) : mesh.block(CellType::tet4);
  if (!block || block->nodes.cols() == 0) {
    throw InputError("the mesh has no solid cells: a body needs a volume");
  }
  Solid solid{mesh, block->type, block->nodes, {}, std::vector<int>(block->nodes.cols(), -1)};
  const std::vector<std::string> names = keys(materials);
  for (const auto& [name, material] : materials) {
    solid.materials.push_back(material);
  }
  const auto material_number = [&](const std::string& region, const std::string& material) {
    const auto place = std::find(names.begin(), names.end(), material);
    if (place == names.end()) {
      throw InputError(
          fmt::format("regions.{}: there is no material '{}'{}", region, material, did_you_mean(material, names)));
    }
    return static_cast<int>(place - names.begin());
  };
  std::vector<std::string> claimed_by(block->nodes.cols());
  for (const auto& [region, material] : regions) {
    if (region == "all") {
      continue;
    }
    const int number = material_number(region, material);
    const auto group = mesh.groups.find(region);
    if (group == mesh.groups.end() || group->second.dimension != 3) {
      throw InputError(fmt::format("regions.{0}: the mesh has no volume group '{0}'{1}", region,
                                   did_you_mean(region, volume_groups(mesh))));
    }
    for (const GroupPart& part : group->second.parts) {
      if (part.type != block->type) {
        continue;
      }
      for (const int cell : part.cells) {
        if (!claimed_by[cell].empty()) {
          throw InputError(fmt::format("regions.{}: its cells belong to region '{}' too; a cell has one material",
                                       region, claimed_by[cell]));
        }
        claimed_by[cell] = region;
        solid.material_of[cell] = number;
      }
    }
  }
  if (const auto all = regions.find("all"); all != regions.end()) {
    const int number = material_number("all", all->second);
    std::replace(solid.material_of.begin(), solid.material_of.end(), -1, number);
  }
  if (const auto without = std::count(solid.material_of.begin(), solid.material_of.end(), -1)) {
    throw InputError(
        fmt::format("regions: {} of {} cells {} no material; name the volume groups that are missing or use 'all'",
                    without, solid.material_of.size(), without == 1 ? "has" : "have"));
  }
  return solid;
}

MassProperties mass_properties(const Solid& solid) {
  MassProperties result;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  const Eigen::Vector3d origin =
      solid.mesh.points.col(solid.nodes(0, 0));  // near the body: differences keep their digits
  const auto visit = [&](double volume, const Eigen::Vector3d& x, Eigen::Index cell) {
    const double mass = solid.materials[solid.material_of[cell]].density * volume;
    const Eigen::Vector3d r = x - origin;
    result.volume += volume;
    result.mass += mass;
    first += mass * r;
    second += mass * r * r.transpose();
  };
  // x x^T has degree 2 per order of the cell, the Jacobian of a curved cell degree 3.
  if (solid.type == CellType::tet4) {
    integrate<4>(solid, {2, 2}, visit);
  } else {
    integrate<10>(solid, {2, 7}, visit);
  }
  const Eigen::Vector3d r = first / result.mass;
  second -= result.mass * r * r.transpose();
  result.centre = origin + r;
  result.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return result;
}

std::vector<bool> points_of_solid(const Solid& solid) {
  std::vector<bool> result(solid.points(), false);
  for (const int a : solid.nodes.reshaped()) {
    result[a] = true;
  }
  return result;
}

}  // namespace bielle::reduce
