#include "reduce/fe/solid.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/fe/cell_mass.hpp"
#include "reduce/fe/solid_block.hpp"

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

/// Integrals of density times 1, r and r r^T.
struct Moments {
  double volume = 0, mass = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(double part, double density, const Eigen::Vector3d& r) {
    const double weight = density * part;
    volume += part;
    mass += weight;
    first += weight * r;
    second += weight * r * r.transpose();
  }
  void add(const Moments& other) {
    volume += other.volume;
    mass += other.mass;
    first += other.first;
    second += other.second;
  }
};

/// Returns the moments of the solid, with r from `origin`. Cells are summed up in groups, which do not depend on the
/// number of threads.
template <int N>
Moments moments(const SolidBlock& block, CellDegrees degrees, const Eigen::Vector3d& origin, int threads) {
  constexpr Eigen::Index together = 512;
  const CellRules<N> rules(degrees);
  std::vector<Moments> parts(static_cast<std::size_t>((block.cells() + together - 1) / together));
#pragma omp parallel for num_threads(threads) schedule(dynamic)
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto begin = static_cast<Eigen::Index>(k) * together;
    for (Eigen::Index e = begin; e < std::min(begin + together, block.cells()); ++e) {
      const CellPoints<N> x = block.points<N>(e);
      const CellRule<N>& rule = rules.of(x);
      const double density = block.material(e).density;
      for (std::size_t p = 0; p < rule.size(); ++p) {
        const Eigen::Matrix3d jacobian = jacobian_at<N>(rule, p, x);
        parts[k].add(rule.weights(p) * jacobian.determinant(), density, x * rule.values[p] - origin);
      }
    }
  }
  Moments result;
  for (const Moments& part : parts) result.add(part);
  return result;
}

/// Returns the moments of the nodes of a lumped solid without its coatings. The lumped functions have the same volume.
template <int N>
Moments lumped_moments(const SolidBlock& block, const Eigen::Vector3d& origin) {
  const CellMass<N> mass;
  Moments result;
  double least_jacobian = 0;
  for (Eigen::Index e = 0; e < block.cells(); ++e) {
    const CellPoints<N> x = block.points<N>(e);
    const Eigen::VectorXd parts = lumped_mass(mass.of(x, least_jacobian), SolidCell<N>::is_second_order).diagonal();
    for (int a = 0; a < N; ++a) result.add(parts(a), block.material(e).density, x.col(a) - origin);
  }
  return result;
}

/// Returns the moments of a coating, which has no volume.
Moments coating_moments(const Solid& solid, const Coating& coating, const Eigen::Vector3d& origin) {
  Moments result;
  for_each_face(solid.mesh, coating.faces, [&](const FacePoints& face) {
    if (solid.lumped) {
      const Eigen::MatrixXd parts = lumped_mass(face_mass(face), cell_info(face.type).order == 2);
      for (Eigen::Index a = 0; a < face.nodes.size(); ++a)
        result.add(parts(a, a), coating.mass_per_area, solid.mesh.points.col(face.nodes(a)) - origin);
    } else {
      for (Eigen::Index p = 0; p < face.places.cols(); ++p)
        result.add(face.normals.col(p).norm(), coating.mass_per_area, face.places.col(p) - origin);
    }
  });
  result.volume = 0;
  return result;
}

/// Refuses cells whose centroid lies on the line of their wound material, which has no axes there.
void check_windings(const Solid& solid, const std::vector<std::string>& names) {
  for_each_block(solid, [&]<int N>(const SolidBlock& block) {
    for (Eigen::Index e = 0; e < block.cells(); ++e) {
      const Material& material = block.material(e);
      if (!material.is_wound()) continue;
      const Eigen::Vector3d centre = block.centroid(e), arm = centre - material.winding_point;
      const double size = (block.points<N>(e).colwise() - centre).colwise().norm().maxCoeff();
      if (arm.cross(material.winding_axis).norm() < 1e-3 * size)
        throw InputError(
            "materials." + names[static_cast<std::size_t>(block.material_number(e))],
            fmt::format("a cell at ({:.6g}, {:.6g}, {:.6g}) m lies on the line around which the axes turn, "
                        "where they have no direction",
                        centre.x(), centre.y(), centre.z()));
    }
  });
}

}  // namespace

Solid make_solid(const Mesh& mesh, const std::map<std::string, Material>& materials,
                 const std::map<std::string, std::string>& regions, Integration integration) {
  if (mesh.solid_count() == 0) {
    throw InputError("the mesh has no solid cells: a body needs a volume");
  }
  Solid solid{mesh, SolidCells(mesh), {}, std::vector<int>(mesh.solid_count(), -1), integration};
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
  std::vector<std::string> claimed_by(mesh.solid_count());
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
    for (const int cell : solid.cells.members(group->second)) {
      if (!claimed_by[cell].empty()) {
        throw InputError(fmt::format("regions.{}: its cells belong to region '{}' too; a cell has one material", region,
                                     claimed_by[cell]));
      }
      claimed_by[cell] = region;
      solid.material_of[cell] = number;
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
  check_windings(solid, names);
  return solid;
}

MassProperties mass_properties(const Solid& solid, int threads) {
  // A point of the body: differences keep their digits.
  const Eigen::Vector3d origin = solid.mesh.points.col(solid.cells.nodes(0)(0));
  // x x^T has degree 2 per order of the cell, the Jacobian of a curved tetrahedron degree 3, that of another cell 2 or
  // 5 along each coordinate.
  Moments all;
  for_each_block(solid, [&]<int N>(const SolidBlock& block) {
    constexpr int curved = N == 4 ? 2 : N == 10 ? 7 : SolidCell<N>::is_second_order ? 9 : 4;
    all.add(solid.lumped ? lumped_moments<N>(block, origin) : moments<N>(block, {2, curved}, origin, threads));
  });
  for (const Coating& coating : solid.coatings) all.add(coating_moments(solid, coating, origin));
  const Eigen::Vector3d r = all.first / all.mass;
  const Eigen::Matrix3d second = all.second - all.mass * r * r.transpose();
  MassProperties result;
  result.mass = all.mass;
  result.volume = all.volume;
  result.centre = origin + r;
  result.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return result;
}

std::vector<bool> points_of_solid(const Solid& solid) {
  std::vector<bool> result(solid.points(), false);
  for (int e = 0; e < solid.cells.size(); ++e) {
    for (const int a : solid.cells.nodes(e)) {
      result[a] = true;
    }
  }
  return result;
}

std::vector<int> nodes_of_solid(const Solid& solid) {
  const std::vector<bool> inside = points_of_solid(solid);
  std::vector<int> nodes;
  for (int a = 0; a < solid.points(); ++a)
    if (inside[a]) nodes.push_back(a);
  return nodes;
}

}  // namespace bielle::reduce
