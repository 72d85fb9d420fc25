// Compares each piece of a body with its own reduction, and all pieces together with the uncut body.
#include <cmath>
#include <numbers>

#include "bodies.hpp"
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/reduction/cut_effect.hpp"
#include "reduce/reduction/reduce_pieces.hpp"
#include "reduce/reduction/reduced_matrices.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/superelement/assembled_pieces.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;

namespace {

const Box bar{{0.8, 0.1, 0.1}, {8, 1, 1}};

std::vector<CutPlane> cuts_at(const std::vector<double>& places) {
  std::vector<CutPlane> cuts;
  for (const double x : places)
    cuts.push_back({"cut_" + std::to_string(cuts.size() + 1), {x, 0, 0}, {1, 0, 0}, "pieces.planes"});
  return cuts;
}

CutBody in_pieces(const Mesh& mesh, const ReductionOptions& options, const std::vector<double>& places,
                  const PiecesRequest& request = {}, std::vector<Check>* checks = nullptr) {
  Progress quiet(true);
  return reduce_pieces(mesh, cuts_at(places), options, request, quiet, 2, checks);
}

std::string refusal(const ReductionOptions& options, const std::vector<double>& places) {
  return message_of<InputError>([&] { in_pieces(box_mesh(bar), options, places, {Tie::rigid, false}); });
}

void check_same(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  REQUIRE(a.rows() == b.rows());
  CHECK((a - b).norm() < 1e-9 * b.norm());
}

/// Returns the resultant of a load pattern that follows the body, as its work in unit translations.
Eigen::Vector3d resultant(const Superelement& piece, const std::string& pattern) {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(piece.size(), 6);
  rigid.topRows(piece.interface_directions()) = interface_rigid_motions(piece.interfaces, piece.centre);
  Eigen::Vector3d force;
  for (int k = 0; k < 3; ++k) force(k) = piece.loads.at(pattern).force[k].row(k).dot(rigid.col(k));
  return force;
}

}  // namespace

TEST_CASE("a piece equals the reduction of its part of the body by itself") {
  const CutBody body = in_pieces(box_mesh(bar), steel_body(Tie::rigid, Tie::average, 3), {0.3}, {Tie::rigid, false});
  REQUIRE(body.pieces.size() == 2);
  CHECK(body.pieces[1].name == "box.2");
  for (const int k : {0, 1}) {
    const Superelement& piece = body.pieces[k];
    const Box part{{k == 0 ? 0.3 : 0.5, 0.1, 0.1}, {k == 0 ? 3 : 5, 1, 1}};
    ReductionOptions options = steel_body(Tie::rigid, Tie::rigid, 3);
    // The interfaces of a piece come first, then its sides of the cuts.
    if (k == 0) options.interfaces = {interface("a", "x0", Tie::rigid), interface("cut_1", "x1", Tie::rigid)};
    if (k == 1) options.interfaces = {interface("b", "x1", Tie::average), interface("cut_1", "x0", Tie::rigid)};
    const Superelement alone = reduced(
        box_mesh(part, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x() + 0.3 * k, x.y(), x.z()); }),
        options);
    CHECK(piece.interfaces[1].name == alone.interfaces[1].name);
    CHECK((piece.interfaces[1].position - alone.interfaces[1].position).norm() < 1e-14);
    check_same(piece.stiffness.topLeftCorner(12, 12), alone.stiffness.topLeftCorner(12, 12));
    check_same(piece.mass.topLeftCorner(12, 12), alone.mass.topLeftCorner(12, 12));
    check_same(piece.frequencies, alone.frequencies);
    CHECK(piece.load_stiffness.size() == alone.load_stiffness.size());
    check_same(piece.load_stiffness[7].topLeftCorner(12, 12), alone.load_stiffness[7].topLeftCorner(12, 12));
  }
  CHECK(body.pieces[0].interfaces[1].position == body.pieces[1].interfaces[1].position);
}

TEST_CASE("points and their residual vectors belong to the piece that contains them") {
  ReductionOptions options = steel_body(Tie::rigid, Tie::rigid, 2);
  options.points = {point_at("near", {0.1, 0.05, 0.05}), point_at("far", {0.7, 0.05, 0.05}), point_on("end", "x1")};
  options.points[1].residual.fill(true);
  const CutBody body = in_pieces(box_mesh(bar), options, {0.4});
  REQUIRE(body.pieces.size() == 2);
  CHECK(body.pieces[0].points.size() == 1);
  CHECK(body.pieces[0].points.count("near") == 1);
  CHECK(body.pieces[0].residual_vectors == 0);
  CHECK(body.pieces[1].points.size() == 2);
  CHECK(body.pieces[1].residual_vectors == 6);
  CHECK((body.pieces[1].points.at("end").position - Eigen::Vector3d(0.8, 0.05, 0.05)).norm() < 1e-14);
  options.points = {point_on("side", "y0")};
  CHECK_THAT(refusal(options, {0.4}), Contains("points.side: its surface lies in 2 pieces, on both sides of 'cut_1': "
                                               "a point belongs to one"));
}

TEST_CASE("free cuts do not change the body, since all of their nodes are common to both sides") {
  const CutBody body = in_pieces(box_mesh(bar), steel_body(Tie::rigid, Tie::average, 8), {0.4}, {Tie::free, true});
  CHECK(shared_interfaces(body.pieces).size() == 9);  // the corners and mid-side nodes of two triangles
  REQUIRE(body.effect.stiffness_ratios.size() == 2);
  CHECK(body.effect.stiffness_ratios[0] == Approx(1).epsilon(1e-8));
  CHECK(body.effect.stiffness_ratios[1] == Approx(1).epsilon(1e-8));
  // The difference is due to modes that the models neglect, about 1e-4 of the first frequencies.
  for (int k = 0; k < 3; ++k) CHECK(body.free_frequencies(k) == Approx(body.effect.uncut_frequencies(k)).epsilon(1e-3));
}

TEST_CASE("rigid cuts stiffen a body, averaging ones soften it, and both errors are reported") {
  const Mesh mesh = box_mesh(bar);
  const CutBody rigid = in_pieces(mesh, steel_body(Tie::rigid, Tie::rigid, 5), {0.2, 0.4, 0.6});
  // The displacements of the pieces are a subspace of those of the uncut mesh (Rayleigh-Ritz): the stiffness is not
  // lower for any load, and no frequency is lower than that of the full model.
  CHECK(rigid.effect.stiffness_ratios[0] > 1 - 1e-9);
  CHECK(rigid.effect.stiffness_ratios[1] > 1.001);
  CHECK(rigid.effect.stiffness_ratios[1] < 1.2);
  const Eigen::VectorXd full = SolidModel(mesh, steel()).frequencies(6);
  for (int k = 0; k < 6; ++k) CHECK(rigid.free_frequencies(k) > full(k));
  CHECK(rigid.free_frequencies(0) > rigid.effect.uncut_frequencies(0));
  CHECK(rigid.free_frequencies(0) < 1.05 * rigid.effect.uncut_frequencies(0));

  const CutBody average = in_pieces(mesh, steel_body(Tie::rigid, Tie::rigid, 5), {0.4}, {Tie::average, true});
  CHECK(average.effect.stiffness_ratios[0] < 1 - 1e-6);
  CHECK(average.effect.stiffness_ratios[1] < 1 + 1e-9);
}

TEST_CASE("without lateral contraction rigid cuts only prevent warping: bending and stretching are exact") {
  ReductionOptions options = steel_body(Tie::rigid, Tie::rigid, 4);
  options.materials = {{"steel", Material::isotropic(210e9, 0, 7800)}};
  const CutBody body = in_pieces(box_mesh(bar), options, {0.2, 0.6});
  CHECK(body.effect.stiffness_ratios[0] == Approx(1).epsilon(1e-9));
  CHECK(body.effect.stiffness_ratios[1] > 1 + 1e-4);  // shear and torsion warp the section
  const Superelement whole = assembled(body.pieces);
  Eigen::MatrixXd stiffness = whole.stiffness;
  std::vector<Eigen::Index> loose;
  for (Eigen::Index k = 0; k < whole.size(); ++k)
    if (k >= 6) loose.push_back(k);
  const Eigen::MatrixXd compliance = bielle::regular_inverse(stiffness(loose, loose)).value();
  // The interfaces are a, cut_1, cut_2 and b. The tip is loaded by a pull and by a moment about z.
  const Eigen::Index tip = 12;
  const double area = 0.01, inertia = 1e-4 / 12;
  CHECK(compliance(tip, tip) == Approx(0.8 / (210e9 * area)).epsilon(1e-8));
  CHECK(compliance(tip + 5, tip + 5) == Approx(0.8 / (210e9 * inertia)).epsilon(1e-8));
}

TEST_CASE("all pieces together have the mass, centre and inertia of the body") {
  std::vector<Check> checks;
  const CutBody body =
      in_pieces(twisted_block(), steel_body(Tie::rigid, Tie::average, 2), {0.13, 0.29}, {Tie::rigid, false}, &checks);
  CHECK(body.pieces.size() == 3);
  CHECK(body.cuts[0].distance > 1e-3);  // the block's faces are curved
  REQUIRE(checks.size() == 3);
  for (const Check& check : checks) CHECK(check.value < 1e-12);
  const Superelement uncut = reduced(twisted_block(), steel_body(Tie::rigid, Tie::average));
  const Superelement whole = assembled(body.pieces);
  CHECK(whole.total_mass == Approx(uncut.total_mass).epsilon(1e-13));
  CHECK((whole.centre - uncut.centre).norm() < 1e-13);
  CHECK((whole.inertia - uncut.inertia).norm() < 1e-12 * uncut.inertia.norm());
}

TEST_CASE("loads are shared by the pieces that contain their surface, in proportion to the area") {
  ReductionOptions options = steel_body(Tie::rigid, Tie::rigid);
  LoadRequest snow, push, wind;
  snow.name = "snow", snow.group = "z1", snow.pressure = 1000;
  push.name = "push", push.group = "y0", push.force = Eigen::Vector3d(3, 4, 5);
  wind.name = "wind", wind.group = "x1", wind.traction = Eigen::Vector3d(0, 7, 0);
  options.loads = {snow, push, wind};
  const CutBody body = in_pieces(box_mesh(bar), options, {0.2}, {Tie::rigid, false});
  CHECK((resultant(body.pieces[0], "snow") - Eigen::Vector3d(0, 0, -20)).norm() < 1e-10);
  CHECK((resultant(body.pieces[1], "snow") - Eigen::Vector3d(0, 0, -60)).norm() < 1e-10);
  CHECK((resultant(body.pieces[0], "push") - Eigen::Vector3d(0.75, 1, 1.25)).norm() < 1e-12);
  CHECK((resultant(body.pieces[1], "push") - Eigen::Vector3d(2.25, 3, 3.75)).norm() < 1e-12);
  CHECK_FALSE(body.pieces[0].loads.contains("wind"));
  CHECK((resultant(body.pieces[1], "wind") - Eigen::Vector3d(0, 0.07, 0)).norm() < 1e-14);
}

TEST_CASE("a ratio of damping is that of the first mode of the whole body") {
  ReductionOptions options = steel_body(Tie::rigid, Tie::rigid, 3);
  options.damping_ratios = {0.03};
  const CutBody body = in_pieces(box_mesh(bar), options, {0.2, 0.4, 0.6}, {Tie::rigid, false});
  const Superelement whole = assembled(body.pieces);
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(whole.size(), 6);
  rigid.topRows(whole.interface_directions()) = interface_rigid_motions(whole.interfaces, whole.centre);
  const FreeModes modes = free_modes(whole.stiffness, whole.mass, rigid);
  const Eigen::VectorXd first = modes.vectors.col(0);
  CHECK(body.free_frequencies(0) == Approx(modes.omega(0) / (2 * std::numbers::pi)).epsilon(1e-12));
  CHECK(first.dot(whole.damping * first) / (2 * modes.omega(0)) == Approx(0.03).epsilon(1e-9));
  CHECK((whole.damping * rigid).norm() < 1e-9 * whole.damping.norm());
}

TEST_CASE("requests that pieces do not support are refused with their key") {
  ReductionOptions options = steel_body(Tie::rigid, Tie::rigid);
  options.interfaces[1] = interface("side", "y1", Tie::average);
  CHECK_THAT(refusal(options, {0.2, 0.6}),
             Contains("interfaces.side: its surface lies in 3 pieces, on both sides of 'cut_1', 'cut_2'"));
  options = steel_body(Tie::rigid, Tie::rigid);
  options.interfaces[1].name = "cut_1";
  CHECK_THAT(refusal(options, {0.4}), Contains("a cut has the name 'cut_1', too"));
  options = steel_body(Tie::rigid, Tie::rigid);
  options.damping_ratios = {0.1, 0.2};
  CHECK_THAT(refusal(options, {0.4}), Contains("a body in pieces has one ratio"));
  options = steel_body(Tie::rigid, Tie::rigid);
  options.interfaces[0].group = "x9";
  CHECK_THAT(refusal(options, {0.4}), Contains("interfaces.a") && Contains("no surface group 'x9'"));
}
