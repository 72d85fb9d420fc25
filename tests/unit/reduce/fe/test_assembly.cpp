#include <cmath>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/fe/geometric_stiffness.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/unit/reduce/fe/field.hpp"

using namespace bielle;
using namespace bielle::reduce;
using bielle::test::field;

namespace {

using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// Columns: three translations, three rotations about the origin.
RowMatrix rigid_motions(const Mesh& mesh) {
  RowMatrix result(3 * mesh.point_count(), 6);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
    result.col(k) = field(mesh, [&](const auto&) { return axis; });
    result.col(3 + k) = field(mesh, [&](const auto& x) { return Eigen::Vector3d(axis.cross(x)); });
  }
  return result;
}

const Map curved = [](const Eigen::Vector3d& x) {
  return Eigen::Vector3d(x.x() + 0.05 * x.y() * x.z(), x.y() + 0.15 * x.x() * x.x(), x.z() - 0.1 * x.x() * x.y());
};

Material wood() { return Material::orthotropic({12e9, 1e9, 0.8e9}, {0.4, 0.35, 0.3}, {0.1e9, 0.8e9, 0.9e9}, 500); }

double largest_entry(const SymmetricMatrix& k) { return *std::max_element(k.values.begin(), k.values.end()); }

/// Returns the nodes that are not on the surface of the unit box.
std::vector<int> interior(const Mesh& flat) {
  std::vector<int> result;
  for (Eigen::Index a = 0; a < flat.point_count(); ++a) {
    const auto x = flat.points.col(a).array();
    if ((x > 1e-9).all() && (x < 1 - 1e-9).all()) {
      result.push_back(static_cast<int>(a));
    }
  }
  return result;
}

}  // namespace

TEST_CASE("Rigid motions cause no force, on straight and curved cells of both orders") {
  const bool quadratic = GENERATE(true, false);
  const bool bent = GENERATE(true, false);
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 3, 2}, quadratic}, bent ? curved : Map{});
  const Solid solid = make_solid(mesh, {{"wood", wood()}}, {{"all", "wood"}});
  const SymmetricMatrix k = assemble_stiffness(solid, node_graph(solid.mesh), 2);
  // Each row is a sum of some hundred entries times displacements of order one.
  CHECK(k.multiply(rigid_motions(mesh)).cwiseAbs().maxCoeff() < 1e-12 * largest_entry(k));
}

TEST_CASE("Homogeneous strain is exact on distorted and on curved meshes: no inner forces, the exact energy") {
  const int variant = GENERATE(0, 1, 2);  // distorted straight tet10, curved tet10, tet4
  const test::Box box{{1, 1, 1}, {3, 3, 3}, variant != 2};
  const Mesh flat = test::box_mesh(box);
  const Mesh mesh =
      variant == 0 ? test::distorted_box_mesh(box, 0.25) : test::box_mesh(box, variant == 1 ? curved : Map{});
  const Solid solid = make_solid(mesh, {{"wood", wood()}}, {{"all", "wood"}});
  const SymmetricMatrix k = assemble_stiffness(solid, node_graph(solid.mesh), 2);
  const Eigen::Matrix3d h = (Eigen::Matrix3d() << 1, 0.4, -0.3, 0.2, -0.7, 0.5, 0.6, 0.1, 0.9).finished();
  const RowMatrix u = field(mesh, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(h * x); });
  const RowMatrix force = k.multiply(u);
  const std::vector<int> inside = interior(flat);
  REQUIRE(inside.size() >= 8);
  for (const int a : inside) {
    CHECK(force.middleRows<3>(3 * a).norm() < 1e-11 * force.cwiseAbs().maxCoeff());
  }
  const Vector6 strain = strain_of(h);
  const double volume = mass_properties(solid).volume;
  CHECK((u.transpose() * force)(0, 0) == Approx(strain.dot(wood().elasticity * strain) * volume).epsilon(1e-12));
}

TEST_CASE("Quadratic cells represent pure bending exactly on a distorted mesh with straight sides") {
  // The field is Saint-Venant's bending about z with unit curvature: sigma_xx = -E y, all other stresses are zero.
  const double nu = 0.3, young = 2e5;
  const test::Box box{{1, 1, 1}, {3, 3, 3}};
  const Mesh mesh = test::distorted_box_mesh(box, 0.25);
  const Solid solid = make_solid(mesh, {{"m", Material::isotropic(young, nu, 1)}}, {{"all", "m"}});
  const SymmetricMatrix k = assemble_stiffness(solid, node_graph(solid.mesh));
  const RowMatrix u = field(mesh, [&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(-x.x() * x.y(), (x.x() * x.x() + nu * (x.y() * x.y() - x.z() * x.z())) / 2,
                           nu * x.y() * x.z());
  });
  const RowMatrix force = k.multiply(u);
  for (const int a : interior(test::box_mesh(box))) {
    CHECK(force.middleRows<3>(3 * a).norm() < 1e-11 * force.cwiseAbs().maxCoeff());
  }
  CHECK((u.transpose() * force)(0, 0) == Approx(young / 3).epsilon(1e-12));  // int E y^2 dV
}

TEST_CASE("The mass matrix has the mass and moments of inertia of the body, on curved cells as well") {
  const bool bent = GENERATE(true, false);
  const bool quadratic = GENERATE(true, false);
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 2, 3}, quadratic}, bent && quadratic ? curved : Map{});
  const Solid solid = make_solid(mesh, {{"wood", wood()}}, {{"all", "wood"}});
  const NodeGraph graph = node_graph(solid.mesh);
  const NodeMatrix m = assemble_mass(solid, graph, 2);
  const MassProperties body = mass_properties(solid);
  const RowMatrix u = rigid_motions(mesh);
  const Eigen::MatrixXd rigid = u.transpose() * m.multiply(u, 3);
  Eigen::Matrix3d cross;
  const Eigen::Vector3d c = body.centre;
  cross << 0, -c.z(), c.y(), c.z(), 0, -c.x(), -c.y(), c.x(), 0;
  Eigen::MatrixXd expected(6, 6);
  expected << body.mass * Eigen::Matrix3d::Identity(), -body.mass * cross, body.mass * cross,
      body.inertia - body.mass * cross * cross;
  CHECK((rigid - expected).norm() < 1e-13 * expected.norm());
}

TEST_CASE("The mass matrix of straight cells integrates exactly all products of fields that they represent") {
  const bool quadratic = GENERATE(true, false);
  const test::Box box{{1, 1, 1}, {2, 2, 2}, quadratic};
  const Mesh mesh = test::distorted_box_mesh(box, 0.25);
  const Solid solid = make_solid(mesh, {{"wood", wood()}}, {{"all", "wood"}});
  const NodeGraph graph = node_graph(solid.mesh);
  const NodeMatrix m = assemble_mass(solid, graph, 2);
  std::vector<Eigen::Vector3d> powers;
  const int degree = quadratic ? 2 : 1;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k) powers.emplace_back(i, j, k);
  const auto count = static_cast<Eigen::Index>(powers.size());
  RowMatrix u(3 * mesh.point_count(), count);
  Eigen::MatrixXd expected(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const Eigen::Vector3d& p = powers[static_cast<std::size_t>(a)];
    u.col(a) = field(mesh, [&](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(std::pow(x.x(), p.x()) * std::pow(x.y(), p.y()) * std::pow(x.z(), p.z()), 0, 0);
    });
    for (Eigen::Index b = 0; b < count; ++b)  // the integral of a monomial over the unit cube
      expected(a, b) = wood().density / (p + powers[static_cast<std::size_t>(b)] + Eigen::Vector3d::Ones()).prod();
  }
  CHECK((u.transpose() * m.multiply(u, 3) - expected).norm() < 1e-13 * expected.norm());
}

TEST_CASE("Matrices do not depend on the number of threads") {
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {3, 2, 2}}, curved);
  const Solid solid = make_solid(mesh, {{"wood", wood()}}, {{"all", "wood"}});
  const NodeGraph graph = node_graph(solid.mesh, 2);
  CHECK(assemble_stiffness(solid, graph, 1).values == assemble_stiffness(solid, graph, 2).values);
  CHECK(assemble_mass(solid, graph, 1).values == assemble_mass(solid, graph, 2).values);
}

TEST_CASE("The energy of the geometric stiffness is the work of the stress on second-order strains") {
  const bool bent = GENERATE(true, false);
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 2, 2}}, bent ? curved : Map{});
  const Solid solid = make_solid(mesh, {{"wood", wood()}}, {{"all", "wood"}});
  const NodeGraph graph = node_graph(solid.mesh);
  const Eigen::Matrix3d h0 = 1e-3 * Eigen::Matrix3d::Random(), h = Eigen::Matrix3d::Random();
  RowMatrix fields(3 * mesh.point_count(), 2);
  fields << field(mesh, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(h0 * x); }), rigid_motions(mesh).col(4);
  const RowMatrix u = field(mesh, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(h * x); });
  const std::vector<Eigen::MatrixXd> work = reduced_geometric_stiffness(solid, graph, fields, u, 2);
  const Eigen::Matrix3d stress = tensor_of(Vector6(wood().elasticity * strain_of(h0)));
  const double volume = mass_properties(solid).volume;
  CHECK(work[0](0, 0) == Approx(volume * (stress * h.transpose() * h).trace()).epsilon(1e-11));
  CHECK(std::abs(work[1](0, 0)) < 1e-3);  // a rotation has no stress, up to 1e-13 of E = 12e9
}

TEST_CASE("An inverted cell is named with its place") {
  Mesh mesh = test::box_mesh({{1, 1, 1}, {1, 1, 1}});
  std::swap(mesh.blocks[0].nodes(0, 2), mesh.blocks[0].nodes(1, 2));
  const Solid solid = make_solid(mesh, {{"wood", wood()}}, {{"all", "wood"}});
  const NodeGraph graph = node_graph(solid.mesh);
  CHECK_THROWS_WITH(assemble_stiffness(solid, graph), Catch::Contains("cell 2 of the mesh, near"));
  CHECK_THROWS_AS(assemble_mass(solid, graph), ComputationError);
}
