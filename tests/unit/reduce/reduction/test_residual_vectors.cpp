// Tests of residual vectors: static responses compared with the full mesh, orthogonality, and loads without a
// remainder.
#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/fe/surface.hpp"
#include "reduce/reduction/fixed_interface_body.hpp"
#include "reduce/reduction/point_ties.hpp"
#include "tests/support/messages.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using bielle::test::message_of;
using Catch::Contains;

namespace {

const std::array<bool, 6> all_six{true, true, true, true, true, true};

/// The full mesh, held at interface "a" alone.
struct FullMesh {
  Mesh mesh = test::twisted_block();
  Solid solid = make_solid(mesh, {{"steel", test::steel()}}, {{"all", "steel"}});
  NodeGraph graph = node_graph(solid.mesh);
  SymmetricMatrix stiffness = assemble_stiffness(solid, graph);

  Eigen::Vector3d centre() const { return mass_properties(solid).centre; }
  RowMatrix displacement(const RowMatrix& loads, Tie tie) const {
    const FixedInterfaceBody held = test::held_body(solid, make_ties(solid, {test::interface("a", "x0", tie)}));
    return held.expand(held.solve(held.restrict(loads)));
  }
};

/// Interface "b" follows the mesh without stiffening it, so that the full mesh does not need it.
ReductionOptions body_with_points(const FullMesh& full, Tie tie, int modes, const std::array<bool, 6>& residual) {
  ReductionOptions options = test::steel_body(tie, Tie::average, modes);
  options.points = {test::point_at("inside", full.centre()), test::point_on("pad", "y1")};
  for (PointRequest& point : options.points) point.residual = residual;
  return options;
}

/// Returns the static coordinates under generalised forces with interface "a" held.
Eigen::MatrixXd static_answer(const Superelement& body, const Eigen::MatrixXd& forces) {
  const Eigen::Index loose = body.size() - 6;
  const Eigen::MatrixXd stiffness = body.stiffness.bottomRightCorner(loose, loose);
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(body.size(), forces.cols());
  q.bottomRows(loose) = stiffness.partialPivLu().solve(forces.bottomRows(loose));
  return q;
}

/// Returns the largest error in the point's motion under unit loads on it, relative to the largest in the same unit.
double compliance_error(const FullMesh& full, const Superelement& body, const PointRequest& request, Tie tie,
                        int load) {
  const TiedPoint point = tie_points(full.solid, {request}, "box").front();
  const RowMatrix exact = point.spread.transpose() * full.displacement(RowMatrix(point.spread), tie);
  const Eigen::MatrixXd& shapes = body.points.at(request.name).shapes;
  const Eigen::MatrixXd found = shapes * static_answer(body, shapes.transpose());
  const Eigen::VectorXd error = (found - exact).col(load).cwiseAbs(), size = exact.col(load).cwiseAbs();
  return std::max(error.head<3>().maxCoeff() / size.head<3>().maxCoeff(),
                  error.tail<3>().maxCoeff() / size.tail<3>().maxCoeff());
}

}  // namespace

TEST_CASE("With residual vectors the static displacement under forces and moments on a point is that of the mesh") {
  const FullMesh full;
  const Tie tie = GENERATE(Tie::rigid, Tie::average);
  const int modes = GENERATE(0, 6);
  const ReductionOptions with = body_with_points(full, tie, modes, all_six);
  const Superelement body = test::reduced(full.mesh, with);
  const Superelement without = test::reduced(full.mesh, body_with_points(full, tie, modes, {}));
  CHECK(body.residual_vectors == 12);
  CHECK(body.modes() == modes + 12);
  CHECK(without.residual_vectors == 0);
  double largest = 0;
  for (const PointRequest& request : with.points)
    for (int load = 0; load < 6; ++load) {
      CAPTURE(request.name, load);
      CHECK(compliance_error(full, body, request, tie, load) < 1e-8);
      largest = std::max(largest, compliance_error(full, without, request, tie, load));
    }
  CHECK(largest > 0.05);
}

TEST_CASE("Residual vectors contain the directions that an interface releases") {
  // If all interfaces are held, only modes and residual vectors move, and have the compliance of the mesh.
  const FullMesh full;
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 5);
  options.interfaces[1].kept = {true, true, true, false, true, false};
  // Nodes of the released surface are under the pad and rotate.
  options.points = {test::point_on("pad", "y1")};
  options.points.front().residual = all_six;
  const Superelement body = test::reduced(full.mesh, options);
  const FixedInterfaceBody held = test::held_body(full.solid, make_ties(full.solid, options.interfaces));
  const TiedPoint point = tie_points(full.solid, options.points, "box").front();
  const RowMatrix exact = point.spread.transpose() * held.expand(held.solve(held.restrict(RowMatrix(point.spread))));
  const Eigen::MatrixXd shapes = body.points.at("pad").shapes.rightCols(body.modes());
  const Eigen::VectorXd flexibility = (2 * EIGEN_PI * body.frequencies).cwiseAbs2().cwiseInverse();
  const Eigen::MatrixXd found = shapes * flexibility.asDiagonal() * shapes.transpose();
  CHECK((found - exact).norm() < 1e-9 * exact.norm());
}

TEST_CASE("Residual vectors of some directions do not change the others") {
  const FullMesh full;
  const ReductionOptions options = body_with_points(full, Tie::rigid, 4, {true, false, false, false, true, false});
  const Superelement body = test::reduced(full.mesh, options);
  CHECK(body.residual_vectors == 4);
  const PointRequest& inside = options.points.front();
  CHECK(compliance_error(full, body, inside, Tie::rigid, 0) < 1e-8);
  CHECK(compliance_error(full, body, inside, Tie::rigid, 4) < 1e-8);
  CHECK(compliance_error(full, body, inside, Tie::rigid, 2) > 1e-4);
  CHECK(body.points.at("inside").residual == inside.residual);
}

TEST_CASE("Residual vectors are orthogonal in stiffness and mass among themselves and to the modes") {
  const FullMesh full;
  const Tie tie = GENERATE(Tie::rigid, Tie::average);
  const Superelement body = test::reduced(full.mesh, body_with_points(full, tie, 6, all_six));
  const Eigen::Index m = body.modes(), residual = body.residual_vectors;
  REQUIRE(m == 18);
  const NodeMatrix mass = assemble_mass(full.solid, full.graph);
  const RowMatrix shapes = body.displacement_recovery.rightCols(m);
  const Eigen::MatrixXd M = shapes.transpose() * mass.multiply(shapes, 3);
  CHECK((M - Eigen::MatrixXd::Identity(m, m)).cwiseAbs().maxCoeff() < 1e-9);
  Eigen::VectorXd omega = 2 * EIGEN_PI * body.frequencies;
  const Eigen::MatrixXd K = omega.cwiseInverse().asDiagonal() *
                            Eigen::MatrixXd(shapes.transpose() * full.stiffness.multiply(shapes)) *
                            omega.cwiseInverse().asDiagonal();
  CHECK((K - Eigen::MatrixXd::Identity(m, m)).cwiseAbs().maxCoeff() < 1e-7);  // error of the iterated modes
  CHECK((K - Eigen::MatrixXd::Identity(m, m)).bottomRightCorner(residual, residual).cwiseAbs().maxCoeff() < 1e-9);
  // Constraint modes cause no force on inner nodes.
  const RowMatrix constraint = body.displacement_recovery.leftCols(m > 0 ? body.interface_directions() : 0);
  const Eigen::MatrixXd coupling = constraint.transpose() * full.stiffness.multiply(shapes.rightCols(residual));
  CHECK(coupling.cwiseAbs().maxCoeff() <
        1e-8 * std::sqrt(body.stiffness.diagonal().maxCoeff() * body.stiffness(body.size() - 1, body.size() - 1)));
  CHECK(body.stiffness.bottomRightCorner(residual, residual).isDiagonal(0));
  // These are Rayleigh quotients of fields that are orthogonal to all lower modes.
  for (Eigen::Index k = m - residual; k < m; ++k) CHECK(body.frequencies(k) > body.frequencies(k - 1));
}

TEST_CASE("With residual vectors the static response to a load pattern is that of the mesh, along any axis") {
  const FullMesh full;
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 3);
  LoadRequest traction{"wind", "z1", {}, Eigen::Vector3d(1e5, -2e5, 3e5), {}, "loads.wind", true};
  LoadRequest pressure{"gas", "y0", 1e5, {}, {}, "loads.gas", true};
  options.loads = {traction, pressure};
  const Superelement body = test::reduced(full.mesh, options);
  // The nine combinations of a traction are only three loads; the pressure has nine, since the normals of the twisted
  // side have all directions.
  CHECK(body.residual_vectors == 3 + 9);
  for (const LoadRequest& load : options.loads) {
    const SurfaceIntegrals surface = integrate_surface(full.mesh, load.group);
    const Eigen::Matrix3Xd forces =
        load.pressure ? pressure_forces(surface, *load.pressure) : traction_forces(surface, *load.traction);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        RowMatrix on_mesh = RowMatrix::Zero(3 * full.mesh.point_count(), 1);
        for (std::size_t a = 0; a < surface.nodes.size(); ++a)
          on_mesh(3 * surface.nodes[a] + l, 0) = forces(k, static_cast<Eigen::Index>(a));
        const RowMatrix exact = full.displacement(on_mesh, Tie::rigid);
        const Eigen::MatrixXd reduced_force = body.loads.at(load.name).force[k].row(l).transpose();
        const Eigen::MatrixXd found = body.displacement_recovery * static_answer(body, reduced_force);
        CHECK((found - exact).norm() < 1e-8 * exact.norm());
      }
  }
}

TEST_CASE("Linearly dependent loads share their residual vectors") {
  const FullMesh full;
  ReductionOptions options = body_with_points(full, Tie::rigid, 4, all_six);
  options.points.push_back(test::point_on("again", "y1"));
  options.points.back().position = Eigen::Vector3d(0.3, 0.4, 0.5);  // the same forces and moments with another arm
  options.points.back().residual.fill(true);
  CHECK(test::reduced(full.mesh, options).residual_vectors == 12);
}

TEST_CASE("A pressure on a plane has one component, which may act along three axes") {
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 2);
  options.loads = {{"gas", "z1", 1e5, {}, {}, "loads.gas", true}};
  CHECK(test::reduced(test::box_mesh({{0.3, 0.1, 0.1}, {3, 1, 1}}), options).residual_vectors == 3);
}

TEST_CASE("Residual vectors are refused if interfaces or modes leave no remainder") {
  const Mesh mesh = test::box_mesh({{0.3, 0.1, 0.1}, {3, 1, 1}});
  const auto refusal = [&](Tie tie, int modes, const std::string& group) {
    ReductionOptions options = test::steel_body(tie, tie, modes);
    options.points = {test::point_on("pin", group)};
    options.points.front().residual.fill(true);
    return message_of<InputError>([&] { test::reduced(mesh, options); });
  };
  const std::string says = "points.pin: its loads leave nothing for residual vectors";
  CHECK_THAT(refusal(Tie::rigid, 2, "x0"), Contains(says));
  CHECK_THAT(refusal(Tie::average, 2, "x1"), Contains(says));
  const int every = 3 * 9 * 5;  // five layers of nine nodes, including mid-side ones, are not tied
  CHECK_THAT(refusal(Tie::rigid, every, "y1"), Contains(says));
}
