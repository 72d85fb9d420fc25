// Mass, centre and inertia of bodies that gmsh's OpenCASCADE kernel builds and meshes, against the closed forms of the
// solids: exact for flat faces, of order four for curved ones.
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <gmsh.h>

#include "reduce/common/progress.hpp"
#include "reduce/fe/solid.hpp"
#include "reduce/mesh/gmsh/session.hpp"
#include "reduce/mesh/import.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

constexpr double density = 7850;

/// @param cells  if given, becomes the number of cells
MassProperties meshed(const std::string& path, double size, const std::optional<std::string>& unit = {},
                      Eigen::Index* cells = nullptr) {
  MeshRequest request;
  request.path = path;
  request.size = size;
  request.length_unit = unit;
  Progress quiet(true);
  const Mesh mesh = import_mesh(request, quiet);
  if (cells) *cells = mesh.solid_count();
  const std::string region = mesh.groups.contains("rod") ? "rod" : "all";
  return mass_properties(make_solid(mesh, {{"steel", Material::isotropic(210e9, 0.3, density)}}, {{region, "steel"}}));
}

MassProperties body(double volume, const Eigen::Vector3d& centre, const Eigen::Matrix3d& inertia_per_mass) {
  MassProperties result;
  result.volume = volume;
  result.mass = density * volume;
  result.centre = centre;
  result.inertia = result.mass * inertia_per_mass;
  return result;
}

/// Returns the relative errors of mass, centre (in radii of gyration) and inertia.
Eigen::Vector3d errors(const MassProperties& found, const MassProperties& exact) {
  const double gyration = std::sqrt(exact.inertia.trace() / (2 * exact.mass));
  return {std::abs(found.mass / exact.mass - 1), (found.centre - exact.centre).norm() / gyration,
          (found.inertia - exact.inertia).norm() / exact.inertia.norm()};
}

/// Returns the least-squares slope of log(error) over log(size).
double order(const std::vector<double>& sizes, const Eigen::VectorXd& error) {
  const Eigen::ArrayXd x = Eigen::Map<const Eigen::ArrayXd>(sizes.data(), sizes.size()).log(), y = error.array().log();
  return ((x - x.mean()) * (y - y.mean())).sum() / (x - x.mean()).square().sum();
}

}  // namespace

TEST_CASE("A turned box and a wedge have the mass, centre and inertia of the closed form to rounding") {
  const test::TemporaryFolder folder;
  const double a = 0.3, b = 0.2, c = 0.1;
  const std::string box = folder.file("box.geo",
                                      "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 0.3, 0.2, 0.1};\n"
                                      "Rotate{{1, 2, 2}, {0, 0, 0}, 0.7}{Volume{1};}");
  const Eigen::Matrix3d r = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2).normalized()).toRotationMatrix();
  const Eigen::Vector3d squares(a * a, b * b, c * c);
  const Eigen::Matrix3d own = ((squares.sum() - squares.array()) / 12).matrix().asDiagonal();
  CHECK(
      errors(meshed(box, 0.07), body(a * b * c, r * Eigen::Vector3d(a, b, c) / 2, r * own * r.transpose())).maxCoeff() <
      1e-12);
  // The right triangle with legs a (x) and b (y), extruded by c: int x = a/3, central second moments a^2/18, b^2/18,
  // product -ab/36 of the area ab/2.
  const std::string wedge = folder.file(
      "wedge.geo",
      "SetFactory(\"OpenCASCADE\"); Point(1) = {0,0,0}; Point(2) = {0.3,0,0}; Point(3) = {0,0.2,0};\n"
      "Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1}; Curve Loop(1) = {1,2,3}; Plane Surface(1) = {1};\n"
      "Extrude {0, 0, 0.1} { Surface{1}; }");
  const double xx = a * a / 18, yy = b * b / 18, zz = c * c / 12, xy = -a * b / 36;
  Eigen::Matrix3d inertia;
  inertia << yy + zz, -xy, 0, -xy, xx + zz, 0, 0, 0, xx + yy;
  CHECK(errors(meshed(wedge, 0.05), body(a * b * c / 2, {a / 3, b / 3, c / 2}, inertia)).maxCoeff() < 1e-12);
}

TEST_CASE("A half tube and a ball approach the mass, centre and inertia of the closed form with order four") {
  const test::TemporaryFolder folder;
  // Half of a tube, y > 0, radii 0.1 and 0.2, along z from 0 to 0.3.
  const double p = 0.1, q = 0.2, h = 0.3;
  const double area = std::numbers::pi * (q * q - p * p) / 2, y = 2 * (q * q * q - p * p * p) / (3 * area);
  const double square = (p * p + q * q) / 4;  // mean of x^2, and of y^2
  const Eigen::Vector3d second(square, square - y * y, h * h / 12);
  const MassProperties half_tube =
      body(area * h, {0, y, h / 2}, Eigen::Matrix3d((second.sum() - second.array()).matrix().asDiagonal()));
  const std::string tube = folder.file("tube.geo",
                                       "SetFactory(\"OpenCASCADE\"); Cylinder(1) = {0,0,0, 0,0,0.3, 0.2, Pi};\n"
                                       "Cylinder(2) = {0,0,0, 0,0,0.3, 0.1, Pi};\n"
                                       "BooleanDifference{Volume{1}; Delete;}{Volume{2}; Delete;}");
  const double radius = 0.15;
  const MassProperties ball = body(4 * std::numbers::pi / 3 * std::pow(radius, 3), {0.1, -0.2, 0.3},
                                   0.4 * radius * radius * Eigen::Matrix3d::Identity());
  const std::string sphere =
      folder.file("ball.geo", "SetFactory(\"OpenCASCADE\"); Sphere(1) = {0.1, -0.2, 0.3, 0.15};");
  for (const auto& [path, exact] : {std::pair{tube, half_tube}, {sphere, ball}}) {
    std::vector<double> sizes{0.05, 0.035, 0.025, 0.018};
    Eigen::MatrixXd error(sizes.size(), 3);
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      Eigen::Index cells = 0;
      error.row(static_cast<Eigen::Index>(k)) = errors(meshed(path, sizes[k], {}, &cells), exact).transpose();
      sizes[k] = std::cbrt(exact.volume / static_cast<double>(cells));
    }
    INFO(path << "\n" << error);
    // The meshes of different size are not similar to each other: the tolerance is half an order.
    CHECK(order(sizes, error.col(0)) == Approx(4).margin(0.5));
    CHECK(order(sizes, error.col(2)) == Approx(4).margin(0.5));
    CHECK(error.bottomRows<1>().maxCoeff() < 1e-4);
  }
}

TEST_CASE("The connecting rod's mesh has the mass, centre and inertia that OpenCASCADE gives to the CAD body") {
  const std::string path = std::string(BIELLE_SOURCE_DIR) + "/meshes/conrod.geo";
  MassProperties cad;
  {
    GmshSession session;
    session.read("conrod.geo", [&] {
      gmsh::open(path);
      gmsh::vectorpair volumes;
      gmsh::model::getEntities(volumes, 3);
      REQUIRE(volumes.size() == 1);
      std::vector<double> inertia;
      gmsh::model::occ::getMass(3, volumes[0].second, cad.volume);
      gmsh::model::occ::getCenterOfMass(3, volumes[0].second, cad.centre.x(), cad.centre.y(), cad.centre.z());
      gmsh::model::occ::getMatrixOfInertia(3, volumes[0].second, inertia);
      cad.inertia = Eigen::Map<const Eigen::Matrix3d>(inertia.data());
    });
  }
  // The file is in mm.
  cad.volume *= 1e-9;
  cad.mass = density * cad.volume;
  cad.centre *= 1e-3;
  cad.inertia *= density * 1e-15;
  Eigen::MatrixXd error(2, 3);
  for (const auto& [row, size] : {std::pair{0, 9.2e-3}, {1, 4.6e-3}}) {
    error.row(row) = errors(meshed(path, size, "mm"), cad).transpose();
  }
  INFO(error);
  // The remaining error comes from elements straightened at fillets, of the size of the fillets.
  CHECK(error.row(1).maxCoeff() < 5e-4);
  CHECK(error(1, 0) < error(0, 0) / 3);
}
