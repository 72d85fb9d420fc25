// Tests of materials whose axes follow the direction around a line, as in wound tubes.
#include <cmath>
#include <numbers>

#include "field.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/stress.hpp"
#include "tests/support/cell_box.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Eigen::Matrix3d, Eigen::Vector3d;

namespace test_wound_material {

constexpr double radial = 1e9, around = 9e9, along = 4e9;

/// Returns a material that is wound around a line. It has moduli along [radial, around, along] and no lateral
/// contraction.
Material wound(const Vector3d& point, const Vector3d& axis) {
  Material material = Material::orthotropic({radial, around, along}, Vector3d::Zero(), Vector3d(1e9, 1e9, 1e9), 1500);
  material.winding_point = point;
  material.winding_axis = axis.normalized();
  return material;
}

/// Returns a quarter of a tube around z with radii 1 and 2 and height 1, then moved.
Mesh quarter(CellType type, int n, const Eigen::Isometry3d& moved = Eigen::Isometry3d::Identity()) {
  return test::cell_box(type, {1, 1, 1}, {n, n, 1}, {}, [&](const Vector3d& x) {
    const double r = 1 + x.x(), angle = std::numbers::pi / 2 * x.y();
    return Vector3d(moved * Vector3d(r * std::cos(angle), r * std::sin(angle), x.z()));
  });
}

/// Returns the exact radial displacement of a tube of this material under pressure, a sum of r^k and r^-k with k^2 =
/// E_around / E_radial (S. G. Lekhnitskii, Theory of Elasticity of an Anisotropic Body, cylindrical anisotropy).
double displacement(double r) { return 1e-3 * (std::pow(r, 3) + std::pow(r, -3)); }

Vector3d exact(const Vector3d& x) {
  const double r = std::hypot(x.x(), x.y());
  return displacement(r) / r * Vector3d(x.x(), x.y(), 0);
}

bool on_surface(const Vector3d& x) {
  const double r = std::hypot(x.x(), x.y()), near = 1e-9;
  return r < 1 + near || r > 2 - near || x.x() < near || x.y() < near || x.z() < near || x.z() > 1 - near;
}

/// Returns the displacements of a quarter whose surface has the displacements of the exact solution.
RowMatrix solution(const test::SolidModel& model) {
  RowMatrix u = test::field(model.mesh, [](const Vector3d& x) { return on_surface(x) ? exact(x) : Vector3d::Zero(); });
  return u + model.solve(-model.stiffness.multiply(u));
}

double error(CellType type, int n) {
  const test::SolidModel model(quarter(type, n), wound(Vector3d::Zero(), Vector3d::UnitZ()),
                               [](const Vector3d& x, int) { return on_surface(x); });
  const RowMatrix right = test::field(model.mesh, exact);
  return (solution(model) - right).cwiseAbs().maxCoeff() / right.cwiseAbs().maxCoeff();
}

TEST_CASE("the deformation of a wound tube is the closed form of cylindrical anisotropy", "[fe]") {
  const CellType type = GENERATE(CellType::hex20, CellType::tet10, CellType::wedge15);
  const double coarse = error(type, 8), fine = error(type, 16);
  INFO(static_cast<int>(type) << ": " << coarse << " " << fine);
  CHECK(fine < 2e-3);
  // The order is 2, since a cell has the axes at its centroid. tet10 has a ratio of 3.1, and of 3.4 from 16 to 32; the
  // others have 4.
  CHECK(coarse / fine > 3);
}

TEST_CASE("the hoop stress of a wound tube is the closed form", "[fe]") {
  const test::SolidModel model(quarter(CellType::hex20, 12), wound(Vector3d::Zero(), Vector3d::UnitZ()),
                               [](const Vector3d& x, int) { return on_surface(x); });
  // At a point in the middle of the wall, on the x axis, the hoop stress is along y.
  int node = -1;
  for (int a = 0; a < model.mesh.point_count(); ++a)
    if ((model.mesh.points.col(a) - Vector3d(1.5, 0, 0)).norm() < 1e-9) node = a;
  REQUIRE(node >= 0);
  const RowMatrix stress = nodal_stress(model.solid, solution(model), {node}, 1);
  const double hoop = around * displacement(1.5) / 1.5;
  CHECK(stress(1, 0) == Approx(hoop).epsilon(0.01));
  CHECK(stress(0, 0) == Approx(radial * 1e-3 * 3 * (1.5 * 1.5 - std::pow(1.5, -4))).margin(0.01 * hoop));
}

TEST_CASE("winding an isotropic material changes nothing", "[fe]") {
  Material steel = Material::isotropic(210e9, 0.3, 7800);
  const test::SolidModel plain(quarter(CellType::hex8, 2), steel);
  steel.winding_point = Vector3d(3, 1, 2);
  steel.winding_axis = Vector3d(1, 2, 2) / 3;
  const test::SolidModel turned(quarter(CellType::hex8, 2), steel);
  const Eigen::Map<const Eigen::VectorXd> a(plain.stiffness.values.data(), plain.stiffness.values.size()),
      b(turned.stiffness.values.data(), turned.stiffness.values.size());
  CHECK((a - b).norm() < 1e-13 * a.norm());
}

TEST_CASE("a wound body that is moved and turned with its line keeps its frequencies", "[fe]") {
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.rotate(Eigen::AngleAxisd(0.9, Vector3d(1, -2, 2).normalized())).pretranslate(Vector3d(0.3, -2, 5));
  const test::SolidModel here(quarter(CellType::hex20, 2), wound(Vector3d(0, 0, 7), Vector3d::UnitZ()));
  const test::SolidModel there(quarter(CellType::hex20, 2, moved),
                               wound(moved * Vector3d(0, 0, -3), moved.linear() * Vector3d::UnitZ()));
  const Eigen::VectorXd f = here.frequencies(6);
  CHECK((there.frequencies(6) - f).norm() < 1e-7 * f.norm());
  const test::SolidModel straight(quarter(CellType::hex20, 2), wound(Vector3d(0, 0, 7), Vector3d::UnitX()));
  CHECK((straight.frequencies(6) - f).norm() > 1e-2 * f.norm());
}

TEST_CASE("cells on the line around which their material is wound are refused", "[fe]") {
  const Mesh mesh = test::cell_box(CellType::hex8, {1, 1, 1}, {1, 1, 1});
  CHECK_THAT(test::message_of<InputError>([&] {
               make_solid(mesh, {{"carbon", wound({0.5, 0.5, 0}, Vector3d::UnitZ())}}, {{"all", "carbon"}});
             }),
             Catch::Contains("materials.carbon: a cell at (0.5, 0.5, 0.5) m lies on the line"));
}

}  // namespace test_wound_material
