// Law 2: a rigid motion of the whole model rotates the forces with it and does not change energies; a uniform velocity
// changes no force.
#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"

using namespace bielle::laws;
using bielle::mechanism::Energy;
using bielle::mechanism::exp_so3;
using bielle::mechanism::Matrix3;
using bielle::mechanism::Vector3;

namespace {

/// Rotations, translations and sums of products of order one: some hundred roundings of the largest term.
constexpr double rounding = 1e-13;

/// Returns the size of the terms of a residual: of a row's entries at unit motions.
double size_of(const Subject& subject, const State& state) {
  const auto& dense = *subject.dense;
  const double K =
      (dense.tangent(state, DenseModel::Part::K) * subject.position_units().asDiagonal()).cwiseAbs().maxCoeff();
  const double C =
      (dense.tangent(state, DenseModel::Part::C) * subject.rate_units().asDiagonal()).cwiseAbs().maxCoeff();
  const double M =
      (dense.tangent(state, DenseModel::Part::M) * subject.rate_units().asDiagonal()).cwiseAbs().maxCoeff() *
      subject.scales.rate;
  return K + C + M + dense.residual(state).cwiseAbs().maxCoeff();
}

VectorX turned(const DenseModel& dense, const Matrix3& Q, VectorX r) {
  for (int node = 0; node < dense.nodes(); ++node) r.segment<3>(6 * node) = Q * r.segment<3>(6 * node).eval();
  return r;
}

}  // namespace

TEST_CASE("law 2: a rigid motion of the whole model turns forces and leaves energies") {
  for (const Sample& sample : samples()) {
    if (sample.inertial) continue;
    for (const Subject& subject : subjects(sample))
      for (const NamedState& named : law_states(subject)) {
        if (!subject.carried_axes) continue;  // multipliers may be components in axes that do not turn
        CAPTURE(title(sample), named.name);
        DenseModel& dense = *subject.dense;
        bielle::test::Random random(7);
        const Matrix3 Q = exp_so3(random.vector_of_length(2));
        const Vector3 gravity = dense.environment.gravity;
        const VectorX r = dense.residual(named.state);
        const Energy energy = dense.energy(named.state);
        const double size = size_of(subject, named.state);

        const State rotated = moved_rigidly(named.state, Q, Vector3::Zero());
        dense.environment.gravity = Q * gravity;
        CHECK((dense.residual(rotated) - turned(dense, Q, r)).cwiseAbs().maxCoeff() <= rounding * size);
        const Energy rotated_energy = dense.energy(rotated);
        const double energy_size = size * subject.scales.length + std::abs(energy.kinetic) + std::abs(energy.elastic);
        CHECK_THAT(rotated_energy.kinetic, Catch::WithinAbs(energy.kinetic, rounding * energy_size));
        CHECK_THAT(rotated_energy.elastic, Catch::WithinAbs(energy.elastic, rounding * energy_size));
        CHECK_THAT(rotated_energy.gravity, Catch::WithinAbs(energy.gravity, rounding * energy_size));
        CHECK_THAT(rotated_energy.dissipation, Catch::WithinAbs(energy.dissipation, rounding * energy_size));
        CHECK_THAT(rotated_energy.input, Catch::WithinAbs(energy.input, rounding * energy_size));
        dense.environment.gravity = gravity;

        // Positions ten lengths away are rounded to ten times the error.
        const State translated =
            moved_rigidly(named.state, Matrix3::Identity(), random.vector3(10 * subject.scales.length));
        CHECK((dense.residual(translated) - r).cwiseAbs().maxCoeff() <= 10 * rounding * size);
        const Energy translated_energy = dense.energy(translated);
        CHECK_THAT(translated_energy.kinetic, Catch::WithinAbs(energy.kinetic, 10 * rounding * energy_size));
        CHECK_THAT(translated_energy.elastic, Catch::WithinAbs(energy.elastic, 10 * rounding * energy_size));

        State flying = named.state;
        const Vector3 velocity = random.vector3(10 * subject.scales.length * subject.scales.rate);
        for (auto& node : flying.nodes) node.v += velocity;
        CHECK((dense.residual(flying) - r).cwiseAbs().maxCoeff() <= 10 * rounding * size);
      }
  }
}
