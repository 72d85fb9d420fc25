// Samples of elastic connections and play between two nodes: bushings, bearings, stiffness fields, clearances.
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

const std::string flexible_nodes = R"yaml(
nodes:
  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}
)yaml";

std::string flexible_joint(const std::string& keys) {
  return flexible_nodes + "joints:\n  it: {nodes: [a, b], " + keys + "}\n";
}

const std::string full_matrix =
    "[[3, .1, .2, .3, -.2, .1], [.1, 2, .1, -.2, .3, .2], [.2, .1, 2, .1, .1, .4], [.3, -.2, .1, 1, .1, .2], "
    "[-.2, .3, .1, .1, 1.5, -.1], [.1, .2, .4, .2, -.1, 2]]";
const std::string unsymmetric_matrix =
    "[[1, .1, .2, .3, -.2, .1], [-.1, 1, .1, -.2, .3, .2], [.2, .3, 1, .1, .1, .4], [.3, -.2, .1, 1, .1, .2], "
    "[-.2, .3, .1, .5, 1.5, -.1], [.1, .2, .4, .2, -.3, 1]]";

Sample bushing_of_matrices() {
  return {Section::joints,
          "bushing",
          "matrices, preload, branches",
          flexible_joint(
              "type: bushing, position: [0.5, 0.2, 0.1], axis: [1, 2, 3], second_axis: [0, 1, -1], stiffness: " +
              full_matrix + ", damping: " + unsymmetric_matrix +
              ", preload: [0.5, -0.3, 0.2, 0.1, 0.4, -0.2], maxwell: [{factor: 0.4, time: 0.7}, {stiffness: [1, 0, 2, "
              "0.5, 0, 1], time: 2}]"),
          {{"nodes", "[a, a]", "two different nodes"},
           {"axis", "[0, 0, 0]", ""},
           {"second_axis", "[1, 2, 3]", ""},
           {"stiffness", "{file: none.csv}", "no such file"},
           {"stiffness",
            "[[1, 0.5, 0, 0, 0, 0], [0.2, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], "
            "[0, 0, "
            "0, 0, 0, 1]]",
            "not symmetric"},
           {"stiffness",
            "[[1, 2, 0, 0, 0, 0], [2, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, "
            "0, 0, 0, "
            "0, 1]]",
            "not positive semidefinite"},
           {"damping",
            "[[0, 1, 0, 0, 0, 0], [1, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, "
            "0, 0, 0, "
            "0, 1]]",
            "drives the motion"},
           {"maxwell.0.stiffness", "[1, 1, 1, 1, 1, 1]", "either"}}};
}

Sample plain_bushing() {
  return {Section::joints,
          "bushing",
          "numbers",
          flexible_joint("type: bushing, stiffness: [1, 2, 1, 0.5, 0, 1]"),
          {{"nodes", "[a, a]", "two different nodes"}, {"stiffness", "[0, 0, 0, 0, 0, 0]", "does nothing"}}};
}

Sample bushing_of_curves() {
  Sample sample{
      Section::joints,
      "bushing",
      "curves",
      flexible_joint("type: bushing, at: [[0.2, 0.1, 0.3], [-0.6, -0.2, -0.1]], stiffness: {file: k.csv}, damping: "
                     "0.2, curves: {x: x.csv, y: {table: x.csv}, z: \"3*q^3 + 0.2*v\", rx: \"q*(1 + 0.2*sin(t))\", rz: "
                     "\"2*q + 0.1*it.x.rate + 0.2*b.position.x\"}, start: {rx: 0.1}"),
      {{"nodes", "[a, c]", "no node 'c'"},
       {"stiffness", "", "which is missing"},
       {"stiffness.file", "x.csv", ""},
       {"curves.x", "none.csv", "no such file"},
       {"curves.x", "falling.csv", "ascend"},
       {"curves.y.table", "one.csv", "at least two points"},
       {"curves.z", "'3*w'", "w"},
       {"curves.rx", "-3", "at least 0"},
       {"curves.rz", "it.w", ""},
       {"start", "{angle: 1}", "angle"},
       {"start.rx", "far", ""}}};
  sample.inertial = true;  // a position of a node
  sample.scales.deformation = 0.2;
  sample.files = [](const std::string& folder) {
    // The kinks of the law are away from the states.
    std::ofstream(folder + "/x.csv") << "displacement, force\n-3,-5\n2.2,3\n4,6\n";
    std::ofstream(folder + "/falling.csv") << "0,1\n1,2\n0.5,3\n";
    std::ofstream(folder + "/one.csv") << "0,1\n";
    std::ofstream(folder + "/k.csv")
        << "1 0.1 0 0 0 0\n0.1 1 0 0 0 0\n0 0 2 0 0 0\n0 0 0 1 0 0\n0 0 0 0 3 0\n0 0 0 0 0 1\n";
  };
  return sample;
}

Sample bearing_of_all() {
  return {Section::joints,
          "bearing",
          "",
          flexible_joint(
              "type: bearing, position: [0.5, 0.2, 0.1], axis: [1, 2, 3], second_axis: [0, 1, -1], radial: "
              "{stiffness: [3, 2], damping: 0.3}, axial: {stiffness: 2, damping: 0.1}, tilting: {stiffness: 1.5, "
              "damping: [0.2, 0.4]}, stiffness: {angle: 2, z: \"q^3\"}, damping: {angle: 0.1}, preload: {z: 0.5}"),
          {{"nodes", "[a, c]", "no node 'c'"},
           {"second_axis", "[1, 2, 3]", ""},
           {"radial", "{}", "expected `stiffness` or `damping`"},
           {"stiffness", "5", "several coordinates"},
           {"stiffness.z", "'q*w'", "w"},
           {"preload.z", "much", ""}}};
}

Sample bushing_unsymmetric() {
  return {Section::joints,
          "bushing",
          "unsymmetric stiffness",
          flexible_joint("type: bushing, stiffness: " + unsymmetric_matrix +
                         ", unsymmetric: true, damping: 0.2, maxwell: [{factor: 0.4, time: 0.7}]"),
          {{"stiffness",
            "[[1, 3, 0, 0, 0, 0], [2, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, "
            "0, 0, 0, 0, 1]]",
            "not positive semidefinite"}}};
}

/// The speed is the rate of a spring between the nodes.
std::vector<Sample> bushing_films() {
  const auto joint = [](const std::string& keys) {
    return flexible_joint("type: bushing, axis: [1, 2, 3], " + keys) +
           "elements:\n  s: {type: spring_damper, nodes: [a, b], stiffness: 1}\n";
  };
  Sample radial{Section::joints,
                "bushing",
                "film, radial",
                joint("stiffness: [1, 2, 1, 0.5, 0, 1], damping: 0.2, maxwell: [{factor: 0.4, time: 0.7}], film: "
                      "{table: oil.csv, speed: 5 + 4*s.elongation.rate + t}"),
                {{"film", "{speed: 1}", "either `table` or `matrices`"},
                 {"film.speed", "it.x.rate", "depends on the bushing 'it' itself"},
                 {"film.speed", "s.elongatio", "did you mean"},
                 {"film.table", "none.csv", "no such file"},
                 {"film.table", "falling.csv", "ascend"}}};
  radial.files = [](const std::string& folder) {
    std::ofstream(folder + "/oil.csv") << "-40 1 0.3 -0.4 2 0.3 0.1 0.05 0.4\n40 3 1 -1.5 2.5 0.5 0.2 0.1 0.6\n";
    std::ofstream(folder + "/falling.csv") << "3 1 1 1 1 1 1 1 1\n2 1 1 1 1 1 1 1 1\n";
  };
  Sample all{Section::joints,
             "bushing",
             "film of all directions",
             joint("film: {matrices: seal.csv, speed: 9*s.elongation.rate - s.elongation}"),
             {{"film.matrices", "narrow.csv", "expected 73 numbers"}}};
  all.files = [](const std::string& folder) {
    std::ofstream file(folder + "/seal.csv");
    for (const double speed : {-40.0, 40.0}) {
      file << speed;
      for (int k = 0; k < 72; ++k) file << ' ' << std::cos(k + 0.01 * speed) + (k % 36 % 7 == 0 ? 6 : 0);
      file << '\n';
    }
    std::ofstream(folder + "/narrow.csv") << "0 1 1 1 1 1 1 1 1\n";
  };
  return {radial, all};
}

std::vector<Sample> coupled_bearings() {
  Sample film{
      Section::joints,
      "bearing",
      "cross-coupled, film",
      flexible_joint("type: bearing, axis: [1, 2, 3], radial: {stiffness: [[3, 0.5], [-0.7, 2]], damping: [[0.3, "
                     "0.1], [0, 0.2]]}, tilting: {stiffness: [[1, 0.2], [-0.3, 2]]}, film: {table: oil.csv}"),
      {{"radial.damping", "[[-1, 0], [0, 1]]", "drives the motion"},
       {"film.table", "none.csv", "no such file"},
       {"film.table", "falling.csv", "ascend"}}};
  film.files = [](const std::string& folder) {
    std::ofstream(folder + "/oil.csv") << "-40 1 0.3 -0.4 2 0.3 0.1 0.05 0.4\n40 3 1 -1.5 2.5 0.5 0.2 0.1 0.6\n";
    std::ofstream(folder + "/falling.csv") << "3 1 1 1 1 1 1 1 1\n2 1 1 1 1 1 1 1 1\n";
  };
  Sample seal{Section::joints,
              "bearing",
              "film of all directions",
              flexible_joint("type: bearing, axis: [1, 2, 3], radial: 1, film: {matrices: seal.csv}"),
              {{"film", "{}", "either `table` or `matrices`"}, {"film.matrices", "narrow.csv", "expected 51 numbers"}}};
  seal.files = [](const std::string& folder) {
    std::ofstream file(folder + "/seal.csv");
    for (const double speed : {-40.0, 40.0}) {
      file << speed;
      for (int k = 0; k < 50; ++k) file << ' ' << std::cos(k + 0.01 * speed) + (k % 25 % 6 == 0 ? 6 : 0);
      file << '\n';
    }
    std::ofstream(folder + "/narrow.csv") << "0 1 1 1 1 1 1 1 1\n";
  };
  return {
      film,
      seal,
      {Section::joints,
       "bearing",
       "matrices of all directions",
       flexible_joint("type: bearing, axis: [1, 2, 3], matrix: {stiffness: [[3, 0.5, 0.1, 0.2, 0.3], [-0.7, 2, 0.2, "
                      "0, 0.1], [0, 0, 1, 0.1, 0], [0.3, 0.1, 0, 2, 0.4], [0, 0, 0, -0.4, 1]], damping: [[1, 0.1, 0, "
                      "0, 0], [0, 1, 0, 0, 0], [0, 0, 1, 0, 0], [0, 0, 0, 1, 0], [0, 0, 0, 0, 1]]}"),
       {{"matrix", "{}", "expected `stiffness` or `damping`"}, {"radial", "1", "or `matrix`"}}}};
}

/// All elements are loaded, by an interference: forces are smooth.
std::vector<Sample> rolling_bearings() {
  const std::string place = "position: [0.7, 0.3, 0.1], axis: [1, 2, 3], elements: 7, pitch_diameter: 6, ";
  std::vector<Sample> list = {
      {Section::joints,
       "ball_bearing",
       "angular contact, spread",
       flexible_joint("type: ball_bearing, " + place +
                      "ball_diameter: 2, grooves: [0.55, 0.53], contact_angle: 0.5, clearance: -3, constant: 0.3"),
       {{"elements", "2", "3"},
        {"ball_diameter", "6", "less than"},
        {"ball_diameter", "4", "have room"},
        {"grooves", "[0.5, 0.52]", "wider than the ball"},
        {"contact_angle", "1.57", "89 degrees"},
        {"cage_angle", "1", "discrete"},
        {"young", "1e11", "follows from `constant`"}}},
      {Section::joints,
       "ball_bearing",
       "discrete, of materials",
       flexible_joint("type: ball_bearing, " + place +
                      "ball_diameter: 1.5, clearance: -4, young: [0.1, 0.2], poisson: [0.3, 0.2], discrete: true, "
                      "cage_angle: 0.3"),
       {{"axial_preload", "1", "contact_angle"}}},
      {Section::joints,
       "roller_bearing",
       "tapered, discrete",
       flexible_joint("type: roller_bearing, " + place +
                      "roller_diameter: 1, roller_length: 1.2, contact_angle: 0.4, clearance: -8, constant: 0.4, "
                      "discrete: true"),
       {{"roller_diameter", "7", "less than"}}},
      {Section::joints,
       "roller_bearing",
       "preloaded",
       flexible_joint("type: roller_bearing, " + place +
                      "roller_diameter: 1, roller_length: 1.2, contact_angle: 0.4, clearance: -8, constant: 0.4, "
                      "axial_preload: 4.8"),
       {{"axial_preload", "1e9", "too soft"}}}};
  for (Sample& sample : list) sample.scales.smooth_within = 0.1;
  return list;
}

std::vector<Sample> journal_bearings() {
  std::vector<Sample> list;
  for (const char* film : {"short", "finite", "finite, cavitation: reynolds"}) {
    Sample sample{
        Section::joints,
        "journal_bearing",
        film,
        flexible_joint(fmt::format("type: journal_bearing, position: [0.7, 0.3, 0.1], axis: [1, 2, 3], diameter: "
                                   "60, length: 20, clearance: 3, viscosity: 1e-3, model: {}",
                                   film)),
        {{"clearance", "4", "no film"}}};
    sample.scales.kinks_unloaded = true;  // without motion the film has no direction
    list.push_back(std::move(sample));
  }
  return list;
}

Sample plain_bearing() {
  return {Section::joints,
          "bearing",
          "numbers",
          flexible_joint("type: bearing, axis: [1, 2, 3], radial: 3, axial: 2, tilting: 1"),
          {{"nodes", "[a, a]", "two different nodes"}, {"axis", "[0, 0, 0]", ""}}};
}

Sample clearance(const std::string& type, const std::string& variant, const std::string& keys,
                 std::vector<BadValue> bad) {
  bad.insert(bad.end(), {{"nodes", "[a, a]", "two different nodes"}});
  Sample sample{Section::joints, type, variant, flexible_joint("type: " + type + ", " + keys), std::move(bad)};
  // Surfaces touch nearly everywhere, and forces vary smoothly over the differences.
  sample.scales.kinks_unloaded = true;
  sample.scales.deformation = 1.5;
  return sample;
}

std::vector<Sample> clearances() {
  const std::string of_hinge = "position: [0.5, 0.2, 0.1], axis: [1, 2, 3], second_axis: [0, 1, -1], ";
  return {
      clearance(
          "clearance_hinge", "ends, collars, friction",
          of_hinge +
              "radial_gap: 0.01, axial_gap: 0.02, length: 0.6, radius: 0.3, contact: {stiffness: 3, exponent: 2, "
              "damping: 0.1}, axial_contact: {stiffness: 2, exponent: 3, restitution: 0.999}, friction: {coefficient: "
              "0.3, static: 0.4, stribeck_velocity: 3, viscous: 0.1, velocity: 2, model: coulomb}",
          {{"second_axis", "[1, 2, 3]", ""},
           {"axial_gap", "", "which is missing"},
           {"radius", "", "which is missing"},
           {"friction.static", "0.1", "no smaller"}}),
      clearance("clearance_hinge", "one contact",
                "axis: [1, 2, 3], radial_gap: 0.01, contact: {stiffness: 2, exponent: 1}", {{"axis", "[0, 0, 0]", ""}}),
      clearance("clearance_hinge", "collars without play",
                of_hinge +
                    "radial_gap: 0.01, axial_gap: 0, radius: 0.3, contact: {stiffness: 3, exponent: 2, damping: "
                    "0.1}, axial_contact: {stiffness: 2, exponent: 1, damping: 0.1}, friction: {coefficient: 0.3, "
                    "velocity: 2}",
                {{"axial_gap", "", "which is missing"}}),
      clearance("clearance_hinge", "materials",
                "axis: [1, 2, 3], radial_gap: 0.01, length: 0.5, contact: {young: [2, 3], poisson: 0.3, damping: 0.1}",
                {{"length", "", "which is missing"}, {"contact.stiffness", "5", "follows from"}}),
      clearance("clearance_spherical", "friction",
                "at: [[0.2, 0.1, 0.3], [-0.6, -0.2, -0.1]], radial_gap: 0.01, radius: 0.2, contact: {stiffness: 3, "
                "exponent: 2, "
                "damping: 0.1}, friction: {coefficient: 0.3, velocity: 2}, stiffness: {x: 0.5}",
                {{"radius", "", "which is missing"}}),
      clearance("clearance_hinge", "bristles",
                "axis: [1, 2, 3], radial_gap: 0.01, length: 0.6, radius: 0.3, contact: {stiffness: 3, exponent: 2, "
                "damping: 0.1}, friction: {model: lugre, coefficient: 0.3, static: 0.4, stribeck_velocity: 3, viscous: "
                "0.1, bristle_stiffness: 1.5, bristle_damping: 0.4}",
                {{"radius", "", "which is missing"},
                 {"friction.static", "0.1", "no smaller"},
                 {"friction.bristle_stiffness", "", "bristle_stiffness"},
                 {"friction.velocity", "1", "model: coulomb"}}),
      clearance("clearance_spherical", "bristles",
                "radial_gap: 0.01, radius: 0.2, contact: {stiffness: 3, exponent: 2}, friction: {model: lugre, "
                "coefficient: 0.3, bristle_stiffness: 2, bristle_damping: 0.3}",
                {{"radius", "", "which is missing"}}),
      clearance("clearance_spherical", "materials",
                "radial_gap: 0.1, radius: 0.2, contact: {young: 2, poisson: [0.3, 0.2]}",
                {{"radius", "", "which is missing"}})};
}

/// Returns the measures of flexible joints and stops: a spring between the nodes uses them.
Sample measured(const std::string& variant, const std::string& joint, const std::string& force, BadValue bad) {
  Sample sample{Section::elements,
                "spring_damper",
                "measures of " + variant,
                flexible_nodes + "joints:\n  j: {nodes: [a, b], " + joint +
                    "}\nelements:\n  it: {type: spring_damper, nodes: [a, b], at: [[0.2, 0.1, -0.3], [0.1, 0.3, 0.2]], "
                    "force: \"" +
                    force + "\"}\n",
                {std::move(bad)}};
  sample.scales.kinks_unloaded = true;
  sample.scales.deformation = 1.5;
  return sample;
}

std::vector<Sample> measures_of_joints() {
  std::vector<Sample> list = {
      measured("a bushing",
               "type: bushing, stiffness: [1, 2, 1, 0.5, 0, 1], damping: 0.3, maxwell: [{factor: 0.4, time: 0.7}]",
               "0.4*j.force.x - 0.3*j.force.z*j.force.rx + 0.5*j.force.rz", {"force", "j.force.q", "did you mean"}),
      measured("a clearance",
               "type: clearance_hinge, axis: [1, 2, 3], radial_gap: 0.01, axial_gap: 0.02, length: 0.6, contact: "
               "{stiffness: 3, exponent: 2, damping: 0.1}, axial_contact: {stiffness: 2, exponent: 3, damping: 0.1}",
               "0.3*j.normal_force + 2*j.gap", {"force", "j.gapp", "did you mean 'gap'"}),
      measured("stops", "type: hinge, axis: [1, 2, 3], stops: {range: [-0.01, 0.01], stiffness: 3, damping: 0.2}",
               "0.7*j.angle.stop_force + 2*j.angle.stop_gap", {"force", "j.angle.stop", "did you mean"})};
  Sample film =
      measured("a bushing with a film", "type: bushing, film: {table: oil.csv, speed: 8*b.velocity.x + 3*b.position.y}",
               "0.4*j.force.x - 0.3*j.force.y*j.reaction.x", {"force", "j.force.q", "did you mean"});
  film.inertial = true;  // velocity of a node
  film.files = [](const std::string& folder) {
    std::ofstream(folder + "/oil.csv") << "-40 1 0.3 -0.4 2 0.3 0.1 0.05 0.4\n40 3 1 -1.5 2.5 0.5 0.2 0.1 0.6\n";
  };
  list[1].scales.smooth_within = 0.1;  // the normal of the bore turns within the radial displacement
  list.push_back(std::move(film));
  return list;
}

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Returns a 12x12 matrix whose null space are the rigid motions of nodes `way` apart, from a 6x6 matrix.
Matrix12 between(const mechanism::Matrix6& K, const mechanism::Vector3& way) {
  Eigen::Matrix<double, 6, 12> P = Eigen::Matrix<double, 6, 12>::Zero();
  P.leftCols<6>() = -mechanism::Matrix6::Identity();
  P.rightCols<6>().setIdentity();
  P.block<3, 3>(0, 3) += 0.5 * mechanism::skew(way);
  P.block<3, 3>(0, 9) += 0.5 * mechanism::skew(way);
  return P.transpose() * K * P;
}

std::string by_rows(const Matrix12& A) {
  std::string text = "[";
  for (int i = 0; i < 12; ++i) {
    text += i == 0 ? "[" : ", [";
    for (int j = 0; j < 12; ++j) text += fmt::format("{}{:.17g}", j == 0 ? "" : ", ", A(i, j));
    text += "]";
  }
  return text + "]";
}

mechanism::Matrix6 some_matrix(double coupling) {
  mechanism::Matrix6 K = mechanism::Matrix6::Identity() * 2;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      if (i != j) K(i, j) = coupling * ((i * j) % 3 - 1);
  return K;
}

Sample field() {
  const mechanism::Vector3 way(0.8, 0.4, 0.6);
  Matrix12 to_ground = Matrix12::Identity();
  return {Section::elements,
          "stiffness_field",
          "by rows",
          flexible_nodes + "elements:\n  it: {type: stiffness_field, nodes: [a, b], stiffness: " +
              by_rows(between(some_matrix(0.2), way)) + ", damping: 0.3}\n",
          {{"nodes", "[a, a]", "two different nodes"},
           {"nodes", "[a, c]", "no node 'c'"},
           {"stiffness", by_rows(to_ground), "resists rigid motions"},
           {"stiffness", by_rows(Matrix12::Zero()), "does nothing"},
           {"stiffness", by_rows(-between(some_matrix(0.2), way)), "not positive semidefinite"}}};
}

Sample field_of_files() {
  Sample sample{
      Section::elements,
      "stiffness_field",
      "files, turned axes",
      flexible_nodes +
          "elements:\n  it: {type: stiffness_field, nodes: [a, b], stiffness: {file: k.csv}, damping: {file: d.csv}, "
          "rotation_vector: [0.3, 0.2, -0.4]}\n",
      {{"stiffness.file", "none.csv", "no such file"},
       {"stiffness.file", "short.csv", ""},
       {"stiffness", "{file: skew.csv}", "not symmetric"},
       {"damping.file", "short.csv", ""}}};
  sample.files = [](const std::string& folder) {
    const mechanism::Matrix3 axes = mechanism::exp_so3(mechanism::Vector3(0.3, 0.2, -0.4));
    const mechanism::Vector3 way = axes.transpose() * mechanism::Vector3(0.8, 0.4, 0.6);
    const auto write = [&](const std::string& name, const Matrix12& A) {
      std::ofstream file(folder + "/" + name);
      for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) file << fmt::format("{:.17g}{}", A(i, j), j < 11 ? "," : "\n");
    };
    mechanism::Matrix6 unsymmetric = some_matrix(0.1);
    unsymmetric(0, 1) += 0.5;
    write("k.csv", between(some_matrix(0.2), way));
    write("d.csv", between(unsymmetric, way));
    write("skew.csv", between(unsymmetric, way));
    std::ofstream(folder + "/short.csv") << "1,2,3\n";
  };
  return sample;
}

}  // namespace

std::vector<Sample> flexible_samples() {
  std::vector<Sample> list = {bushing_of_matrices(), plain_bushing(), bushing_of_curves(), bearing_of_all(),
                              plain_bearing(),       field(),         field_of_files()};
  for (Sample& sample : clearances()) list.push_back(std::move(sample));
  list.push_back(bushing_unsymmetric());
  for (const auto& more : {bushing_films(), coupled_bearings(), rolling_bearings(), journal_bearings()})
    list.insert(list.end(), more.begin(), more.end());
  for (Sample& sample : measures_of_joints()) list.push_back(std::move(sample));
  return list;
}

}  // namespace bielle::laws
