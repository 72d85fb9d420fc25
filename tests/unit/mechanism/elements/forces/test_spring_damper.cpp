// Springs and dampers: closed forms. (Tangents, invariance and power: tests/laws.)
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/elements/forces/spring_damper.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/model_text.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using Catch::Contains;

namespace {

std::unique_ptr<Model> spring(const std::string& keys, const std::string& b = "[3, 4, 0]") {
  return model_from_text("nodes: {a: {position: [0, 0, 0]}, b: {position: " + b + "}}\nelements:\n" +
                         "  s: {type: spring_damper, nodes: [a, b], " + keys + "}\n");
}

}  // namespace

TEST_CASE("tension pulls the ends together along their line") {
  const auto model = spring("stiffness: 10, damping: 2, length: 4");
  const DenseModel dense(*model);
  State state = dense.start();
  state.nodes[2].v = {1, 2, 3};
  // Length 5, elongation 1, direction (0.6, 0.8, 0), rate 0.6 + 1.6.
  const double N = 10 * 1 + 2 * 2.2;
  VectorX expected = VectorX::Zero(12);
  expected.segment<3>(0) = -N * Vector3(0.6, 0.8, 0);
  expected.segment<3>(6) = N * Vector3(0.6, 0.8, 0);
  CHECK((dense.residual(state).tail<12>() - expected).norm() < 1e-14);
  const Energy energy = dense.energy(state);
  CHECK_THAT(energy.elastic, Catch::WithinRel(5.0, 1e-14));
  CHECK_THAT(energy.dissipation, Catch::WithinRel(2 * 2.2 * 2.2, 1e-14));
}

TEST_CASE("without a free length a spring is free of force as placed") {
  const auto model = spring("stiffness: 1e6, at: [[0.1, 0, 0], [0, -0.2, 0.3]]");
  const DenseModel dense(*model);
  CHECK(dense.residual(dense.start()).norm() == 0);
}

TEST_CASE("a formula of elongation and rate stores and dissipates, one of time is input") {
  const auto hardening = spring("force: '3*e + e^3 + 2*v*abs(v)', length: 3");
  const DenseModel dense(*hardening);
  State state = dense.start();
  state.nodes[2].v = {0.6, 0.8, 0};
  Energy energy = dense.energy(state);  // e = 2, v = 1
  CHECK_THAT(energy.elastic, Catch::WithinRel(3.0 * 4 / 2 + 16.0 / 4, 1e-14));
  CHECK_THAT(energy.dissipation, Catch::WithinRel(2.0, 1e-14));
  CHECK(energy.input == 0);

  // The force has a kink at e = 1: the energy is 5 (e - 1)^2/2 beyond.
  const auto slack = spring("force: 'if(e > 1, 5*(e - 1), 0)', length: 3");
  CHECK_THAT(DenseModel(*slack).energy(DenseModel(*slack).start()).elastic, Catch::WithinRel(2.5, 1e-9));

  const auto actuator = spring("force: '100*t - 0*e'");
  const DenseModel timed(*actuator);
  state.time = 0.5;
  energy = timed.energy(state);
  CHECK(energy.elastic == 0);
  CHECK(energy.dissipation == 0);
  CHECK_THAT(energy.input, Catch::WithinRel(-50.0, 1e-14));
}

TEST_CASE("a spring of free length zero passes through zero length") {
  const auto model = spring("stiffness: 7, length: 0", "[0, 0, 0]");
  const DenseModel dense(*model);
  const State state = dense.start();
  CHECK(dense.residual(state).norm() == 0);
  const MatrixX K = dense.tangent(state, DenseModel::Part::K);
  CHECK((K.block<3, 3>(6, 6) - 7 * Matrix3::Identity()).norm() < 1e-14);
  CHECK((K.block<3, 3>(6, 12) + 7 * Matrix3::Identity()).norm() < 1e-14);
}

TEST_CASE("a spring whose ends meet has no direction and says so") {
  CHECK_THROWS_WITH(spring("stiffness: 7, length: 1", "[0, 0, 0]"),
                    Contains("elements.s.nodes") && Contains("coincide"));
  const auto model = spring("stiffness: 7, length: 1");
  const DenseModel dense(*model);
  State state = dense.start();
  state.time = 2;
  state.nodes[2].x = state.nodes[1].x;
  CHECK_THROWS_AS(dense.residual(state), bielle::ComputationError);
  CHECK_THROWS_WITH(dense.residual(state), Contains("t = 2 s: the ends of spring_damper 's' have met"));
}

TEST_CASE("contradictions in a spring are refused") {
  CHECK_THROWS_WITH(spring("length: 1"), Contains("needs `stiffness`, `damping` or `force`"));
  CHECK_THROWS_WITH(spring("stiffness: 1, force: 'e'"), Contains("elements.s.stiffness"));
  CHECK_THROWS_WITH(spring("stiffness: -1"), Contains("elements.s.stiffness"));
  CHECK_THROWS_WITH(spring("force: 'x*e'"), Contains("elements.s.force"));
}

TEST_CASE("values of a spring_damper may have units, which must fit") {
  const auto tension = [](const std::string& keys) {
    const auto model = spring(keys);
    const DenseModel dense(*model);
    return dense.residual(dense.start()).segment<3>(12).norm();
  };
  CHECK_THAT(tension("stiffness: 10 N/mm, length: 400 cm"), Catch::WithinRel(10000.0, 1e-14));
  CHECK_THAT(tension("force: 2 kN"), Catch::WithinRel(2000.0, 1e-14));
  CHECK_THROWS_WITH(spring("damping: 1 N/m"),
                    Contains("elements.s.damping: expected a value in N s/m, found one in 'N/m'"));
}
