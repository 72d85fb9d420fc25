// A straight solid bar in pieces that is bent to an arc by a moment at its tip.
//
// Elastica: a moment M turns the tip by M L/EI, and the axis becomes a circle. Each piece is linear in its own frame:
// without Poisson's contraction its solid is exact in pure bending (the displacement is quadratic), so that all pieces
// together turn by M L/EI, but for the quadratic part of Green's strain, (du_x/dx)^2 / 2, in the geometric stiffness:
// it stretches the axis by kappa^2 h^2 / 12 and turns the tip by twice that share more, 2/3 of the square of the strain
// at the surface. A piece of angle theta without the shortening of its chord would be longer than that of the arc by
// (theta/2)/sin(theta/2), which is 1 + theta^2/24; the pieces include it, and their error is of a higher power. With
// contraction the rigid cuts stiffen the bar, by the amount that the assembled pieces give for a moment at the tip.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/dense/dense_solves.hpp"
#include "reduce/reduction/reduce_pieces.hpp"
#include "reduce/superelement/assembled_pieces.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/static_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::StaticModel;

namespace {

constexpr double young = 210e9, width = 0.005;
constexpr double bending_stiffness = young * width * width * width * width / 12;

/// Returns a bar 1 m x 5 mm x 5 mm along x, cut into equal pieces without modes, which statics does not need.
CutBody bar_in_pieces(int count, double poisson, int bricks = 64) {
  reduce::ReductionOptions options;
  options.name = "bar";
  options.materials = {{"steel", reduce::Material::isotropic(young, poisson, 7800)}};
  options.regions = {{"all", "steel"}};
  options.interfaces.resize(2);
  options.interfaces[0].name = options.interfaces[0].group = "x0";
  options.interfaces[1].name = options.interfaces[1].group = "x1";
  options.stress_recovery = reduce::RecoveryExtent::none;
  std::vector<reduce::CutPlane> cuts;
  for (int k = 1; k < count; ++k)
    cuts.push_back({fmt::format("cut_{}", k), {static_cast<double>(k) / count, 0, 0}, {1, 0, 0}, ""});
  Progress quiet(true);
  const reduce::Mesh mesh = test::box_mesh({{1, width, width}, {bricks, 1, 1}}, [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), x.y() - width / 2, x.z() - width / 2);
  });
  return reduce::reduce_pieces(mesh, cuts, options, {reduce::Tie::rigid, false}, quiet, 2);
}

/// Returns the position and angle of the tip under a moment that turns a bar of EI by `angle`.
Vector3 bent_tip(const CutBody& body, double angle) {
  const test::TemporaryFolder folder;
  write_cut_body(body, folder / "bar.h5");
  StaticModel model(
      fmt::format("nodes: {{root: {{fixed: true}}, tip: {{position: [1, 0, 0]}}}}\n"
                  "elements: {{bar: {{type: superelement, file: {}/bar.h5, nodes: {{x0: root, x1: tip}}}}}}\n"
                  "loads: {{bend: {{node: tip, moment: [0, 0, {:.17g}]}}}}\n",
                  folder.path(), angle * bending_stiffness));
  REQUIRE(model.load(8, 1e-8 * bending_stiffness) >= 0);
  return {model.node("tip").x.x(), model.node("tip").x.y(), log_so3(model.node("tip").R).z()};
}

/// Returns the tip position of the circle with this angle at its end.
Eigen::Vector2d circle(double angle) { return {std::sin(angle) / angle, (1 - std::cos(angle)) / angle}; }

}  // namespace

TEST_CASE("a bar in pieces bends to a circle") {
  const double angle = 1.5, green = angle * angle * width * width / 6;
  std::vector<double> errors;
  for (const int count : {2, 4, 8}) {
    const Vector3 tip = bent_tip(bar_in_pieces(count, 0), angle);
    CAPTURE(count, tip.transpose());
    CHECK(tip.z() == Approx(angle * (1 + green)).epsilon(1e-6));
    const double of_piece = angle / count;
    const Eigen::Vector2d exact = circle(angle);
    errors.push_back((tip.head<2>() - exact).norm());
    CHECK(errors.back() < 0.1 * of_piece * of_piece / 24 * exact.norm());
  }
  CAPTURE(errors);
  for (std::size_t k = 1; k < errors.size(); ++k) CHECK(errors[k] < 0.27 * errors[k - 1] + 2 * green);
}

TEST_CASE("contraction that rigid cuts hinder stiffens the bar by what its pieces say") {
  const CutBody body = bar_in_pieces(4, 0.3, 48);  // bricks as long as wide
  const Superelement whole = assembled(body.pieces);
  // Root held: the angle of the tip per moment there. Interfaces: x0, three cuts, x1.
  std::vector<Eigen::Index> loose;
  for (Eigen::Index k = 6; k < whole.size(); ++k) loose.push_back(k);
  REQUIRE(whole.interfaces.back().name == "x1");
  const Eigen::MatrixXd compliance = bielle::regular_inverse(whole.stiffness(loose, loose)).value();
  const double stiffening = 1 / (compliance(compliance.rows() - 1, compliance.rows() - 1) * bending_stiffness);
  // Without any contraction steel is (1 - nu)/((1 + nu)(1 - 2 nu)) = 1.346 times as stiff. Two ends of each of four
  // pieces suppress it over less than half a width: 8 x 10 mm out of 1 m.
  CHECK(stiffening > 1.001);
  CHECK(stiffening < 1 + 0.346 * 0.08);
  // The division into tetrahedra is not symmetric, and the tip leaves the plane slightly: the effect is of second
  // order.
  const double angle = 1.5, sideways = 0.01;
  const Eigen::Index rz = compliance.rows() - 1;
  CHECK(std::hypot(compliance(rz - 1, rz), compliance(rz - 2, rz)) < sideways * compliance(rz, rz));
  CHECK(bent_tip(body, angle).z() == Approx(angle / stiffening).epsilon(sideways * sideways));
}
