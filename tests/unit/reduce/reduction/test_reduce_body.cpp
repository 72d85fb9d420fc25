#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/support/eigenvalues.hpp"
#include "tests/support/solid_model.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  // Entries have different units. The entry of coordinates i, j is compared on the scale of the diagonals, some of
  // which may be zero (a direction that alone holds a rigid motion has no stiffness).
  const double largest = a.diagonal().cwiseAbs().maxCoeff();
  const Eigen::VectorXd scale = a.diagonal().cwiseAbs().cwiseMax(1e-6 * largest).cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (a - b) * scale.asDiagonal()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE(
    "A reduced body has exact rigid motions, mass properties and inertia integrals up to rounding, for any ties") {
  const int variant = GENERATE(0, 1, 2, 3, 4);
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 6);
  if (variant == 1) {
    options = test::steel_body(Tie::average, Tie::average, 6);
    options.interfaces[0].position = Eigen::Vector3d(-0.2, 0.1, 0.3);
  } else if (variant == 2) {
    options = test::steel_body(Tie::free, Tie::average, 6);
  } else if (variant == 3) {
    options.interfaces[0].kept = {true, true, true, true, true, false};
    options.interfaces[1].kept = {true, true, true, false, true, false};
    options.interfaces[0].rotation = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, -1, 2).normalized()).toRotationMatrix();
    options.interfaces[0].position = Eigen::Vector3d(-0.2, 0.1, 0.3);
  } else if (variant == 4) {
    options.interfaces.pop_back();
  }
  ReductionReport report;
  const Superelement body = test::reduced(test::twisted_block(), options, &report);
  std::map<std::string, double> values;
  for (const Check& check : report.checks) {
    INFO(check.name << " = " << check.value);
    CHECK(check.passed());
    values[check.name] = check.value;
  }
  // The bounds are closer than those of the product's checks, which allow for slender bodies and fine meshes.
  for (const char* exact :
       {"rigid_motion_force", "mass_error", "centre_error", "inertia_error", "rigid_motion_recovery",
        "inertia_components_error", "rigid_motion_stress", "mode_orthogonality"}) {
    INFO(exact << " = " << values.at(exact));
    CHECK(values.at(exact) < 2e-13);
  }
  for (const char* rounded : {"rigid_motion_force_on_mesh", "stiffness_coupling", "mode_stiffness", "mode_residual"}) {
    INFO(rounded << " = " << values.at(rounded));
    CHECK(values.at(rounded) < 1e-9);
  }
  CHECK(values.at("spin_stiffness_virial") < 1e-9);
  if (!body.load_stiffness.empty()) {
    CHECK(values.at("load_stiffness_virial") < 1e-9);
  }
  // The stiffness does not couple constraint modes and fixed-boundary modes; modes are mass-normalised.
  const Eigen::Index m = body.modes(), b = body.interface_directions();
  CHECK(body.stiffness.topRightCorner(b, m).norm() == 0);
  const Eigen::VectorXd omega2 = (2 * std::numbers::pi * body.frequencies).cwiseAbs2();
  CHECK((body.stiffness.bottomRightCorner(m, m).diagonal() - omega2).norm() < 1e-12 * omega2.norm());
  CHECK(check_superelement(body).size() >= 8);
}

TEST_CASE("Free frequencies of the reduced body are above those of the full model, and converge to them") {
  const Mesh mesh = test::twisted_block();
  const Eigen::VectorXd full = test::SolidModel(mesh, test::steel()).frequencies(4);  // the full model has no ties
  double previous = 1e9;
  for (const int modes : {0, 4, 12, 30}) {
    const Superelement body = test::reduced(mesh, test::steel_body(Tie::average, Tie::average, modes));
    const Eigen::VectorXd error = free_frequencies(body).head(4).cwiseQuotient(full).array() - 1;
    CHECK(error.minCoeff() > -1e-10);  // the Rayleigh-Ritz bound, up to rounding
    CHECK(error.maxCoeff() < previous);
    previous = error.maxCoeff();
  }
  CHECK(previous < 5e-3);  // modes up to more than twice these frequencies, the rule of thumb of the method
}

TEST_CASE("Interface axes rotate the coordinates and change nothing else") {
  const Mesh mesh = test::twisted_block();
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 3);
  const Superelement plain = test::reduced(mesh, options);
  const Eigen::Matrix3d r = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  options.interfaces[0].rotation = options.interfaces[1].rotation = r;
  const Superelement turned = test::reduced(mesh, options);
  Eigen::MatrixXd transform = Eigen::MatrixXd::Identity(15, 15);
  for (int k = 0; k < 4; ++k) {
    transform.block<3, 3>(3 * k, 3 * k) = r;  // q = R q'
  }
  CHECK(difference(transform.transpose() * plain.stiffness * transform, turned.stiffness) < 1e-8);
  CHECK(difference(transform.transpose() * plain.mass * transform, turned.mass) < 1e-8);
}

TEST_CASE("Another position of the interface node only transforms the coordinates by the rigid arm") {
  const Mesh mesh = test::twisted_block();
  const Tie tie = GENERATE(Tie::rigid, Tie::average);
  ReductionOptions options = test::steel_body(tie, Tie::average, 3);
  const Superelement plain = test::reduced(mesh, options);
  const Eigen::Vector3d arm(-0.3, 0.2, 0.1);
  options.interfaces[0].position = plain.interfaces[0].position + arm;
  const Superelement moved = test::reduced(mesh, options);
  Eigen::MatrixXd transform = Eigen::MatrixXd::Identity(15, 15);
  transform.block<3, 3>(0, 3) = skew(arm);  // d at the old place = d' - theta x arm
  CHECK(difference(transform.transpose() * plain.stiffness * transform, moved.stiffness) < 1e-8);
  CHECK(difference(transform.transpose() * plain.mass * transform, moved.mass) < 1e-8);
}

TEST_CASE("Directions that are not kept are condensed statically") {
  const Mesh mesh = test::twisted_block();
  const Tie tie = GENERATE(Tie::rigid, Tie::average);
  ReductionOptions options = test::steel_body(tie, Tie::rigid);
  const Eigen::MatrixXd all = test::reduced(mesh, options).stiffness;
  options.interfaces[0].kept = {true, true, false, true, true, false};
  const Eigen::MatrixXd some = test::reduced(mesh, options).stiffness;
  const std::vector<int> kept{0, 1, 3, 4, 6, 7, 8, 9, 10, 11}, released{2, 5};
  const Eigen::MatrixXd inner = all(released, released), outer = all(kept, released);
  const Eigen::MatrixXd condensed =
      Eigen::MatrixXd(all(kept, kept)) - outer * regular_inverse(inner).value() * outer.transpose();
  CHECK(difference(condensed, some) < 1e-8);
}

TEST_CASE("An average interface is softer than a rigid one") {
  const Mesh mesh = test::twisted_block();
  const Superelement rigid = test::reduced(mesh, test::steel_body(Tie::rigid, Tie::rigid));
  const Superelement average = test::reduced(mesh, test::steel_body(Tie::average, Tie::average));
  const Eigen::MatrixXd gain = rigid.stiffness - average.stiffness;  // a constraint can only add stiffness
  const Eigen::VectorXd scale = rigid.stiffness.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd values = symmetric_eigenpairs(scale.asDiagonal() * gain * scale.asDiagonal()).values;
  CHECK(values.minCoeff() > -1e-9);
  CHECK(values.maxCoeff() > 1e-3);
}

TEST_CASE("Modes are limited by number, by frequency, or by both") {
  const Mesh mesh = test::twisted_block();
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 12);
  const Eigen::VectorXd twelve = test::reduced(mesh, options).frequencies;
  REQUIRE(twelve.size() == 12);
  options.modes.below = (twelve(6) + twelve(7)) / 2;
  CHECK(test::reduced(mesh, options).frequencies.size() == 7);
  options.modes.count.reset();
  CHECK((test::reduced(mesh, options).frequencies - twelve.head(7)).norm() < 1e-9 * twelve(6));
  options.modes.count = 3;
  CHECK(test::reduced(mesh, options).frequencies.size() == 3);
  options.modes.below.reset();
  options.modes.count = 100000;
  CHECK_THROWS_WITH(test::reduced(mesh, options), Contains("modes.count: 100000 fixed-boundary modes are asked for"));
  options.modes.count.reset();
  CHECK(test::reduced(mesh, options).modes() == 0);
}

TEST_CASE("The sum of effective masses is the part that the constraint modes do not contain") {
  const Mesh mesh = test::box_mesh({{0.2, 0.1, 0.1}, {2, 1, 1}});
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid);
  options.interfaces.pop_back();
  options.modes.count = 108;  // all modes, since there are 36 inner points
  const Superelement body = test::reduced(mesh, options);
  // With all modes, Phi Phi^T = M_ii^-1, so that the sums are (M U)_i^T M_ii^-1 (M U)_i with the rigid motions U about
  // the centre.
  const Solid solid = make_solid(mesh, options.materials, options.regions);
  const NodeGraph graph = node_graph(solid.mesh);
  const NodeMatrix mass = assemble_mass(solid, graph);
  const Eigen::MatrixXd m = mass.multiply(RowMatrix::Identity(mesh.point_count(), mesh.point_count()), 1);
  const RowMatrix momenta = mass.multiply(rigid_motions(mesh.points, body.centre), 3);
  std::vector<int> inside;
  for (int a = 0; a < mesh.point_count(); ++a) {
    if (mesh.points(0, a) > 0) {
      inside.push_back(a);
    }
  }
  REQUIRE(3 * inside.size() == 108);
  REQUIRE(body.modes() == 108);
  const Eigen::MatrixXd inner = m(inside, inside);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
  for (int i = 0; i < 3; ++i) {
    const Eigen::MatrixXd component = momenta(Eigen::seqN(i, mesh.point_count(), 3), Eigen::all);
    const Eigen::MatrixXd p = component(inside, Eigen::all);
    expected += (p.transpose() * solve_symmetric(inner, p)).diagonal();
  }
  const Eigen::VectorXd sums = body.effective_mass.colwise().sum();
  CHECK((sums - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("Damping is modal damping of the free body, or Rayleigh damping") {
  const Mesh mesh = test::twisted_block();
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 3);
  options.damping_ratios = {0.02};
  const Superelement body = test::reduced(mesh, options);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(15, 6);
  u.topRows(12) = interface_rigid_motions(body.interfaces, body.centre);
  CHECK(relative_force(body.damping, body.mass, u) < 1e-12);
  // The state matrix of M q.. + C q. + K q = 0 has the states (w q, q.). The ratio of each elastic mode is its decay
  // over its frequency. If w is close to the highest frequency, both halves have similar sizes; otherwise the rounding
  // of eigenvalues grows with w^2.
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(30, 30);
  const Eigen::MatrixXd inverse = regular_inverse(body.mass).value();
  const double w = std::sqrt((inverse * body.stiffness).norm());
  state << Eigen::MatrixXd::Zero(15, 15), w * Eigen::MatrixXd::Identity(15, 15), -inverse * body.stiffness / w,
      -inverse * body.damping;
  const Eigen::VectorXcd values = test::eigenvalues(state);
  const double lowest = 2 * std::numbers::pi * free_frequencies(body)(0);
  int elastic = 0;
  for (const std::complex<double>& value : values) {
    if (std::abs(value) > 0.5 * lowest) {
      ++elastic;
      CHECK(-value.real() / std::abs(value) == Approx(0.02).epsilon(1e-6));
    }
  }
  CHECK(elastic == 18);
  options.damping_ratios.clear();
  options.rayleigh = {{3.0, 2e-6}};
  const Superelement rayleigh = test::reduced(mesh, options);
  CHECK(difference(3.0 * rayleigh.mass + 2e-6 * rayleigh.stiffness, rayleigh.damping) < 1e-15);
}

TEST_CASE("The number of threads does not change the result beyond rounding") {
  const Mesh mesh = test::twisted_block();
  const ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 4);
  Progress quiet(true);
  const Superelement one = reduce_body(mesh, options, quiet, 1), two = reduce_body(mesh, options, quiet, 2);
  CHECK(difference(one.stiffness, two.stiffness) < 1e-9);
  CHECK(difference(one.mass, two.mass) < 1e-9);
}

TEST_CASE("A body in two pieces is refused") {
  Mesh chain = test::box_mesh({{3, 1, 1}, {3, 1, 1}});
  Eigen::MatrixXi kept(10, 0);
  for (const auto& cell : chain.blocks[0].nodes.colwise()) {
    const double x = chain.points(0, cell).mean();
    if (x < 1 || x > 2) {
      kept.conservativeResize(10, kept.cols() + 1);
      kept.rightCols<1>() = cell;
    }
  }
  chain.blocks[0].nodes = kept;
  CHECK_THROWS_WITH(test::reduced(chain, test::steel_body(Tie::rigid, Tie::rigid)), Contains("2 pieces"));
}
