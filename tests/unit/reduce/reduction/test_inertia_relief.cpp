// Tests of residual vectors for the body's own inertia, and of the share of the response that a reduction reports.
#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/fe/assembly.hpp"
#include "reduce/reduction/fixed_interface_body.hpp"
#include "reduce/reduction/reduce_pieces.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace test_inertia_relief {
namespace {

constexpr double young = 210e9, density = 7800;  // constants of test::steel()

/// Returns the forces of the twelve accelerations that are linear in space, on a mesh.
RowMatrix inertia_loads(const Solid& solid) {
  const NodeGraph graph = node_graph(solid.mesh);
  const Eigen::Vector3d centre = mass_properties(solid).centre;
  RowMatrix fields = RowMatrix::Zero(3 * solid.points(), 12);
  for (Eigen::Index a = 0; a < solid.points(); ++a)
    for (int i = 0; i < 3; ++i)
      fields.block<1, 4>(3 * a + i, 4 * i) << 1, (solid.mesh.points.col(a) - centre).transpose();
  return assemble_mass(solid, graph, 1).multiply(fields, 3, 1);
}

/// Returns the static coordinates of a body whose interface "a" is held.
Eigen::MatrixXd answer(const Superelement& body, const Eigen::MatrixXd& forces, Eigen::Index held) {
  const Eigen::Index loose = body.size() - held;
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(body.size(), forces.cols());
  q.bottomRows(loose) =
      Eigen::MatrixXd(body.stiffness.bottomRightCorner(loose, loose)).partialPivLu().solve(forces.bottomRows(loose));
  return q;
}

double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).norm() / b.norm(); }

/// Returns a slender steel bar of 1 m with rigid ends.
Superelement bar(bool relieved, int modes = 16) {
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, modes);
  options.inertia_relief = relieved;
  options.stress_recovery = RecoveryExtent::all;
  return test::reduced(test::box_mesh({{1, 0.04, 0.04}, {24, 1, 1}}), options);
}

/// Largest stress along the bar, which spins at the rate w about z through its centre, and the largest relative
/// deviation from the closed form rho w^2 (L^2 - x^2)/2, with x from the centre and half of the length L.
struct SpinningStress {
  double largest = 0, difference = 0;  ///< relative to the largest value of the closed form
};

SpinningStress spinning_stress(const Superelement& body) {
  const double w = 300, half = 0.5, largest = density * w * w * half * half / 2;
  // The inertia components give the generalised forces of a(x) = w x (w x r): f = - sum over k, l, m eps_klm w_l S_km U
  // w.
  Eigen::MatrixXd turning = Eigen::MatrixXd::Zero(body.size(), 1);
  turning.topRows(body.interface_directions()) =
      interface_rigid_motions(body.interfaces, body.centre).col(5) * w;  // U w
  const auto S = [&](int k, int l) -> Eigen::MatrixXd {
    constexpr std::array<std::array<int, 3>, 3> place{{{0, 5, 4}, {5, 1, 3}, {4, 3, 2}}};
    const Eigen::MatrixXd& matrix = body.inertia_components[static_cast<std::size_t>(place[k][l])];
    return k <= l ? matrix : Eigen::MatrixXd(matrix.transpose());
  };
  // With w along z, (w x v)_x = -w v_y and (w x v)_y = w v_x.
  const Eigen::VectorXd force = w * (S(0, 1) * turning - S(1, 0) * turning);
  // The bar is held at one end. The centrifugal forces are in equilibrium and do not load it.
  const Eigen::VectorXd stress = body.stress_recovery * answer(body, force, 6);
  SpinningStress result;
  for (std::size_t k = 0; k < body.stress_nodes.size(); ++k) {
    const double x = body.mesh.points(0, body.stress_nodes[k]) - half;
    if (std::abs(x) > 0.4) continue;  // rigid ends prevent the contraction
    const double found = stress(6 * static_cast<Eigen::Index>(k)), exact = density * w * w * (half * half - x * x) / 2;
    result.largest = std::max(result.largest, found / largest);
    result.difference = std::max(result.difference, std::abs(found - exact) / largest);
  }
  return result;
}

}  // namespace

TEST_CASE("With inertia relief the static response to any acceleration that is linear in space is that of the mesh") {
  const Tie tie = GENERATE(Tie::rigid, Tie::average, Tie::free);
  const int modes = GENERATE(0, 6);
  const Mesh mesh = test::twisted_block();
  ReductionOptions options = test::steel_body(tie, Tie::average, modes);
  options.inertia_relief = true;
  const Superelement body = test::reduced(mesh, options);
  CHECK(body.residual_vectors == 12);
  const Solid solid = make_solid(mesh, options.materials, options.regions);
  const RowMatrix loads = inertia_loads(solid);
  const FixedInterfaceBody held = test::held_body(solid, make_ties(solid, {options.interfaces.front()}));
  const RowMatrix exact = held.expand(held.solve(held.restrict(loads)));
  const Eigen::MatrixXd& T = body.displacement_recovery;
  const Eigen::Index of_a = body.interface_directions() - 6;
  const Eigen::MatrixXd found = T * answer(body, T.transpose() * loads, of_a);
  for (Eigen::Index c = 0; c < 12; ++c) CHECK(relative(found.col(c), exact.col(c)) < 1e-7);
  options.inertia_relief = false;
  const Superelement without = test::reduced(mesh, options);
  const Eigen::MatrixXd few =
      without.displacement_recovery * answer(without, without.displacement_recovery.transpose() * loads, of_a);
  double worst = 0;
  for (Eigen::Index c = 0; c < 12; ++c) worst = std::max(worst, relative(few.col(c), exact.col(c)));
  CHECK(worst > 0.01);
}

TEST_CASE("The energies of the response to accelerations tell the missing part") {
  const Mesh mesh = test::twisted_block();
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 6);
  const InertiaAnswer without = test::reduced(mesh, options).inertia_answer;
  options.inertia_relief = true;
  const InertiaAnswer with = test::reduced(mesh, options).inertia_answer;
  CHECK(relative(with.whole, without.whole) < 1e-10);
  CHECK(with.missing.norm() < 1e-9 * with.whole.norm());
  CHECK(without.missing.norm() > 0.01 * without.whole.norm());
  // These are the energies of the mesh, held at its interfaces.
  const Solid solid = make_solid(mesh, options.materials, options.regions);
  const FixedInterfaceBody held = test::held_body(solid, make_ties(solid, options.interfaces));
  const RowMatrix loads = inertia_loads(solid);
  const RowMatrix exact = held.expand(held.solve(held.restrict(loads)));
  CHECK(relative(with.whole, loads.transpose() * exact) < 1e-9);
}

TEST_CASE("A bar that spins about its middle has two thirds of its largest stress, and all of it with inertia relief") {
  // Its ends are not held; 16 modes (bending, torsion, the first along the bar) give only the mean stress, rho w^2
  // L^2/3.
  CHECK(spinning_stress(bar(false)).largest == Approx(2.0 / 3).epsilon(0.02));
  const SpinningStress relieved = spinning_stress(bar(true));
  CHECK(relieved.largest == Approx(1).epsilon(0.01));
  CHECK(relieved.difference < 0.01);
  CHECK(spinning_stress(bar(true, 0)).difference < 0.01);
}

TEST_CASE("The energies of the response of a bar to accelerations along it are those of a rod with held ends") {
  const Superelement body = bar(false);
  const double A = 0.04 * 0.04, half = 0.5;
  // An acceleration a causes the stress rho a x, and c x causes rho c (L^2 - 3 x^2)/6. With the ends held, twice the
  // energies are:
  const double constant = A * density * density / young * 2 * std::pow(half, 3) / 3;
  const double linear = A * density * density / (36 * young) * 8 * std::pow(half, 5) / 5;
  CHECK(body.inertia_answer.whole(0, 0) == Approx(constant).epsilon(0.02));
  CHECK(body.inertia_answer.whole(1, 1) == Approx(linear).epsilon(0.1));  // the ends prevent the contraction
  // The first mode along the bar is kept: cos(pi x/2L) has 96/pi^4 of the first energy. The second mode is not kept.
  CHECK(body.inertia_answer.missing(0, 0) / constant == Approx(1 - 96 / std::pow(M_PI, 4)).epsilon(0.1));
  CHECK(body.inertia_answer.missing(1, 1) / body.inertia_answer.whole(1, 1) > 0.999);
}

TEST_CASE("Inertia relief adds to other residual vectors, and adds none if the modes are complete") {
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 4);
  options.inertia_relief = true;
  options.points = {test::point_on("pad", "y1")};
  options.points.front().residual = {true, true, true, true, true, true};
  const Superelement body = test::reduced(test::twisted_block(), options);
  CHECK(body.residual_vectors == 18);
  CHECK(body.inertia_answer.missing.norm() < 1e-9 * body.inertia_answer.whole.norm());

  ReductionOptions all = test::steel_body(Tie::rigid, Tie::rigid, 108);  // 36 points inside
  all.interfaces.pop_back();
  all.inertia_relief = true;
  const Superelement whole = test::reduced(test::box_mesh({{0.2, 0.1, 0.1}, {2, 1, 1}}), all);
  CHECK(whole.residual_vectors == 0);
  CHECK(whole.inertia_answer.missing.norm() < 1e-8 * whole.inertia_answer.whole.norm());
}

TEST_CASE("Each piece of a body has its own inertia relief") {
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 3);
  options.inertia_relief = true;
  Progress quiet(true);
  const CutBody body =
      reduce_pieces(test::box_mesh({{0.8, 0.1, 0.1}, {8, 1, 1}}), {{"cut_1", {0.3, 0, 0}, {1, 0, 0}, "pieces.planes"}},
                    options, {Tie::rigid, false}, quiet, 2);
  REQUIRE(body.pieces.size() == 2);
  for (const Superelement& piece : body.pieces) {
    CHECK(piece.residual_vectors > 0);
    CHECK(piece.inertia_answer.missing.norm() < 1e-8 * piece.inertia_answer.whole.norm());
  }
}

}  // namespace test_inertia_relief
