// Beams of unsymmetric section: the coupling of their displacements by the shear centre and inclined principal axes.
// Their damping is tested as well.
#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/beam/section_shape.hpp"
#include "tests/support/dense_solution.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::StaticModel;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double L = 12, E = 3, G = 1.2;

/// Returns a cantilever along x of an l section, its centroid on the line of the nodes; section axes are the inertial
/// ones.
std::string angle(const std::string& keys, const std::string& loads = "") {
  return fmt::format(
             "nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: [{}, 0, 0]}}}}\n"
             "elements: {{b: {{type: beam, nodes: [root, tip], elements: 2, orientation: [0, 1, 0], section: {{l: "
             "{{width: 1.2, "
             "height: 1, thickness: [0.2, 0.3]}}, young: {}, shear: {}}}{}}}}}\n",
             L, E, G, keys) +
         loads;
}

SectionConstants constants() {
  return make_section_shape("l", (VectorX(4) << 1.2, 1, 0.2, 0.3).finished())->constants();
}

/// Returns the linear displacements of the tip.
Vector6 tip(const std::string& yaml) {
  StaticModel beam(yaml);
  const VectorX r = beam.dense.residual(beam.state)(beam.free);
  beam.dense.environment.load_factor = 0;
  return -bielle::test::solution(beam.stiffness(), r).head<6>();
}

}  // namespace

TEST_CASE("a load through the shear centre bends an angle without twisting it") {
  const SectionConstants k = constants();
  REQUIRE(k.shear_centre.norm() > 0.3);
  const auto twist = [](const std::string& at) {
    return tip(angle(", distributed: {force: [0, 2e-3, 1e-3]" + at + "}"))[3];
  };
  const double at_shear_centre = twist(fmt::format(", at: [{:.17g}, {:.17g}]", k.shear_centre.x(), k.shear_centre.y()));
  // Through the centroid its moment about the shear centre twists: -(s_y q_z - s_z q_y) per length.
  const double torque = -(k.shear_centre.x() * 1e-3 - k.shear_centre.y() * 2e-3);
  CHECK_THAT(twist(""), WithinRel(torque * L * L / 2 / (G * k.J), 1e-11));
  CHECK_THAT(at_shear_centre, WithinAbs(0, 1e-11 * std::abs(torque) * L * L / (G * k.J)));
}

TEST_CASE("a force along an axis of an angle bends it about its principal axes") {
  // kappa = [I_y -I_yz; -I_yz I_z]^-1 M/E with M_y = -(L - x) F; w_z'' = -kappa_y, w_y'' = kappa_z; the shear of F; and
  // the twist by F beside the shear centre, which moves the centroid by phi e_x x (-s).
  const SectionConstants k = constants();
  const double D = k.I_y * k.I_z - k.I_yz * k.I_yz;
  const Matrix2 shear = k.shear_area.inverse() / G;
  const double s_y = k.shear_centre.x(), s_z = k.shear_centre.y(), phi = -s_y * L / (G * k.J);
  const Vector6 moved = tip(angle("", "loads: {p: {node: tip, force: [0, 0, 1]}}\n"));
  CHECK_THAT(moved[2], WithinRel(L * L * L / 3 * k.I_z / (E * D) + shear(1, 1) * L - phi * s_y, 1e-11));
  CHECK_THAT(moved[1], WithinRel(-L * L * L / 3 * k.I_yz / (E * D) + shear(0, 1) * L + phi * s_z, 1e-11));
  CHECK_THAT(moved[0], WithinAbs(0, 1e-11));
  CHECK_THAT(moved[3], WithinRel(phi, 1e-11));
}

TEST_CASE("Kelvin-Voigt damping is the stiffness times its time, whatever the section") {
  const StaticModel beam(angle(", damping: 0.3, twist: 0.2"));
  const MatrixX K = beam.stiffness(), C = beam.dense.tangent(beam.state, DenseModel::Part::C)(beam.free, beam.free);
  CHECK((C - 0.3 * K).cwiseAbs().maxCoeff() < 1e-14 * K.cwiseAbs().maxCoeff());
}
