// Cross sections: closed forms and published constants.
#include <cmath>
#include <numbers>
#include <sstream>

#include <catch2/catch.hpp>

#include "mechanism/elements/beam/beam_section.hpp"
#include "mechanism/math/so3.hpp"

using namespace bielle::mechanism;
using Catch::Contains;
using Catch::WithinRel;
using std::numbers::pi;

namespace {

SectionLaw section(const std::string& text) { return SectionLaw(bielle::YamlValue::parse(text, "section.yaml")); }

VectorX diagonal(const BeamSection& s) { return s.stiffness.diagonal(); }

}  // namespace

TEST_CASE("the torsion constant of a rectangle is that of Saint-Venant's series") {
  // S. Timoshenko, J. Goodier, Theory of Elasticity, table of art. 109 (k_1 in J = k_1 a c^3), and two more digits.
  CHECK_THAT(rectangle_constants(1, 1).J, Catch::WithinAbs(0.140577, 5e-7));
  CHECK_THAT(rectangle_constants(2, 1).J / 2, Catch::WithinAbs(0.229, 5e-4));
  CHECK_THAT(rectangle_constants(1, 10).J / 10, Catch::WithinAbs(0.312, 5.1e-4));
  CHECK(rectangle_constants(0.3, 0.1).J == rectangle_constants(0.1, 0.3).J);
  // A narrow strip: 1/3 a c^3 (1 - 0.6302 c/a), 0.6302 = 192/pi^5 * (sum of odd n^-5).
  CHECK_THAT(rectangle_constants(1000, 1).J * 3 / 1000,
             WithinRel(1 - 192 / std::pow(pi, 5) * 31.0 / 32 * 1.0369277551433699 / 1000, 1e-14));
}

TEST_CASE("rectangles, circles and tubes have their moments about y and z") {
  const SectionConstants r = rectangle_constants(0.3, 0.1);
  CHECK_THAT(r.A, WithinRel(0.03, 1e-15));
  CHECK_THAT(r.I_y, WithinRel(0.3 * 0.001 / 12, 1e-14));
  CHECK_THAT(r.I_z, WithinRel(0.1 * 0.027 / 12, 1e-14));
  CHECK_THAT(r.shear_area(0, 0), WithinRel(0.025, 1e-15));
  const SectionConstants c = tube_constants(2, 0);
  CHECK_THAT(c.A, WithinRel(4 * pi, 1e-15));
  CHECK_THAT(c.I_y, WithinRel(4 * pi, 1e-15));
  CHECK_THAT(c.J, WithinRel(8 * pi, 1e-15));
  CHECK_THAT(c.shear_area(1, 1), WithinRel(6.0 / 7 * 4 * pi, 1e-15));
  const SectionConstants t = tube_constants(2, 1);
  CHECK_THAT(t.I_z, WithinRel(15 * pi / 4, 1e-14));
  // A thin tube carries shear with half of its area.
  const SectionConstants thin = tube_constants(1, 0.9999);
  CHECK_THAT(thin.shear_area(0, 0), WithinRel(0.5 * thin.A, 1e-4));
}

TEST_CASE("a shape with its material becomes stiffness and mass per length") {
  const BeamSection s = section("{rectangle: [0.2, 0.1], young: 200, poisson: 0.25, density: 10}").at(0.3);
  const SectionConstants k = rectangle_constants(0.2, 0.1);
  VectorX expected(6);
  expected << 4, 80 * 0.02 * 5 / 6, 80 * 0.02 * 5 / 6, 80 * k.J, 200 * k.I_y, 200 * k.I_z;
  CHECK((diagonal(s) - expected).norm() < 1e-14);
  CHECK_THAT(s.mass, WithinRel(0.2, 1e-14));
  CHECK((s.inertia.diagonal() - 10 * Vector3(k.I_y + k.I_z, k.I_y, k.I_z)).norm() < 1e-16);
  CHECK((diagonal(section("{rectangle: [0.2, 0.1], young: 200, shear: 80, density: 10}").at(0)) - expected).norm() <
        1e-14);
  CHECK(section("{rectangle: [0.2, 0.1], young: 200, shear: 80}").at(0).mass == 0);
  expected.segment<2>(1) *= 1.2;
  CHECK((diagonal(section("{rectangle: [0.2, 0.1], young: 200, shear: 80, shear_factors: [1, 1]}").at(0)) - expected)
            .norm() < 1e-14);
}

TEST_CASE("an offset section couples stretch with bending and carries its mass beside the node line") {
  const BeamSection s = section("{circle: 0.1, young: 200, poisson: 0, density: 10, offset: [0.3, -0.2]}").at(0);
  const double EA = 2 * pi, EI = 200 * pi * 1e-4 / 4;
  // A force through the centroid does not bend: n = EA e, m = o x n.
  Vector6 strain = Vector6::Unit(0);
  Vector6 resultants = s.stiffness * strain;
  CHECK((resultants - EA * (Vector6() << 1, 0, 0, 0, -0.2, -0.3).finished()).norm() < 1e-13);
  // Pure curvature about y strains the centroid by kappa_y z and stretches it.
  resultants = s.stiffness * Vector6::Unit(4);
  CHECK_THAT(resultants[4], WithinRel(EI + EA * 0.04, 1e-13));
  CHECK_THAT(resultants[0], WithinRel(-0.2 * EA, 1e-13));
  CHECK((s.mass_offset - Vector3(0, 0.3, -0.2)).norm() == 0);
}

TEST_CASE("constants and matrices are taken as given") {
  const BeamSection c =
      section("{EA: 1, GAy: 2, GAz: 3, GJ: 4, EIy: 5, EIz: 6, mass_per_length: 7, Jx: 0.5, Jy: 0.25, Jz: 0.125}").at(1);
  CHECK((diagonal(c) - VectorX(VectorX::LinSpaced(6, 1, 6))).norm() == 0);
  CHECK(c.mass == 7);
  CHECK((c.inertia.diagonal() - Vector3(0.5, 0.25, 0.125)).norm() == 0);
  // m = 2, offset (0, 0.1, 0): mass matrix about the node line.
  const BeamSection m = section(R"(
stiffness: [[10, 0, 0, 0, 1, 0], [0, 9, 0, 0, 0, 0], [0, 0, 8, 0, 0, 0], [0, 0, 0, 7, 0, 0], [1, 0, 0, 0, 6, 0], [0, 0, 0, 0, 0, 5]]
mass: [[2, 0, 0, 0, 0, -0.2], [0, 2, 0, 0, 0, 0], [0, 0, 2, 0.2, 0, 0], [0, 0, 0.2, 0.52, 0, 0], [0, 0, 0, 0, 0.2, 0], [-0.2, 0, 0, 0, 0, 0.32]]
)")
                            .at(0);
  CHECK(m.stiffness(0, 4) == 1);
  CHECK_THAT(m.mass, WithinRel(2.0, 1e-15));
  CHECK((m.mass_offset - Vector3(0, 0.1, 0)).norm() < 1e-15);
  CHECK((m.inertia - Vector3(0.5, 0.2, 0.3).asDiagonal().toDenseMatrix()).norm() < 1e-15);
}

TEST_CASE("a tapered section is interpolated in its dimensions") {
  const SectionLaw taper = section("[{circle: 0.1, young: 3, shear: 1}, {circle: 0.3, young: 3, shear: 1}]");
  CHECK_THAT(taper.at(0.5).stiffness(0, 0), WithinRel(3 * pi * 0.04, 1e-14));
  CHECK_THAT(taper.at(1).stiffness(4, 4), WithinRel(3 * pi * 0.0081 / 4, 1e-14));
  CHECK_THROWS_WITH(section("[{circle: 0.1, young: 3, shear: 1}, {tube: [0.3, 0.1], young: 3, shear: 1}]"),
                    Contains("cannot taper from 'circle' to 'tube'"));
}

TEST_CASE("given constants and matrices may stand beside the node line, as a shape may") {
  const std::string round = "circle: 0.1, young: 200, poisson: 0, density: 10";
  const BeamSection centred = section("{" + round + "}").at(0);
  const BeamSection beside = section("{" + round + ", offset: [0.3, -0.2]}").at(0);
  const auto text = [](const Matrix6& A) {
    const Eigen::IOFormat rows(Eigen::FullPrecision, 0, ", ", ", ", "[", "]");
    std::ostringstream out;
    out << "[" << A.format(rows) << "]";
    return out.str();
  };
  Matrix6 mass = Matrix6::Zero();
  mass.topLeftCorner<3, 3>().diagonal().setConstant(centred.mass);
  mass.bottomRightCorner<3, 3>() = centred.inertia;
  const BeamSection given =
      section("{stiffness: " + text(centred.stiffness) + ", mass: " + text(mass) + ", offset: [0.3, -0.2]}").at(0);
  CHECK((given.stiffness - beside.stiffness).norm() < 1e-14 * beside.stiffness.norm());
  CHECK((given.mass_offset - beside.mass_offset).norm() < 1e-15);
  CHECK((given.inertia - beside.inertia).norm() < 1e-14 * beside.inertia.norm());
  const BeamSection constants = section("{EA: 1, GAy: 2, GAz: 3, GJ: 4, EIy: 5, EIz: 6, offset: [0.5, 0]}").at(0);
  // The stretch at the origin is Gamma_x - 0.5 kappa_z: EIz about the node line grows by EA 0.25.
  CHECK(constants.stiffness(5, 5) == Approx(6.25));
  CHECK(constants.stiffness(0, 5) == Approx(-0.5));
}

TEST_CASE("what one end of a taper has, the other has to have") {
  const std::string round = "circle: 0.1, young: 3, shear: 1";
  CHECK_THROWS_WITH(section("[{" + round + ", density: 1}, {" + round + "}]"), Contains("both ends"));
  CHECK_THROWS_WITH(section("[{" + round + "}, {" + round + ", offset: [0.1, 0]}]"), Contains("offset"));
  const std::string constants = "EA: 1, GAy: 2, GAz: 3, GJ: 4, EIy: 5, EIz: 6";
  CHECK_THROWS_WITH(section("[{" + constants + "}, {" + constants + ", mass_per_length: 1, Jx: 1, Jy: 1, Jz: 1}]"),
                    Contains("both ends"));
}

TEST_CASE("a section that does not exist is refused with its key") {
  CHECK_THROWS_WITH(section("{rectangle: [0.2, 0.1], circle: 1, young: 1, shear: 1}"),
                    Contains("`rectangle` and `circle`, not by both"));
  CHECK_THROWS_WITH(
      section("{rectangel: [0.2, 0.1], young: 1, shear: 1}"),
      Contains("section.yaml:1: rectangel: 'rectangel' is no kind of section") && Contains("did you mean 'rectangle'"));
  CHECK_THROWS_WITH(section("{ba: 2, density: 3}"), Contains("'ba' is no kind of section; expected one of"));
  CHECK_THROWS_WITH(section("{circle: 1, young: 1, shear: 1, stress_points: []}"), Contains("at least one point"));
  CHECK_THROWS_WITH(section("{rectangle: [1e200, 1e200], young: 1, shear: 1}"),
                    Contains("expected lengths in metres from 1e-12 to 1e+06"));
  CHECK_THROWS_WITH(section("{rectangle: [1e-200, 1e-200], young: 1, shear: 1}"),
                    Contains("expected lengths in metres from 1e-12 to 1e+06"));
  CHECK_THROWS_WITH(section("{circle: 1, young: 1, shear: 1, density: 1, offset: [1e200, 0]}"),
                    Contains("too large or too small"));
  CHECK_THROWS_WITH(section("{young: 1, shear: 1}"), Contains("exactly one of"));
  CHECK_THROWS_WITH(section("{rectangle: [0.2, -0.1], young: 1, shear: 1}"), Contains("rectangle"));
  CHECK_THROWS_WITH(section("{rectangle: 0.2, young: 1, shear: 1}"), Contains("[width_y, height_z]"));
  CHECK_THROWS_WITH(section("{tube: [0.1, 0.2], young: 1, shear: 1}"), Contains("inner radius must be smaller"));
  CHECK_THROWS_WITH(section("{circle: 0.1, shear: 1}"), Contains("young"));
  CHECK_THROWS_WITH(section("{circle: 0.1, young: 1}"), Contains("`poisson` or `shear`"));
  CHECK_THROWS_WITH(section("{circle: 0.1, young: 1, shear: 1, poisson: 0.3}"),
                    Contains("either `shear` or `poisson`"));
  CHECK_THROWS_WITH(section("{circle: 0.1, young: 1, poisson: 0.6}"),
                    Contains("greater than -1 and at most 0.5") && Contains("poisson"));
  CHECK_THROWS_WITH(section("{circle: 0.1, young: 1, poisson: 0.3, denisty: 1}"), Contains("did you mean 'density'"));
  CHECK_THROWS_WITH(section("{EA: 1, GAy: 2, GAz: 3, GJ: 4, EIy: 5, EIz: 0}"), Contains("EIz"));
  CHECK_THROWS_WITH(section("{EA: 1, GAy: 2, GAz: 3, GJ: 4, EIy: 5}"), Contains("EIz"));
  CHECK_THROWS_WITH(section("{EA: 1, GAy: 2, GAz: 3, GJ: 4, EIy: 5, EIz: 6, mass_per_length: 1, Jx: 1, Jy: 1, Jz: 0}"),
                    Contains("Jz") && Contains("mass moments > 0"));
  CHECK_THROWS_WITH(section("{EA: 1, GAy: 2, GAz: 3, GJ: 4, EIy: 5, EIz: 6, mass_per_length: 0, Jx: 1, Jy: 1, Jz: 1}"),
                    Contains("Jx") && Contains("without mass"));
  CHECK_THROWS_WITH(section("{i: {width: 1, heigth: 1, web: 0.1, flange: 0.1}, young: 1, shear: 1}"),
                    Contains("did you mean 'height'"));
  const std::string indefinite =
      "stiffness: [[1, 2, 0, 0, 0, 0], [2, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], "
      "[0, 0, 0, 0, 0, 1]]";
  CHECK_THROWS_WITH(section(indefinite), Contains("stiffness must be positive definite"));
  const std::string unsymmetric =
      "stiffness: [[1, 0.2, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, "
      "0], [0, 0, 0, 0, 0, 1]]";
  CHECK_THROWS_WITH(section(unsymmetric), Contains("must be symmetric"));
  const std::string unit =
      "[[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 0, "
      "0, 0, 1]]";
  const std::string odd =
      "[[1, 0, 0, 0, 0, 0], [0, 2, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 0, "
      "0, 0, 1]]";
  CHECK_THROWS_WITH(section("{stiffness: " + unit + ", mass: " + odd + "}"),
                    Contains("no section has this mass matrix"));
}

TEST_CASE("dimensions, moduli and constants of sections may have units, which must fit") {
  const auto difference = [](const std::string& first, const std::string& second) {
    const BeamSection a = section(first).at(0.5), b = section(second).at(0.5);
    return (a.stiffness - b.stiffness).norm() / b.stiffness.norm() + std::abs(a.mass - b.mass) / (1 + b.mass);
  };
  CHECK(difference("{rectangle: [200 mm, 10 cm], young: 210 GPa, poisson: 0.3, density: 7.85 g/cm^3}",
                   "{rectangle: [0.2, 0.1], young: 210e9, poisson: 0.3, density: 7850}") < 1e-14);
  CHECK(difference("{i: {width: [80 mm, 0.1], height: 200 mm, web: 6 mm, flange: 8 mm}, young: 1, shear: 1}",
                   "{i: {width: [0.08, 0.1], height: 0.2, web: 0.006, flange: 0.008}, young: 1, shear: 1}") < 1e-12);
  CHECK(difference("{EA: 1 kN, GAy: 2, GAz: 3, GJ: 4 kN m^2, EIy: 5, EIz: 6, offset: [10 mm, 0]}",
                   "{EA: 1000, GAy: 2, GAz: 3, GJ: 4000, EIy: 5, EIz: 6, offset: [0.01, 0]}") < 1e-14);
  CHECK_THROWS_WITH(section("{circle: 0.1, young: 210 GN, shear: 1}"),
                    Contains("young: expected a value in Pa, found one in 'GN'"));
  CHECK_THROWS_WITH(section("{EA: 1 Pa, GAy: 2, GAz: 3, GJ: 4, EIy: 5, EIz: 6}"),
                    Contains("EA: expected a value in N, found one in 'Pa'"));
  CHECK_THROWS_WITH(section("{l: {width: 1 kg, height: 1, thickness: 0.1}, young: 1, shear: 1}"),
                    Contains("l.width: expected a value in m, found one in 'kg'"));
}
