#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/reduction/fixed_interface_body.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

struct Model {
  Mesh mesh;
  Solid solid;
  SymmetricMatrix stiffness;
  Ties ties;

  Model(Mesh m, const std::vector<InterfaceRequest>& requests)
      : mesh(std::move(m)),
        solid(make_solid(mesh, {{"steel", test::steel()}}, {{"all", "steel"}})),
        stiffness(assemble_stiffness(solid, node_graph(solid.mesh))),
        ties(make_ties(solid, requests)) {}
  FixedInterfaceBody held() const { return test::held_body(solid, ties); }
};

}  // namespace

TEST_CASE("The held body is in equilibrium under any load, and satisfies its conditions") {
  const int variant = GENERATE(0, 1, 2, 3);
  std::vector<InterfaceRequest> requests;
  int supports = 0;
  switch (variant) {
    case 0:  // held by fixed degrees of freedom alone
      requests = {test::interface("a", "x0", Tie::rigid), test::interface("b", "x1", Tie::rigid)};
      requests[1].kept = {true, true, true, false, true, false};
      break;
    case 1:  // held by averages alone
      requests = {test::interface("a", "x0", Tie::average), test::interface("b", "x1", Tie::average)};
      requests[1].kept = {true, false, true, false, true, false};
      supports = 6;
      break;
    case 2:  // a ball joint holds three motions, an average the others
      requests = {test::interface("a", "x0", Tie::rigid), test::interface("b", "x1", Tie::average)};
      requests[0].kept = {true, true, true, false, false, false};
      supports = 3;
      break;
    default:  // a rigid tie and an average
      requests = {test::interface("a", "x0", Tie::rigid), test::interface("b", "x1", Tie::average)};
  }
  const Model model(test::twisted_block(), requests);
  const FixedInterfaceBody held = model.held();
  CHECK(held.supports() == supports);

  const auto averages = static_cast<Eigen::Index>(model.ties.averages.size());
  const Eigen::MatrixXd f = Eigen::MatrixXd::Random(held.size(), 3);
  // The displacements have the size that such loads cause, with a compliance of about 1e-10 m/N.
  const Eigen::MatrixXd q = 1e-9 * Eigen::MatrixXd::Random(averages, 3);
  const Eigen::MatrixXd z = held.solve(f, q);
  const RowMatrix u = held.expand(z);
  if (averages > 0) {
    CHECK((model.ties.spread.transpose() * u - q).norm() < 1e-10 * u.norm());
  }
  // The unbalanced force at inner nodes must be C^T lambda.
  const Eigen::MatrixXd residual = f - held.restrict(model.stiffness.multiply(u));
  if (averages == 0) {
    CHECK(residual.norm() < 1e-9 * f.norm());
  } else {
    const Eigen::MatrixXd spread = held.restrict(RowMatrix(model.ties.spread));
    const Eigen::MatrixXd lambda = spread.colPivHouseholderQr().solve(residual);
    CHECK((residual - spread * lambda).norm() < 1e-9 * f.norm());
  }
  const Eigen::MatrixXd g = Eigen::MatrixXd::Random(held.size(), 2);
  const double forth = (g.transpose() * held.solve(f)).norm();
  CHECK((g.transpose() * held.solve(f) - held.solve(g).transpose() * f).norm() < 1e-9 * forth);
}

TEST_CASE("The force on a held average is that on its surface, and so is its work") {
  const Model model(test::twisted_block(),
                    {test::interface("a", "x0", Tie::average), test::interface("b", "x1", Tie::average)});
  const FixedInterfaceBody held = model.held();
  const Eigen::MatrixXd spread = held.restrict(RowMatrix(model.ties.spread));
  const Eigen::MatrixXd z = held.solve(Eigen::MatrixXd::Zero(held.size(), 12), Eigen::MatrixXd::Identity(12, 12));
  const Eigen::MatrixXd forces = held.restrict(model.stiffness.multiply(held.expand(z)));
  // Loads act on the two surfaces alone and are distributed like unit loads: forces = C^T lambda, and lambda = z^T K z.
  const Eigen::MatrixXd lambda = spread.colPivHouseholderQr().solve(forces);
  CHECK((spread * lambda - forces).norm() < 1e-8 * forces.norm());
  const Eigen::MatrixXd work = z.transpose() * forces;
  CHECK((work - lambda).norm() < 1e-8 * work.norm());
}

TEST_CASE("The maps of forces on points and of displacements of points are transposes") {
  std::vector<InterfaceRequest> requests{test::interface("a", "x0", Tie::rigid)};
  requests[0].kept[5] = false;
  requests.push_back(test::interface("b", "x1", Tie::rigid));
  const Model model(test::twisted_block(), requests);
  const FixedInterfaceBody held = model.held();
  const Eigen::MatrixXd z = Eigen::MatrixXd::Random(held.size(), 2);
  const RowMatrix f = RowMatrix::Random(3 * model.mesh.point_count(), 2);
  CHECK((z.transpose() * held.restrict(f) - Eigen::MatrixXd(held.expand(z).transpose() * f)).norm() < 1e-12 * f.norm());
}

TEST_CASE("A body that its interfaces do not hold is refused with the motion that remains free") {
  const auto message = [](const std::vector<InterfaceRequest>& requests) {
    const Model model(test::box_mesh({{0.4, 0.1, 0.2}, {4, 2, 2}}), requests);
    try {
      model.held();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  auto a = test::interface("a", "x0", Tie::rigid);
  a.kept = {true, true, true, true, true, false};
  CHECK_THAT(message({a}), Contains("interfaces.a: with every kept direction of the interfaces held, the body "
                                    "can still turn about the axis (0, 0, ") &&
                               Contains("through (0, 0.05, "));
  a.tie = Tie::average;
  CHECK_THAT(message({a}), Contains("can still turn about the axis (0, 0, "));
  a.kept = {false, true, true, true, true, true};
  CHECK_THAT(message({a}), Contains("can still move along ("));
  a.tie = Tie::rigid;
  CHECK_THAT(message({a}), Contains("can still move along ("));
  // Two ball joints leave the rotation about the line between them free.
  auto b = test::interface("b", "x1", Tie::rigid);
  a.kept = b.kept = {true, true, true, false, false, false};
  CHECK_THAT(message({a, b}), Contains("can still turn about the axis (") && Contains("1, 0, 0)"));
  b.kept[3] = true;
  CHECK(message({a, b}) == "accepted");
}

TEST_CASE("Parts that are connected by an edge are found, with its place") {
  // Two boxes share one edge, about which the second one can rotate.
  Mesh mesh = test::box_mesh({{2, 2, 1}, {2, 2, 1}});
  Eigen::MatrixXi kept(10, 0);
  for (const auto& cell : mesh.blocks[0].nodes.colwise()) {
    const Eigen::Vector3d centre = mesh.points(Eigen::all, cell).rowwise().mean();
    if ((centre.x() < 1) == (centre.y() < 1)) {
      kept.conservativeResize(10, kept.cols() + 1);
      kept.rightCols<1>() = cell;
    }
  }
  mesh.blocks[0].nodes = kept;
  std::vector<int> cells;
  for (const int c : mesh.groups.at("x0").parts[0].cells) {
    if (mesh.points(1, mesh.blocks[1].nodes.col(c)).maxCoeff() < 1.1) {
      cells.push_back(c);
    }
  }
  mesh.groups["x0"].parts[0].cells = cells;
  const Model model(mesh, {test::interface("a", "x0", Tie::rigid)});
  CHECK_THROWS_WITH(model.held(), Contains("singular at the point") && Contains("a point or an edge"));
}
