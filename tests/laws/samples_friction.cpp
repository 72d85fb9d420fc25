// Samples of friction in joints.
#include <fstream>

#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

/// Returns a joint with friction. Quantities are of order one: low speeds of surfaces, large radii, soft bristles.
Sample rubbing(const std::string& type, const std::string& variant, const std::string& keys,
               const std::string& friction, std::vector<BadValue> bad) {
  const char* const second_axis = type == "universal" ? ", second_axis: [3, 0, -1]" : "";
  bad.push_back({"nodes", "[a, a]", "two different nodes"});
  bad.push_back({keys.substr(0, keys.find(':')), "[0, 0, 0]", ""});
  if (type == "universal") bad.push_back({"second_axis", "[1, 2, 4]", "right angles"});
  Sample sample{Section::joints, type, variant,
                "nodes:\n"
                "  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}\n"
                "  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}\n"
                "joints:\n  it: {type: " +
                    type + ", nodes: [a, b], position: [0.5, 0.2, 0.1], " + keys + second_axis + ", friction: {" +
                    friction + "}}\n",
                std::move(bad)};
  sample.scales.kinks_unloaded = true;  // |F|, |M| and |v| have kinks at zero
  sample.scales.smooth_within = 0.25;   // on the way there
  return sample;
}

/// Returns a point that rubs along a curve.
Sample rubbing_point(const std::string& variant, bool closed, const std::string& friction, std::vector<BadValue> bad) {
  bad.push_back({"friction.radius", "1", "does not turn"});
  bad.push_back({"nodes", "[a, a]", "two different nodes"});
  bad.push_back({"curve", "none.csv", "none.csv"});
  Sample sample{Section::joints, "point_on_curve", variant,
                "nodes:\n"
                "  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}\n"
                "  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}\n"
                "joints:\n  it: {type: point_on_curve, nodes: [a, b], position: [0.55, 0.2, 0.15], curve: points.csv, "
                "closed: " +
                    std::string(closed ? "true" : "false") + ", friction: {" + friction + "}}\n",
                std::move(bad)};
  // One piece, or five: finite differences stay within a piece, where the curve has all derivatives.
  sample.files = [closed](const std::string& folder) {
    std::ofstream(folder + "/points.csv") << (closed ? "0.2,0.1,0\n1.0,0.3,0.3\n1.2,1.0,0.2\n0.5,1.4,0\n-0.1,0.9,-0.2\n"
                                                     : "0.2,0.1,0\n1.0,0.3,0.3\n1.2,1.0,0.2\n0.5,1.4,0\n");
  };
  sample.scales.amplitude = 0.2;
  sample.scales.kinks_unloaded = true;
  sample.scales.smooth_within = 0.25;
  return sample;
}

/// Returns a slider that rubs on a beam.
Sample rubbing_slider(const std::string& variant, const std::string& orientation, const std::string& friction,
                      std::vector<BadValue> bad) {
  bad.push_back({"node", "a", "slide on itself"});
  bad.push_back({"beam", "shft", "did you mean 'shaft'"});
  Sample sample{
      Section::joints, "slider", variant,
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
          orientation + ", friction: {" + friction + "}}\n",
      std::move(bad)};
  sample.scales.amplitude = 0.1;  // within one element: the curvature jumps from one to the next
  sample.scales.kinks_unloaded = true;
  sample.scales.smooth_within = 0.25;
  return sample;
}

}  // namespace

std::vector<Sample> friction_samples() {
  const std::string axis = "axis: [1, 2, 3]";
  const std::string creeps = "coefficient: 0.3, static: 0.5, stribeck_velocity: 0.9, viscous: 0.2, velocity: 0.4";
  const std::string bristles =
      "model: lugre, coefficient: 0.4, static: 0.6, stribeck_velocity: 0.9, viscous: 0.1, bristle_stiffness: 1.5, "
      "bristle_damping: 0.7";
  const std::string sticks = "model: stick_slip, coefficient: 0.3, static: 0.5, viscous: 0.1, stribeck_velocity: 0.9";
  const std::string bearing = ", radius: 0.7, arm: 0.6, preload: 0.8";
  const std::vector<BadValue> law = {{"friction.static", "0.2", "no smaller"}},
                              of_creeping = {{"friction.stribeck_velocity", "0", ""},
                                             {"friction.bristle_stiffness", "5", "model: lugre"}},
                              of_bristles = {{"friction.stribeck_velocity", "0", ""},
                                             {"friction.velocity", "1", "model: coulomb"}},
                              of_bearing = {{"friction.radius", "", "radius"}};
  const auto all = [](std::initializer_list<std::vector<BadValue>> parts) {
    std::vector<BadValue> joined;
    for (const auto& part : parts) joined.insert(joined.end(), part.begin(), part.end());
    return joined;
  };
  std::vector<Sample> list;
  list.push_back(rubbing("hinge", "friction", axis, creeps + bearing, all({law, of_creeping, of_bearing})));
  list.push_back(rubbing("hinge", "bristles", axis, bristles + bearing, all({law, of_bristles, of_bearing})));
  list.push_back(rubbing("hinge", "stick and slip", axis, sticks + bearing, all({law, of_bearing})));
  list.push_back(rubbing("prismatic", "friction", axis, creeps + ", arm: 0.6",
                         all({law, of_creeping, {{"friction.radius", "1", "does not turn"}}})));
  list.push_back(rubbing("prismatic", "stick and slip", axis, sticks, law));
  // N of a planar joint is the size of one multiplier, whose kink random states meet with bristles.
  for (const char* type : {"cylindrical", "planar"})
    list.push_back(rubbing(type, "friction", axis, creeps + bearing, all({law, of_creeping, of_bearing})));
  list.push_back(rubbing("cylindrical", "bristles", axis, bristles + bearing, all({law, of_bristles, of_bearing})));
  list.push_back(rubbing("planar", "without widths", axis, "coefficient: 0.3, radius: 0.7", {}));
  list.back().bad.push_back({"friction.model", "stick_slip", "one coordinate"});
  list.push_back(rubbing("spherical", "friction", axis, creeps + ", radius: 0.7", all({law, of_creeping, {}})));
  list.push_back(rubbing("spherical", "bristles", axis, bristles + ", radius: 0.7", all({law, of_bristles, {}})));
  list.push_back(rubbing("screw", "friction", axis + ", pitch: 0.8", creeps + bearing,
                         all({law, of_creeping, of_bearing, {{"pitch", "0", "hinge"}, {"friction.radius", "0", ""}}})));
  list.push_back(rubbing("universal", "friction", axis, creeps + bearing, all({law, of_creeping, of_bearing})));
  list.push_back(rubbing("screw", "stick and slip", axis + ", pitch: 0.8", sticks + bearing,
                         all({law, of_bearing, {{"pitch", "0", "hinge"}, {"friction.radius", "0", ""}}})));
  list.push_back(rubbing("universal", "friction in one bearing", axis,
                         "angle_2: {coefficient: 0.3, radius: 0.4, velocity: 0.5}", {}));
  std::erase_if(list.back().bad, [](const BadValue& each) { return each.key.starts_with("friction."); });
  for (const BadValue& each : std::vector<BadValue>{{"friction.angle_2", "{coefficient: 0.3}", "radius"}})
    list.back().bad.push_back(each);
  list.push_back(rubbing("point_on_line", "friction", "line: [1, 2, 3]", creeps, all({law, of_creeping})));
  list.push_back(rubbing("point_on_plane", "bristles", "normal: [1, 2, 3]", bristles, all({law, of_bristles})));
  list.push_back(rubbing_point("friction", false, creeps, all({law, of_creeping})));
  list.push_back(rubbing_point("friction, closed", true, creeps + ", preload: 0.8", all({law, of_creeping, {}})));
  list.push_back(rubbing_point("bristles", true, bristles, all({law, of_bristles})));
  list.push_back(rubbing_point("stick and slip", true, sticks, law));
  list.push_back(rubbing_slider("friction", "free", creeps, all({law, of_creeping})));
  list.push_back(rubbing_slider("friction, tangent", "tangent", creeps + ", arm: 0.6", all({law, of_creeping, {}})));
  list.push_back(rubbing_slider("bristles", "tangent", bristles, all({law, of_bristles})));
  list.push_back(rubbing_slider("stick and slip", "free", sticks, law));
  return list;
}

}  // namespace bielle::laws
