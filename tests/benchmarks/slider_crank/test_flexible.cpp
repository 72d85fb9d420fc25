// A slider-crank with a flexible rod: data of the IVP test set's problem "crank" (B. Simeon, Modelling a flexible
// slider crank mechanism by a mixed system of DAEs and PDEs, Math. Model. Sys. 2 (1996) 1): crank 0.15 m driven at 150
// rad/s, rod 0.30 m of 8 x 8 mm, E = 2e11, nu = 0.3, density 7870, slider 0.075552 kg, no gravity. Here the rod starts
// straight and undeformed with the velocities of a rigid rod. Reference: geometrically exact rod (GA = 5/6 G A) by
// nodal spectral elements and Runge-Kutta, converged to some 1e-8 m in the deflection of the midpoint: extremes
// +1.87059e-3 (t = 0.04778) and -1.87011e-3 m, slider at t = 0.1: 0.16974254 m.
#include <map>

#include <catch2/catch.hpp>

#include "mechanism/io/energy_balance.hpp"
#include "reduce/superelement/superelement.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

/// The mechanism in the plane, in line at the start; the rod spans the nodes `a` and `b`.
std::string slider_crank(const std::string& rod) {
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

std::string beam_rod(int elements) {
  return "  rod: {type: beam, nodes: [a, b], elements: " + std::to_string(elements) +
         ", section: {rectangle: [0.008, 0.008], young: 2e11, poisson: 0.3, density: 7870, "
         "shear_factors: [0.8333333333333333, 0.8333333333333333]}}\n";
}

/// Deflection of a point beside the line between a and b, positive to the left of the way from a to b.
double deflection(const Vector3& point, const Vector3& a, const Vector3& b) {
  const Vector3 along = (b - a).normalized();
  return Vector3(-along.y(), along.x(), 0).dot(point - a);
}

}  // namespace

TEST_CASE("a flexible rod of eight beams deflects as the geometrically exact reference") {
  const ReadyModel model(slider_crank(beam_rod(8)));
  double lowest = 0, highest = 0;
  EnergyBalance books;
  const State end = integrate(model, Scheme::generalized_alpha(0.9), 2e-5, 0.1, [&](const State& state) {
    const double w = deflection(model.node(state, "rod.4").x, model.node(state, "a").x, model.node(state, "b").x);
    lowest = std::min(lowest, w);
    highest = std::max(highest, w);
    const Energy energy = model.system.energy(state, model.environment());
    if (state.time == 0)
      books.start(0, energy);
    else
      books.advance(state.time, energy);
  });
  // Eight elements of fourth order in frequency are within 1e-3 of the rod; the step resolves its first mode 70 times.
  CHECK(highest == Approx(1.87059e-3).epsilon(5e-3));
  CHECK(lowest == Approx(-1.87011e-3).epsilon(5e-3));
  // The start sets off an undamped axial vibration of the slider on the rod (19e3 rad/s, amplitude m a l/EA = 1e-5 m)
  // whose phase after 300 periods is not resolved.
  CHECK(model.node(end, "b").x.x() == Approx(0.16974254).margin(2e-5));
  // Work of the drive against kinetic and elastic energy: the scheme dissipates in the axial modes only.
  CHECK(std::abs(books.balance()) < 2e-3 * books.largest());
}

namespace {

/// The rod reduced to its ends and fixed-boundary modes. @param prestress  with geometric stiffness
bielle::test::BeamSuperelement reduced_rod(bool prestress, double stiffening = 1) {
  bielle::test::BeamChain chain;
  const int elements = 20;
  for (int k = 0; k <= elements; ++k) chain.nodes.push_back({0.3 * k / elements, 0, 0});
  const double E = stiffening * 2e11, G = E / 2.6, A = 64e-6, I = A * A / 12, density = 7870;
  chain.properties = {density * A, E * A, E * I, E * I, G * 0.1405770 * A * A, density * 2 * I};
  chain.interfaces = {{0}, {elements}};
  chain.modes = 8;
  chain.prestress = prestress;
  bielle::test::BeamSuperelement rod = chain.reduced();
  rod.body.interfaces[0].name = "big_end";
  rod.body.interfaces[1].name = "small_end";
  return rod;
}

struct Extremes {
  double lowest = 0, highest = 0, largest_balance = 0, largest_energy = 0, slider_error = 0;
};

/// Runs the slider-crank with the superelement: deflection of the middle beside the line of the ends.
Extremes run_with_superelement(const bielle::test::BeamSuperelement& rod, double h) {
  const bielle::test::TemporaryFolder folder;
  const std::string file = folder / "rod.h5";
  bielle::write_superelement(rod.body, file);
  const ReadyModel model(slider_crank("  rod: {type: superelement, file: \"" + file +
                                      "\", position: [0.15, 0, 0], nodes: {big_end: a, small_end: b}}\n"));
  std::size_t member = 0;
  while (model.file.model.members()[member].component->name() != "rod") ++member;
  const Component& body = *model.file.model.members()[member].component;
  std::size_t size = 0, coordinates = 0;
  for (const OutputField& field : body.output_fields()) {
    if (field.name == "coordinates") coordinates = size;
    size += field.size();
  }
  std::vector<double> record(size);
  // The mass points on both sides of the middle, 1 mm away: their mean is the middle's to 1e-4.
  Eigen::Index left = 0, right = 0;
  for (Eigen::Index p = 0; p < rod.points.cols(); ++p) {
    if (rod.points(0, p) < 0.15 && rod.points(0, p) > rod.points(0, left)) left = p;
    if (rod.points(0, p) > 0.15 && (right == 0 || rod.points(0, p) < rod.points(0, right))) right = p;
  }
  REQUIRE(std::abs(rod.points(0, left) + rod.points(0, right) - 0.3) < 1e-9);
  const Eigen::RowVectorXd middle = 0.5 * (rod.field.row(3 * left + 1) + rod.field.row(3 * right + 1));
  Extremes result;
  EnergyBalance books;
  integrate(model, Scheme::generalized_alpha(0.9), h, 0.1, [&](const State& state) {
    body.write_output(LocalState(state, model.system.slots()[member], model.environment()), record.data());
    const Eigen::Map<const VectorX> q(record.data() + coordinates, middle.size());
    const double w = middle.dot(q) - 0.5 * (q[1] + q[7]);
    result.lowest = std::min(result.lowest, w);
    result.highest = std::max(result.highest, w);
    const double angle = 150 * state.time, r = 0.15, l = 0.3;
    const double x = r * std::cos(angle) + std::sqrt(l * l - r * r * std::sin(angle) * std::sin(angle));
    result.slider_error = std::max(result.slider_error, std::abs(model.node(state, "slider").x.x() - x));
    const Energy energy = model.system.energy(state, model.environment());
    if (state.time == 0)
      books.start(0, energy);
    else
      books.advance(state.time, energy);
    result.largest_balance = std::max(result.largest_balance, std::abs(books.balance()));
  });
  result.largest_energy = books.largest();
  return result;
}

}  // namespace

TEST_CASE("the rod as a superelement deflects as the rod of beams, thanks to its geometric stiffness") {
  const Extremes with = run_with_superelement(reduced_rod(true), 2e-5);
  CHECK(with.highest == Approx(1.87059e-3).epsilon(5e-3));
  CHECK(with.lowest == Approx(-1.87011e-3).epsilon(5e-3));
  CHECK(with.largest_balance < 2e-3 * with.largest_energy);
  // The test discriminates: without it the deflection is off by 6 percent.
  const Extremes without = run_with_superelement(reduced_rod(false), 2e-5);
  CHECK(std::abs(without.highest - 1.87059e-3) > 10 * std::abs(with.highest - 1.87059e-3));
}

TEST_CASE("a slider-crank with a stiff superelement is the rigid one in closed form") {
  // A thousand times stiffer: the rod's elongation under its 380 N is 1e-8 m, bending still less.
  const Extremes stiff = run_with_superelement(reduced_rod(true, 1e3), 5e-5);
  CHECK(stiff.slider_error < 5e-8);
  CHECK(stiff.highest - stiff.lowest < 1e-5);
}

TEST_CASE("recorded fields are the recovery of the recorded coordinates") {
  bielle::test::BeamSuperelement rod = reduced_rod(false);
  // Any rows will do: displacements of two nodes, stresses of one.
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
  // Of the deviator: sqrt(3/2 dev:dev), the definition rather than the formula.
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
