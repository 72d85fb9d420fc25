// The slider-crank with a flexible rod that starts straight and undeformed with the velocities of a rigid one.
// Reference: geometrically exact rod (GA = 5/6 G A) by a spectral element (tests/references/flexible_crank.py):
// extremes of the deflection of its midpoint, and the slider at t = 0.1.
#include <map>

#include "mechanism/session/energy_balance.hpp"
#include "tests/benchmarks/slider_crank/flexible.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using namespace bielle::test::flexible_crank;
using bielle::test::integrate;
using bielle::test::ReadyModel;

TEST_CASE("a flexible rod of eight beams deflects as the geometrically exact reference") {
  const ReadyModel model(slider_crank(beam_rod(8)));
  double lowest = 0, highest = 0;
  EnergyBalance energy_balance;
  const State end = integrate(model, Scheme::generalized_alpha(0.9), 2e-5, 0.1, [&](const State& state) {
    const double w = deflection(model.node(state, "rod.4").x, model.node(state, "a").x, model.node(state, "b").x);
    lowest = std::min(lowest, w);
    highest = std::max(highest, w);
    const Energy energy = model.system.energy(state, model.environment());
    if (state.time == 0)
      energy_balance.start(0, energy);
    else
      energy_balance.advance(state.time, energy);
  });
  // Eight elements of fourth order in frequency are within 1e-3 of the rod; the step resolves its first mode 70 times.
  const bielle::test::ReferenceTable exact("flexible_crank");
  CHECK(highest == Approx(exact("rigid_start.highest")).epsilon(5e-3));
  CHECK(lowest == Approx(exact("rigid_start.lowest")).epsilon(5e-3));
  // The start excites an undamped axial vibration of the slider on the rod (19e3 rad/s, amplitude m a l/EA = 1e-5 m),
  // whose phase after 300 periods is not resolved.
  CHECK(model.node(end, "b").x.x() == Approx(exact("rigid_start.slider")).margin(2e-5));
  // The work of the drive is compared with kinetic and elastic energy: the scheme dissipates in the axial modes only.
  CHECK(std::abs(energy_balance.balance()) < 2e-3 * energy_balance.largest());
}

namespace {

struct Extremes {
  double lowest = 0, highest = 0, largest_balance = 0, largest_energy = 0, slider_error = 0;
};

/// Runs the slider-crank with the superelement.
Extremes run_with_superelement(const bielle::test::BeamSuperelement& rod, double h) {
  WithSuperelement crank(rod);
  const ReadyModel& model = crank.model;
  Extremes result;
  EnergyBalance energy_balance;
  integrate(model, Scheme::generalized_alpha(0.9), h, 0.1, [&](const State& state) {
    const double w = crank.deflection(state);
    result.lowest = std::min(result.lowest, w);
    result.highest = std::max(result.highest, w);
    const double angle = 150 * state.time, r = 0.15, l = 0.3;
    const double x = r * std::cos(angle) + std::sqrt(l * l - r * r * std::sin(angle) * std::sin(angle));
    result.slider_error = std::max(result.slider_error, std::abs(model.node(state, "slider").x.x() - x));
    const Energy energy = model.system.energy(state, model.environment());
    if (state.time == 0)
      energy_balance.start(0, energy);
    else
      energy_balance.advance(state.time, energy);
    result.largest_balance = std::max(result.largest_balance, std::abs(energy_balance.balance()));
  });
  result.largest_energy = energy_balance.largest();
  return result;
}

}  // namespace

TEST_CASE("the rod as a superelement deflects as the rod of beams, thanks to its geometric stiffness") {
  const Extremes with = run_with_superelement(reduced_rod(true), 2e-5);
  const bielle::test::ReferenceTable exact("flexible_crank");
  const double highest = exact("rigid_start.highest");
  CHECK(with.highest == Approx(highest).epsilon(5e-3));
  CHECK(with.lowest == Approx(exact("rigid_start.lowest")).epsilon(5e-3));
  CHECK(with.largest_balance < 2e-3 * with.largest_energy);
  // The test is sensitive: without geometric stiffness the deflection differs by 6 percent.
  const Extremes without = run_with_superelement(reduced_rod(false), 2e-5);
  CHECK(std::abs(without.highest - highest) > 10 * std::abs(with.highest - highest));
}

TEST_CASE("a slider-crank with a stiff superelement is the rigid one in closed form") {
  // The rod is a thousand times stiffer: its elongation under 380 N is 1e-8 m, and its bending is smaller.
  const Extremes stiff = run_with_superelement(reduced_rod(true, 1e3), 5e-5);
  CHECK(stiff.slider_error < 5e-8);
  CHECK(stiff.highest - stiff.lowest < 1e-5);
}

TEST_CASE("recorded fields are the recovery of the recorded coordinates") {
  bielle::test::BeamSuperelement rod = reduced_rod(false);
  // The rows are arbitrary: displacements of two nodes, stresses of one.
  std::srand(3);
  rod.body.mesh.points = Eigen::Matrix3Xd::Random(3, 2);
  rod.body.displacement_recovery = MatrixX::Random(6, rod.body.size());
  rod.body.stress_recovery = MatrixX::Random(6, rod.body.size());
  rod.body.stress_nodes = {1};
  const bielle::test::TemporaryFolder folder;
  const std::string file = folder / "rod.h5";
  bielle::write_superelement(rod.body, file);
  const std::string text = slider_crank("  rod: {type: superelement, file: \"" + file +
                                        "\", position: [0.15, 0, 0], nodes: {big_end: a, small_end: b}}\n");
  const ReadyModel model(text + "output: {fields: {rod: [von_mises, displacement]}}\n");
  const State end = integrate(model, Scheme::generalized_alpha(0.9), 5e-5, 0.005);
  std::size_t member = 0;
  while (model.file.model.members()[member].component->name() != "rod") ++member;
  const Component& body = *model.file.model.members()[member].component;
  std::map<std::string, std::size_t> begin;
  std::size_t size = 0;
  for (const OutputField& field : body.output_fields()) {
    begin[field.name] = size;
    size += field.size();
  }
  std::vector<double> record(size);
  body.write_output(LocalState(end, model.system.slots()[member], model.environment()), record.data());
  const Eigen::Map<const VectorX> q(&record[begin.at("coordinates")], rod.body.size());
  REQUIRE(q.norm() > 0);
  const VectorX u = rod.body.displacement_recovery * q, s = rod.body.stress_recovery * q;
  CHECK((Eigen::Map<const VectorX>(&record[begin.at("displacement")], 6) - u).norm() < 1e-15 * u.norm());
  // The von Mises stress is that of the deviator, sqrt(3/2 dev:dev), which is its definition.
  Eigen::Matrix3d stress;
  stress << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
  const Eigen::Matrix3d deviator = stress - stress.trace() / 3 * Eigen::Matrix3d::Identity();
  CHECK(record[begin.at("von_mises")] == Approx(std::sqrt(1.5) * deviator.norm()).epsilon(1e-12));

  using Catch::Contains;
  CHECK_THROWS_WITH(ReadyModel(text + "output: {fields: {rod: [displacment]}}\n"),
                    Contains("did you mean 'displacement'"));
  CHECK_THROWS_WITH(ReadyModel(text + "output: {fields: {rodd: [displacement]}}\n"), Contains("did you mean 'rod'"));
  CHECK_THROWS_WITH(ReadyModel(text + "output: {fields: {crank: [displacement]}}\n"),
                    Contains("has no further fields"));
}
