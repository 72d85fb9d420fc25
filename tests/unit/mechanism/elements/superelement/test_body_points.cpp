// Nodes that are fixed to points inside a superelement: their positions, and the effect of loads on them.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/superelement/point_shapes.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/cut_chain.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/static_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace {

BeamSuperelement body_with_mesh(const BeamChain& chain) {
  BeamSuperelement reduced = chain.reduced();
  add_mesh(chain, 0.03, reduced);
  return reduced;
}

/// Adds a point to the body's file, with the rows that `at` gives for it.
void name_point(Superelement& body, const std::string& name, const Vector3& place,
                const std::array<bool, 6>& residual = {}) {
  body.points[name] = {place, point_shapes(body, place), residual};
}

/// Returns the straight beam of length 1 with its middle as a third interface, or with a point there.
std::string cantilever(const std::string& folder, const std::string& middle, const std::string& points) {
  return "nodes: {root: {fixed: true}" + middle + "}\n" + points +
         "elements:\n  it: {type: superelement, file: " + folder + "/beam.h5, nodes: {a: root" +
         (middle.empty() ? "" : ", c: middle") + "}}\n";
}

}  // namespace

TEST_CASE("points of a rigidly moved body move rigidly, on its mesh and between its nodes") {
  const BeamChain chain = bent_chain();
  const BeamSuperelement reduced = body_with_mesh(chain);
  MatrixX U = MatrixX::Zero(reduced.body.size(), 6);
  Eigen::Index row = 0;
  for (const Interface& interface : reduced.body.interfaces) {
    const Matrix3 Rt = interface.rotation.transpose();
    U.block<3, 3>(row, 0) = Rt;
    U.block<3, 3>(row, 3) = -Rt * skew(interface.position);
    U.block<3, 3>(row + 3, 3) = Rt;
    row += 6;
  }
  for (const Vector3& point : {Vector3(reduced.body.mesh.points.col(17)), Vector3(0.7, -0.03, 0.22)}) {
    const MatrixX shapes = point_shapes(reduced.body, point);
    Matrix6 expected = Matrix6::Identity();
    expected.topRightCorner<3, 3>() = -skew(point);
    CHECK(error(shapes * U, expected) < 1e-9);
  }
  // At a node the displacement is the node's: others count by a millionth.
  const MatrixX at_node = point_shapes(reduced.body, reduced.body.mesh.points.col(17));
  const MatrixX own = reduced.body.displacement_recovery.middleRows<3>(3 * 17);
  CHECK(error(at_node.topRows<3>(), own) < 1e-4 * own.cwiseAbs().maxCoeff());
}

TEST_CASE("a load on a point does what it does on an interface there, but for the compliance that the basis lacks") {
  // Small loads at the middle of a cantilever of length 1, EIz = 1: deflection 1/24, slope 1/8 at the middle under a
  // force, 5/48 at the tip. The basis contains the modes of the beam clamped at both ends, which give the rest of the
  // middle's compliance 1/192 and a part of 1/16 of its rotation under a moment.
  TemporaryFolder folder;
  BeamChain chain = straight_beam({}, 12);
  write_superelement(body_with_mesh(chain).body, folder / "beam.h5");
  const std::string points = "points: {middle: {element: it, at: [0.5, 0, 0]}}\n";
  constexpr double force = 1e-3;
  StaticModel model(cantilever(folder.path(), "", points) +
                    fmt::format("loads: {{p: {{node: middle, force: [0, {}, 0]}}}}\n", force));
  for (int k = model.dense.multiplier_begin(); k < model.dense.size(); ++k) model.free.push_back(k);
  REQUIRE(model.load(1, 1e-10) >= 0);  // rounding of EA = 1e5
  // The point is between the mesh's nodes, including those at a twentieth of the length: the error is some 1e-3.
  CHECK(model.node("middle").x.y() == Approx(force / 24).epsilon(3e-3));
  CHECK(model.node("it.b").x.y() == Approx(force * 5 / 48).epsilon(2e-3));  // interfaces respond exactly to a load
  CHECK(log_so3(model.node("middle").R).z() == Approx(force / 8).epsilon(5e-3));
}

TEST_CASE("a point that the body file names is what a point at its place is, and needs no displacements in the file") {
  TemporaryFolder folder;
  Superelement body = body_with_mesh(straight_beam({}, 12)).body;
  name_point(body, "middle", {0.5, 0, 0});
  const auto middle = [&](const std::string& point) {
    StaticModel model(cantilever(folder.path(), "", "points: {p: {element: it, " + point + "}}\n") +
                      "loads: {p: {node: p, force: [0, 1e-3, 0], moment: [1e-3, 0, 2e-3]}}\n");
    for (int k = model.dense.multiplier_begin(); k < model.dense.size(); ++k) model.free.push_back(k);
    REQUIRE(model.load(1, 1e-10) >= 0);
    return model.node("p");
  };
  write_superelement(body, folder / "beam.h5");
  const NodeState at = middle("at: [0.5, 0, 0]");
  body.displacement_recovery.resize(0, 0);
  write_superelement(body, folder / "beam.h5");
  const NodeState named = middle("point: middle");
  CHECK((named.x - at.x).norm() < 1e-14);
  CHECK((named.R - at.R).norm() < 1e-14);
  CHECK(named.x.y() > 1e-5);
}

TEST_CASE("a point that the body file names moves with its piece") {
  TemporaryFolder folder;
  CutBody body = cut_beam();
  Superelement& piece = body.pieces[1];
  const Eigen::Index n = piece.size();
  // The point is midway between the interfaces at 0.3 and 0.6, and moves with the mean of their motions.
  NamedPoint point{{0.45, 0, 0}, MatrixX::Zero(6, n), {}};
  point.shapes.leftCols<6>().setIdentity();
  point.shapes.middleCols<6>(6).setIdentity();
  point.shapes *= 0.5;
  piece.points["waist"] = point;
  write_cut_body(body, folder / "beam.h5");
  const std::string text =
      "nodes: {root: {position: [1, 2, 0], rotation_vector: [0, 0, \"pi/2\"]}}\n"
      "points: {p: {element: it, point: waist}}\n"
      "elements:\n  it: {type: superelement, file: " +
      folder.path() + "/beam.h5, position: [1, 2, 0], rotation_vector: [0, 0, \"pi/2\"], nodes: {root: root}}\n";
  const auto model = model_from_text(text);
  CHECK((model->node(*model->find_node("p")).frame.x - Vector3(1, 2.45, 0)).norm() < 1e-14);
  for (const Member& member : model->members()) {
    Declaration declaration;
    member.component->declare(declaration);
    CHECK(declaration.multipliers.size() == (member.component->name() == "it.2" ? 6u : 0u));
  }
}

TEST_CASE("wrong points are refused with what to do") {
  TemporaryFolder folder;
  const BeamChain chain = straight_beam();
  write_superelement(body_with_mesh(chain).body, folder / "beam.h5");
  const auto refusal = [&](const std::string& points) {
    return message_of<InputError>([&] { model_from_text(cantilever(folder.path(), "", points)); });
  };
  CHECK_THAT(refusal("points: {p: {element: it, at: [0.5, 0.3, 0]}}\n"),
             Contains("points.p.at") && Contains("away from the nearest node"));
  CHECK(refusal("points: {p: {element: it, at: [500 mm, 0, 0]}}\n") == "(nothing thrown)");
  CHECK_THAT(refusal("points: {p: {element: it, at: [500 kg, 0, 0]}}\n"),
             Contains("points.p.at[1]: expected a value in m, found one in 'kg'"));
  CHECK_THAT(refusal("points: {p: {element: bit, at: [0.5, 0, 0]}}\n"),
             Contains("no superelement 'bit'; did you mean 'it'"));
  CHECK_THAT(refusal("points: {root: {element: it, at: [0.5, 0, 0]}}\n"), Contains("points.root") && Contains("root"));
  CHECK_THAT(refusal("points: {p: {element: it}}\n"),
             Contains("points.p: expected either `at`") && Contains("or `point`"));
  CHECK_THAT(refusal("points: {p: {element: it, at: [0.5, 0, 0], point: tip}}\n"),
             Contains("points.p: expected either `at`"));
  CHECK_THAT(refusal("points: {p: {element: it, piont: tip}}\n"),
             Contains("'piont' is not a key of a point; did you mean 'point'"));
  CHECK_THAT(
      refusal("points: {p: {element: it, point: tip}}\n"),
      Contains("points.p.point: ") && Contains("beam.h5 names no points: give `at`, or name 'tip' under `points`"));
  Superelement named = body_with_mesh(chain).body;
  name_point(named, "middle", {0.5, 0, 0});
  write_superelement(named, folder / "beam.h5");
  CHECK_THAT(refusal("points: {p: {element: it, point: midle}}\n"),
             Contains("points.p.point: 'midle' is no point of ") && Contains("did you mean 'middle'"));
  write_superelement(chain.reduced().body, folder / "beam.h5");
  CHECK_THAT(refusal("points: {p: {element: it, at: [0.5, 0, 0]}}\n"), Contains("displacement: all"));
}
