// Tests of solid cells of all types: completeness, patch test, invariance, eigenvalues of a single cell.
#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/geometric_stiffness.hpp"
#include "reduce/fe/mean_strain.hpp"
#include "reduce/fe/mesh_error.hpp"
#include "reduce/fe/stress.hpp"
#include "reduce/fe/surface.hpp"
#include "reduce/mesh/shape_functions.hpp"
#include "tests/support/cell_box.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;
using test::cell_box;
using test::distortion;
using test::mixed_box;

namespace {

const Eigen::Vector3d extent(1.2, 0.9, 0.7);
const Material steel = Material::isotropic(2e5, 0.3, 4);

std::vector<CellType> solid_types() {
  std::vector<CellType> types;
  for (const CellInfo& cell : cell_table())
    if (cell.dimension == 3) types.push_back(cell.type);
  return types;
}

/// Cells of one type, or of all types of one order.
struct Cells {
  std::string name;
  std::function<Mesh(std::array<int, 3> bricks, double amount)> distorted_box;
};

std::vector<Cells> all_cells() {
  std::vector<Cells> result;
  for (const CellType type : solid_types())
    result.push_back({cell_name(type), [type](std::array<int, 3> bricks, double amount) {
                        return cell_box(type, extent, bricks, distortion(extent, amount));
                      }});
  for (const int order : {1, 2})
    result.push_back(
        {order == 1 ? "mixed, order 1" : "mixed, order 2", [order](std::array<int, 3> bricks, double amount) {
           return mixed_box(order, extent, bricks, distortion(extent, amount));
         }});
  return result;
}

Eigen::MatrixXd dense(const SymmetricMatrix& k) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(k.size, k.size);
  for (std::int64_t j = 0; j < k.size; ++j)
    for (std::int64_t p = k.starts[static_cast<std::size_t>(j)]; p < k.starts[static_cast<std::size_t>(j) + 1]; ++p)
      full(k.rows[static_cast<std::size_t>(p)], j) = full(j, k.rows[static_cast<std::size_t>(p)]) =
          k.values[static_cast<std::size_t>(p)];
  return full;
}

/// Displacements u = H x.
RowMatrix linear_field(const Mesh& mesh, const Eigen::Matrix3d& H) {
  RowMatrix u(3 * mesh.point_count(), 1);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) u.middleRows<3>(3 * a) = H * mesh.points.col(a);
  return u;
}

std::vector<int> all_nodes(const Mesh& mesh) {
  std::vector<int> nodes(static_cast<std::size_t>(mesh.point_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

bool is_inside(const Eigen::Vector3d& x) {
  return (x.array() > 1e-9).all() && (x.array() < extent.array() - 1e-9).all();
}

}  // namespace

TEST_CASE("Cells of all types have the mass, centre, inertia and surface of the box that they fill") {
  const Cells cells = GENERATE(from_range(all_cells()));
  CAPTURE(cells.name);
  const Mesh mesh = cells.distorted_box({2, 3, 2}, 0.1);
  const test::SolidModel model(mesh, steel);
  const MassProperties found = mass_properties(model.solid);
  CHECK(found.volume == Approx(extent.prod()).epsilon(1e-13));
  CHECK(found.mass == Approx(4 * extent.prod()).epsilon(1e-13));
  CHECK((found.centre - extent / 2).norm() < 1e-13);
  const Eigen::Array3d squares = extent.array().square();
  CHECK((found.inertia.diagonal().array() - found.mass / 12 * (squares.sum() - squares)).abs().maxCoeff() < 1e-12);
  // The mass matrix has the same mass.
  const RowMatrix ones = RowMatrix::Ones(mesh.point_count(), 1);
  CHECK(model.mass.multiply(ones, 1).sum() == Approx(found.mass).epsilon(1e-13));
  for (const auto& [name, area] : {std::pair<std::string, double>{"x1", extent.y() * extent.z()},
                                   {"y0", extent.x() * extent.z()},
                                   {"z1", extent.x() * extent.y()}}) {
    const SurfaceIntegrals surface = integrate_surface(mesh, name);
    CHECK(surface.area == Approx(area).epsilon(1e-13));
    CHECK(surface.weights.sum() == Approx(area).epsilon(1e-13));
    const int axis = name[0] - 'x';
    CHECK(surface.normals.row(axis).sum() == Approx(name[1] == '1' ? area : -area).epsilon(1e-13));
  }
}

TEST_CASE("Cells of all types pass the patch test: constant strain in distorted cells") {
  const Cells cells = GENERATE(from_range(all_cells()));
  CAPTURE(cells.name);
  const Mesh mesh = cells.distorted_box({3, 2, 2}, 0.12);
  const test::SolidModel model(mesh, steel);
  Eigen::Matrix3d H;
  H << 2, 1, 0.5, 1.5, -1, 0.3, 0.2, 0.4, 3;
  const RowMatrix u = linear_field(mesh, H), forces = model.stiffness.multiply(u, 1);
  const double scale = forces.cwiseAbs().maxCoeff();
  int inside = 0;
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a)
    if (is_inside(mesh.points.col(a))) {
      ++inside;
      CHECK(forces.middleRows<3>(3 * a).cwiseAbs().maxCoeff() < 1e-11 * scale);
    }
  CHECK(inside > 0);
  const Eigen::Matrix<double, 6, 1> strain = (Eigen::Matrix<double, 6, 1>() << H(0, 0), H(1, 1), H(2, 2),
                                              H(1, 2) + H(2, 1), H(0, 2) + H(2, 0), H(0, 1) + H(1, 0))
                                                 .finished();
  const Eigen::Matrix<double, 6, 1> expected = steel.elasticity * strain;
  const RowMatrix stress = nodal_stress(model.solid, u, all_nodes(mesh));
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a)
    CHECK((stress.middleRows<6>(6 * a) - expected).norm() < 1e-10 * expected.norm());
  CHECK((mean_strain(model.solid, u) - strain).norm() < 1e-12 * strain.norm());
  // The product is twice the energy; a constant stress has no error.
  CHECK((u.transpose() * forces)(0, 0) == Approx(extent.prod() * strain.dot(expected)).epsilon(1e-12));
  CHECK(estimate_mesh_error(model.solid, u).relative(0) < 1e-6);
}

TEST_CASE("A single distorted cell of any type has six motions without energy, the rigid ones") {
  const CellType type = GENERATE(from_range(solid_types()));
  CAPTURE(cell_name(type));
  const CellInfo& cell = cell_info(type);
  Mesh mesh;
  Eigen::MatrixXd x = local_nodes(type);
  for (Eigen::Index a = 0; a < x.cols(); ++a)  // bilinear terms keep edges straight, but not parallel
    x.col(a) += 0.1 * Eigen::Vector3d(x(1, a) * x(2, a), 0.5 * x(0, a) * x(2, a), -x(0, a) * x(1, a)) +
                Eigen::Vector3d(0.3 * x(1, a), 0, 0.2 * x(0, a));
  mesh.points = x;
  mesh.blocks.push_back({type, Eigen::VectorXi::LinSpaced(cell.nodes, 0, cell.nodes - 1)});
  const Solid solid = make_solid(mesh, {{"m", steel}}, {{"all", "m"}});
  const NodeGraph graph = node_graph(solid.mesh);
  const Eigen::MatrixXd K = dense(assemble_stiffness(solid, graph));
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
  CHECK(values.head<6>().cwiseAbs().maxCoeff() < 1e-10 * values.maxCoeff());
  CHECK(values(6) > 1e-4 * values.maxCoeff());
  const Eigen::VectorXd masses = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense([&] {
                                   SymmetricMatrix m;
                                   const NodeMatrix mass = assemble_mass(solid, graph);
                                   m.size = cell.nodes;
                                   m.starts = {0};
                                   for (int b = 0; b < cell.nodes; ++b) {
                                     for (int a = b; a < cell.nodes; ++a) {
                                       m.rows.push_back(a);
                                       m.values.push_back(mass.values[static_cast<std::size_t>(graph.place(b, a))]);
                                     }
                                     m.starts.push_back(static_cast<std::int64_t>(m.rows.size()));
                                   }
                                   return m;
                                 }()))
                                     .eigenvalues();
  CHECK(masses.minCoeff() > 0);
}

TEST_CASE("Plain integration stiffens hex8 and wedge6, reduced integration gives hex20 six hourglass modes") {
  const auto values = [](CellType type, Integration integration) {
    const Mesh mesh = cell_box(type, extent, {1, 1, 1});
    const Solid solid = make_solid(mesh, {{"m", steel}}, {{"all", "m"}}, integration);
    const Eigen::MatrixXd K = dense(assemble_stiffness(solid, node_graph(mesh)));
    return Eigen::VectorXd(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K / steel.elasticity(0, 0)).eigenvalues());
  };
  for (const CellType type : {CellType::hex8, CellType::wedge6}) {
    CAPTURE(cell_name(type));
    const Eigen::VectorXd standard = values(type, Integration::standard), plain = values(type, Integration::plain);
    CHECK((values(type, Integration::reduced) - standard).norm() < 1e-12);
    CHECK((plain - standard).minCoeff() > -1e-12);  // internal modes only reduce the stiffness
    CHECK(plain.sum() > 1.05 * standard.sum());
  }
  const Eigen::VectorXd standard = values(CellType::hex20, Integration::standard),
                        reduced = values(CellType::hex20, Integration::reduced);
  CHECK((values(CellType::hex20, Integration::plain) - standard).norm() < 1e-12);
  CHECK(standard(6) > 1e-3);
  // 60 displacements without six rigid motions leave 54 deformations, of which 48 have strain at the eight points.
  CHECK(reduced.head<12>().cwiseAbs().maxCoeff() < 1e-12);
  CHECK(reduced(12) > 1e-3);
}

TEST_CASE("Stiffness, stress and geometric stiffness of all types rotate with the body") {
  const Cells cells = GENERATE(from_range(all_cells()));
  CAPTURE(cells.name);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Mesh here = cells.distorted_box({1, 1, 2}, 0.1);
  Mesh there = here;
  there.points = R * here.points;
  const test::SolidModel a(here, steel), b(there, steel);
  RowMatrix u(3 * here.point_count(), 1), turned = u;
  for (Eigen::Index k = 0; k < u.rows(); ++k) u(k) = std::sin(1.0 + 7.0 * static_cast<double>(k));
  for (Eigen::Index k = 0; k < here.point_count(); ++k) turned.middleRows<3>(3 * k) = R * u.middleRows<3>(3 * k);
  const RowMatrix f = a.stiffness.multiply(u, 1), g = b.stiffness.multiply(turned, 1);
  for (Eigen::Index k = 0; k < here.point_count(); ++k)
    CHECK((R * f.middleRows<3>(3 * k) - g.middleRows<3>(3 * k)).norm() < 1e-10 * f.cwiseAbs().maxCoeff());
  const auto first_invariant = [](const RowMatrix& stress) {
    return Eigen::VectorXd(stress(Eigen::seqN(0, stress.rows() / 6, 6), 0) +
                           stress(Eigen::seqN(1, stress.rows() / 6, 6), 0) +
                           stress(Eigen::seqN(2, stress.rows() / 6, 6), 0));
  };
  const Eigen::VectorXd of_a = first_invariant(nodal_stress(a.solid, u, all_nodes(here)));
  const Eigen::VectorXd of_b = first_invariant(nodal_stress(b.solid, turned, all_nodes(here)));
  CHECK((of_a - of_b).norm() < 1e-10 * of_a.norm());
  const double one = reduced_geometric_stiffness(a.solid, a.graph, u, u)[0](0, 0);
  const double other = reduced_geometric_stiffness(b.solid, b.graph, turned, turned)[0](0, 0);
  CHECK(one == Approx(other).epsilon(1e-9));
}

TEST_CASE("The geometric stiffness of constant stress is the same for all types") {
  // The energy is int tr(H^T s H') dV with the constant gradient H of u and a constant stress s.
  const Cells cells = GENERATE(from_range(all_cells()));
  CAPTURE(cells.name);
  const Mesh mesh = cells.distorted_box({2, 1, 2}, 0.1);
  const test::SolidModel model(mesh, steel);
  Eigen::Matrix3d H, S;
  H << 0.1, 0.4, -0.2, 0.3, 0.2, 0.1, -0.5, 0.6, 0.3;
  S << 2, 1, 0.5, 1, -1, 0.3, 0.5, 0.3, 3;
  const RowMatrix stressed = linear_field(mesh, S), shape = linear_field(mesh, H);
  const Eigen::Matrix<double, 6, 1> strain =
      (Eigen::Matrix<double, 6, 1>() << S(0, 0), S(1, 1), S(2, 2), 2 * S(1, 2), 2 * S(0, 2), 2 * S(0, 1)).finished();
  const Eigen::Matrix<double, 6, 1> s = steel.elasticity * strain;
  const Eigen::Matrix3d stress = (Eigen::Matrix3d() << s(0), s(5), s(4), s(5), s(1), s(3), s(4), s(3), s(2)).finished();
  const double expected = extent.prod() * (H * stress * H.transpose()).trace();
  CHECK(reduced_geometric_stiffness(model.solid, model.graph, stressed, shape)[0](0, 0) ==
        Approx(expected).epsilon(1e-11));
}

TEST_CASE("An inverted cell of any type is named") {
  const CellType type = GENERATE(from_range(solid_types()));
  CAPTURE(cell_name(type));
  Mesh mesh = cell_box(type, extent, {1, 1, 1});
  mesh.points.row(0) *= -1;
  const Solid solid = make_solid(mesh, {{"m", steel}}, {{"all", "m"}});
  const NodeGraph graph = node_graph(solid.mesh);
  CHECK_THROWS_AS(assemble_stiffness(solid, graph), ComputationError);
  CHECK_THROWS_AS(assemble_mass(solid, graph), ComputationError);
}
