// Round bodies of gmsh's OpenCASCADE kernel against exact elasticity: a sphere in free vibration and under pressure, a
// spinning cylinder and a spinning disk, a shaft in torsion as a superelement.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "reduce/common/progress.hpp"
#include "reduce/fe/stress.hpp"
#include "reduce/fe/surface.hpp"
#include "reduce/mesh/import.hpp"
#include "reduce/reduction/checks.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/solid_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace test_round_bodies {
namespace {

const Material steel = Material::isotropic(210e9, 0.3, 7800);
constexpr double shear_modulus = 210e9 / 2.6, density = 7800;

/// Returns the body of gmsh's OpenCASCADE kernel that the lines build, lengths in metres.
Mesh round_body(const std::string& lines, double size, const std::vector<SurfaceSelection>& surfaces = {}) {
  const test::TemporaryFolder folder;
  MeshRequest request;
  request.path = folder.file("body.geo", "SetFactory(\"OpenCASCADE\");\n" + lines);
  request.size = size;
  request.surfaces = surfaces;
  Progress quiet(true);
  return import_mesh(request, quiet);
}

bool on_plane(const Eigen::Vector3d& x, int axis) { return std::abs(x(axis)) < 1e-9; }

RowMatrix nodal_load(const Mesh& mesh, const SurfaceIntegrals& surface, const Eigen::Matrix3Xd& forces) {
  RowMatrix load = RowMatrix::Zero(3 * mesh.point_count(), 1);
  for (std::size_t k = 0; k < surface.nodes.size(); ++k)
    load.middleRows<3>(3 * surface.nodes[k]) = forces.col(static_cast<Eigen::Index>(k));
  return load;
}

/// Returns the inertia forces of a body that spins about z.
RowMatrix centrifugal(const test::SolidModel& model, double omega) {
  RowMatrix field = RowMatrix::Zero(3 * model.mesh.point_count(), 1);
  for (Eigen::Index p = 0; p < model.mesh.point_count(); ++p)
    for (int i = 0; i < 2; ++i) field(3 * p + i) = omega * omega * model.mesh.points(i, p);
  return model.mass.multiply(field, 3);
}

/// Returns the largest of |value / exact - 1| over the nodes at a distance from the z axis, value(node, unit radial
/// vector).
template <class Value>
double worst_at(const Mesh& mesh, double radius, double exact, const Value& value) {
  double worst = -1;
  for (int p = 0; p < mesh.point_count(); ++p) {
    Eigen::Vector3d radial = mesh.points.col(p);
    radial.z() = 0;
    if (std::abs(radial.norm() - radius) < 1e-6)
      worst = std::max(worst, std::abs(value(p, Eigen::Vector3d(radial / radius)) / exact - 1));
  }
  return worst;
}

double hoop_stress(const test::SolidModel& model, const RowMatrix& u, int node, const Eigen::Vector3d& radial) {
  const RowMatrix s = nodal_stress(model.solid, u, {node});
  const Eigen::Vector2d t(-radial.y(), radial.x());
  return t.x() * t.x() * s(0) + t.y() * t.y() * s(1) + 2 * t.x() * t.y() * s(5);
}

}  // namespace

TEST_CASE("A free sphere: its lowest modes, five of torsion, and the breathing mode") {
  // H. Lamb, Proc. London Math. Soc. 13 (1882) 189, tests/references/elastic_bodies.py. Toroidal n = 2: k R = 2.50 with
  // k = omega sqrt(rho / G).
  const test::ReferenceTable exact("elastic_bodies");
  const double toroidal = exact("sphere.torsion_root") * std::sqrt(shear_modulus / density) / (2 * std::numbers::pi);
  CHECK(toroidal == Approx(exact("sphere.torsion")).epsilon(1e-12));
  Eigen::Vector2d errors;
  for (int level = 0; level < 2; ++level) {
    const test::SolidModel sphere(round_body("Sphere(1) = {0, 0, 0, 1};", level == 0 ? 0.34 : 0.17), steel);
    const Eigen::VectorXd found = sphere.frequencies(6);
    errors(level) = (found.head(5).array() / toroidal - 1).abs().maxCoeff();
    CHECK(found(5) > 1.05 * toroidal);  // spheroidal n = 2 is next, k R = 2.64
  }
  INFO(errors.transpose());
  CHECK(errors(1) < 1e-3);
  CHECK(std::log2(errors(0) / errors(1)) > 3);

  // Breathing, an octant between planes of symmetry: 2558.44 Hz; spheroidal n = 4 is 0.3 % above.
  const double breathing = exact("sphere.breathing");
  const test::SolidModel octant(round_body("Sphere(1) = {0, 0, 0, 1, 0, Pi/2, Pi/2};", 0.2), steel,
                                [](const Eigen::Vector3d& x, int i) { return on_plane(x, i); });
  const Eigen::VectorXd found = octant.frequencies(12);
  CHECK((found.array() / breathing - 1).abs().minCoeff() < 3e-4);
}

TEST_CASE("A hollow sphere under internal pressure: Lame's displacements and hoop stress") {
  // a = 0.1, b = 0.2 m, p = 100 MPa, A = p a^3 / (b^3 - a^3): u = A r / E (1 - 2 nu + (1 + nu) b^3 / (2 r^3)),
  // sigma_theta = A (1 + b^3 / (2 r^3)). An octant between planes of symmetry.
  const double a = 0.1, b = 0.2, lame = 100e6 / 7;
  Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(2, 3);  // largest of u(a), u(b); mean of the hoop stress at a
  for (int level = 0; level < 2; ++level) {
    const Mesh mesh = round_body(
        "Sphere(1) = {0, 0, 0, 0.2, 0, Pi/2, Pi/2}; Sphere(2) = {0, 0, 0, 0.1, 0, Pi/2, Pi/2};\n"
        "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n",
        0.02 / (1 + level), {{"bore", {ShapeSelector(BoxSelector{{0, 0, 0}, {a, a, a}})}, ""}});
    const test::SolidModel model(mesh, steel, [](const Eigen::Vector3d& x, int i) { return on_plane(x, i); });
    const SurfaceIntegrals bore = integrate_surface(mesh, "bore");
    CHECK(bore.area == Approx(std::numbers::pi * a * a / 2).epsilon(1e-4));
    const RowMatrix u = model.solve(nodal_load(mesh, bore, pressure_forces(bore, 100e6)));
    for (Eigen::Index p = 0; p < mesh.point_count(); ++p) {
      const double r = mesh.points.col(p).norm();
      if (std::abs(r - a) > 1e-6 && std::abs(r - b) > 1e-6) continue;
      const double exact = lame * r / 210e9 * (0.4 + 1.3 * b * b * b / (2 * r * r * r));
      const double found = u.middleRows<3>(3 * p).col(0).dot(mesh.points.col(p)) / r;
      double& error = errors(level, r < 0.15 ? 0 : 1);
      error = std::max(error, std::abs(found / exact - 1));
    }
    const RowMatrix stress = nodal_stress(model.solid, u, bore.nodes);
    double mean = 0;
    for (std::size_t k = 0; k < bore.nodes.size(); ++k) {
      const Eigen::VectorXd s = stress.middleRows<6>(6 * static_cast<Eigen::Index>(k)).col(0);
      const Eigen::Vector3d n = mesh.points.col(bore.nodes[k]) / a;
      Eigen::Matrix3d tensor;
      tensor << s(0), s(5), s(4), s(5), s(1), s(3), s(4), s(3), s(2);
      mean += (tensor.trace() - n.dot(tensor * n)) / 2 / static_cast<double>(bore.nodes.size());
    }
    errors(level, 2) = std::abs(mean / (5 * lame) - 1);
  }
  INFO(errors);
  CHECK(errors.row(0).minCoeff() > 0);
  CHECK(errors.row(1).maxCoeff() < 2e-3);
  CHECK(std::log2(errors(0, 0) / errors(1, 0)) > 2.5);  // displacements are of order three
  CHECK(std::log2(errors(0, 1) / errors(1, 1)) > 2.5);
}

TEST_CASE("A spinning solid cylinder in plane strain, and a spinning disk with a hole in plane stress") {
  // S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, 1000 rad/s. Cylinder R = 0.2 m: u(R) = 3.8628571428571e-5 m,
  // hoop stress on the axis 133.714285714 MPa. Disk 0.05 / 0.25 m: hoop stress 405.6 MPa inside, 101.4 MPa outside.
  const test::SolidModel cylinder(round_body("Cylinder(1) = {0, 0, 0, 0, 0, 0.04, 0.2, Pi/2};", 0.03), steel,
                                  [](const Eigen::Vector3d& x, int i) { return i == 2 || on_plane(x, i); });
  const RowMatrix u = cylinder.solve(centrifugal(cylinder, 1000));
  const double displacement = worst_at(cylinder.mesh, 0.2, 3.8628571428571e-5, [&](int p, const Eigen::Vector3d& n) {
    return u.middleRows<3>(3 * p).col(0).dot(n);
  });
  CHECK(displacement >= 0);
  CHECK(displacement < 2e-3);
  int centre = 0;
  cylinder.mesh.points.colwise().norm().minCoeff(&centre);
  CHECK(hoop_stress(cylinder, u, centre, Eigen::Vector3d::UnitX()) == Approx(133.714285714e6).epsilon(0.01));

  const Mesh ring = test::box_mesh({{1, 1, 1}, {16, 12, 1}}, [](const Eigen::Vector3d& x) {
    const double radius = 0.05 + 0.2 * x.x() * x.x(), angle = std::acos(0.0) * x.y();  // finer at the hole
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0.002 * x.z());
  });
  const test::SolidModel disk(ring, steel, [](const Eigen::Vector3d& x, int i) { return on_plane(x, i); });
  const RowMatrix v = disk.solve(centrifugal(disk, 1000));
  const auto hoop = [&](int p, const Eigen::Vector3d& n) { return hoop_stress(disk, v, p, n); };
  CHECK(worst_at(ring, 0.05, 405.6e6, hoop) < 0.02);
  CHECK(worst_at(ring, 0.25, 101.4e6, hoop) < 0.02);
}

TEST_CASE(
    "A round shaft as a superelement: Saint-Venant's torsion, whose sections stay plane, is exact for rigid ends") {
  // Stiffness G pi R^4 / (2 L); held at both ends, and free: f = sqrt(G / rho) / (2 L).
  const double radius = 0.1, length = 1, exact = std::sqrt(shear_modulus / density) / (2 * length);
  CHECK(exact == Approx(1608.9615894886).epsilon(1e-12));
  const double stiffness = shear_modulus * std::numbers::pi * std::pow(radius, 4) / (2 * length);
  const auto end = [](const std::string& name, double x) {
    return SurfaceSelection{name, {ShapeSelector(PlaneSelector{{x, 0, 0}, {1, 0, 0}})}, ""};
  };
  const Mesh mesh = round_body("Cylinder(1) = {0, 0, 0, 1, 0, 0, 0.1};", 0.06, {end("left", 0), end("right", length)});
  ReductionOptions options;
  options.name = "shaft";
  options.materials = {{"steel", steel}};
  options.regions = {{"all", "steel"}};
  for (const char* name : {"left", "right"}) {
    options.interfaces.emplace_back();
    options.interfaces.back().name = options.interfaces.back().group = name;
  }
  options.modes.count = 20;
  Progress quiet(true);
  const Superelement shaft = reduce_body(mesh, options, quiet, 1);
  for (const auto& [i, j, sign] : {std::tuple{3, 3, 1}, {9, 9, 1}, {3, 9, -1}}) {
    INFO(shaft.stiffness(i, j) / stiffness - sign);
    CHECK(sign * shaft.stiffness(i, j) == Approx(stiffness).epsilon(2e-3));
  }
  const auto nearest = [&](const Eigen::VectorXd& found) { return (found.array() / exact - 1).abs().minCoeff(); };
  CHECK(nearest(shaft.frequencies) < 1e-3);
  // The free shaft follows from its ends and the torsion modes of the held one (two among 20): its frequency is
  // slightly higher.
  CHECK(nearest(free_frequencies(shaft)) < 1e-2);
}

}  // namespace test_round_bodies
