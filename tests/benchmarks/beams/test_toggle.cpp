// A toggle of two legs with rigid joints is pressed flat: its legs buckle, it snaps through and stiffens again.
//
// F. W. Williams, Quart. J. Mech. Appl. Math. 17 (1964) 451. Reference here: Reissner's rod with linear strains, one
// leg by shooting (Runge and Kutta's method) for each height of the apex, from one height to the next.
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/static_analysis.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;

namespace test_toggle {
namespace {

constexpr double angle = 0.2, EA = 2e4, GA = 8e3, EI = 1;  // a leg of length 1
const double reach = std::cos(angle), rise = std::sin(angle);

/// x, y, theta and M along the leg, under the constant force (Fx, Fy) on its sections.
using Section = Eigen::Vector4d;
Section end_of_leg(const Eigen::Vector3d& unknowns) {
  const double Fx = unknowns[0], Fy = unknowns[1];
  Section z(0, 0, angle, unknowns[2]);
  bielle::test::advance_by_runge_kutta(z, 1.0, 400, [&](const Section& s) -> Section {
    const double c = std::cos(s[2]), d = std::sin(s[2]);
    const double stretch = 1 + (Fx * c + Fy * d) / EA, shear = (-Fx * d + Fy * c) / GA;
    const double x = stretch * c - shear * d, y = stretch * d + shear * c;
    return {x, y, s[3] / EI, -(x * Fy - y * Fx)};
  });
  return z;
}

/// Forces and moment at the foot that bring the apex down by v, without turning it.
Eigen::Vector3d pressed(double v, Eigen::Vector3d unknowns) {
  const auto gap = [&](const Eigen::Vector3d& u) -> Eigen::Vector3d {
    const Section z = end_of_leg(u);
    return {z[0] - reach, z[1] - (rise - v), z[2] - angle};
  };
  for (int k = 0; k < 20; ++k) {
    const Eigen::Vector3d r = gap(unknowns);
    Eigen::Matrix3d J;
    for (int j = 0; j < 3; ++j) {
      const double h = 1e-6 * (1 + std::abs(unknowns[j]));
      J.col(j) =
          (gap(unknowns + h * Eigen::Vector3d::Unit(j)) - gap(unknowns - h * Eigen::Vector3d::Unit(j))) / (2 * h);
    }
    unknowns -= J.inverse() * r;
    if (r.norm() < 1e-12) break;
  }
  return unknowns;
}

/// Returns the load on the apex of the whole toggle at each height, by half the toggle.
std::vector<double> reference(const std::vector<double>& heights) {
  std::vector<double> loads;
  Eigen::Vector3d unknowns = Eigen::Vector3d::Zero();
  double v = 0;
  for (const double end : heights) {
    constexpr double step = 1e-3;
    while (v < end) {
      v = std::min(v + step, end);
      unknowns = pressed(v, unknowns);
    }
    loads.push_back(-2 * unknowns[1]);
  }
  return loads;
}

double load_at(double v, int elements) {
  const std::string leg = fmt::format(
      "elements: {}, orientation: [0, 0, 1], section: {{EA: {}, GAy: {}, GAz: {}, GJ: 1, "
      "EIy: {}, EIz: {}}}",
      elements, EA, GA, GA, EI, EI);
  const MechanismFile file = read_mechanism_text(
      fmt::format(
          "nodes:\n  left: {{position: [{0}, 0, 0], fixed: true}}\n  apex: {{position: [0, {1}, 0], fixed: [x, z, "
          "rx, ry, rz]}}\n  right: {{position: [{2}, 0, 0], fixed: true}}\n"
          "elements:\n  a: {{type: beam, nodes: [left, apex], {3}}}\n  b: {{type: beam, nodes: [right, apex], "
          "{3}}}\n"
          "loads: {{p: {{node: apex, force: [0, -1, 0]}}}}\n"
          "analysis: [{{type: static, arc_length: {{until: {{node: apex, direction: y, displacement: {4:.17g}}}}}}}]\n",
          -reach, rise, reach, leg, -v),
      "model.yaml");
  Session session(file.model);
  const auto& options = dynamic_cast<const StaticAnalysis&>(*file.analyses.front()).options();
  return compute_statics(session, options).load_factor;
}

}  // namespace

TEST_CASE("a toggle past its limit loads is that of the rod, by shooting") {
  const std::vector<double> heights = {0.03, 0.1, 0.2, 0.3, 0.37};
  const std::vector<double> exact = reference(heights);
  // The toggle snaps through: the load has a maximum before and falls below it after.
  CHECK(*std::max_element(exact.begin(), exact.end() - 1) >
        1.2 * *std::min_element(exact.begin() + 1, exact.end() - 1));
  const double size = std::abs(exact[1]);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double coarse = load_at(heights[k], 16) - exact[k], fine = load_at(heights[k], 32) - exact[k];
    CAPTURE(heights[k], exact[k], coarse, fine);
    CHECK(std::abs(fine) < 5e-3 * size);
    CHECK((std::abs(fine) < 0.3 * std::abs(coarse) || std::abs(coarse) < 1e-4 * size));
  }
}

}  // namespace test_toggle
