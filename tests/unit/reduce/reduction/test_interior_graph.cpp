#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/reduction/fixed_interface_body.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

std::vector<InterfaceRequest> ends_held(int variant) {
  std::vector<InterfaceRequest> requests{test::interface("a", "x0", variant == 1 ? Tie::average : Tie::rigid),
                                         test::interface("b", "x1", variant == 0 ? Tie::rigid : Tie::average)};
  if (variant == 0) requests[1].kept = {true, true, true, false, true, false};  // two released directions
  if (variant == 2) requests[0].kept = {true, true, true, false, false, false};
  return requests;
}

struct Held {
  Mesh mesh = test::twisted_block();
  Solid solid = make_solid(mesh, {{"steel", test::steel()}}, {{"all", "steel"}});
  Ties ties;
  HeldFreedoms freedoms;
  explicit Held(int variant) : ties(make_ties(solid, ends_held(variant))), freedoms(solid, ties) {}
  Held(const Held&) = delete;
};

}  // namespace

TEST_CASE("The graph of points is that of the stiffness", "[reduction]") {
  const Held model(0);
  const NodeGraph nodes = node_graph(model.solid.mesh);
  std::vector<std::int64_t> first;
  for (std::int64_t unknown = 0; unknown <= 3 * model.solid.points(); unknown += 3) first.push_back(unknown);
  const BlockGraph from_mesh = point_graph(nodes),
                   from_matrix = block_graph(assemble_stiffness(model.solid, nodes), first);
  CHECK(from_mesh.first == from_matrix.first);
  CHECK(from_mesh.starts == from_matrix.starts);
  CHECK(from_mesh.rows == from_matrix.rows);
}

TEST_CASE("The graph of the interior, from the mesh alone, contains every entry that is factorised", "[reduction]") {
  const int variant = GENERATE(0, 1, 2, 3);
  const Held model(variant);
  const NodeGraph nodes = node_graph(model.solid.mesh);
  const SymmetricMatrix stiffness = assemble_stiffness(model.solid, nodes);
  const InteriorUnknowns interior = model.freedoms.interior();
  const BlockGraph graph = interior_graph(point_graph(nodes), interior);
  const RowMatrix forces = stiffness.multiply(RowMatrix(interior.carried));
  const SymmetricMatrix matrix =
      bordered(principal_submatrix(stiffness, interior.kept), Eigen::MatrixXd(forces(interior.kept, Eigen::all)),
               Eigen::MatrixXd(interior.carried.transpose() * forces));
  const BlockGraph exact = block_graph(matrix, graph.first);
  REQUIRE(graph.size() == exact.size());
  for (int b = 0; b < graph.size(); ++b) {
    const auto rows = [b](const BlockGraph& of) {
      return std::vector<int>(of.rows.begin() + of.starts[b], of.rows.begin() + of.starts[b + 1]);
    };
    const std::vector<int> ours = rows(graph), needed = rows(exact);
    REQUIRE(std::is_sorted(ours.begin(), ours.end()));
    REQUIRE(std::includes(ours.begin(), ours.end(), needed.begin(), needed.end()));
    if (interior.carried.cols() == 0) REQUIRE(ours == needed);
  }
}

TEST_CASE("A structure prepared during the assembly gives the same factor as one found afterwards", "[reduction]") {
  const int variant = GENERATE(0, 1, 2, 3);
  const Held model(variant);
  for (const int threads : {1, 2, 3}) {
    CAPTURE(variant, threads);
    const auto prepared = assembled_matrices(model.solid, model.freedoms.interior(), threads);
    const auto nothing_known = assembled_matrices(model.solid, {}, threads);
    const auto another_known = assembled_matrices(model.solid, Held((variant + 1) % 4).freedoms.interior(), threads);
    const RowMatrix u = RowMatrix::Random(3 * model.solid.points(), 2);
    CHECK(prepared->stiffness_times(u) == nothing_known->stiffness_times(u));
    CHECK(prepared->mass_times(u) == nothing_known->mass_times(u));
    const auto held = [&](const BodyMatrices& matrices) {
      return FixedInterfaceBody(model.freedoms, model.solid, matrices, model.ties, threads);
    };
    const FixedInterfaceBody first = held(*prepared);
    const Eigen::MatrixXd f = Eigen::MatrixXd::Random(first.size(), 2);
    CHECK(first.solve(f) == held(*nothing_known).solve(f));
    CHECK(first.solve(f) == held(*another_known).solve(f));
  }
}

TEST_CASE("An inverted cell is reported from every thread", "[reduction]") {
  Held model(1);
  Eigen::MatrixXi& nodes = model.mesh.blocks.front().nodes;
  std::swap(nodes(0, 3), nodes(1, 3));
  std::vector<std::string> said;
  for (const int threads : {1, 2, 2, 5}) {
    try {
      assembled_matrices(model.solid, model.freedoms.interior(), threads);
      FAIL("accepted");
    } catch (const ComputationError& error) {
      said.push_back(error.what());
    }
  }
  CHECK_THAT(said.front(), Catch::Contains("cell 3") && Catch::Contains("inside out"));
  CHECK(said == std::vector<std::string>(said.size(), said.front()));
}
