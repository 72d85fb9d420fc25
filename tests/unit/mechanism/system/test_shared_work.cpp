// Evaluations by several threads: the same numbers to the last bit, the same failures.
#include <limits>

#include <catch2/catch.hpp>

#include "mechanism/system/system.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random.hpp"
#include "tests/support/superelement_arms.hpp"

using namespace bielle::mechanism;
using bielle::ComputationError;
using bielle::test::message_of;
using bielle::test::Random;
using bielle::test::SuperelementArms;

namespace {

State moved(const System& system, double size) {
  Random random(1);
  State state = system.start(0.3);
  system.displace(state, State(state), size * random.vector(system.dofs()));
  system.set_rates(state, random.vector(system.dofs()), random.vector(system.dofs()));
  return state;
}

/// Returns all results of a system, one after the other.
std::vector<double> everything(const System& system, const Environment& environment, State state) {
  std::vector<double> all, values;
  const auto take = [&](const auto& vector) { all.insert(all.end(), vector.data(), vector.data() + vector.size()); };
  VectorX r(system.size());
  ResidualScale scale;
  system.residual(state, environment, r, &scale);
  take(r);
  take(scale.largest);
  const VectorX dq = VectorX::Constant(system.dofs(), 0.01);
  for (const TangentWeights& weights : {TangentWeights{1, 20, 400, 0, 1}, TangentWeights{0, 0, 1, 1, 1, true}}) {
    system.tangent(state, environment, weights, &dq, values);
    take(values);
  }
  const Energy energy = system.energy(state, environment);
  for (const double each : {energy.kinetic, energy.elastic, energy.gravity, energy.dissipation, energy.input})
    all.push_back(each);
  system.accept(state, environment);
  take(state.memory);
  return all;
}

}  // namespace

TEST_CASE("what a system computes does not depend on the number of threads") {
  const SuperelementArms arms;
  const MechanismFile file = arms.file();
  System system(file.model);
  const State state = moved(system, 0.01);
  const std::vector<double> alone = everything(system, file.model.environment, state);
  for (const int threads : {2, 3, 8}) {
    system.use_threads(threads);
    for (int round = 0; round < 20; ++round) REQUIRE(everything(system, file.model.environment, state) == alone);
  }
}

TEST_CASE("a failure is reported alike by any number of threads") {
  const SuperelementArms arms;
  const MechanismFile file = arms.file();
  System system(file.model);
  State state = system.start(0);
  // Neither arm finds its frame.
  for (const char* name : {"b", "d"})
    state.nodes[static_cast<std::size_t>(*file.model.find_node(name))].x.setConstant(
        std::numeric_limits<double>::quiet_NaN());
  VectorX r(system.size());
  const auto message = [&] {
    return message_of<ComputationError>([&] { system.residual(state, file.model.environment, r); });
  };
  const std::string alone = message();
  CHECK_THAT(alone, Catch::Contains("'upper'"));
  for (const int threads : {2, 5}) {
    system.use_threads(threads);
    for (int round = 0; round < 20; ++round) REQUIRE(message() == alone);
  }
  // A failed evaluation must leave no traces.
  const State whole = moved(system, 0.01);
  VectorX expected(system.size());
  System(file.model).residual(whole, file.model.environment, expected);
  system.residual(whole, file.model.environment, r);
  CHECK(r == expected);
}
