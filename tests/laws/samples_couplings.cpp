// Samples of couplings of joints and wheels: gears, differentials, racks, gear meshes.
#include <fstream>

#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

/// Returns joints of a moving carrier with three others.
Sample coupling(const std::string& type, const std::string& variant, const std::string& keys,
                std::vector<BadValue> bad) {
  Sample sample{Section::joints, type, variant,
                "nodes:\n"
                "  carrier: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}\n"
                "  a: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}\n"
                "  b: {position: [-0.4, 0.6, 0.2], rotation_vector: [0.1, 0.9, 0.4]}\n"
                "  c: {position: [-0.1, -0.6, 0.5], rotation_vector: [0.5, 0.2, -0.4]}\n"
                "joints:\n"
                "  it: {type: " +
                    type + ", " + keys +
                    "}\n"
                    "  one: {type: hinge, nodes: [carrier, a], axis: [1, 2, 3]}\n"
                    "  two: {type: cylindrical, nodes: [carrier, b], axis: [-1, 2, 1]}\n"
                    "  three: {type: hinge, nodes: [a, c], axis: [0.3, -1, 1]}\n"
                    "  ball: {type: spherical, nodes: [a, c]}\n",
                std::move(bad)};
  // Angles of frames whose axes point in quite different directions vary too fast for finite differences.
  sample.scales.deformation = 0.2;
  return sample;
}

/// Wheels on parallel axes (or others) whose bearings are on a moving carrier.
Sample mesh(const std::string& variant, const std::string& keys, std::vector<BadValue> bad) {
  bad.push_back({"nodes", "[a, a]", "two different wheels"});
  bad.push_back({"axes", "[0, 0, 0]", ""});
  Sample sample{Section::joints, "gear_mesh", variant,
                "nodes:\n"
                "  carrier: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}\n"
                "  a: {position: [0, 0, 0], rotation_vector: [-0.7, 0.2, 0.4]}\n"
                "  b: {position: [0.6, 0.8, 0], rotation_vector: [0.1, 0.9, 0.4]}\n"
                "joints:\n"
                "  it: {type: gear_mesh, nodes: [a, b], " +
                    keys + "}\n",
                std::move(bad)};
  sample.scales.kinks_unloaded = true;  // teeth push to both sides, and apart
  return sample;
}

/// Returns the same with teeth whose errors and stiffness vary within a part of a radian.
Sample wavy(const std::string& variant, const std::string& keys, std::vector<BadValue> bad) {
  Sample sample = mesh(variant, keys, std::move(bad));
  sample.scales.smooth_within = 0.1;
  return sample;
}

/// Returns a rope over three nodes.
Sample rope(const std::string& type, const std::string& variant, const std::string& keys, std::vector<BadValue> bad) {
  return {Section::joints, type, variant,
          "nodes:\n"
          "  a: {position: [-1.2, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}\n"
          "  b: {position: [0.2, 1.7, 0.1], rotation_vector: [-0.7, 0.2, 0.4]}\n"
          "  c: {position: [1.6, -0.3, 0.2], rotation_vector: [0.1, 0.9, 0.4]}\n"
          "joints:\n"
          "  it: {type: " +
              type + ", " + keys + "}\n",
          std::move(bad)};
}

}  // namespace

std::vector<Sample> coupling_samples() {
  std::vector<Sample> list;
  list.push_back(coupling("gear", "ratio", "joints: [one, two], ratio: -0.4",
                          {{"ratio", "0", "other than 0"},
                           {"ratio", "", "`ratio`"},
                           {"joints", "[one, ball]", "it has no angle"},
                           {"joints", "[one, one]", "coupled with itself"},
                           {"joints", "[one, twoo]", "did you mean 'two'"},
                           {"joints", "[one, two.angel]", "did you mean 'angle'"},
                           {"joints", "[one, it]", "no joint between two nodes"}}));
  list.push_back(coupling(
      "gear", "teeth", "joints: [one, {joint: three, coordinate: angle}], teeth: [20, 31], internal: true",
      {{"joints.1.joint", "thre", "did you mean 'three'"}, {"joints.1.coordinate", "displacement", "no angle"}}));
  list.push_back(coupling("gear", "factors", "joints: [one, two.displacement, three], factors: [1, -0.7, 2.5]",
                          {{"factors", "[1, 0, 2]", "other than 0"},
                           {"factors", "[1, 2]", "as many"},
                           {"joints", "[one, two, three]", "several coordinates"}}));
  list.push_back(coupling("gear", "elastic",
                          "joints: [one, two.displacement, three], factors: [1, -0.7, 2.5], "
                          "stiffness: 5, damping: 0.4",
                          {{"stiffness", "", "give its `stiffness`"}}));
  list.push_back(coupling("gear", "elastic coupling with play",
                          "joints: [one, three], ratio: -0.4, stiffness: 5, damping: 0.1, backlash: 0.02", {}));
  list.push_back(coupling("differential", "elastic", "joints: [one, two, three], ratio: 3.5, stiffness: 2, damping: 0",
                          {{"stiffness", "", "give its `stiffness`"}}));
  list.push_back(coupling("rack_and_pinion", "elastic coupling with play",
                          "joints: [three, two], radius: 0.3, stiffness: 7, damping: 0.05, backlash: 0.03", {}));
  list.push_back(coupling("differential", "", "joints: [one, two, three], ratio: 3.5", {{"ratio", "0", ""}}));
  list.push_back(coupling("rack_and_pinion", "", "joints: [three, two], radius: 0.3",
                          {{"radius", "0", "other than 0"}, {"joints", "[three, one]", "it has no displacement"}}));
  list.push_back(mesh("rigid, helical",
                      "carrier: carrier, axes: [0, 0, 1], radii: [0.4, 0.6], pressure_angle: 0.4, helix_angle: 0.3",
                      {{"carrier", "a", "its own carrier"},
                       {"carrier", "d", "no node 'd'"},
                       {"radii", "[0.4, 0.5]", "1 m apart"},
                       {"pressure_angle", "20", "[rad]"},
                       {"helix_angle", "30", "[rad]"}}));
  list.push_back(mesh(
      "rigid, crossed, on the ground", "axes: [[0.8, -0.6, 0], [0, 0, 1]], position: [0.18, 0.24, 0], helix_angle: 0.7",
      {{"position", "[0, 0, 0]", "axis of the first wheel"}, {"position", "[0.3, 0.3, 0.1]", "common perpendicular"}}));
  list.push_back(mesh(
      "elastic, internal",
      "carrier: carrier, axes: [0, 0, 1], radii: [1.5, 0.5], internal: true, stiffness: 5, damping: 0.4, backlash: 0",
      {{"carrier", "b", "its own carrier"}, {"radii", "[1, 1]", "apart"}}));
  list.push_back(
      mesh("rigid, with errors",
           "carrier: carrier, axes: [0, 0, 1], radii: [0.4, 0.6], errors: [{table: [[0, 0], [0.4, 0.1], [0.7, "
           "-0.1], [1, 0]], wheel: 2, phase: 0.2}, {formula: 0.1*sin(2*phi)}]",
           {{"errors", "[{table: [[0, 0], [0.4, 1], [0.6, 1], [1, 2]]}]", "the last value must repeat the first"},
            {"errors", "[{table: [[0, 0], [0.4, 1], [0.6, 1], [2, 0]]}]", "from 0 to 1"},
            {"errors", "[{table: [[0, 0], [0.4, 1], [1, 0]]}]", "four rows"},
            {"errors", "{wheel: 2}", "either a `table` or a `formula`"},
            {"errors", "{formula: phi, teeth: 3}", "belongs to a `table`"},
            {"errors", "theta", "theta"}}));
  const std::string teeth =
      "carrier: carrier, axes: [0, 0, 1], radii: [0.4, 0.6], damping: 0.25, helix_angle: 0.2, errors: 0.1*sin(3*phi), ";
  list.push_back(wavy("elastic, with a stiffness by table",
                      teeth + "stiffness: {table: [[0, 5], [0.3, 6], [0.6, 4], [1, 5]], teeth: 2, wheel: 2}",
                      {{"stiffness", "{table: [[0, 5], [0.5, -1], [0.6, 1], [1, 5]], teeth: 2}", "greater than 0"},
                       {"stiffness", "{table: [[0, 5], [0.5, 4], [0.6, 4], [1, 5]]}", "`teeth`"},
                       {"stiffness", "{teeth: 20}", "either a `table` or `iso`"},
                       {"stiffness", "{iso: {width: 1, teeth: [20, 20]}}", "pitch radii"},
                       {"stiffness", "{iso: {width: 1, teeth: [20, 30], shifts: [-50, 0]}}", "between -0.5 and 2"},
                       {"stiffness", "{iso: {width: 1, teeth: [20, 30]}, teeth: 20}", "belongs to a `table`"}}));
  list.back().scales.smooth_within = 0.02;  // the third derivative of the spline jumps
  list.push_back(wavy("elastic, with play", teeth + "backlash: 0.01, stiffness: 5 + sin(2*phi)", {}));
  list.push_back(wavy(
      "elastic, with a stiffness by formula", teeth + "stiffness: 5 + sin(2*phi)",
      {{"stiffness", "2*sin(phi)", "greater than 0"}, {"stiffness", "1/phi", "phi"}, {"stiffness", "5 + t", "t"}}));
  list.push_back(wavy("elastic, with a stiffness and errors by both angles",
                      "carrier: carrier, axes: [0, 0, 1], radii: [0.4, 0.6], damping: 0.25, helix_angle: 0.2, errors: "
                      "0.1*sin(3*phi - 2*phi_2), stiffness: 5 + sin(2*phi)*cos(3*phi_2)",
                      {{"stiffness", "1.5 + sin(phi) + cos(phi_2)", "of the second"},
                       {"stiffness", "5 + sin(phi_3)", "phi_3"},
                       {"errors", "{formula: phi_2, wheel: 2}", "phi_2"}}));
  list.push_back(wavy("elastic, by its size",
                      teeth + "stiffness: {iso: {width: 1e-9, teeth: [20, 30], shifts: [0.1, 0], young: 100e9}}",
                      {{"axes", "[[0, 0, 1], [0, 0.1, 1]]", ""}}));
  Sample lift = coupling("cam", "lift", "joints: [one, two.displacement], lift: lift.csv",
                         {{"lift", "profile.csv", "the last value must repeat the first"},
                          {"lift", "none.csv", "no such file"},
                          {"joints", "[two.displacement, one]", "no angle"}});
  Sample knife =
      coupling("cam", "knife edge",
               "joints: [one, three], profile: profile.csv, follower: roller, radius: 0, at: [0.1, 0.2, 0.3]",
               {{"profile", "lift.csv", "greater than 0"}});
  knife.scales.amplitude = 0.1;
  const std::string creeps = ", friction: {coefficient: 0.3, velocity: 0.4";
  const std::vector<BadValue> rollers = {{"profile", "lift.csv", "greater than 0"}};
  const std::vector<BadValue> faces = {{"profile", "hollow.csv", "hollow"}, {"normal", "[1, 2, 3]", "right angles"}};
  const auto both = [](std::vector<BadValue> first, const std::vector<BadValue>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  };
  Sample edge = coupling("cam", "knife edge that rubs",
                         "joints: [one, three], profile: profile.csv, follower: roller, radius: 0" + creeps + "}",
                         both(rollers, {{"friction.radius", "1", "does not turn"}}));
  Sample roller =
      coupling("cam", "roller on its pin",
               "joints: [one, three], profile: profile.csv, follower: roller, radius: 0.2" + creeps + ", radius: 0.1}",
               both(rollers, {{"friction.radius", "", "radius"}, {"friction.arm", "1", "no moment"}}));
  for (Sample* sample : {&edge, &roller}) {
    sample->scales.amplitude = 0.1;
    sample->scales.smooth_within = 0.25;
  }
  const std::string normal = "joints: [one, three], profile: round.csv, follower: flat, normal: [2, -1, 0]";
  Sample face =
      coupling("cam", "flat face", normal + ", at: [0.1, 0.2, 0.3]", both(faces, {{"radius", "1", "roller"}}));
  Sample rubbing_face = coupling("cam", "flat face that rubs", normal + creeps + "}",
                                 both(faces, {{"friction.radius", "1", "does not turn"}}));
  // The support function is a spline of 48 pieces, whose third derivative jumps.
  for (Sample* sample : {&face, &rubbing_face}) sample->scales.smooth_within = 0.02;
  for (Sample* sample : {&edge, &roller, &rubbing_face}) sample->scales.kinks_unloaded = true;  // |F| where it vanishes
  for (Sample* sample : {&lift, &knife, &edge, &roller, &face, &rubbing_face}) {
    // Few knots, away from the reference: finite differences stay within a piece of the splines.
    sample->files = [](const std::string& folder) {
      std::ofstream(folder + "/lift.csv") << "-0.8,0\n0.8,0.3\n2.4,0.1\n4,-0.2\n5.4831853071795862,0\n";
      std::ofstream(folder + "/profile.csv") << "0,1\n1.5,1.3\n2.9,0.9\n4.5,1.1\n";
      std::ofstream(folder + "/round.csv") << "0,1\n1,1.05\n2.1,1\n3.1,0.95\n4.2,1\n5.2,1.02\n";
      std::ofstream(folder + "/hollow.csv") << "0,1\n1,0.3\n2.1,1\n3.1,0.3\n4.2,1\n5.2,0.3\n";
    };
    list.push_back(*sample);
  }
  for (const std::string axes : {"first", "second", "inertial"}) {
    Sample force{Section::elements,
                 "node_force",
                 axes,
                 "nodes:\n"
                 "  a: {position: [-1.2, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}\n"
                 "  b: {position: [0.2, 1.7, 0.1], rotation_vector: [-0.7, 0.2, 0.4]}\n"
                 "elements:\n"
                 "  it: {type: node_force, nodes: [a, b], at: [0.2, -0.1, 0.3], axes: " +
                     axes +
                     ", force: [2, 1 + t, \"0.5*distance(a, b)\"], moment: [0.4, \"0.3*distance(a, b)^2\", -1]}\n",
                 {{"nodes", "[a, a]", "two different nodes"}, {"moment", "[1, 2, 'x']", "x"}}};
    force.inertial = axes == "inertial";
    list.push_back(force);
  }
  const std::vector<BadValue> bad_rope = {{"nodes", "[a, b, b]", "follows itself"},
                                          {"nodes", "[a, b, d]", "no node 'd'"},
                                          {"radii", "[1, 2]", "expected 3 radii"},
                                          {"axis", "[0, 0, 0]", ""}};
  const auto with = [&](std::vector<BadValue> more) {
    more.insert(more.end(), bad_rope.begin(), bad_rope.end());
    return more;
  };
  list.push_back(
      rope("belt", "crossed",
           "nodes: [a, b, c], radii: [0.3, -0.2, 0.4], axis: [1, 0.2, 3], EA: 6, pretension: 12, damping: 0.3",
           with({{"radii", "[0.3, 0, 0.1]", "other than 0"}, {"radii", "[0.3, 5, 0.1]", "overlap"}})));
  list.push_back(
      rope("cable", "over a pulley onto a drum",
           "nodes: [a, b, c], radii: [0, -0.2, 0.4], axis: [1, 0.2, 3], at: [[0.1, 0.2, -0.1], ~, ~], EA: 6, "
           "pretension: 12, damping: 0.3",
           with({{"at", "[[0, 0, 0]]", "3 points"}})));
  list.push_back(
      rope("cable", "with a turn round a pulley",
           "nodes: [a, b, c], radii: [0, -0.2, 0.4], axis: [1, 0.2, 3], turns: [~, 1, ~], EA: 6, "
           "pretension: 12, damping: 0.3",
           with({{"turns", "[~, 1]", "3 numbers of turns"}, {"turns", "[~, ~, 1]", "on which the rope slides"}})));
  list.push_back(rope(
      "cable", "gripped",
      "nodes: [a, b, c], radii: [0, -0.2, 0.4], axis: [1, 0.2, 3], grips: [b], EA: 6, pretension: 14, damping: 0.1",
      with({{"grips", "[d]", "no node 'd'"}, {"grips", "[ground]", "none of the cable"}})));
  // Without damping: before the first step the rate of the slip belongs to a very short time. See
  // test_slipping_rope.cpp.
  Sample belt = rope("belt", "that slips",
                     "nodes: [a, b, c], radii: [0.3, -0.2, 0.4], axis: [1, 0.2, 3], EA: 6, pretension: 12, friction: "
                     "[0.15, ~, 0.3]",
                     with({{"friction", "[0.1]", "3 coefficients"}, {"friction", "[0.1, 0.2, 0.3]", "at once"}}));
  Sample cable =
      rope("cable", "that slips",
           "nodes: [a, b, c], radii: [0, 0.2, 0.4], axis: [1, 0.2, 3], EA: 6, pretension: 14, friction: [~, 0.1, ~], "
           "turns: [~, 1, ~]",
           with({{"friction", "[0.1, 0.2, ~]", "ends here"},
                 {"friction", "[~, 0.2, 0.1]", "ends here"},
                 {"turns", "[~, ~, 1]", "on which the rope slides"}}));
  for (Sample* sample : {&belt, &cable}) {
    sample->scales.first_order = 0.1;  // less than the length of rope in the sections
    list.push_back(*sample);
  }
  return list;
}

}  // namespace bielle::laws
