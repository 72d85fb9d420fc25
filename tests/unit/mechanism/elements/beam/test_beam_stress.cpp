// Stresses of beams as measures: against the closed form of a cantilever, and against what is recorded.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::message_of;
using bielle::test::model_from_text;
using bielle::test::session_of;
using Catch::Contains;

namespace test_beam_stress {

/// A cantilever of two elements, 1 m long, b = 0.03 m wide (y) and h = 0.04 m high (z), with a load at its end. The
/// points are the top edge and the centroid.
const std::string cantilever = R"yaml(
nodes: {root: {fixed: true}, tip: {position: [1, 0, 0]}}
elements:
  boom:
    type: beam
    nodes: [root, tip]
    elements: 2
    orientation: [0, 1, 0]
    section: {rectangle: [0.03, 0.04], young: 2e11, poisson: 0.3, density: 7800, stress_points: [[0, 0.02], [0, 0]]}
loads: {end: {node: tip, force: [50, 0, 2]}}
measures:
  top: boom.element_1.stress.p1.xx
  shear: boom.element_1.stress.p2.xz
  at_top: boom.element_1.von_mises.p1
  at_centroid: boom.element_2.von_mises.p2
  in_second: boom.element_2.von_mises.max
  largest: boom.von_mises.max
)yaml";

}  // namespace test_beam_stress

TEST_CASE("stresses of a cantilever as measures are those of the theory of beams") {
  using namespace test_beam_stress;
  Session session = session_of(cantilever);
  compute_statics(session, StaticsOptions{});
  const double b = 0.03, h = 0.04, A = b * h, I = b * h * h * h / 12, E = 2e11, N = 50, V = 2;
  // The tension acts on the deflection w, to first order: M = V (1 - x) - N (w(1) - w(x)). A load upwards presses the
  // top, the axial stress is (N + V slope)/A, the shear stress of the centroid 3/2 (V - N slope)/A. The middle of an
  // element has the axes of the helix between its ends, turned by the mean of their slopes.
  const auto w = [&](double x) { return V * x * x * (3 - x) / (6 * E * I); };
  const auto end_slope = [&](double x) { return V * x * (2 - x) / (2 * E * I); };
  const auto slope = [&](double x) { return (end_slope(x - 0.25) + end_slope(x + 0.25)) / 2; };
  const auto axial = [&](double x) { return (N + V * slope(x)) / A; };
  const auto at_top = [&](double x) { return axial(x) - (V * (1 - x) - N * (w(1) - w(x))) * h / 2 / I; };
  const auto at_centroid = [&](double x) { return 1.5 * (V - N * slope(x)) / A; };
  constexpr double second_order = 1e-6;  // N L^2/(EI) squared, 2.4e-6, and less in some of the quantities
  const auto measured = [&](const char* name) { return session.measure(name); };
  CHECK(measured("top") == Approx(at_top(0.25)).epsilon(second_order));
  CHECK(measured("at_top") == Approx(std::abs(measured("top"))).epsilon(1e-12));
  CHECK(measured("shear") == Approx(at_centroid(0.25)).epsilon(second_order));
  CHECK(measured("at_centroid") ==
        Approx(std::hypot(axial(0.75), std::sqrt(3) * at_centroid(0.75))).epsilon(second_order));
  CHECK(measured("in_second") ==
        Approx(std::hypot(axial(0.75), std::sqrt(3) * at_centroid(0.75))).epsilon(second_order));
  CHECK(measured("largest") == measured("at_top"));
  const auto recorded = session.read("elements/boom/von_mises");  // elements, points
  REQUIRE(recorded.size() == 4);
  CHECK(recorded[0] == Approx(measured("at_top")).epsilon(1e-14));
  CHECK(recorded[3] == Approx(measured("at_centroid")).epsilon(1e-14));
}

TEST_CASE("the force of a spring may depend on a stress that begins at zero") {
  using namespace test_beam_stress;
  std::string text = cantilever;
  text.replace(text.find("50, 0, 2"), 8, "0, 0, 0");
  text.replace(text.find("loads:"), 0,
               "  spring: {type: spring_damper, nodes: [root, tip], force: \"1e-9*boom.von_mises.max + 1e3*e\"}\n");
  Session session = session_of(text);
  compute_statics(session, StaticsOptions{});
  for (const char* name : {"top", "shear", "at_top", "at_centroid", "in_second", "largest"}) {
    CAPTURE(name);
    CHECK(session.measure(name) == 0);
  }
}

TEST_CASE("the largest stress of a beam has the derivatives of the element that has it") {
  const auto model = model_from_text(
      "nodes: {root: {}, tip: {position: [1, 0, 0]}}\n"
      "elements:\n"
      "  boom: {type: beam, nodes: [root, tip], elements: 2, damping: 0.02, section: {rectangle: [0.3, 0.2], young: "
      "900, "
      "poisson: 0.2, density: 1.5, stress_points: [[0.15, 0.1], [-0.1, 0.05]]}}\n"
      "  spring: {type: spring_damper, nodes: [root, tip], at: [[0.2, 0.1, -0.3], [0, 0, 0]], force: "
      "\"0.1*boom.von_mises.max\"}\n");
  const DenseModel dense(*model);
  const int middle = *model->find_node("boom.1"), tip = *model->find_node("tip");
  const auto [stretched, strain] = GENERATE(table<double, double>({{0.02, 0.1}, {0.08, 0.1}}));  // x of both nodes
  CAPTURE(stretched);
  VectorX step = VectorX::Zero(dense.size());
  step.segment<6>(6 * middle) << stretched, 0.01, -0.02, 0.03, 0.01, 0.02;
  step.segment<6>(6 * tip) << strain, 0.03, 0.02, 0.01, -0.02, 0.04;
  State state = dense.start();
  dense.move(state, step);
  const Eigen::MatrixXd K = bielle::test::jacobian(
      [&](const VectorX& h) {
        State moved = state;
        dense.move(moved, h);
        return dense.residual(moved);
      },
      dense.size(), 1e-3);
  CHECK((dense.tangent(state, DenseModel::Part::K) - K).cwiseAbs().maxCoeff() < 1e-9 * K.cwiseAbs().maxCoeff());
}

TEST_CASE("a stress that a beam does not have is refused with those that it has") {
  using namespace test_beam_stress;
  const auto message = [](const std::string& wrong, const std::string& by) {
    std::string text = cantilever;
    text.replace(text.find(wrong), wrong.size(), by);
    return message_of<bielle::InputError>([&] { session_of(text); });
  };
  CHECK_THAT(message("boom.element_2.von_mises.p2", "boom.element_2.von_mises.p3"),
             Contains("'boom' has no 'element_2.von_mises.p3'; did you mean 'element_2.von_mises.p"));
  CHECK_THAT(message("boom.von_mises.max", "boom.von_mises.p1"), Contains("'boom' has no 'von_mises.p1'"));
  CHECK_THAT(message("boom.von_mises.max", "boom.element_3.von_mises.max"),
             Contains("has no 'element_3.von_mises.max'"));
  CHECK_THAT(message(", stress_points: [[0, 0.02], [0, 0]]", ""), Contains("'boom' has no 'element_1.stress.p1.xx'"));
}
