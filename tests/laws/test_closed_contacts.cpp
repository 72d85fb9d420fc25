// Tangent and power of closed contacts: the laws test contacts as they begin, this test with the memory of a contact.
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;

namespace {

/// Samples, and the values of the memory of their components in contact.
struct ClosedContact {
  std::string variant, event;  ///< variant of the sample, and a word of the names of the component's event functions
  std::vector<std::pair<Eigen::Index, double>> memory;
};

}  // namespace

TEST_CASE("closed contacts have the tangents of their forces, and keep or dissipate their energy") {
  // Teeth: after the angles, whether each flank touches. One-way clutch: holds at 3 rad, far ahead. Couplings: the side
  // that touches.
  const std::vector<ClosedContact> contacts = {{"elastic, with play", "teeth touch", {{5, 1}, {6, 1}}},
                                               {"one-way, elastic", "one-way", {{0, 1}, {1, 3}}},
                                               {"elastic coupling with play", "forwards", {{0, 1}}},
                                               {"elastic coupling with play", "forwards", {{0, -1}}}};
  for (const ClosedContact& contact : contacts) {
    int pushed = 0;
    for (const Sample& sample : samples()) {
      if (sample.variant != contact.variant) continue;
      for (const Subject& subject : subjects(sample)) {
        const DenseModel& dense = *subject.dense;
        const auto& events = dense.declarations().front().event_functions;
        if (events.empty() || events.front().name.find(contact.event) == std::string::npos) continue;
        const double reach = 0.005 * subject.scales.smooth_within;
        for (unsigned seed = 2; seed <= 6; ++seed) {
          State state = subject.random_state(1, seed);
          for (const auto& [place, value] : contact.memory) state.memory[place] = value;
          CAPTURE(title(sample), seed);
          const auto moved = [&](auto move) {
            return bielle::test::jacobian(
                [&](const VectorX& step) -> VectorX {
                  State other = state;
                  (dense.*move)(other, step);
                  return dense.residual(other);
                },
                dense.size(), reach);
          };
          const auto K = dense.tangent(state, DenseModel::Part::K), C = dense.tangent(state, DenseModel::Part::C);
          CHECK((moved(&DenseModel::move) - K).cwiseAbs().maxCoeff() < 1e-7 * (1 + K.cwiseAbs().maxCoeff()));
          CHECK((moved(&DenseModel::move_rates) - C).cwiseAbs().maxCoeff() < 1e-8 * (1 + C.cwiseAbs().maxCoeff()));
          const VectorX r = dense.residual(state), v = dense.rates(state);
          if (r.norm() > 0) ++pushed;
          const double stored = bielle::test::derivative(
              [&](double s) { return dense.energy(dense.along_motion(state, s)).elastic; }, reach);
          const double power = r.dot(v);
          CHECK_THAT(power, Catch::WithinAbs(stored + dense.energy(state).dissipation, 1e-8 * (1 + std::abs(power))));
          // A flank that is closed by its memory may be apart in a random state. Its damper then returns energy, which
          // a spring cannot do.
          if (contact.event == "one-way") CHECK(dense.energy(state).dissipation >= 0);
        }
      }
    }
    CHECK(pushed > 0);
  }
}
