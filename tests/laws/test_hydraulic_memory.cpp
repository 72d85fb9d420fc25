// Tangents of hydraulics in states of their memory that the laws, which test them before any motion, do not reach:
// valves that are locked, or were, and both sides of an accumulator.
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;

namespace {

/// Returns the memory by type: of a valve [begun, command, locked, opening, speed], of an accumulator its side.
const std::map<std::string, std::vector<std::vector<double>>>& memories() {
  static const std::vector<std::vector<double>> of_valves = {{1, 1, 1, 0.4, 0.2}, {1, -1, 0, 0.4, 0.2}};
  static const std::map<std::string, std::vector<std::vector<double>>> all = {
      {"valve", of_valves},  {"servo_valve", of_valves},    {"check", of_valves},
      {"relief", of_valves}, {"counterbalance", of_valves}, {"accumulator", {{0}, {1}}}};
  return all;
}

}  // namespace

TEST_CASE("locked valves and both sides of accumulators have the tangents of their flows") {
  std::map<std::string, int> checked;
  for (const Sample& sample : samples()) {
    const auto found = memories().find(sample.type);
    if (found == memories().end() || sample.place.rfind("hydraulics", 0) != 0) continue;
    for (const Subject& subject : subjects(sample))
      for (const std::vector<double>& memory : found->second)
        for (unsigned seed = 2; seed <= 5; ++seed) {
          const DenseModel& dense = *subject.dense;
          State state = subject.random_state(1, seed);
          REQUIRE(dense.declarations().front().memory.size() == memory.size());
          for (std::size_t k = 0; k < memory.size(); ++k) state.memory[static_cast<Eigen::Index>(k)] = memory[k];
          CAPTURE(title(sample), memory, seed);
          const auto moved = [&](auto move, const VectorX& units) -> MatrixX {
            return bielle::test::jacobian(
                [&](const VectorX& step) -> VectorX {
                  State other = state;
                  (dense.*move)(other, step.cwiseProduct(units));
                  return dense.residual(other);
                },
                dense.size(), 1e-3 * subject.scales.smooth_within);
          };
          const VectorX positions = subject.position_units(), rates = subject.rate_units();
          const MatrixX K = dense.tangent(state, DenseModel::Part::K) * positions.asDiagonal(),
                        C = dense.tangent(state, DenseModel::Part::C) * rates.asDiagonal();
          CHECK((moved(&DenseModel::move, positions) - K).cwiseAbs().maxCoeff() < 1e-8 * (1 + K.cwiseAbs().maxCoeff()));
          CHECK((moved(&DenseModel::move_rates, rates) - C).cwiseAbs().maxCoeff() <
                1e-8 * (1 + C.cwiseAbs().maxCoeff()));
          ++checked[sample.type];
        }
  }
  for (const auto& [type, unused] : memories()) {
    CAPTURE(type);
    CHECK(checked[type] > 0);
  }
}
