#include "import_support.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/corners.hpp"
#include "reduce/mesh/gmsh/session.hpp"
#include "reduce/mesh/import.hpp"
#include "tests/support/messages.hpp"

namespace bielle::test {

using namespace bielle::reduce;

MeshRequest request(const std::string& path) {
  MeshRequest result;
  result.path = path;
  return result;
}

Mesh import(const MeshRequest& request) {
  Progress progress(true);
  return import_mesh(request, progress);
}

std::string import_message(const MeshRequest& request) {
  return message_of<InputError>([&] { import(request); });
}

SurfaceSelection selection(const std::string& group, const SurfaceSelector& selector) {
  return {group, {selector}, ""};
}

std::string msh(const std::vector<std::string>& points, const std::vector<std::string>& elements,
                const std::vector<std::string>& names) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const auto section = [&](const std::string& name, const std::vector<std::string>& rows, bool numbered) {
    text += fmt::format("${}\n{}\n", name, rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      text += numbered ? fmt::format("{} {}\n", i + 1, rows[i]) : rows[i] + "\n";
    text += fmt::format("$End{}\n", name);
  };
  if (!names.empty()) section("PhysicalNames", names, false);
  section("Nodes", points, true);
  section("Elements", elements, true);
  return text;
}

std::string as_msh(const reduce::Mesh& mesh) {
  std::vector<std::string> points, elements, names;
  for (const auto& x : mesh.points.colwise())
    points.push_back(fmt::format("{:.17g} {:.17g} {:.17g}", x[0], x[1], x[2]));
  int number = 0;
  for (const auto& [name, group] : mesh.groups) {
    names.push_back(fmt::format("{} {} \"{}\"", group.dimension, ++number, name));
    for (const reduce::GroupPart& part : group.parts)
      for (const int cell : part.cells) {
        std::string row = fmt::format("{} 2 {} {}", static_cast<int>(part.type), number, number);
        for (const int node : mesh.block(part.type)->nodes.col(cell)) row += fmt::format(" {}", node + 1);
        elements.push_back(row);
      }
  }
  return msh(points, elements, names);
}

void gmsh_convert(const std::string& source, const std::string& target, double size, int order) {
  GmshSession session;
  session.read("test", [&] {
    gmsh::option::setString("Geometry.OCCTargetUnit", "MM");  // gmsh writes STEP files in mm
    gmsh::open(source);
    gmsh::option::setNumber("Mesh.MeshSizeMax", size);
    gmsh::option::setNumber("Mesh.ElementOrder", order);
    if (!target.ends_with(".step") && !target.ends_with(".brep")) gmsh::model::mesh::generate(3);
    gmsh::write(target);
  });
}

Eigen::Vector3d area_vector(const Mesh& mesh, const std::string& group) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const GroupPart& part : mesh.groups.at(group).parts)
    for (int cell : part.cells)
      sum += reduce::area_vector(mesh.points, corners_of(part.type, mesh.block(part.type)->nodes.col(cell)));
  return sum;
}

double corner_area(const Mesh& mesh, const std::string& group) {
  double sum = 0;
  for (const GroupPart& part : mesh.groups.at(group).parts)
    for (int cell : part.cells)
      sum += area_of(mesh.points, corners_of(part.type, mesh.block(part.type)->nodes.col(cell)));
  return sum;
}

}  // namespace bielle::test
