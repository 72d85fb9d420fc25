// Compares the reduction of matrices of other programs with that of the mesh from which they come, and with closed
// forms.
#include <numbers>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/matrices/superelement_set.hpp"
#include "tests/unit/reduce/matrices/matrix_bodies.hpp"
#include "tests/unit/reduce/matrices/verified.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

/// A body whose ends are tied, as a mesh and as matrices.
struct BothWays {
  Superelement mesh, matrices;
};

BothWays reduced_both_ways(Tie a, Tie b, int modes, bool turned = false) {
  Mesh mesh = test::twisted_block();
  for (const char* name : {"x0", "x1"}) {
    Group group;  // the tie has nodes of equal weight in place of the surface
    group.nodes = mesh.groups.at(name).nodes;
    group.weights.assign(group.nodes.size(), 1.0);
    mesh.groups[std::string(name) + " nodes"] = group;
  }
  ReductionOptions options = test::steel_body(a, b, modes);
  MatrixOptions foreign;
  foreign.interfaces = {test::tied("a", test::node_numbers(mesh, "x0"), a),
                        test::tied("b", test::node_numbers(mesh, "x1"), b)};
  foreign.modes.count = modes;
  for (std::size_t k = 0; k < 2; ++k) {
    options.interfaces[k].group += " nodes";
    const Group& group = mesh.groups.at(options.interfaces[k].group);
    foreign.interfaces[k].position = mesh.points(Eigen::all, group.nodes).rowwise().mean();
    options.interfaces[k].position = foreign.interfaces[k].position;
  }
  MatrixSet set = test::matrices_of(mesh);
  if (turned) test::turn_nodes(set);
  return {test::reduced(mesh, options), test::reduced(set, foreign)};
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff();
}

}  // namespace

/// Returns the signs of the modes of `body` relative to those of another, from the displacements; 1 for the interfaces.
Eigen::VectorXd signs(const Superelement& body, const Superelement& other) {
  Eigen::VectorXd result = Eigen::VectorXd::Ones(body.size());
  for (Eigen::Index k = body.interface_directions(); k < body.size(); ++k)
    if (body.displacement_recovery.col(k).dot(other.displacement_recovery.col(k)) < 0) result(k) = -1;
  return result;
}

TEST_CASE("Matrices of a mesh reduce to the superelement of the mesh") {
  const auto [a, b] = GENERATE(std::pair{Tie::rigid, Tie::rigid}, std::pair{Tie::rigid, Tie::average},
                               std::pair{Tie::average, Tie::average});
  const bool turned = GENERATE(false, true);
  const auto [mesh, matrices] = reduced_both_ways(a, b, 6, turned);
  REQUIRE(matrices.size() == mesh.size());
  CHECK(difference(mesh.frequencies, matrices.frequencies) < 1e-9);
  CHECK(difference(mesh.stiffness, matrices.stiffness) < 1e-9);
  const Eigen::VectorXd sign = signs(matrices, mesh);
  const auto same = [&](const Eigen::MatrixXd& matrix) { return sign.asDiagonal() * matrix * sign.asDiagonal(); };
  CHECK(difference(mesh.mass, same(matrices.mass)) < 1e-8);
  for (std::size_t k = 0; k < 6; ++k)
    CHECK((mesh.inertia_components[k] - same(matrices.inertia_components[k])).norm() < 1e-8 * mesh.mass.norm());
  CHECK(difference(mesh.displacement_recovery, matrices.displacement_recovery * sign.asDiagonal()) < 1e-7);
  CHECK(difference(mesh.effective_mass, matrices.effective_mass) < 1e-7);
  CHECK(matrices.total_mass == Approx(mesh.total_mass).epsilon(1e-11));
  CHECK((matrices.centre - mesh.centre).norm() < 1e-11);
  CHECK(difference(mesh.inertia, matrices.inertia) < 1e-10);
}

TEST_CASE("Modes of matrices of large bodies are found by iteration") {
  const Mesh mesh = test::box_mesh({{0.4, 0.1, 0.15}, {6, 3, 3}});
  MatrixOptions options;
  options.interfaces = {test::tied("a", test::node_numbers(mesh, "x0"))};
  options.modes.count = 5;
  const MatrixSet set = test::matrices_of(mesh);
  REQUIRE(set.size() > most_unasked_modes);
  const Superelement counted = test::reduced(set, options);
  CHECK(counted.modes() == 5);
  options.modes.count.reset();
  options.modes.below = 1.01 * counted.frequencies(3);
  const Superelement below = test::reduced(set, options);
  REQUIRE(below.modes() == 4);
  CHECK(difference(counted.frequencies.head(4), below.frequencies) < 1e-8);
  options.modes.count = 2;  // the lowest of four
  const Superelement both = test::reduced(set, options);
  REQUIRE(both.modes() == 2);
  CHECK(difference(counted.frequencies.head(2), both.frequencies) < 1e-8);
  options.modes.count = 30;
  CHECK(test::reduced(set, options).modes() == 4);
  options.modes.count.reset();
  options.modes.below.reset();
  CHECK_THROWS_WITH(test::reduced(set, options), Contains("tell how many modes to keep"));
  options.modes.count = 100000;
  CHECK_THROWS_WITH(test::reduced(set, options), Contains("100000 fixed-boundary modes are asked for"));
}

TEST_CASE("A reduced beam keeps its matrices, independently of the scalars for its interior") {
  MatrixSet set = test::beam_set(3);
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10}), test::tied("b", {40})};
  const Superelement plain = test::reduced(set, options);
  REQUIRE(plain.modes() == 12);
  // A regular matrix turns the unknowns of the two inner nodes into scalars.
  Eigen::MatrixXd mixed = Eigen::MatrixXd::Identity(24, 24);
  mixed.block(6, 6, 12, 12) += 0.3 * Eigen::MatrixXd::Random(12, 12);
  set.stiffness = test::sparse(mixed.transpose() * set.stiffness * mixed);
  set.mass = test::sparse(mixed.transpose() * set.mass * mixed);
  for (int k = 0; k < 12; ++k) set.unknowns[static_cast<std::size_t>(6 + k)] = {-1, k};
  const Superelement scalars = test::reduced(set, options);
  CHECK(difference(plain.stiffness, scalars.stiffness) < 1e-9);
  CHECK(difference(plain.frequencies, scalars.frequencies) < 1e-9);
  CHECK(difference(plain.mass.cwiseAbs(), scalars.mass.cwiseAbs()) < 1e-7);  // modes are determined up to their sign
  CHECK(plain.total_mass == Approx(6));
  CHECK(plain.centre.x() == Approx(1));
  CHECK(plain.inertia(2, 2) == Approx(2.0));  // m L^2 / 12
  CHECK(plain.inertia(0, 0) == Approx(2e-4));
}

TEST_CASE("The stiffness at the only interface of a body is zero up to rounding") {
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10})};
  const Superelement body = test::reduced(test::beam_set(3), options);
  REQUIRE(body.interface_directions() == 6);
  MatrixSet set = matrix_set_of(body);
  const bool noisy = GENERATE(false, true);
  if (noisy)
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) set.stiffness.coeffRef(i, j) = 1e-10 * (i - 2 * j);  // neither symmetric nor definite
  CHECK(test::faults_of(set) == "");
  const Superelement again = test::reduced(set, {});
  CHECK(again.stiffness.topLeftCorner(6, 6).norm() == 0);
  CHECK(difference(body.frequencies, again.frequencies) < 1e-9);
  // The body is connected to the ground by a spring on which it would vibrate at a tenth of its first frequency.
  set.stiffness.coeffRef(1, 1) += 0.01 * std::pow(2 * std::numbers::pi * body.frequencies(0), 2) * body.total_mass;
  CHECK_THROWS_WITH(test::reduced(set, {}), Contains("held to the ground"));
}

TEST_CASE("The interfaces of a reduced file are all of its nodes, or those that it declares") {
  MatrixSet set = test::beam_set(2);
  const Superelement all = test::reduced(set, {});
  REQUIRE(all.interfaces.size() == 3);
  CHECK(all.interfaces[1].name == "node_20");
  CHECK(all.modes() == 0);
  set.interfaces = {{"left", 0}, {"right", 2}};
  const Superelement declared = test::reduced(set, {});
  REQUIRE(declared.interfaces.size() == 2);
  CHECK(declared.interfaces[0].name == "left");
  CHECK(declared.modes() == 6);
}

TEST_CASE("A direction that an interface releases is an inner unknown, also in axes of the interface") {
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10}), test::tied("b", {20})};
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()).toRotationMatrix();
  options.interfaces[1].rotation = turn;
  // The interface releases the rotation about its own z, as a hinge does.
  options.interfaces[1].kept = {true, true, true, true, true, false};
  const Superelement body = test::reduced(test::beam_set(), options);
  REQUIRE(body.interface_directions() == 11);
  CHECK(body.modes() == 1);
  // If the interface is displaced along its own y by w, the beam is a cantilever in this plane: the force is 3 EI w /
  // L^3 with EI of this plane.
  const double s = std::sin(0.7), c = std::cos(0.7), EIz = 3e4, EIy = 2e4;
  // The hinge releases the rotation about z' alone. The condensation of this rotation gives k_yy - k_yr^2 / k_rr in the
  // turned axes.
  const double EI1 = c * c * EIz + s * s * EIy, L = 2;
  CHECK(body.stiffness(7, 7) == Approx(12 * EI1 / 8 - std::pow(6 * EI1 / 4, 2) / (4 * EI1 / L)));
}

TEST_CASE("Matrices with massless rotations, as lumped ones have, can be reduced") {
  MatrixSet set = test::beam_set(4);
  Eigen::MatrixXd lumped = Eigen::MatrixXd::Zero(set.size(), set.size());
  for (Eigen::Index k = 0; k < set.size(); ++k)
    if (!set.unknowns[static_cast<std::size_t>(k)].is_rotation()) {
      const int node = set.unknowns[static_cast<std::size_t>(k)].node;
      lumped(k, k) = node == 0 || node == 4 ? 0.75 : 1.5;
    }
  set.mass = test::sparse(lumped);
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10}), test::tied("b", {50})};
  const Superelement body = test::reduced(set, options);
  CHECK(body.modes() == 9);  // three inner masses with three directions each
  CHECK(body.total_mass == Approx(6));
}

TEST_CASE("Unknowns without any entries are dropped") {
  MatrixSet set = test::beam_set();
  const Superelement before = test::reduced(set, {});
  set.unknowns.push_back({-1, 0});
  set.stiffness.conservativeResize(13, 13);
  set.mass.conservativeResize(13, 13);
  const Superelement after = test::reduced(set, {});
  CHECK(after.size() == before.size());
  CHECK(difference(before.stiffness, after.stiffness) < 1e-14);
}

TEST_CASE("Damping matrices and points are reduced with the body") {
  MatrixSet set = test::beam_set(2);
  set.damping = SparseColumns(1e-4 * set.stiffness);
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10}), test::tied("b", {30})};
  NodePoint node, place;
  node.name = "middle";
  node.node = 20;
  place.name = "near";
  place.place = Eigen::Vector3d(2, 0, 0);
  options.points = {node};
  const Superelement body = test::reduced(set, options);
  CHECK(difference(1e-4 * body.stiffness, body.damping) < 1e-9);
  // If the clamped right end of a beam is raised by w, its middle has the displacement w / 2 and the slope 3 w / (2 L).
  CHECK(body.points.at("middle").shapes(1, 7) == Approx(0.5));
  CHECK(body.points.at("middle").shapes(5, 7) == Approx(0.75));
  options.damping_ratios = {0.02};
  CHECK(test::reduced(set, options).damping.norm() > 0);
  CHECK(difference(body.damping, test::reduced(set, options).damping) > 0.01);
}

TEST_CASE("Residual vectors make the static response at points exact") {
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10}), test::tied("b", {60})};
  options.modes.count = 2;
  NodePoint point;
  point.name = "quarter";
  point.node = 30;
  point.residual = {false, true, false, false, false, true};
  point.subject = "points.quarter";
  options.points = {point};
  const Superelement body = test::reduced(test::beam_set(5), options);
  REQUIRE(body.residual_vectors == 2);
  // A beam of length L, clamped at both ends, with a force at a has w = F a^3 b^3 / (3 EI L^3) and the slope F a^2 b^2
  // (b - a) / (2 EI L^3) there.
  const double a = 0.8, b = 1.2, L = 2, EI = 3e4;
  const Eigen::MatrixXd shapes = body.points.at("quarter").shapes.rightCols(body.modes());
  const Eigen::VectorXd stiffness = body.stiffness.diagonal().tail(body.modes());
  const Eigen::VectorXd answer = stiffness.cwiseInverse().cwiseProduct(shapes.row(1).transpose());
  CHECK(shapes.row(1).dot(answer) == Approx(std::pow(a * b / L, 3) / (3 * EI)).epsilon(1e-9));
  CHECK(shapes.row(5).dot(answer) == Approx(a * a * b * b * (b - a) / (2 * EI * L * L * L)).epsilon(1e-9));
  options.modes.count.reset();  // all modes together have the complete response
  CHECK_THROWS_WITH(test::reduced(test::beam_set(5), options), Contains("points.quarter") && Contains("leave nothing"));
}

TEST_CASE("The geometric stiffness of the file belongs to the spin that the user states") {
  MatrixSet set = test::beam_set();
  MatrixOptions options;
  options.spin = Eigen::Vector3d(0, 0, 50);
  CHECK_THROWS_WITH(test::reduced(set, options), Contains("no geometric stiffness"));
  set.geometric_stiffness = SparseColumns(0.01 * set.stiffness);
  const Superelement body = test::reduced(set, options);
  CHECK(difference(0.01 / 2500 * body.stiffness, body.spin_stiffness[2]) < 1e-9);
  CHECK(body.spin_stiffness[0].norm() == 0);
  options.spin = Eigen::Vector3d(0, 1, 50);
  CHECK_THROWS_WITH(test::reduced(set, options), Contains("along one axis"));
}
