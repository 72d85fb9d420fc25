// Samples of joints that are not lower pairs: universal and constant-velocity joints, screws, links, guided points,
// wheels.
#include <fstream>

#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

/// Returns two nodes turned against each other; the joint's axes are those of neither.
Sample higher_pair(const std::string& type, const std::string& keys, std::vector<BadValue> bad) {
  bad.push_back({"nodes", "[a, a]", "two different nodes"});
  bad.push_back({"nodes", "[a, c]", "no node 'c'"});
  return {Section::joints, type, "",
          "nodes:\n"
          "  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}\n"
          "  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}\n"
          "joints:\n  it: {type: " +
              type + ", nodes: [a, b], " + keys + "}\n",
          std::move(bad)};
}

Sample variant(Sample sample, const std::string& name) {
  sample.variant = name;
  return sample;
}

/// Tyres on a plane and on a road; in the random states some touch, some are above the road.
std::vector<Sample> tyre_samples() {
  const std::string place = "normal: [0.1, 0.2, 1], axis: [1, 2, -0.2], radius: 0.9, position: [0, 0, -0.2]";
  const std::string slip =
      "slip: {longitudinal: 2, lateral: 1.5, friction: 5, relaxation: [0.4, 0.7], trail: 0.1, camber: 0.3";
  const std::string all = place + ", stiffness: 3, damping: 0.4, rolling_resistance: 0.2, speed: 0.6, " + slip;
  std::vector<Sample> list = {
      higher_pair("tyre", place + ", stiffness: 3",
                  {{"axis", "[0.1, 0.2, 1]", "lies flat"},
                   {"position", "[0, 0, 9]", "below the plane"},
                   {"stiffness", "", "which is missing"},
                   {"curve", "none.csv", "give one of them"}}),
      variant(higher_pair("tyre", all + ", stiffest_load: 1.1}", {{"slip.curvature", "0.5", "`shape` is missing"}}),
              "brush model"),
      variant(higher_pair("tyre",
                          place + ", stiffness: 3, speed: 9, slip: {longitudinal: 2, lateral: 1.5, friction: 1.3, "
                                  "relaxation: [0.4, 0.7], damping: 0.8}",
                          {}),
              "damped tread"),
      variant(higher_pair("tyre", all + ", shape: 1.6, curvature: -0.5}", {}), "magic formula"),
      variant(higher_pair("tyre",
                          place + ", curve: force.csv, damping: 0.4, speed: 0.6, " + slip +
                              "}, road: {table: road.csv, along: [1, 0.2, 0]}",
                          {{"curve", "pulls.csv", "positive and does not fall"},
                           {"curve", "preload.csv", "expected 0"},
                           {"road.table", "none.csv", "no such file"},
                           {"road.table", "narrow.csv", "valley"},
                           {"road.table", "high.csv", "below the road"},
                           {"road.along", "[0.1, 0.2, 1]", "along its plane"}}),
              "on a road")};
  for (Sample& sample : list) {
    sample.scales.smooth_within = 0.02;  // slip of a tyre that is hardly pressed in, which grows with 1/N
    sample.scales.first_order = 0.2;     // deflections of the tread below and above those that friction holds
    sample.scales.kinks_unloaded = !sample.variant.empty();  // slip at standstill
  }
  list.back().files = [](const std::string& folder) {
    // The kinks of the curve are away from the states.
    std::ofstream(folder + "/force.csv") << "0,0\n9,20\n";
    std::ofstream(folder + "/pulls.csv") << "0,0\n1,-3\n";
    std::ofstream(folder + "/preload.csv") << "0,1\n1,3\n";
    // One piece, or two that join smoothly: finite differences stay within a piece.
    std::ofstream(folder + "/road.csv") << "-9,0.9\n-3,0.1\n3,0.2\n9,-0.7\n";
    std::ofstream(folder + "/narrow.csv") << "-1,1\n0,0\n1,1\n";
    std::ofstream(folder + "/high.csv") << "-1,9\n1,9\n";
  };
  return list;
}

const BadValue bad_axis{"axis", "[0, 0, 0]", ""};

}  // namespace

std::vector<Sample> higher_pair_samples() {
  const std::string place = "position: [0.5, 0.2, 0.1], axis: [1, 2, 3]";
  const std::string points = "at: [[0.1, -0.2, 0.3], [-0.3, 0.1, 0.2]]";
  std::vector<Sample> list;
  list.push_back(higher_pair("universal", place + ", second_axis: [3, 0, -1]",
                             {bad_axis, {"second_axis", "[1, 2, 4]", "right angles"}}));
  list.push_back(variant(higher_pair("universal",
                                     place + ", second_axis: [3, 0, -1], stiffness: {angle_1: 3, angle_2: \"2*q + "
                                             "q^3\"}, damping: {angle_2: 0.4}",
                                     {bad_axis,
                                      {"stiffness", "1", "several coordinates"},
                                      {"stiffness.angle_2", "x", "x"},
                                      {"damping", "1", "several coordinates"}}),
                         "springs"));
  list.push_back(higher_pair("constant_velocity", place + ", second_axis: [0, 1, -1]",
                             {bad_axis, {"second_axis", "[1, 2, 3]", "parallel"}}));
  list.push_back(variant(higher_pair("constant_velocity", "position: [0.5, 0.2, 0.1], axes: [[1, 2, 3], [0, 1, 1]]",
                                     {{"axes", "[[1, 0, 0], [-1, 0, 0]]", "fold back"}}),
                         "drawn bent"));
  list.push_back(higher_pair("screw", place + ", pitch: 0.8", {bad_axis, {"pitch", "0", "take a hinge"}}));
  list.push_back(higher_pair("distance", points + ", length: 0.9", {}));
  list.push_back(variant(
      higher_pair("distance", points + ", length: \"0.9 + 0.3*t + 0.2*sin(t)\"", {{"length", "'x'", "x"}}), "of time"));
  list.push_back(higher_pair("spherical_spherical", points, {}));
  list.push_back(higher_pair("revolute_spherical", points + ", axis: [1, 2, 3], length: 0.9",
                             {bad_axis, {"length", "0.05", "along the axis"}}));
  list.push_back(higher_pair("point_on_line", "position: [0.5, 0.2, 0.1], line: [1, 2, 3], stiffness: 4",
                             {{"line", "[0, 0, 0]", ""}}));
  list.push_back(higher_pair("point_on_plane", "position: [0.5, 0.2, 0.1], normal: [1, 2, 3], second_axis: [0, 1, -1]",
                             {{"normal", "[0, 0, 0]", ""}, {"second_axis", "[2, 4, 6]", "parallel"}}));
  list.push_back(higher_pair("wheel", "normal: [0.1, 0.2, 1], axis: [1, 2, -0.2], radius: 0.5",
                             {{"normal", "[0, 0, 0]", ""}, {"axis", "[0.1, 0.2, 1]", "lies flat"}}));
  list.push_back(
      variant(higher_pair("wheel", "normal: [0.1, 0.2, 1], axis: [1, 2, -0.2], radius: 0.5, position: [0, 0, -0.1]",
                          {{"position", "[0, 0, 9]", "below the plane"}}),
              "on a plane through a point"));
  list.push_back(variant(higher_pair("wheel",
                                     "normal: [0.1, 0.2, 1], axis: [1, 2, -0.2], radius: 0.5, at: [[0.1, -0.2, -0.3], "
                                     "[0.2, -0.1, 0.3]]",
                                     {{"at", "[[0, 0, 9], [0, 0, 0]]", "below the plane"}}),
                         "off its node"));
  for (const std::string friction : {"", ", friction: 0.7"}) {
    std::vector<BadValue> bad = {};
    Sample tyre =
        higher_pair("wheel",
                    "normal: [0.1, 0.2, 1], axis: [1, 2, -0.2], radius: 0.5, slip: {longitudinal: 2, lateral: 1.5, "
                    "speed: 0.8" +
                        friction + "}",
                    bad);
    tyre.scales.kinks_unloaded = true;  // at a push of zero
    list.push_back(variant(tyre, friction.empty() ? "linear tyre" : "saturating tyre"));
  }
  for (Sample& sample : tyre_samples()) list.push_back(std::move(sample));
  for (const std::string kind : {"open", "closed", "placed"}) {
    const bool closed = kind == "closed";
    Sample curve = higher_pair("point_on_curve",
                               "position: [0.55, 0.2, 0.15], curve: points.csv, stiffness: 2, damping: 0.3, closed: " +
                                   std::string(closed ? "true" : "false") +
                                   (kind == "placed" ? ", axis: [0.1, 0, 1], second_axis: [1, 0.2, 0], curve_origin: "
                                                       "[0.1, 0, -0.05]"
                                                     : ""),
                               {{"curve", "none.csv", "none.csv"}});
    // One piece, or five: finite differences stay within a piece, where the curve has all derivatives.
    curve.files = [closed](const std::string& folder) {
      std::ofstream(folder + "/points.csv")
          << (closed ? "0.2,0.1,0\n1.0,0.3,0.3\n1.2,1.0,0.2\n0.5,1.4,0\n-0.1,0.9,-0.2\n"
                     : "0.2,0.1,0\n1.0,0.3,0.3\n1.2,1.0,0.2\n0.5,1.4,0\n");
    };
    curve.scales.amplitude = 0.2;
    list.push_back(variant(curve, kind));
  }
  for (const std::string orientation : {"free", "tangent"}) {
    Sample slider{
        Section::joints,
        "slider",
        orientation,
        "nodes:\n"
        "  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}\n"
        "  b: {position: [1.5, 0.7, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}\n"
        "  s: {position: [0.7, 0.4, 0.1], rotation_vector: [0.2, 0.2, 0.4]}\n"
        "elements:\n"
        "  shaft: {type: beam, nodes: [a, b], elements: 4, arc_through: [1, 0.2, 0.4], section: {circle: 0.1, young: "
        "1e6, "
        "poisson: 0.3, density: 100}}\n"
        "joints:\n"
        "  it: {type: slider, node: s, beam: shaft, at: [0.1, -0.05, 0.1], start: 0.38, ends: stop, orientation: " +
            orientation + ", stiffness: 3}\n",
        {{"node", "a", "slide on itself"}, {"node", "c", "no node 'c'"}, {"beam", "shft", "did you mean 'shaft'"}}};
    slider.scales.amplitude = 0.1;  // within one element: the curvature jumps from one to the next
    list.push_back(slider);
  }
  return list;
}

}  // namespace bielle::laws
