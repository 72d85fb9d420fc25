// Linear solves with condensed amplitudes: the same steps as without, for any weights; the choice of condensed
// amplitudes; singular ones.
#include <catch2/catch.hpp>

#include "mechanism/solvers/newton/newton_matrix.hpp"
#include "tests/support/linear_amplitudes.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random.hpp"
#include "tests/support/silent_reader.hpp"
#include "tests/support/superelement_arms.hpp"

using namespace bielle::mechanism;
using bielle::ComputationError;
using bielle::test::LinearAmplitudes;
using bielle::test::message_of;
using bielle::test::Random;
using bielle::test::SilentReader;
using bielle::test::SuperelementArms;
using Catch::Contains;

namespace {

/// Returns a small random motion about the start: everything moves and is loaded.
State moved(const System& system, Random& random) {
  State state = system.start(0.3);
  system.displace(state, State(state), 0.01 * random.vector(system.dofs()));
  system.set_rates(state, random.vector(system.dofs()), random.vector(system.dofs()));
  state.multiplier = random.vector(system.multipliers());
  return state;
}

/// J x + r, row by row over |J| |x| + |r|.
double backward_error(const System& system, const NewtonMatrix& linear, const VectorX& x, const VectorX& r) {
  VectorX sum = r, size = r.cwiseAbs();
  system.pattern().for_each([&](int k, int row, int column) {
    const double term = linear.values()[static_cast<std::size_t>(k)] * x[column];
    sum[row] += term;
    size[row] += std::abs(term);
  });
  return (sum.cwiseAbs().array() / size.array()).maxCoeff();
}

const Component& element(const Model& model, const char* name) {
  return *model.components_of({Section::elements, name})[0];
}

std::size_t condensed_blocks(const Model& model) { return System(model).condensed_pattern().blocks().size(); }

/// A rigid body that slides on a spring, with amplitudes.
struct Slider {
  MechanismFile file = read_mechanism_text(R"yaml(
nodes: {a: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  mass: {type: point_mass, node: a, mass: 2}
  spring: {type: spring_damper, nodes: [ground, a], stiffness: 3, length: 1}
)yaml",
                                           "slider.yaml");
  Slider(const MatrixX& K, const MatrixX& M) {
    file.model.add(std::make_unique<LinearAmplitudes>("block", *file.model.find_node("a"), 1, K, M),
                   Entry{Section::elements, "block"}, Recorded::no);
  }
};

constexpr int amplitudes = CondensedPattern::least_block + 2;

}  // namespace

TEST_CASE("a step with condensed amplitudes is the step of the whole") {
  const SuperelementArms arms;
  const MechanismFile file = arms.file();
  const System system(file.model);
  REQUIRE(system.condensed_pattern().blocks().size() == 2);
  CHECK(system.condensed_pattern().rest().size() == system.size() - 2 * SuperelementArms::modes);
  Random random(1);
  const State state = moved(system, random);
  const VectorX r = random.vector(system.size());
  // A time step, statics, a consistent start.
  const auto weights = GENERATE(TangentWeights{1, 2e3, 4e6, 0, 1}, TangentWeights{1, 0, 0, 0, 1, true},
                                TangentWeights{0, 0, 1, 1, 1, true});
  NewtonMatrix linear(system);
  linear.factor(state, file.model.environment, weights, nullptr);
  VectorX x(system.size()), whole = -r;
  linear.solve(r, x);
  constexpr double rounding = 1e-12;  // about a hundred terms, with entries that grow by several tens
  CHECK(backward_error(system, linear, x, r) < rounding);
  SparseLU factors(system.pattern());
  VectorX scale = VectorX::Ones(system.size());
  scale.tail(system.multipliers()).setConstant(linear.scale());
  REQUIRE(factors.factor(linear.values(), scale) == FactorStatus::good);
  factors.solve(whole);
  CHECK(backward_error(system, linear, whole, r) < rounding);
  CHECK(linear.determinant_sign() == factors.determinant_sign());
  CHECK_FALSE(linear.nearly_singular());
}

TEST_CASE("amplitudes that others use are not condensed") {
  const SuperelementArms arms;
  MechanismFile file = arms.file();
  REQUIRE(condensed_blocks(file.model) == 2);
  const Component& upper = element(file.model, "upper");
  const auto add = [&](const char* name, const Component& other, bool passive) -> Component& {
    return file.model.add(std::make_unique<SilentReader>(name, other, passive), Entry{Section::elements, name},
                          Recorded::no);
  };
  const Component& measure = add("measure", upper, true);  // takes no part in the equations
  CHECK(condensed_blocks(file.model) == 2);
  add("force", measure, false);  // but a force that depends on it does
  CHECK(condensed_blocks(file.model) == 1);
  const System system(file.model);
  const Slots& lower = system.slots_of(element(file.model, "lower"));
  CHECK(system.condensed_pattern().blocks()[0].inner.front() ==
        system.dofs() - system.start(0).amplitude.size() + lower.amplitude_begin);
}

TEST_CASE("amplitudes whose own matrix is singular are solved for with the others") {
  // The third amplitude is connected only to the node, by a force: K = [k .. c; .. ; c .. 0].
  Random random(2);
  MatrixX K = random.positive_matrix(amplitudes + 1);
  K.row(3).setZero();
  K.col(3).setZero();
  K(0, 3) = K(3, 0) = 1;
  const Slider slider(K, random.positive_matrix(amplitudes + 1));
  const System system(slider.file.model);
  REQUIRE(system.condensed_pattern().blocks().size() == 1);
  NewtonMatrix linear(system);
  linear.factor(system.start(0), Environment{}, TangentWeights{1, 0, 0, 0, 1}, nullptr);
  const VectorX r = random.vector(system.size());
  VectorX x(system.size());
  linear.solve(r, x);
  CHECK(backward_error(system, linear, x, r) < 1e-13);
  CHECK_FALSE(linear.nearly_singular());
}

TEST_CASE("an amplitude that nothing determines is named although it would be condensed") {
  Random random(3);
  MatrixX K = random.positive_matrix(amplitudes + 1);
  K.row(5).setZero();
  K.col(5).setZero();
  const Slider slider(K, MatrixX::Zero(amplitudes + 1, amplitudes + 1));
  const System system(slider.file.model);
  REQUIRE(system.condensed_pattern().blocks().size() == 1);
  NewtonMatrix linear(system);
  CHECK_THAT(message_of<ComputationError>([&] {
               linear.factor(system.start(0), Environment{}, TangentWeights{1, 0, 0, 0, 1}, nullptr);
             }),
             Contains("singular at q5 of element 'block'"));
}
