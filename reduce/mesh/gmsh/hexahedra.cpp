#include "reduce/mesh/gmsh/hexahedra.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gmsh.h>

namespace bielle::reduce {

namespace {

// Numbers of cells of the mesh in gmsh's count.
double cells_of(const char* shape) {
  double count = 0;
  gmsh::option::getNumber(std::string("Mesh.Nb") + shape, count);
  return count;
}

bool only_quadrilaterals() { return cells_of("Quadrangles") > 0 && cells_of("Triangles") == 0; }

bool only_hexahedra() {
  return cells_of("Hexahedra") > 0 && cells_of("Tetrahedra") + cells_of("Prisms") + cells_of("Pyramids") == 0;
}

std::size_t boundary_count(int dimension, int entity) {
  gmsh::vectorpair boundary;
  gmsh::model::getBoundary({{dimension, entity}}, boundary, false, false, false);
  return boundary.size();
}

// Tells whether each volume has six faces with four edges each.
bool only_blocks() {
  gmsh::vectorpair volumes, faces;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::getEntities(faces, 2);
  return std::all_of(volumes.begin(), volumes.end(),
                     [](const auto& volume) { return boundary_count(3, volume.second) == 6; }) &&
         std::all_of(faces.begin(), faces.end(), [](const auto& face) { return boundary_count(2, face.second) == 4; });
}

// Meshes blocks by grids. @returns false if other cells than hexahedra result
bool mesh_blocks(const MeshSizes& sizes) {
  with_sizes(sizes, [] {
    gmsh::model::mesh::clear();
    gmsh::model::mesh::setTransfiniteAutomatic();
    gmsh::model::mesh::generate(3);
  });
  return only_hexahedra();
}

// Surfaces are meshed into triangles first: gmsh would otherwise divide them before it fills the volumes.
void mesh_by_subdivision(const MeshSizes& sizes) {
  with_sizes(sizes, [] {
    double factor = 1;
    gmsh::option::getNumber("Mesh.MeshSizeFactor", factor);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", 2 * factor);
    gmsh::model::mesh::clear();
    gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 0);
    gmsh::model::mesh::generate(2);
    gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 2);
    gmsh::model::mesh::generate(3);
    gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", factor);
  });
}

}  // namespace

HexahedralMesh mesh_hexahedra(GmshSession& session, const std::string& name, const MeshSizes& sizes) {
  HexahedralMesh result = HexahedralMesh::subdivided;
  session.compute(fmt::format("'{}' cannot be meshed into hexahedra", name), [&] {
    if (only_quadrilaterals()) {
      with_sizes(sizes, [] { gmsh::model::mesh::generate(3); });
      if (only_hexahedra()) result = HexahedralMesh::prescribed;
    } else if (only_blocks()) {
      if (mesh_blocks(sizes)) result = HexahedralMesh::structured;
    }
    if (result == HexahedralMesh::subdivided) {
      gmsh::model::mesh::removeConstraints();
      mesh_by_subdivision(sizes);
    }
    check_volumes_meshed(name);
  });
  return result;
}

std::string describe(HexahedralMesh mesh) {
  switch (mesh) {
    case HexahedralMesh::prescribed:
      return "hexahedra: as the geometry prescribes them";
    case HexahedralMesh::structured:
      return "hexahedra: in grids, since every volume is a block of six faces";
    default:
      return "hexahedra: tetrahedra of twice the size are divided into four each, since not every volume is a block of "
             "six faces";
  }
}

}  // namespace bielle::reduce
