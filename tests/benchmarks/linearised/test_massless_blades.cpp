// Parts of a rotor without inertia in some rotations.
#include "tests/benchmarks/linearised/turning_models.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_massless_blades {
namespace {

constexpr double rate = 7, hinge = 0.2, arm = 0.5, mass = 3;

/// Blades with flap hinges on a hub that moves on springs in the plane of rotation.
std::string flapping(int count, const std::string& blade, const std::string& springs = "[1e4, 2e4, 0, 0, 0, 0]") {
  std::string nodes, bodies, hinges;
  for (int b = 0; b < count; ++b) {
    const double at = two_pi * b / count, c = std::cos(at), s = std::sin(at);
    nodes += fmt::format("  b{}: {{position: [{:.17g}, {:.17g}, 0], rotation_vector: [0, 0, {:.17g}]}}\n", b,
                         (hinge + arm) * c, (hinge + arm) * s, at);
    bodies += fmt::format("  b{0}: {{node: b{0}, mass: {1}, {2}}}\n", b, mass, blade);
    hinges += fmt::format(
        "  f{0}: {{type: hinge, nodes: [rotor, b{0}], position: [{1:.17g}, {2:.17g}, 0], axis: [{3:.17g}, {4:.17g}, "
        "0]}}\n",
        b, hinge * c, hinge * s, s, -c);
  }
  return "nodes:\n  hub: {fixed: [z, rx, ry, rz]}\n  rotor: {}\n" + nodes +
         "elements:\n  hub: {type: rigid_body, node: hub, mass: 10, inertia: [1, 1, 1]}\n"
         "  rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [1, 1, 1]}\n" +
         bodies + "joints:\n  mount: {type: bushing, nodes: [ground, hub], stiffness: " + springs +
         "}\n  shaft: {type: hinge, nodes: [hub, rotor], position: [0, 0, 0], axis: [0, 0, 1]}\n" + hinges +
         "drives: {motor: {joint: shaft, rate: 7}}\n";
}

/// Returns two masses on bushings that resist rotations, on a free rotor.
std::string on_bushings(const std::string& body, double turning) {
  std::string text =
      "nodes: {hub: {}, rotor: {}, p: {position: [0.5, 0, 0]}, q: {position: [-0.5, 0, 0]}}\n"
      "elements:\n  hub: {type: rigid_body, node: hub, mass: 100, inertia: [50, 50, 50]}\n"
      "  rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [1, 1, 1]}\n";
  for (const char* node : {"p", "q"}) text += fmt::format("  {0}: {{node: {0}, mass: 1, {1}}}\n", node, body);
  text +=
      "joints:\n  mount: {type: bushing, nodes: [ground, hub], stiffness: [1e5, 1.1e5, 1e5, 1e5, 1e5, 1e5]}\n"
      "  shaft: {type: hinge, nodes: [hub, rotor], position: [0, 0, 0], axis: [0, 0, 1]}\n";
  for (const char* node : {"p", "q"})
    text += fmt::format("  {0}h: {{type: bushing, nodes: [rotor, {0}], stiffness: [1e5, 1e5, 1e5, {1}, {1}, {1}]}}\n",
                        node, turning);
  return text;
}

ModesReport found(const std::string& text, int count = 20) {
  const ModesOf model(text);
  ModesOptions options;
  options.search.count = count;
  SteadyRotation rotation;
  rotation.joint = model.file.model.members_of({Section::joints, "shaft"}).front();
  rotation.rate = rate;
  options.rotation = rotation;
  return compute_modes(model.session, options);
}

}  // namespace

TEST_CASE("blades without inertia about their length flap at Om (1 + m e r/I)^1/2", "[linearised]") {
  struct Case {
    std::string blade;
    double own;
  };
  const Case cases[] = {{"type: rigid_body, inertia: [0, 0.25, 0.25]", 0.25}, {"type: point_mass", 0}};
  for (const Case& each : cases)
    for (const int count : {2, 3}) {
      const ModesReport report = found(flapping(count, each.blade));
      const double expected =
          rate * std::sqrt(1 + mass * hinge * arm / (each.own + mass * arm * arm));  // W. Johnson (1980), 2-3
      CAPTURE(each.blade, count);
      CHECK(report.found.all);
      CHECK(count_rigid(report) == 1);
      std::vector<double> rates = rates_of(report);
      REQUIRE(rates.size() == static_cast<std::size_t>(count + 2));
      for (int k = 0; k < count; ++k) CHECK(rates[static_cast<std::size_t>(k)] == Approx(expected).epsilon(1e-9));
    }
}

TEST_CASE("no inertia is the limit of a small one in a part that turns", "[linearised]") {
  for (const char* springs : {"[1e4, 2e4, 0, 0, 0, 0]", "[1e4, 1e4, 0, 0, 0, 0]"})
    for (const int count : {2, 3}) {
      const ModesReport none = found(flapping(count, "type: rigid_body, inertia: [0, 0.25, 0.25]", springs)),
                        little = found(flapping(count, "type: rigid_body, inertia: [1e-12, 0.25, 0.25]", springs));
      CAPTURE(springs, count);
      CHECK(none.turning->periodicity == little.turning->periodicity);
      check_rates(rates_of(none), rates_of(little), 1e-9);
    }
}

TEST_CASE("masses that elastic joints keep from rotating have all their modes in a part that turns", "[linearised]") {
  for (const double turning : {0.1, 10.0, 1e4}) {
    const ModesReport none = found(on_bushings("type: point_mass", turning), 12),
                      little = found(on_bushings("type: rigid_body, inertia: [1e-9, 1e-9, 1e-9]", turning), 12);
    CAPTURE(turning);
    CHECK(count_rigid(none) == 1);
    std::vector<double> expected = rates_of(little);  // including those of the small inertia, which are the fastest
    REQUIRE(expected.size() >= rates_of(none).size());
    expected.resize(rates_of(none).size());
    CHECK(expected.size() >= 10);
    check_rates(rates_of(none), expected, 1e-5);
  }
}

}  // namespace test_massless_blades
