// Samples of elements and loads.
#include <fstream>

#include "mechanism/elements/superelement/point_shapes.hpp"
#include "reduce/superelement/superelement.hpp"
#include "tests/laws/sample.hpp"
#include "tests/support/beam_superelement.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

const std::string two_nodes = R"yaml(
gravity: [1, -2, 3]
nodes:
  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}
)yaml";

Sample rigid_body() {
  return {Section::elements,
          "rigid_body",
          "",
          two_nodes + R"yaml(
elements:
  it: {type: rigid_body, node: a, mass: 2, centre: [0.2, -0.3, 0.5], inertia: [1, 1.5, 2, 0.1, -0.2, 0.3], also: [b]}
)yaml",
          {{"mass", "", ""},
           {"node", "c", "no node 'c'"},
           {"inertia", "[1, 1, 3]", "exceeds the sum"},
           {"inertia", "[-1, 1, 1]", "positive definite"},
           {"inertia", "", ""},
           {"also", "[a]", "own node"}}};
}

Sample turned_body() {
  return {Section::elements,
          "rigid_body",
          "inertia about the node, in axes of its own",
          two_nodes + R"yaml(
elements:
  it:
    type: rigid_body
    node: a
    mass: 2
    centre: [0.2, -0.1, 0.3]
    inertia: [1, 1.5, 2]
    inertia_about: node
    inertia_axes: {bryant: [0.3, -0.2, 0.5]}
)yaml",
          {{"inertia", "[0.1, 0.1, 0.1]", "positive definite"}, {"centre", "[5, 0, 0]", "inertia"}}};
}

Sample solid_body() {
  return {Section::elements,
          "rigid_body",
          "solid",
          two_nodes + R"yaml(
elements:
  it: {type: rigid_body, node: a, solid: {box: [1, 2, 0.5], density: 2}, centre: [0.1, 0, 0]}
)yaml",
          {{"solid.position", "[1, 2, 0]", "positions of their own"}}};
}

Sample drilled_body() {
  return {Section::elements,
          "rigid_body",
          "solids added up and cut out",
          two_nodes + R"yaml(
elements:
  it:
    type: rigid_body
    node: b
    solid:
      - {box: [1, 2, 0.5], density: 2, position: [0.1, 0, 0], bryant: [0.1, 0.2, 0.3]}
      - {cone: [0.5, 0.2, 1], mass: 0.7, position: [0, 0, 0.7]}
      - {cylinder: [0.1, 0.5], density: 2, cut: true}
)yaml",
          {{"node", "c", "no node 'c'"},
           {"solid", "[{sphere: 1, density: 1, cut: true}]", "no mass"},
           {"solid.0.density", "", ""},
           {"solid.1.cone", "[0, 0, 1]", "radii"}}};
}

Sample shaped_body() {
  Sample sample{Section::elements,
                "rigid_body",
                "shapes",
                two_nodes + R"yaml(
elements:
  it:
    type: rigid_body
    node: b
    mass: 2
    inertia: [1, 1.5, 2]
    shape:
      - {box: [1, 2, 0.5], position: [0.1, 0, 0], bryant: [0.1, 0.2, 0.3], colour: steelblue, opacity: 0.5}
      - {tube: [0.2, 0.1, 1], colour: "#a0B0c0"}
      - {cone: [0.5, 0.2, 1], position: [0, 0, 0.7]}
      - {ring: [0.5, 0.2]}
      - {sphere: 0.1}
      - {cylinder: [0.1, 0.5]}
      - {stl: part.stl, scale: 0.001}
)yaml",
                {{"shape.0.colour", "steelblu", "did you mean 'steelblue'"},
                 {"shape.1.colour", "'#a0b0c'", "six digits"},
                 {"shape.1.tube", "[0.1, 0.2, 1]", "inner radius"},
                 {"shape.2.cone", "[0, 0, 1]", "radii"},
                 {"shape.3.ring", "[0.1, 0.2]", "centre line"},
                 {"shape.6.stl", "missing.stl", "missing.stl"},
                 {"shape.6.scale", "1e300", ""},
                 {"shape.5.cylinder", "", "exactly one"}}};
  sample.files = [](const std::string& folder) {
    std::ofstream(folder + "/part.stl") << "solid part\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  };
  return sample;
}

Sample point_mass() {
  return {Section::elements,
          "point_mass",
          "",
          two_nodes + R"yaml(
elements:
  it: {type: point_mass, node: b, mass: 2, centre: [0.3, 0.1, -0.2]}
)yaml",
          {{"node", "c", "no node 'c'"}}};
}

const std::vector<BadValue> bad_beam = {{"nodes", "[a, a]", "two different nodes"},
                                        {"orientation", "[0.8, 0.4, 0.6]", "parallel"},
                                        {"twist", "100", "more `elements`"}};

Sample beam() {
  std::vector<BadValue> bad = bad_beam;
  bad.insert(bad.end(), {});
  return {Section::elements, "beam", "offset section, damped", two_nodes + R"yaml(
elements:
  it:
    type: beam
    nodes: [a, b]
    elements: 2
    orientation: [0, 0, 1]
    twist: 0.3
    damping: 0.2
    bending: residual
    section: {rectangle: [1.1, 0.8], young: 2, poisson: 0.2, density: 1.5, offset: [0.1, -0.2], shear_factors: [0.8, 0.7]}
)yaml",
          bad};
}

Sample curved_beam() {
  return {Section::elements,
          "beam",
          "arc, coupled section",
          two_nodes + R"yaml(
elements:
  it:
    type: beam
    nodes: [a, b]
    elements: 1
    arc_through: [0.7, 0.5, 0.3]
    bending: constant
    section:
      stiffness: [[3, .1, .2, .3, -.2, .1], [.1, 2, .1, -.2, .3, .2], [.2, .1, 2, .1, .1, .4], [.3, -.2, .1, 1, .1, .2], [-.2, .3, .1, .1, 1.5, -.1], [.1, .2, .4, .2, -.1, 2]]
      mass: [[2, 0, 0, 0, 0.4, -0.2], [0, 2, 0, -0.4, 0, 0], [0, 0, 2, 0.2, 0, 0], [0, -0.4, 0.2, 1, 0, 0], [0.4, 0, 0, 0, 0.8, 0.1], [-0.2, 0, 0, 0, 0.1, 0.6]]
)yaml",
          {{"nodes", "[a, c]", "no node 'c'"}, {"arc_through", "[0.7, 0.3, 0.1]", "one line"}}};
}

Sample tapered_beam() {
  return {Section::elements,
          "beam",
          "massless, tapered, about a centre",
          R"yaml(
nodes:
  a: {position: [1, 0, 0], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [0, 0.6, 0.8], rotation_vector: [-0.7, 0.2, 0.4]}
elements:
  it:
    type: beam
    nodes: [a, b]
    elements: 2
    arc_centre: [0, 0, 0]
    section:
      - {EA: 4, GAy: 2, GAz: 3, GJ: 1, EIy: 2, EIz: 1}
      - {EA: 3, GAy: 1, GAz: 2, GJ: 2, EIy: 1, EIz: 1}
)yaml",
          {{"nodes", "[a, 3]", "no node '3'"},
           {"elements", "x", ""},
           {"arc_centre", "[0, 0, 0.1]", "not at one distance"}}};
}

/// Returns a sample with inclined principal axes, a shear centre of its own, and taper.
Sample tapered_shape() {
  return {Section::elements,
          "beam",
          "tapered l section",
          two_nodes + R"yaml(
elements:
  it:
    type: beam
    nodes: [a, b]
    elements: 2
    section:
      - {l: {width: 1.2, height: 1, thickness: [0.3, 0.2]}, young: 2, poisson: 0.2, density: 1.5, stress_points: [[0, -0.2]]}
      - {l: {width: 1, height: 1.1, thickness: 0.3}, young: 2, poisson: 0.2, density: 1.5, stress_points: [[0, -0.2]]}
)yaml",
          {{"nodes", "[a, c]", "no node 'c'"},
           {"section.1.l.thickness", "2", "thinner"},
           {"section", "{l: {width: 1, height: 1, thickness: 2}, young: 1, shear: 1}", "thinner"},
           {"section", "{circle: 1, young: 1, shear: 1, stress_points: [[2, 0]]}", "outside of the section"}}};
}

/// Returns every other kind of section, with all of its keys.
Sample beam_of(const std::string& variant, const std::string& section, std::vector<BadValue> bad) {
  bad.insert(bad.end(), {{"nodes", "[a, c]", "no node 'c'"}});
  return {Section::elements, "beam", variant,
          two_nodes + "elements:\n  it: {type: beam, nodes: [a, b], elements: 1, section: " + section + "}\n",
          std::move(bad)};
}

std::vector<Sample> beams_of_sections() {
  const std::string steel = ", young: 2, shear: 1, density: 1.5}";
  return {beam_of("circle", "{circle: 0.4" + steel, {}),
          beam_of("tube", "{tube: [0.5, 0.3]" + steel, {{"section.tube", "[0.3, 0.5]", "must be smaller"}}),
          beam_of("i section", "{i: {width: [0.8, 0.6], height: 1, web: 0.1, flange: [0.2, 0.15]}" + steel,
                  {{"section.i.height", "0.3", "room for a web"}, {"section.i.web", "0.7", "thinner"}}),
          beam_of("t section", "{t: {width: 0.8, height: 1, web: 0.1, flange: 0.2}" + steel,
                  {{"section.t.height", "0.1", "room for a web"}, {"section.t.web", "1", "thinner"}}),
          beam_of("box section", "{box: {width: 0.8, height: 1, thickness: [0.1, 0.2]}" + steel,
                  {{"section.box.thickness", "[0.5, 0.1]", "hollow"}}),
          beam_of("constants with mass",
                  "{EA: 4, GAy: 2, GAz: 3, GJ: 1, EIy: 2, EIz: 1, mass_per_length: 1, Jx: 0.4, Jy: 0.3, Jz: 0.2, "
                  "offset: [0.1, 0.2]}",
                  {{"section.Jx", "0", "mass moments > 0"}, {"section.Jy", "", "Jy"}, {"section.Jz", "x", "x"}})};
}

/// Loads per length, dead and follower, off the centre of a curved and twisted beam.
Sample loaded_beam(const std::string& variant, const std::string& load, bool inertial) {
  Sample sample{Section::elements,
                "beam",
                variant,
                two_nodes + R"yaml(
elements:
  it:
    type: beam
    nodes: [a, b]
    elements: 2
    arc_through: [0.7, 0.5, 0.3]
    twist: 0.4
    section: {EA: 4, GAy: 2, GAz: 3, GJ: 1, EIy: 2, EIz: 1}
    distributed: )yaml" +
                    load + "\n",
                {{"nodes", "[a, c]", "no node 'c'"},
                 {"arc_through", "[0.7, 0.3, 0.1]", "one line"},
                 {"twist", "100", "more `elements`"},
                 {"distributed.force", "[x, 1, 2]", "x"},
                 {"distributed", "{at: [1, 2]}", "`force` or `moment`"}}};
  sample.inertial = inertial;
  return sample;
}

/// Returns a sample of aerodynamic forces on a curved and twisted beam.
Sample airfoil(bool pitch_rate) {
  Sample sample{Section::elements,
                "beam",
                pitch_rate ? "airfoil" : "airfoil without pitch rate",
                two_nodes + R"yaml(
elements:
  it:
    type: beam
    nodes: [a, b]
    elements: 2
    arc_through: [0.7, 0.5, 0.3]
    twist: 0.4
    section: {EA: 4, GAy: 2, GAz: 3, GJ: 1, EIy: 2, EIz: 1}
    airfoil: {chord: "0.5 + 0.3*s", twist: "0.2 - 0.4*s", at: [0.1, -0.05], lift: "2*sin(2*alpha)", drag: "0.1 + sin(alpha)^2", moment: "-0.1*cos(alpha)", density: 0.8, wind: ["3 + s", "7*cos(t)", "5 - s*t"])yaml" +
                    std::string(pitch_rate ? "" : ", pitch_rate: false") + "}\n",
                {{"airfoil.chord", "s", "chord greater than 0"},
                 {"airfoil.lift", "2*beta", "beta"},
                 {"airfoil.lift", "", "needs `lift`, or `polars`"}}};
  sample.inertial = true;             // the wind
  sample.scales.smooth_within = 0.3;  // the angle of attack changes within the speed of the air
  return sample;
}

/// Returns a sample with coefficients of stations along the beam, in place of those of one airfoil.
Sample airfoil_with_polars() {
  Sample sample = airfoil(true);
  sample.variant = "airfoil with polars";
  const std::string one = "lift: \"2*sin(2*alpha)\", drag: \"0.1 + sin(alpha)^2\", moment: \"-0.1*cos(alpha)\"";
  sample.model.replace(sample.model.find(one), one.size(),
                       "polars: [{at: 0.2, lift: \"2*sin(2*alpha)\", drag: \"0.1 + sin(alpha)^2\"}, {at: 0.6, lift: "
                       "\"sin(alpha)\", moment: \"-0.1*cos(alpha)\"}, {at: 0.7, lift: 0.5}]");
  sample.bad = {{"airfoil.lift", "1", "does not go with `polars`"},
                {"airfoil.polars", "[{at: 0.5, lift: 1}, {at: 0.5, lift: 2}]", "after the one before it"},
                {"airfoil.polars", "[{at: 0.5, lift: s}]", "s"},
                {"airfoil.polars", "[{at: 0.5}]", "either a `table`, or `lift`"},
                {"airfoil.polars", "[{at: 0.5, lift: 1, angles: deg}]", "belongs to a `table`"},
                {"airfoil.polars", "[{at: 0.5, table: [[-180, 0, 1, 0], [180, 0, 1, 0]]}]", "angles: deg"},
                {"airfoil.polars", "[{at: 0.5, table: [[1, 0, 1, 0], [1, 0, 1, 0]]}]", "ascend"},
                {"airfoil.polars", "[{at: 0.5, table: [[-3, 0, 1, 0], [3, 0, 1, 0]], drag: 1}]", "is a column"},
                {"airfoil.polars", "[{at: 0.5, table: none.csv}]", "no such file"}};
  return sample;
}

Sample dead_line_load() {
  return loaded_beam(
      "dead line load",
      R"yaml({force: ["1 + s*t", "2*cos(3*s)", "if(s < 0.3, -1, 0.5)"], moment: ["0.3 + s", "s^2", "0.7"], at: [0.1, -0.2], follower: false})yaml",
      true);
}

Sample follower_line_load() {
  return loaded_beam(
      "follower line load",
      R"yaml({force: ["1 + s*t", "2*cos(3*s)", "if(s < 0.3, -1, 0.5)"], moment: ["0.3 + s", "s^2", "0.7"], at: [0.1, -0.2], follower: true})yaml",
      false);
}

/// Loads by the motion of the beam and by measures; smooth, because the laws compare differences.
Sample dead_line_load_of_motion() {
  Sample sample = loaded_beam(
      "dead line load of the motion",
      R"yaml({force: ["1 + s*vx*vy - 0.3*vz^2", "-0.5*vy^3 + b.position.x", "section_vx + s*vy*t"], moment: ["0.1*section_vx*vz", "vx - 0.2*section_vz^2", "a.angular_velocity.y"], at: [0.1, -0.2]})yaml",
      true);
  sample.bad.push_back({"distributed.force", "[vx, section_vv, 1]", "section_vv"});
  sample.bad.push_back({"distributed.force", "[b.position.w, 1, 1]", "'b' has no 'position.w'"});
  return sample;
}

Sample follower_line_load_of_motion() {
  // Inertial, because a velocity relative to the air at rest is not that relative to a frame in flight.
  return loaded_beam(
      "follower line load of the motion",
      R"yaml({force: ["-section_vx", "2*section_vy*section_vz - s", "distance(a, b)*section_vz"], moment: ["-0.3*section_vz", "0.2*section_vx*section_vz^2", "section_vy^2 + s*distance(a, b)"], at: [0.1, -0.2], follower: true})yaml",
      true);
}

Sample spring() {
  return {Section::elements,
          "spring_damper",
          "",
          two_nodes + R"yaml(
elements:
  it: {type: spring_damper, nodes: [a, b], at: [[0.2, 0.1, -0.3], [0.1, 0.3, 0.2]], stiffness: 3, damping: 0.7, length: 0.6}
)yaml",
          {{"nodes", "[a, a]", "two different nodes"}}};
}

Sample spring_by_formula() {
  return {Section::elements,
          "spring_damper",
          "formula",
          two_nodes + R"yaml(
elements:
  it: {type: spring_damper, nodes: [a, b], at: [[0.2, 0.1, -0.3], [0, 0, 0]], force: "2*e + e^3 + 0.4*v + 0.1*v^3"}
)yaml",
          {{"force", "2*x", "x"}, {"force", "2*(e", ""}}};
}

Sample timed_spring() {
  return {Section::elements,
          "spring_damper",
          "formula of time",
          two_nodes + R"yaml(
elements:
  it: {type: spring_damper, nodes: [a, b], force: "2*e*cos(t) + 0.4*v*e + sin(3*t)"}
)yaml",
          {{"nodes", "[b, b]", "two different nodes"}, {"force", "sin(", ""}}};
}

/// The force of another spring is a measure of elongation and rate.
Sample following_spring() {
  return {Section::elements,
          "spring_damper",
          "force of a spring",
          two_nodes + R"yaml(
elements:
  other: {type: spring_damper, nodes: [a, b], at: [[0.1, 0.3, 0.2], [0, 0.2, -0.1]], force: "3*e + e^3 + 0.7*v"}
  it: {type: spring_damper, nodes: [a, b], at: [[0.2, 0.1, -0.3], [0, 0, 0]], force: "0.5*other.force + 0.1*other.force^2"}
)yaml",
          {{"force", "other.forces", "did you mean 'force'"}}};
}

/// Forces and moments in sections of a beam: a spring between its ends uses them.
Sample spring_of_a_beam(const std::string& variant, const std::string& beam) {
  return {Section::elements,
          "spring_damper",
          "section forces of a beam, " + variant,
          two_nodes + R"yaml(
elements:
  boom: {type: beam, nodes: [a, b], elements: 1, )yaml" +
              beam + R"yaml(}
  it: {type: spring_damper, nodes: [a, b], at: [[0.2, 0.1, -0.3], [0, 0, 0]], force: "0.5*boom.force.x + 0.3*boom.force.y - 0.2*boom.element_1.force.z + 0.4*boom.moment.x - 0.6*boom.moment.y + 0.7*boom.moment.z*boom.force.x"}
)yaml",
          {{"force", "boom.force.q", "did you mean 'force."},
           {"force", "boom.element_2.force.x", "did you mean 'element_1.force.x'"}}};
}

/// Returns the stresses of a beam of two elements: a spring between its ends uses them. Squares of von Mises stresses
/// are smooth at zero.
Sample spring_of_beam_stresses() {
  Sample sample{Section::elements,
                "spring_damper",
                "stresses of a beam",
                two_nodes + R"yaml(
elements:
  boom: {type: beam, nodes: [a, b], elements: 2, damping: 0.02, section: {rectangle: [0.3, 0.2], young: 900, poisson: 0.2, density: 1.5, stress_points: [[0.15, 0.1], [-0.1, 0.05]]}}
  it: {type: spring_damper, nodes: [a, b], at: [[0.2, 0.1, -0.3], [0, 0, 0]], force: "1e-2*boom.element_2.von_mises.p2^2 + 2e-2*boom.element_1.von_mises.p1^2 - 1e-2*boom.element_1.stress.p1.xx + 2e-2*boom.element_2.stress.p2.xy - 3e-2*boom.element_2.stress.p1.xz"}
)yaml",
                {{"force", "boom.von_mises.p1", "did you mean 'von_mises.max'"},
                 {"force", "boom.element_2.stress.p3.xx", "did you mean 'element_2.stress.p"},
                 {"force", "boom.element_1.stress.p1.yy", "did you mean 'element_1.stress.p1.xy'"}}};
  sample.scales.smooth_within = 0.25;  // the square of a stress has terms of high order in the rotations
  return sample;
}

/// Returns a bent body with three interfaces, load patterns, damping and prestress; nodes stand as meshed. Small local
/// displacements are its premise.
Sample superelement(const std::string& loads) {
  Sample sample{Section::elements,
                "superelement",
                "",
                R"yaml(
gravity: [1, -2, 3]
nodes:
  tip: {position: [0.3, -0.1, 0], rotation_vector: [0.3, -0.5, 0.8]}
elements:
  it:
    type: superelement
    file: body.h5
    nodes: {a: tip}
    damping: {rayleigh: [0.1, 0.02]}
    loads: )yaml" + loads +
                    "\n",
                {{"file", "other.h5", "other.h5"},
                 {"nodes", "{a: c}", "no node 'c'"},
                 {"nodes", "{z: tip}", "no interface"},
                 {"nodes.a", "ground", "m away"},
                 {"loads", "{pull: 1}", "no load pattern"},
                 {"loads.push", "'x*t'", "x"},
                 {"loads.spread.factor", "'x*t'", "x"}}};
  // Second-order displacements make forces vary on a shorter scale than the body's length: half of it, so that
  // differences are as accurate as the law requires.
  sample.scales.length = 0.5;
  sample.scales.deformation = 0.1;
  sample.scales.amplitude = 0.1;
  sample.files = [](const std::string& folder) {
    write_superelement(test::bent_chain().reduced().body, folder + "/body.h5");
  };
  return sample;
}

Sample superelement_with_followers() {
  return superelement(R"yaml({push: "1 + t", spread: {factor: 2, follower: true}})yaml");
}

Sample superelement_with_dead_load() {
  Sample sample = superelement(R"yaml({push: "1 + t", spread: {factor: "cos(t)", follower: false}})yaml");
  sample.variant = "dead load";
  sample.inertial = true;
  return sample;
}

/// Interfaces that turn about an axis of their own, transmit one moment, or slide along an axis of their own.
Sample superelement_with_free_directions() {
  Sample sample{Section::elements,
                "superelement",
                "free directions",
                R"yaml(
gravity: [1, -2, 3]
nodes:
  root: {position: [0.3, -0.1, 0], rotation_vector: [0.3, -0.5, 0.8]}
  tip: {position: [1.3, 0.3, 0.035280002], rotation_vector: [-0.7, 0.2, 0.4]}
  middle: {position: [0.7166666667, -0.0305555556, 0.2372461549]}
elements:
  it: {type: superelement, file: body.h5, nodes: {a: root, b: tip, c: middle}}
)yaml",
                {{"nodes", "{a: root, b: tip}", "leaves some directions of its node free"},
                 {"nodes.b", "root", "m away"},
                 {"nodes.c", "tip", "m away"}}};
  sample.scales.length = 0.5;  // held this loosely, the body turns about its slender axis when the middle moves by less
  sample.scales.deformation = 0.1;
  sample.scales.amplitude = 0.1;
  sample.files = [](const std::string& folder) {
    test::BeamChain chain = test::bent_chain();
    chain.interfaces[1].kept = {true, true, true, true, true, false};
    chain.interfaces[2].kept = {true, false, true, false, true, false};
    write_superelement(chain.reduced().body, folder + "/body.h5");
  };
  return sample;
}

/// With nodes that ride on points inside, one on the body's axis and one off it.
/// @param inside, off_axis  "at: [..]", or "point: .." for those of the file
Sample superelement_with_points(const std::string& variant, const std::string& inside, const std::string& off_axis) {
  Sample sample{Section::elements,
                "superelement",
                variant,
                R"yaml(
gravity: [1, -2, 3]
nodes:
  tip: {position: [0.3, -0.1, 0], rotation_vector: [0.3, -0.5, 0.8]}
points:
  inside: {element: it, )yaml" +
                    inside + R"yaml(}
  beside: {element: it, )yaml" +
                    off_axis + R"yaml(}
elements:
  it: {type: superelement, file: body.h5, nodes: {a: tip}, frame: mean_axes}
)yaml",
                {{"nodes", "{z: tip}", "no interface"}, {"frame", "{interface: z}", "no interface"}}};
  sample.scales.length = 0.25;  // see above; points are nearer still
  sample.scales.deformation = 0.1;
  sample.scales.amplitude = 0.1;
  sample.files = [](const std::string& folder) {
    const test::BeamChain chain = test::bent_chain();
    test::BeamSuperelement reduced = chain.reduced();
    test::add_mesh(chain, 0.05, reduced);
    for (const auto& [name, place] :
         {std::pair("core", Eigen::Vector3d(0.55, -0.07, 0.17)), std::pair("rim", Eigen::Vector3d(0.92, 0.09, 0.25))})
      reduced.body.points[name] = {place, mechanism::point_shapes(reduced.body, place), {}};
    write_superelement(reduced.body, folder + "/body.h5");
  };
  return sample;
}

Sample dead_load() {
  Sample sample{Section::loads,
                "load",
                "dead",
                two_nodes + R"yaml(
loads:
  it: {node: a, force: ["1 + t", 2, "cos(t)"], moment: [0.3, "t", 1], at: [0.2, 0.1, -0.3]}
)yaml",
                {{"node", "c", "no node 'c'"}, {"moment", "['x', 1, 2]", "x"}}};
  sample.inertial = true;
  return sample;
}

Sample follower_load() {
  return {Section::loads,
          "load",
          "follower",
          two_nodes + R"yaml(
loads:
  it: {node: a, force: ["1 + t", 2, "cos(t)"], moment: [0.3, "t", 1], at: [0.2, 0.1, -0.3], follower: true}
)yaml",
          {}};
}

}  // namespace

std::vector<Sample> element_samples() {
  std::vector<Sample> list = {
      rigid_body(),
      turned_body(),
      solid_body(),
      drilled_body(),
      shaped_body(),
      point_mass(),
      beam(),
      curved_beam(),
      tapered_beam(),
      tapered_shape(),
      dead_line_load(),
      follower_line_load(),
      dead_line_load_of_motion(),
      follower_line_load_of_motion(),
      airfoil(true),
      airfoil(false),
      airfoil_with_polars(),
      spring(),
      spring_by_formula(),
      timed_spring(),
      following_spring(),
      spring_of_a_beam("damped, tapered",
                       "damping: 0.2, twist: 0.3, section: [{rectangle: [1.1, 0.8], young: 2, poisson: 0.2, density: "
                       "1.5}, {rectangle: [0.9, 0.7], young: 2, poisson: 0.2, density: 1.5}]"),
      spring_of_a_beam("constant strain",
                       "damping: 0.1, bending: constant, arc_through: [0.7, 0.5, 0.3], section: {EA: 4, GAy: 2, GAz: "
                       "3, GJ: 1, EIy: 2, EIz: 1}"),
      spring_of_beam_stresses(),
      superelement_with_followers(),
      superelement_with_dead_load(),
      superelement_with_free_directions(),
      superelement_with_points("points", "at: [0.55, -0.07, 0.17]", "at: [0.92, 0.09, 0.25]"),
      superelement_with_points("named points", "point: core", "point: rim"),
      dead_load(),
      follower_load()};
  for (Sample& sample : beams_of_sections()) list.push_back(std::move(sample));
  return list;
}

}  // namespace bielle::laws
