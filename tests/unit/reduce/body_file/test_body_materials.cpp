// Tests of materials in body files: their stiffness, and the messages about impossible ones.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/body_file/body_materials.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_file.hpp"
#include "reduce/fe/elasticity.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random.hpp"

using namespace bielle;
using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace test_body_materials {
namespace {

Material material(const std::string& text) { return read_material(YamlValue::parse(text, "rod.yaml")); }

std::string message(const std::string& text) {
  return message_of<InputError>([&] { material(text); });
}

// A unidirectional carbon laminate.
const std::string laminate =
    "{E1: 140e9, E2: 10e9, E3: 9e9, nu12: 0.3, nu13: 0.28, nu23: 0.4, G12: 5e9, G13: 4.8e9, G23: 3.5e9, density: 1600";

constexpr int first[6] = {0, 1, 2, 1, 0, 0}, second[6] = {0, 1, 2, 2, 2, 1};

}  // namespace

TEST_CASE("isotropic constants give the modulus and the contraction of a pulled bar") {
  const Material steel = material("{young: 210e9, poisson: 0.3, density: 7850}");
  const Matrix6 compliance = steel.elasticity.inverse();
  CHECK(1 / compliance(0, 0) == Approx(210e9).epsilon(1e-12));
  CHECK(-compliance(1, 0) / compliance(0, 0) == Approx(0.3).epsilon(1e-12));
  CHECK(1 / compliance(5, 5) == Approx(210e9 / 2.6).epsilon(1e-12));
  CHECK(steel.density == 7850);
}

TEST_CASE("orthotropic constants are the entries of the compliance") {
  const Matrix6 s = material(laminate + "}").elasticity.inverse();
  CHECK(1 / s(0, 0) == Approx(140e9).epsilon(1e-12));
  CHECK(1 / s(1, 1) == Approx(10e9).epsilon(1e-12));
  CHECK(1 / s(2, 2) == Approx(9e9).epsilon(1e-12));
  CHECK(-s(1, 0) / s(0, 0) == Approx(0.3).epsilon(1e-12));   // nu12: along 2 by stress along 1
  CHECK(-s(2, 0) / s(0, 0) == Approx(0.28).epsilon(1e-12));  // nu13
  CHECK(-s(2, 1) / s(1, 1) == Approx(0.4).epsilon(1e-12));   // nu23
  CHECK(1 / s(3, 3) == Approx(3.5e9).epsilon(1e-12));        // yz: G23
  CHECK(1 / s(4, 4) == Approx(4.8e9).epsilon(1e-12));        // xz: G13
  CHECK(1 / s(5, 5) == Approx(5e9).epsilon(1e-12));          // xy: G12
}

TEST_CASE("axes around a line: fibres along axis 1 run around the line or along it") {
  const Material hoop = material(laminate + ", axes: {point: [1, 0, 0], axis: [0, 0, 2]}}");
  CHECK(hoop.is_wound());
  CHECK(hoop.winding_axis == Eigen::Vector3d::UnitZ());
  const auto modulus = [](const Material& of, const Eigen::Vector3d& place, int axis) {
    return 1 / Matrix6(of.elasticity_at(place).inverse())(axis, axis);
  };
  CHECK(modulus(hoop, {3, 0, 5}, 1) == Approx(140e9).epsilon(1e-12));  // y is the direction around the line
  CHECK(modulus(hoop, {3, 0, 5}, 2) == Approx(10e9).epsilon(1e-12));   // axis 2 is along the line
  CHECK(modulus(hoop, {3, 0, 5}, 0) == Approx(9e9).epsilon(1e-12));
  CHECK(modulus(hoop, {1, -2, 0}, 0) == Approx(140e9).epsilon(1e-12));
  const Material lengthwise =
      material(laminate + ", axes: {point: [1, 0, 0], axis: [0, 0, 1], x: [0, 0, 1], y: [1, 0, 0]}}");
  CHECK(modulus(lengthwise, {3, 0, 5}, 2) == Approx(140e9).epsilon(1e-12));
  CHECK(modulus(lengthwise, {3, 0, 5}, 0) == Approx(10e9).epsilon(1e-12));
  CHECK_THAT(message(laminate + ", axes: {point: [1, 0, 0]}}"), Contains("axis"));
  CHECK_THAT(message(laminate + ", axes: {point: [1, 0, 0], axis: [0, 0, 0]}}"), Contains("axes.axis"));
  CHECK_THAT(message(laminate + ", axes: {point: [1, 0, 0], axis: [0, 0, 1], x: [0, 0, 1]}}"),
             Contains("not parallel"));
  CHECK_THAT(message(laminate + ", axes: {point: [1, 0, 0], axis: [0, 0, 1], z: [0, 0, 1]}}"), Contains("'z'"));
  CHECK_THAT(message(laminate + ", axes: 3}"), Contains("axes"));
}

TEST_CASE("axes turn a material: along y of the body it is as stiff as along its own axis 1") {
  const Material turned = material(laminate + ", axes: {x: [0, 1, 0], y: [-1, 0, 0]}}");
  const Matrix6 s = turned.elasticity.inverse();
  CHECK(1 / s(1, 1) == Approx(140e9).epsilon(1e-12));
  CHECK(1 / s(0, 0) == Approx(10e9).epsilon(1e-12));
  CHECK(1 / s(2, 2) == Approx(9e9).epsilon(1e-12));
  CHECK(1 / s(4, 4) == Approx(3.5e9).epsilon(1e-12));  // xz: G23
  CHECK(1 / s(3, 3) == Approx(4.8e9).epsilon(1e-12));  // yz: G13
}

TEST_CASE("a rotation of the elastic constants is the rotation of the fourth-order tensor") {
  Random random(3);
  const Matrix6 c = random.positive_matrix(6);
  const Eigen::Matrix3d r = Eigen::AngleAxisd(1.1, random.vector_of_length(1)).toRotationMatrix();
  const Matrix6 turned = rotate_elasticity(c, r);
  // The rotation is written out for all components, without the symmetry of the index pairs.
  const auto voigt = [](int i, int j) { return i == j ? i : 6 - i - j; };
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      double sum = 0;
      for (int m = 0; m < 3; ++m)
        for (int n = 0; n < 3; ++n)
          for (int o = 0; o < 3; ++o)
            for (int p = 0; p < 3; ++p)
              sum += r(first[a], m) * r(second[a], n) * r(first[b], o) * r(second[b], p) * c(voigt(m, n), voigt(o, p));
      CHECK(turned(a, b) == Approx(sum).margin(1e-13));
    }
  CHECK((rotate_elasticity(turned, r.transpose()) - c).norm() < 1e-13);
  const Material steel = material("{young: 210e9, poisson: 0.3, density: 7850}");
  CHECK((rotate_elasticity(steel.elasticity, r) - steel.elasticity).norm() < 1e-12 * steel.elasticity.norm());
}

TEST_CASE("anisotropic constants are the matrix of the file") {
  const Material steel = material("{young: 210e9, poisson: 0.3, density: 7850}");
  std::string rows;
  for (int i = 0; i < 6; ++i) {
    rows += i == 0 ? "[" : ", [";
    for (int j = 0; j < 6; ++j) rows += fmt::format("{}{:.17g}", j == 0 ? "" : ", ", steel.elasticity(i, j));
    rows += "]";
  }
  CHECK(material("{stiffness: [" + rows + "], density: 7850}").elasticity == steel.elasticity);
  CHECK_THAT(message("{stiffness: [[1, 2], [2, 1]], density: 7850}"), Catch::StartsWith("rod.yaml:1: stiffness: "));
  CHECK_THAT(
      message("{stiffness: [[1,2,0,0,0,0],[0,1,0,0,0,0],[0,0,1,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]], "
              "density: 1}"),
      Contains("must be symmetric"));
  CHECK_THAT(
      message("{stiffness: [[1,2,0,0,0,0],[2,1,0,0,0,0],[0,0,1,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]], "
              "density: 1}"),
      Contains("not positive definite"));
}

TEST_CASE("impossible materials are refused with their key and its range") {
  CHECK_THAT(message("{young: 0, poisson: 0.3, density: 7850}"),
             Catch::StartsWith("rod.yaml:1: young: expected a number greater than 0"));
  CHECK_THAT(message("{young: 210e9, poisson: 0.5, density: 7850}"),
             Catch::StartsWith("rod.yaml:1: poisson: expected a number between -1 and 0.5, both excluded, found 0.5"));
  CHECK_THAT(message("{young: 210e9, poisson: -1, density: 7850}"),
             Catch::StartsWith("rod.yaml:1: poisson: expected a number between -1 and 0.5"));
  CHECK_THAT(message("{young: 210e9, poisson: 0.3, density: 0}"),
             Catch::StartsWith("rod.yaml:1: density: expected a number greater than 0"));
  CHECK_THAT(message("{young: 210e9, poisson: 0.3}"), Contains("the key 'density' is missing"));
  CHECK_THAT(message("{young: 210e9, density: 7850}"), Contains("the key 'poisson' is missing"));
  CHECK_THAT(message("{yuong: 210e9, poisson: 0.3, density: 7850}"),
             Contains("'yuong' is not a key of an isotropic material; did you mean 'young'?"));
  CHECK_THAT(message("{young: 210e9, poisson: 0.3, density: 7850, E1: 1}"),
             Contains("expected the keys of one kind of material"));
  CHECK_THAT(message("{young: 210e9, poisson: 0.3, density: 7850, axes: {x: [1, 0, 0], y: [0, 1, 0]}}"),
             Contains("'axes' is not a key of an isotropic material"));
  // These constants have nu12 nu21 > 1.
  CHECK_THAT(
      message("{E1: 1e9, E2: 1e9, E3: 1e9, nu12: 1.1, nu13: 0, nu23: 0, G12: 1e9, G13: 1e9, G23: 1e9, density: 1}"),
      Catch::StartsWith("rod.yaml:1: ") && Contains("not positive definite"));
}

TEST_CASE("materials have units") {
  const Material steel = material("{young: 210 GPa, poisson: 0.3, density: 7.85 g/cm^3}");
  CHECK(steel.elasticity(3, 3) == Approx(210e9 / 2.6));
  CHECK(steel.density == Approx(7850));
  CHECK(1 / material("{E1: 140 GPa, E2: 10e9, E3: 9e9, nu12: 0, nu13: 0, nu23: 0, G12: 5 GPa, G13: 5e9, G23: 5e9, "
                     "density: 1600}")
                .elasticity.inverse()(0, 0) ==
        Approx(140e9));
  CHECK(message("{young: 210 mm, poisson: 0.3, density: 7850}") ==
        "rod.yaml:1: young: expected a value in Pa, found one in 'mm', which measures something else");
  CHECK(message("{young: 210e9, poisson: 30 %, density: 7850}") ==
        "rod.yaml:1: poisson: expected a number without a unit, found the unit '%'");
  CHECK(message("{young: 210e9, poisson: 0.3, density: 78 kN}") ==
        "rod.yaml:1: density: expected a value in kg/m^3, found one in 'kN', which measures something else");
}

TEST_CASE("the message about a material that lacks constants of its kind names one of them") {
  CHECK_THAT(message("{density: 1}"), Catch::EndsWith("is missing"));
  CHECK_THAT(message("{E2: 1e9, density: 1}"), Catch::EndsWith("is missing"));
}

TEST_CASE("values that no solid has give a warning with their key and its range") {
  const auto warnings = [](const std::string& text) {
    const YamlValue material = YamlValue::parse(text, "rod.yaml");
    warn_of_material(material);
    return material.warnings();
  };
  CHECK(warnings("{young: 210e9, poisson: 0.3, density: 7850}").empty());
  CHECK(warnings("{young: 1.2e12, poisson: 0.1, density: 22590}").empty());  // diamond's stiffness, osmium's density
  CHECK(warnings("{young: 2e6, poisson: 0.49, density: 30}").empty());       // a foam of rubber
  const auto in_other_units = warnings("{young: 210e3, poisson: 0.3, density: 7.85e-9}");  // N, mm, t
  REQUIRE(in_other_units.size() == 2);
  CHECK_THAT(in_other_units[0],
             Catch::StartsWith("rod.yaml:1: young: is 210000 meant? Solids have 1e6") && Contains("steel has 210e9"));
  CHECK_THAT(in_other_units[1], Catch::StartsWith("rod.yaml:1: density: is 7.85e-09 meant?"));
  CHECK(
      warnings("{E1: 140e3, E2: 10e9, E3: 10e9, nu12: 0, nu13: 0, nu23: 0, G12: 5e9, G13: 5, G23: 5e9, density: 1600}")
          .size() == 2);
  CHECK(warnings("{stiffness: [[1,0,0,0,0,0],[0,1,0,0,0,0],[0,0,1,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]], "
                 "density: 1000}")
            .size() == 1);
}

}  // namespace test_body_materials
