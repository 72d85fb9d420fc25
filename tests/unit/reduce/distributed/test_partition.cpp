// Tests of the division of cells: each cell is in one part, parts have equal sizes, and their matrices add up to the
// solid's.
#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "reduce/distributed/partition.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/fe/surface.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

struct Bar {
  Mesh mesh = test::box_mesh({{2, 1, 0.5}, {6, 3, 2}});
  Solid solid = make_solid(mesh, {{"steel", Material::isotropic(2e11, 0.3, 7800)}}, {{"all", "steel"}});
};

}  // namespace

TEST_CASE("each cell is in one part, and all parts except the first have one size") {
  const Bar box;
  const auto parts = GENERATE(1, 2, 3, 7);
  std::multiset<int> seen;
  std::size_t least = box.mesh.solid_count(), most = 0;
  const auto divided = divided_cells(box.solid, parts);
  for (const std::vector<int>& cells : divided) {
    seen.insert(cells.begin(), cells.end());
    if (&cells == &divided.front() && parts > 1) continue;
    least = std::min(least, cells.size());
    most = std::max(most, cells.size());
  }
  CHECK(seen.size() == static_cast<std::size_t>(box.solid.cells.size()));
  CHECK(std::set<int>(seen.begin(), seen.end()).size() == seen.size());
  CHECK(most - least <= 3);  // the first part may have one cell more for each halving
  if (parts > 1) CHECK(std::abs(3 * static_cast<int>(divided.front().size()) - static_cast<int>(most)) <= 9);
}

TEST_CASE("a body of two parts is divided across its length") {
  const Bar box;
  const auto parts = divided_cells(box.solid, 2);
  const SolidPart low = part_of(box.solid, parts[0], {}), high = part_of(box.solid, parts[1], {});
  CHECK(low.share.points.row(0).maxCoeff() <= 2.0 / 3 + 1e-12);  // a quarter is one and a half of six slices
  CHECK(high.share.points.row(0).minCoeff() >= 1.0 / 3 - 1e-12);
}

TEST_CASE("if there are more parts than cells, some are empty") {
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {1, 1, 1}, false});
  const Solid solid = make_solid(mesh, {{"steel", Material::isotropic(2e11, 0.3, 7800)}}, {{"all", "steel"}});
  const auto parts = divided_cells(solid, 20);
  REQUIRE(parts.size() == 20);
  CHECK(std::any_of(parts.begin(), parts.end(), [](const auto& cells) { return cells.empty(); }));
  for (const std::vector<int>& cells : parts) CHECK(part_of(solid, cells, {}).share.material_of.size() == cells.size());
}

TEST_CASE("matrices of the parts add up to those of the solid, with and without coatings and lumped masses") {
  Bar box;
  for (const char* name : {"x0", "y1", "z0"})
    box.solid.coatings.push_back({surface_group(box.mesh, name), name[0] == 'x' ? 3000.0 : 500.0});
  box.solid.lumped = GENERATE(false, true);
  const CoatedCells coated = coated_cells(box.solid);
  const NodeGraph graph = node_graph(box.solid.mesh);
  const RowMatrix u = RowMatrix::Random(3 * box.solid.points(), 2);
  const RowMatrix force = assemble_stiffness(box.solid, graph).multiply(u);
  const RowMatrix momentum = assemble_mass(box.solid, graph).multiply(u, 3);
  RowMatrix sum_of_forces = RowMatrix::Zero(u.rows(), 2), sum_of_momenta = sum_of_forces;
  for (const std::vector<int>& cells : divided_cells(box.solid, 3)) {
    SolidPart part = part_of(box.solid, cells, coated);
    const Mesh mesh{part.share.points, part.share.blocks, {}};
    const Solid solid{mesh,
                      SolidCells(mesh),
                      box.solid.materials,
                      part.share.material_of,
                      part.share.integration,
                      part.share.coatings,
                      part.share.lumped};
    const NodeGraph own = node_graph(solid.mesh);
    RowMatrix rows(3 * solid.points(), 2);
    for (std::size_t a = 0; a < part.points.size(); ++a)
      rows.middleRows<3>(3 * static_cast<Eigen::Index>(a)) = u.middleRows<3>(3 * part.points[a]);
    const RowMatrix forces = assemble_stiffness(solid, own).multiply(rows);
    const RowMatrix momenta = assemble_mass(solid, own).multiply(rows, 3);
    for (std::size_t a = 0; a < part.points.size(); ++a) {
      sum_of_forces.middleRows<3>(3 * part.points[a]) += forces.middleRows<3>(3 * static_cast<Eigen::Index>(a));
      sum_of_momenta.middleRows<3>(3 * part.points[a]) += momenta.middleRows<3>(3 * static_cast<Eigen::Index>(a));
    }
  }
  CHECK((sum_of_forces - force).norm() < 1e-13 * force.norm());
  CHECK((sum_of_momenta - momentum).norm() < 1e-13 * momentum.norm());
}
