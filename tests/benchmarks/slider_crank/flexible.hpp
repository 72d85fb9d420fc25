// A slider-crank with a flexible rod: data of the IVP test set's problem "crank" (B. Simeon, Modelling a flexible
// slider crank mechanism by a mixed system of DAEs and PDEs, Math. Model. Sys. 2 (1996) 1): crank 0.15 m driven at 150
// rad/s, rod 0.30 m of 8 x 8 mm, E = 2e11, nu = 0.3, density 7870, slider 0.075552 kg, no gravity.
#pragma once

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/superelement/superelement.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bielle::test::flexible_crank {

using namespace bielle::mechanism;

/// Returns the mechanism in the plane, in line at the start; the rod spans the nodes `a` and `b`.
inline std::string slider_crank(const std::string& rod) {
  return R"yaml(
nodes:
  crank: {position: [0, 0, 0], angular_velocity: [0, 0, 150]}
  pin: {position: [0.15, 0, 0]}
  a: {position: [0.15, 0, 0], velocity: [0, 22.5, 0], angular_velocity: [0, 0, -75]}
  b: {position: [0.45, 0, 0], angular_velocity: [0, 0, -75]}
  slider: {position: [0.45, 0, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 0.36, inertia: [0.0014, 0.0014, 0.002727], also: [pin]}
  slider: {type: point_mass, node: slider, mass: 0.075552}
)yaml" + rod +
         R"yaml(
joints:
  main: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1]}
  big_end: {type: hinge, nodes: [pin, a], axis: [0, 0, 1]}
  wrist: {type: hinge, nodes: [b, slider], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}
drives: {motor: {joint: main, angle: "150*t"}}
)yaml";
}

inline std::string beam_rod(int elements) {
  return "  rod: {type: beam, nodes: [a, b], elements: " + std::to_string(elements) +
         ", section: {rectangle: [0.008, 0.008], young: 2e11, poisson: 0.3, density: 7870, "
         "shear_factors: [0.8333333333333333, 0.8333333333333333]}}\n";
}

/// Returns the deflection of a point from the line between a and b, positive to the left of the way from a to b.
inline double deflection(const Vector3& point, const Vector3& a, const Vector3& b) {
  const Vector3 along = (b - a).normalized();
  return Vector3(-along.y(), along.x(), 0).dot(point - a);
}

/// Returns the rod reduced to its ends and fixed-boundary modes. @param prestress  with geometric stiffness
inline BeamSuperelement reduced_rod(bool prestress, double stiffening = 1) {
  BeamChain chain;
  const int elements = 20;
  for (int k = 0; k <= elements; ++k) chain.nodes.push_back({0.3 * k / elements, 0, 0});
  const double E = stiffening * 2e11, G = E / 2.6, A = 64e-6, I = A * A / 12, density = 7870;
  chain.properties = {density * A, E * A, E * I, E * I, G * 0.1405770 * A * A, density * 2 * I};
  chain.interfaces = {{0}, {elements}};
  chain.modes = 8;
  chain.prestress = prestress;
  BeamSuperelement rod = chain.reduced();
  rod.body.interfaces[0].name = "big_end";
  rod.body.interfaces[1].name = "small_end";
  return rod;
}

/// The slider-crank with the rod as a superelement, and the deflection of its middle from the line of the ends.
class WithSuperelement {
 public:
  explicit WithSuperelement(const BeamSuperelement& rod) : model(text_with(rod, file_)) {
    while (model.file.model.members()[member_].component->name() != "rod") ++member_;
    std::size_t size = 0;
    for (const OutputField& field : body().output_fields()) {
      if (field.name == "coordinates") coordinates_ = size;
      size += field.size();
    }
    record_.resize(size);
    // The mass points on both sides of the middle, 1 mm away: their mean is the middle's to 1e-4.
    Eigen::Index left = 0, right = 0;
    for (Eigen::Index p = 0; p < rod.points.cols(); ++p) {
      if (rod.points(0, p) < 0.15 && rod.points(0, p) > rod.points(0, left)) left = p;
      if (rod.points(0, p) > 0.15 && (right == 0 || rod.points(0, p) < rod.points(0, right))) right = p;
    }
    REQUIRE(std::abs(rod.points(0, left) + rod.points(0, right) - 0.3) < 1e-9);
    middle_ = 0.5 * (rod.field.row(3 * left + 1) + rod.field.row(3 * right + 1));
  }
  double deflection(const State& state) {
    body().write_output(LocalState(state, model.system.slots()[member_], model.environment()), record_.data());
    const Eigen::Map<const VectorX> q(record_.data() + coordinates_, middle_.size());
    return middle_.dot(q) - 0.5 * (q[1] + q[7]);
  }

 private:
  const Component& body() const { return *model.file.model.members()[member_].component; }
  static std::string text_with(const BeamSuperelement& rod, const std::string& file) {
    write_superelement(rod.body, file);
    return slider_crank("  rod: {type: superelement, file: \"" + file +
                        "\", position: [0.15, 0, 0], nodes: {big_end: a, small_end: b}}\n");
  }
  TemporaryFolder folder_;
  std::string file_ = folder_ / "rod.h5";
  std::size_t member_ = 0, coordinates_ = 0;
  std::vector<double> record_;
  Eigen::RowVectorXd middle_;

 public:
  const ReadyModel model;
};

}  // namespace bielle::test::flexible_crank
