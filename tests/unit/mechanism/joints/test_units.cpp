// Units in entries of joints, drives and contacts: values with units are those in SI, and other dimensions are refused.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/joints/joint.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/system/system.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using bielle::test::message_of;
using bielle::test::TemporaryFolder;
using Catch::Contains;

namespace {

/// Returns a model of three nodes with the entry `it` of some section.
MechanismFile with_entry(const std::string& section, const std::string& entry) {
  const TemporaryFolder folder;
  folder.file("round.csv", "0,1\n1,1.05\n2.1,1\n3.1,0.95\n4.2,1\n5.2,1.02\n");
  folder.file("points.csv", "0,0,0\n0.4,0.3,0\n0.6,0.8,0\n0.5,1.4,0.2\n");
  const std::string text = R"yaml(
nodes:
  a: {position: [0, 0, 0]}
  b: {position: [0.6, 0.8, 0]}
  c: {position: [1.6, -0.3, 0.2]}
elements:
  bar: {type: beam, nodes: [a, c], elements: 2, section: {circle: 0.1, young: 1e9, poisson: 0.3, density: 1000}}
joints:
  axle: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}
  guide: {type: cylindrical, nodes: [ground, b], axis: [0, 1, 0]}
)yaml";
  return read_mechanism_file(
      folder.file("model.yaml", text + (section == "joints" ? "" : section + ":\n") + "  it: {" + entry + "}\n"));
}

/// Returns the descriptions of all components of `it`, with the frames and starts of a joint.
std::string description_of(const std::string& section, const std::string& entry) {
  const MechanismFile file = with_entry(section, entry);
  const System system(file.model);
  const State state = system.start(0);
  Description description(file.model);
  std::string text;
  for (std::size_t m = 0; m < file.model.members().size(); ++m) {
    const Member& member = file.model.members()[m];
    if (member.entry.name != "it") continue;
    member.component->describe(LocalState(state, system.slots()[m], file.model.environment), description);
    const auto* joint = dynamic_cast<const Joint*>(member.component.get());
    if (!joint) continue;
    for (const Frame& frame : {joint->frames().on_first, joint->frames().on_second})
      text += format_vector(frame.x) + format_vector(frame.R.col(0)) + format_vector(frame.R.col(2));
    for (std::size_t k = 0; k < joint->coordinates().size(); ++k) text += fmt::format(" {:.9g}", joint->starts_at(k));
  }
  for (const std::string& line : description.lines()) text += "\n" + line;
  return text;
}

struct Pair {
  const char *section, *with_units, *plain;
};

struct Refusal {
  const char *section, *entry, *expected, *found;
};

std::string refusal_of(const Refusal& each) {
  return message_of<bielle::InputError>([&] { with_entry(each.section, each.entry); });
}

}  // namespace

TEST_CASE("values with units in entries of joints are those in SI") {
  const Pair pairs[] = {
      {"joints",
       "type: hinge, nodes: [a, b], position: ['50 cm', '200 mm', 0.1], axis: [1, 2, 3], stiffness: '5 kN m/rad', "
       "damping: '20 N mm s/rad', rest: '30 deg', preload: '2 kN m', stops: {range: ['-180 deg', '2 turn'], stiffness: "
       "'3 kN m/rad', damping: '2 N m s/rad'}, locked: {from: '100 ms', to: '1 min', release: '4 kN m'}",
       "type: hinge, nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3], stiffness: 5000, damping: 0.02, rest: "
       "pi/6, preload: 2000, stops: {range: [-pi, 4*pi], stiffness: 3000, damping: 2}, locked: {from: 0.1, to: 60, "
       "release: 4000}"},
      {"joints",
       "type: prismatic, nodes: [a, b], axis: [1, 0, 0], stiffness: '3 N/mm', stops: {range: [~, '12 mm'], "
       "stiffness: '1 N/mm'}, start: '5 mm', friction: {coefficient: 0.1, preload: '2 kN', arm: '10 cm', "
       "velocity: '2 mm/s'}",
       "type: prismatic, nodes: [a, b], axis: [1, 0, 0], stiffness: 3000, stops: {range: [~, 0.012], stiffness: 1000}, "
       "start: 0.005, friction: {coefficient: 0.1, preload: 2000, arm: 0.1, velocity: 0.002}"},
      {"joints",
       "type: cylindrical, nodes: [a, b], axis: [1, 0, 0], stiffness: {displacement: '3 N/mm', angle: '2 kN "
       "m/rad'}, start: {displacement: '5 mm', angle: '90 deg'}",
       "type: cylindrical, nodes: [a, b], axis: [1, 0, 0], stiffness: {displacement: 3000, angle: 2000}, start: "
       "{displacement: 0.005, angle: pi/2}"},
      {"joints", "type: spherical, nodes: [a, b], at: [['1 mm', 0, 0], [0, '2 cm', 0]], start: {rx: '10 deg'}",
       "type: spherical, nodes: [a, b], at: [[0.001, 0, 0], [0, 0.02, 0]], start: {rx: pi/18}"},
      {"joints", "type: screw, nodes: [a, b], axis: [1, 0, 0], pitch: '5 mm'",
       "type: screw, nodes: [a, b], axis: [1, 0, 0], pitch: 0.005"},
      {"joints", "type: universal, nodes: [a, b], axis: [1, 0, 0], second_axis: [0, 1, 0], position: ['1 cm', 0, 0]",
       "type: universal, nodes: [a, b], axis: [1, 0, 0], second_axis: [0, 1, 0], position: [0.01, 0, 0]"},
      {"joints", "type: constant_velocity, nodes: [a, b], axis: [1, 0, 0], position: ['1 cm', 0, 0]",
       "type: constant_velocity, nodes: [a, b], axis: [1, 0, 0], position: [0.01, 0, 0]"},
      {"joints", "type: distance, nodes: [a, b], at: [['1 cm', 0, 0], [0, 0, 0]], length: '80 cm'",
       "type: distance, nodes: [a, b], at: [[0.01, 0, 0], [0, 0, 0]], length: 0.8"},
      {"joints", "type: spherical_spherical, nodes: [a, b], length: '80 cm'",
       "type: spherical_spherical, nodes: [a, b], length: 0.8"},
      {"joints", "type: revolute_spherical, nodes: [a, b], axis: [0, 0, 1], length: '80 cm'",
       "type: revolute_spherical, nodes: [a, b], axis: [0, 0, 1], length: 0.8"},
      {"joints", "type: point_on_line, nodes: [a, b], line: [1, 0, 0], position: ['1 cm', 0, 0], damping: '2 N s/mm'",
       "type: point_on_line, nodes: [a, b], line: [1, 0, 0], position: [0.01, 0, 0], damping: 2000"},
      {"joints", "type: point_on_plane, nodes: [a, b], normal: [1, 0, 0], start: {x: '5 mm'}",
       "type: point_on_plane, nodes: [a, b], normal: [1, 0, 0], start: {x: 0.005}"},
      {"joints", "type: point_on_curve, nodes: [a, b], curve: points.csv, position: ['60 cm', 0.8, 0]",
       "type: point_on_curve, nodes: [a, b], curve: points.csv, position: [0.6, 0.8, 0]"},
      {"joints", "type: slider, node: b, beam: bar, at: ['20 cm', 0, 0], stiffness: '1 N/mm'",
       "type: slider, node: b, beam: bar, at: [0.2, 0, 0], stiffness: 1000"},
      {"joints",
       "type: wheel, nodes: [ground, b], normal: [0, 0, 1], axis: [1, 0, 0], radius: '300 mm', slip: "
       "{longitudinal: '30 kN', lateral: '20 kN', speed: '10 cm/s'}",
       "type: wheel, nodes: [ground, b], normal: [0, 0, 1], axis: [1, 0, 0], radius: 0.3, slip: {longitudinal: 30000, "
       "lateral: 20000, speed: 0.1}"},
      {"joints",
       "type: bushing, nodes: [a, b], stiffness: ['1 kN/mm', 2, 3, '1 kN m/rad', 5, 6], preload: ['1 kN', 0, 0, 0, '2 "
       "kN m', 0], damping: '1 ms', start: {rx: '10 deg', x: '1 mm'}",
       "type: bushing, nodes: [a, b], stiffness: [1e6, 2, 3, 1000, 5, 6], preload: [1000, 0, 0, 0, 2000, 0], damping: "
       "0.001, start: {rx: pi/18, x: 0.001}"},
      {"joints",
       "type: bearing, nodes: [a, b], axis: [1, 0, 0], radial: {stiffness: ['1 kN/mm', 2], damping: '2 N s/mm'}, "
       "axial: '3 N/mm', tilting: '1 kN m/rad'",
       "type: bearing, nodes: [a, b], axis: [1, 0, 0], radial: {stiffness: [1e6, 2], damping: 2000}, axial: 3000, "
       "tilting: 1000"},
      {"joints",
       "type: clearance_hinge, nodes: [a, b], axis: [1, 0, 0], radial_gap: '50 um', axial_gap: '0.2 mm', length: '3 "
       "cm', radius: '1 cm', contact: {young: '210 GPa', poisson: 0.3}, axial_contact: {stiffness: 2e10}, friction: "
       "{coefficient: 0.1, velocity: '1 cm/s'}",
       "type: clearance_hinge, nodes: [a, b], axis: [1, 0, 0], radial_gap: 5e-5, axial_gap: 2e-4, length: 0.03, "
       "radius: 0.01, contact: {young: 210e9, poisson: 0.3}, axial_contact: {stiffness: 2e10}, friction: {coefficient: "
       "0.1, velocity: 0.01}"},
      {"joints",
       "type: clearance_spherical, nodes: [a, b], radial_gap: '50 um', radius: '1 cm', contact: {young: ['210 "
       "GPa', '70 GPa'], poisson: 0.3}",
       "type: clearance_spherical, nodes: [a, b], radial_gap: 5e-5, radius: 0.01, contact: {young: [210e9, 70e9], "
       "poisson: 0.3}"},
      {"joints",
       "type: gear_mesh, nodes: [a, b], axes: [0, 0, 1], radii: ['40 cm', '600 mm'], pressure_angle: '25 deg', "
       "helix_angle: '10 deg', stiffness: '1 kN/mm', damping: '2 N s/mm', backlash: '20 um'",
       "type: gear_mesh, nodes: [a, b], axes: [0, 0, 1], radii: [0.4, 0.6], pressure_angle: 25*pi/180, helix_angle: "
       "pi/18, stiffness: 1e6, damping: 2000, backlash: 2e-5"},
      {"joints", "type: rack_and_pinion, joints: [axle, guide.displacement], radius: '40 mm'",
       "type: rack_and_pinion, joints: [axle, guide.displacement], radius: 0.04"},
      {"joints", "type: gear, joints: [axle, guide.displacement], factors: ['40 mm/rad', -1]",
       "type: gear, joints: [axle, guide.displacement], factors: [0.04, -1]"},
      {"joints",
       "type: cam, joints: [axle, guide.displacement], profile: round.csv, follower: roller, radius: '2 cm', "
       "at: ['1 cm', 0, 0], friction: {coefficient: 0.1, radius: '5 mm'}",
       "type: cam, joints: [axle, guide.displacement], profile: round.csv, follower: roller, radius: 0.02, at: [0.01, "
       "0, 0], friction: {coefficient: 0.1, radius: 0.005}"},
      {"joints",
       "type: belt, nodes: [a, b], radii: ['10 cm', '20 cm'], axis: [0, 0, 1], EA: '6 kN', pretension: '0.1 kN', "
       "damping: '1 ms'",
       "type: belt, nodes: [a, b], radii: [0.1, 0.2], axis: [0, 0, 1], EA: 6000, pretension: 100, damping: 0.001"},
      {"joints",
       "type: cable, nodes: [a, b, c], radii: [0, '-10 cm', 0], axis: [0, 0, 1], at: [['1 cm', 0, 0], ~, ~], "
       "EA: '6 kN'",
       "type: cable, nodes: [a, b, c], radii: [0, -0.1, 0], axis: [0, 0, 1], at: [[0.01, 0, 0], ~, ~], EA: 6000"},
      {"joints",
       "type: contact, shapes: [{node: ground, plane: [0, 0, 1], at: [0, 0, '-80 cm']}, {node: b, box: ['20 cm', 0.3, "
       "0.3], rounding: '1 cm', rotation_vector: ['10 deg', 0, 0]}], stiffness: 1e7, friction: {coefficient: 0.3, "
       "model: lugre, bristle_stiffness: '40 1/mm'}",
       "type: contact, shapes: [{node: ground, plane: [0, 0, 1], at: [0, 0, -0.8]}, {node: b, box: [0.2, 0.3, 0.3], "
       "rounding: 0.01, rotation_vector: [pi/18, 0, 0]}], stiffness: 1e7, friction: {coefficient: 0.3, model: lugre, "
       "bristle_stiffness: 40000}"},
      {"drives", "joint: axle, torque: '3*t', limit: '2 kN m', release: '100 ms'",
       "joint: axle, torque: '3*t', limit: 2000, release: 0.1"},
      {"drives", "joint: guide, force: '3*t', limit: ['-2 kN', ~], release: {when: axle.angle, crosses: '90 deg'}",
       "joint: guide, force: '3*t', limit: [-2000, ~], release: {when: axle.angle, crosses: pi/2}"},
      {"drives", "joint: axle, pid: {target: 0, kp: '2 kN m/rad', ki: 30, limit: '2 kN m', tracking_time: '50 ms'}",
       "joint: axle, pid: {target: 0, kp: 2000, ki: 30, limit: 2000, tracking_time: 0.05}"},
  };
  for (const Pair& pair : pairs) {
    CAPTURE(pair.with_units);
    CHECK(description_of(pair.section, pair.with_units) == description_of(pair.section, pair.plain));
  }
  const MechanismFile file = with_entry("drives", "joint: axle, angle: '90 deg'");
  const auto& axle = dynamic_cast<const Joint&>(*file.model.components_of({Section::joints, "axle"}).front());
  CHECK(axle.starts_at(0) == Approx(M_PI / 2).epsilon(1e-14));
}

TEST_CASE("values of another dimension in entries of joints are refused with both units") {
  const Refusal refusals[] = {
      {"joints", "type: hinge, nodes: [a, b], axis: [1, 0, 0], stiffness: '5 N/m'", "N m/rad", "N/m"},
      {"joints", "type: hinge, nodes: [a, b], axis: [1, 0, 0], damping: '5 N s/m'", "N m s/rad", "N s/m"},
      {"joints", "type: hinge, nodes: [a, b], axis: [1, 0, 0], start: {angle: '5 mm'}", "rad", "mm"},
      {"joints", "type: hinge, nodes: [a, b], axis: [1, 0, 0], start_rate: '5 Hz'", "rad/s", "Hz"},
      {"joints", "type: hinge, nodes: [a, b], axis: [1, 0, 0], stops: {range: [0, '1 m'], stiffness: 1}", "rad", "m"},
      {"joints", "type: hinge, nodes: [a, b], axis: [1, 0, 0], locked: {release: '1 kN'}", "N m", "kN"},
      {"joints", "type: hinge, nodes: [a, b], axis: [1, 0, 0], position: ['5 deg', 0, 0]", "m", "deg"},
      {"joints", "type: hinge, nodes: [a, b], axis: ['1 m', 0, 0]", "without a unit", "m"},
      {"joints", "type: hinge, nodes: [a, b], axis: [1, 0, 0], friction: {coefficient: 0.1, radius: '5 N'}", "m", "N"},
      {"joints", "type: prismatic, nodes: [a, b], axis: [1, 0, 0], rest: '5 deg', stiffness: 1", "m", "deg"},
      {"joints", "type: cylindrical, nodes: [a, b], axis: [1, 0, 0], start: {angle: '5 mm'}", "rad", "mm"},
      {"joints", "type: planar, nodes: [a, b], axis: [1, 0, 0], stiffness: {x: '5 N m/rad'}", "N/m", "N m/rad"},
      {"joints", "type: spherical, nodes: [a, b], damping: {rx: '5 N s/m'}", "N m s/rad", "N s/m"},
      {"joints", "type: screw, nodes: [a, b], axis: [1, 0, 0], pitch: '5 deg'", "m", "deg"},
      {"joints", "type: universal, nodes: [a, b], axis: [1, 0, 0], second_axis: [0, 1, 0], start: {angle_1: '1 m'}",
       "rad", "m"},
      {"joints", "type: constant_velocity, nodes: [a, b], axis: [1, 0, 0], start: {bend_x: '1 m'}", "rad", "m"},
      {"joints", "type: distance, nodes: [a, b], length: '5 kg'", "m", "kg"},
      {"joints", "type: revolute_spherical, nodes: [a, b], axis: [0, 0, 1], length: '5 kg'", "m", "kg"},
      {"joints", "type: point_on_line, nodes: [a, b], line: [1, 0, 0], start: '5 deg'", "m", "deg"},
      {"joints", "type: point_on_plane, nodes: [a, b], normal: [1, 0, 0], start: {y: '5 deg'}", "m", "deg"},
      {"joints", "type: point_on_curve, nodes: [a, b], curve: points.csv, start: '5 deg'", "m", "deg"},
      {"joints", "type: slider, node: b, beam: bar, start: '20 cm'", "without a unit", "cm"},
      {"joints", "type: wheel, nodes: [ground, b], normal: [0, 0, 1], axis: [1, 0, 0], radius: '3 s'", "m", "s"},
      {"joints", "type: bushing, nodes: [a, b], stiffness: [1, 1, 1, '1 N/m', 1, 1]", "N m/rad", "N/m"},
      {"joints", "type: bearing, nodes: [a, b], axis: [1, 0, 0], radial: '3 N m/rad'", "N/m", "N m/rad"},
      {"joints",
       "type: clearance_hinge, nodes: [a, b], axis: [1, 0, 0], radial_gap: 1e-4, contact: {stiffness: '3 N/m'}",
       "without a unit", "N/m"},
      {"joints", "type: clearance_spherical, nodes: [a, b], radial_gap: '3 Pa', contact: {stiffness: 3}", "m", "Pa"},
      {"joints", "type: gear_mesh, nodes: [a, b], axes: [0, 0, 1], radii: [0.4, 0.6], pressure_angle: '20 mm'", "rad",
       "mm"},
      {"joints", "type: gear, joints: [axle, guide.angle], ratio: '2 m'", "without a unit", "m"},
      {"joints", "type: differential, joints: [axle, guide.angle, axle], ratio: '2 m'", "without a unit", "m"},
      {"joints", "type: rack_and_pinion, joints: [axle, guide.displacement], radius: '2 deg'", "m", "deg"},
      {"joints", "type: cam, joints: [axle, guide.displacement], profile: round.csv, follower: roller, radius: '2 deg'",
       "m", "deg"},
      {"joints", "type: belt, nodes: [a, b], radii: [0.1, 0.2], axis: [0, 0, 1], EA: '6 GPa'", "N", "GPa"},
      {"joints", "type: cable, nodes: [a, b], radii: [0, 0], EA: 6, damping: '1 N'", "s", "N"},
      {"joints", "type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: b, sphere: '2 s'}], stiffness: 1",
       "m", "s"},
      {"drives", "joint: axle, angle: '90 mm'", "rad", "mm"},
      {"drives", "joint: axle, rate: '9 Hz'", "rad/s", "Hz"},
      {"drives", "joint: guide, displacement: '90 deg'", "m", "deg"},
      {"drives", "joint: guide, speed: '9 Hz'", "m/s", "Hz"},
      {"drives", "joint: axle, torque: '9 N'", "N m", "N"},
      {"drives", "joint: guide, force: '9 N m'", "N", "N m"},
      {"drives", "joint: axle, torque: '3*t', limit: '2 N'", "N m", "N"},
      {"drives", "joint: axle, pid: {target: 0, kp: 2, limit: '2 N'}", "N m", "N"},
      {"drives", "joint: axle, rate: 1, release: '2 m'", "s", "m"},
  };
  for (const Refusal& each : refusals) {
    CAPTURE(each.entry);
    const std::string said = refusal_of(each);
    CHECK_THAT(said, Contains("model.yaml:"));
    const bool pure = std::string(each.expected) == "without a unit";
    CHECK_THAT(said, Contains((pure ? "" : "expected a value in ") + std::string(each.expected) + ", found"));
    CHECK_THAT(said, Contains("'" + std::string(each.found) + "'"));
  }
}
