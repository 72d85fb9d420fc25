// Nodes that elements make between others start with velocities that follow from those nodes, whether these are given,
// carried or driven.
//
// Expected values are kinetic energies of rigid rotation, T = 1/2 omega^2 (I_hub + integral of m r^2 along the blade).
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mechanism/solvers/start/blade_section.hpp"

using namespace bielle::mechanism;
using bielle::test::blade_section;

namespace {

constexpr double omega = 1.3, r_0 = 0.4, r_1 = 3, m = 5, Jx = 0.02;

/// Returns the kinetic energy at the start of the motion.
double kinetic(const std::string& text) {
  Session session(read_mechanism_text(text, "model.yaml").model);
  DynamicsOptions options;
  options.duration = 1e-5;
  options.stepping.size = 1e-5;
  const Motion motion = session.dynamics(options);
  return motion.energy().kinetic;
}

/// About x: the blade lies along z from r_0 to r_1; its section's inertia about y is Jy = 0.01.
double blade_energy() {
  return 0.5 * omega * omega * (m * (std::pow(r_1, 3) - std::pow(r_0, 3)) / 3 + 0.01 * (r_1 - r_0));
}
constexpr double hub_energy() { return 0.5 * 4 * omega * omega; }

/// @param first  entries of elements before the hub @param hub  its entry
std::string model(const std::string& root_and_hub_nodes, const std::string& elements) {
  return fmt::format(R"yaml(
nodes:
  {}
  tip: {{position: [0, 0, {}], velocity: [0, {}, 0], angular_velocity: [{}, 0, 0]}}
elements:
  {}
)yaml",
                     root_and_hub_nodes, r_1, -omega * r_1, omega, elements);
}

const std::string blade =
    fmt::format("blade: {{type: beam, nodes: [root, tip], elements: 16, section: {}}}", blade_section);
const std::string hub = "hub: {type: rigid_body, node: hub, mass: 80, inertia: [4, 3, 3], also: [root]}";
const std::string carried_root =
    fmt::format("hub: {{angular_velocity: [{}, 0, 0]}}\n  root: {{position: [0, 0, {}]}}", omega, r_0);

}  // namespace

TEST_CASE("inner nodes of a beam follow a node that is carried, whatever the order of the file") {
  const double expected = blade_energy() + hub_energy();
  CHECK(kinetic(model(carried_root, hub + "\n  " + blade)) == Approx(expected).epsilon(1e-4));
  CHECK(kinetic(model(carried_root, blade + "\n  " + hub)) == Approx(expected).epsilon(1e-4));
  // The energy equals that without carried nodes, to rounding.
  const std::string own = fmt::format(
      "hub: {{angular_velocity: [{0}, 0, 0]}}\n  root: {{position: [0, 0, {1}], velocity: [0, {2}, 0], "
      "angular_velocity: [{0}, 0, 0]}}",
      omega, r_0, -omega * r_0);
  CHECK(kinetic(model(carried_root, blade + "\n  " + hub)) ==
        Approx(kinetic(model(own, blade + "\n  hub: {type: rigid_body, node: hub, mass: 80, inertia: [4, 3, 3]}")))
            .epsilon(1e-13));
}

TEST_CASE("inner nodes of a beam follow a node that is driven") {
  const std::string driven = fmt::format(
      "root: {{position: [0, 0, {}], motion: {{rx: \"{}*t\", ry: 0, rz: 0, y: \"-{}*sin({}*t)\"}}, fixed: [x, z]}}",
      r_0, omega, r_0, omega);
  CHECK(kinetic(model(driven, blade)) == Approx(blade_energy()).epsilon(1e-4));
}

TEST_CASE("a beam of one element has no inner nodes, and one between nodes at rest rests") {
  const std::string one =
      fmt::format("blade: {{type: beam, nodes: [hub, tip], elements: 1, section: {}}}", blade_section);
  CHECK(kinetic(fmt::format("nodes: {{hub: {{}}, tip: {{position: [1, 0, 0]}}}}\nelements:\n  {}\n", one)) == 0);
  const std::string more =
      fmt::format("blade: {{type: beam, nodes: [hub, tip], elements: 3, section: {}}}", blade_section);
  CHECK(kinetic(fmt::format("nodes: {{hub: {{}}, tip: {{position: [1, 0, 0]}}}}\nelements:\n  {}\n", more)) == 0);
}

TEST_CASE("interfaces that are not named follow a carried interface, and a beam follows them") {
  bielle::test::TemporaryFolder folder;
  bielle::write_superelement(bielle::test::straight_beam().reduced().body, folder / "beam.h5");
  // The body of mass 1 and length 1 along x, then a beam from its end to x = 2, all about z.
  const std::string text = fmt::format(R"yaml(
nodes:
  hub: {{angular_velocity: [0, 0, {0}]}}
  root: {{position: [0.5, 0, 0]}}
elements:
  arm: {{type: superelement, file: {1}, nodes: {{a: root}}, position: [0.5, 0, 0]}}
  hub: {{type: rigid_body, node: hub, mass: 1, inertia: [2, 3, 4], also: [root]}}
)yaml",
                                       omega, folder / "beam.h5");
  const double arm = (std::pow(1.5, 3) - std::pow(0.5, 3)) / 3;
  CHECK(kinetic(text) == Approx(0.5 * omega * omega * (4 + arm)).epsilon(1e-9));
}
