// The solid cells of a mesh with their materials and coatings: the assembly integrates over them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/fe/integration.hpp"
#include "reduce/fe/material.hpp"
#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/solid_cells.hpp"

namespace bielle::reduce {

/// Mass without stiffness on a surface: paint, lining.
struct Coating {
  Group faces;  ///< the coated faces of the mesh; faces that occur in several coatings have the mass of each
  double mass_per_area = 0;  ///< [kg/m^2]
};

/// Isoparametric cells of linear elastic material. It refers to its mesh.
struct Solid {
  const Mesh& mesh;
  SolidCells cells;
  std::vector<Material> materials;
  std::vector<int> material_of;  ///< number of each cell's material in `materials`
  Integration integration = Integration::standard;
  std::vector<Coating> coatings = {};
  bool lumped = false;  ///< whether its mass matrix is diagonal (assembly.hpp), in place of the consistent one

  Eigen::Index points() const { return mesh.points.cols(); }
};

/// Gives every solid cell its material.
/// @param regions  volume group -> name of a material; the key "all" stands for every cell that belongs to no other
/// listed group
/// @throws InputError for a group that the mesh does not have or that is no volume, a material that is not defined,
///         cells in two listed groups or in none
Solid make_solid(const Mesh& mesh, const std::map<std::string, Material>& materials,
                 const std::map<std::string, std::string>& regions, Integration integration = Integration::standard);

/// Mass, its centre and the inertia about it, integrated over the cells and coatings. For a lumped mass matrix they are
/// sums over the nodes: the mass is that of the integral, while centre and inertia have an error of the mesh.
struct MassProperties {
  double mass = 0;                                    ///< [kg]
  double volume = 0;                                  ///< [m^3]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre, body axes [kg m^2]
};

MassProperties mass_properties(const Solid& solid, int threads = 1);

/// Tells for each point whether it belongs to a solid cell.
std::vector<bool> points_of_solid(const Solid& solid);
/// Returns the points of solid cells, ascending.
std::vector<int> nodes_of_solid(const Solid& solid);

}  // namespace bielle::reduce
