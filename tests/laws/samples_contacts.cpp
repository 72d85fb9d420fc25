// Samples of contacts: each pair of shapes that can touch, pressed together so deeply that they touch in all random
// states of the laws.
#include <fstream>

#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

const std::string contact_law =
    "stiffness: 3, damping: 0.1, friction: {coefficient: 0.4, static: 0.6, stribeck_velocity: 2, velocity: 1.5, "
    "viscous: 0.1}";

/// Returns two nodes turned against each other, 1.4 m apart along z.
Sample touching(const std::string& variant, const std::string& shapes, std::vector<BadValue> bad,
                const std::string& law = contact_law) {
  Sample sample{Section::joints, "contact", variant,
                R"yaml(
nodes:
  a: {position: [0.1, 0.05, -0.1], rotation_vector: [0.1, -0.2, 0.3]}
  b: {position: [0.2, 0.1, 1.3], rotation_vector: [-0.2, 0.1, 0.2]}
joints:
  it: {type: contact, )yaml" +
                    shapes + ", " + law + "}\n",
                std::move(bad)};
  const bool between = shapes.rfind("between", 0) == 0;
  if (!between)
    sample.bad.insert(sample.bad.end(), {{"shapes", "[{node: a, sphere: 1}, {node: a, sphere: 1}]", "same node"}});
  sample.bad.insert(sample.bad.end(),
                    {{"friction.static", "0.1", "no smaller"}, {"friction.stribeck_velocity", "0", ""}});
  sample.scales.deformation = 0.12;
  sample.scales.smooth_within = 0.02;
  return sample;
}

const BadValue bad_node = {"shapes.0.node", "c", "no node 'c'"};

/// A roof of two triangles, in millimetres: a ridge along x at z = 0, open below.
void write_roof(const std::string& folder) {
  std::ofstream file(folder + "/roof.stl");
  file << "solid roof\n";
  const auto triangle = [&](const char* a, const char* b, const char* c) {
    file << " facet normal 0 0 0\n  outer loop\n   vertex " << a << "\n   vertex " << b << "\n   vertex " << c
         << "\n  endloop\n endfacet\n";
  };
  triangle("-5000 0 0", "5000 0 0", "0 5000 -2000");
  triangle("5000 0 0", "-5000 0 0", "0 -5000 -2000");
  file << "endsolid roof\n";
}

/// Adds shapes that lie across the ridge of the roof, stand on it, or are pressed from above.
void add_on_surfaces(std::vector<Sample>& list) {
  const auto on_roof = [&](const std::string& variant, const std::string& shape, std::vector<BadValue> bad) {
    list.push_back(touching(
        variant, "shapes: [{node: a, surface: roof.stl, units: mm, at: [0, 0, 0.3]}, {node: b, " + shape + "}]",
        std::move(bad)));
    list.back().files = write_roof;
  };
  on_roof("capsule, surface, across its ridge", "capsule: [1.4, 3], axes: {x: [0, 0, 1], y: [1, 0.3, 0]}", {});
  on_roof("capsule, surface, on its end",
          "capsule: [1.4, 2], axes: {x: [0.3, 1, 0], y: [0, 0.2, 1]}, at: [0.07, 1.1, 0.33]", {});
  on_roof("cylinder, surface, across its ridge",
          "cylinder: [1.5, 4], rounding: 0.7, axes: {x: [0, 0, 1], y: [1, 0.3, 0]}", {{"shapes.1.rounding", "2", ""}});
  on_roof("cylinder, surface, on its rim",
          "cylinder: [1.2, 2.6], rounding: 0.6, axes: {z: [0.4, 0.5, 1], x: [1, 0, 0]}", {});
  on_roof("box, surface", "box: [2, 1.8, 2.4], rounding: 0.7, axes: {x: [1, 0.3, 0.1], y: [0, 1, 0.2]}", {});
  on_roof("plane, surface", "plane: [0, 0.1, -1], at: [0, 0, -1.3]", {{"shapes.1.plane", "[0, 0, 0]", ""}});
}

void add_cylinders(std::vector<Sample>& list) {
  list.push_back(touching("cylinder, cylinder, crossing",
                          "shapes: [{node: a, cylinder: [0.9, 4], rounding: 0.4, axes: {x: [0, 0, 1], y: [0, 1, 0]}}, "
                          "{node: b, cylinder: [0.9, 3], rounding: 0.4, axes: {x: [0, 0, 1], y: [1, 0.2, 0]}}]",
                          {{"shapes.0.rounding", "1", ""}}));
  list.push_back(touching("cylinder, cylinder, nearly parallel",
                          "shapes: [{node: a, cylinder: [0.9, 2], rounding: 0.4, axes: {x: [0, 0, 1], y: [0, 1, 0]}}, "
                          "{node: b, cylinder: [0.9, 3], rounding: 0.4, axes: {x: [0, 0, 1], y: [0.1, 1, 0]}}]",
                          {}));
  list.push_back(touching("cylinder, cylinder, rim on side",
                          "shapes: [{node: a, cylinder: [0.9, 4], rounding: 0.6, axes: {x: [0, 0, 1], y: [0, 1, 0]}}, "
                          "{node: b, cylinder: [1.1, 1.6], rounding: 0.6, axes: {z: [0.6, 0.3, 1], x: [1, 0, 0]}}]",
                          {}));
  list.push_back(touching("cylinder, cylinder, standing",
                          "shapes: [{node: a, cylinder: [1, 1.6], rounding: 0.6}, {node: b, cylinder: [1.3, 1.8], "
                          "rounding: 0.7, at: [0.3, 0, 0]}]",
                          {}));
  list.push_back(touching("box, cylinder, lying",
                          "shapes: [{node: a, box: [3, 3, 1.6], rounding: 0.5}, {node: b, cylinder: [1, 2], rounding: "
                          "0.5, axes: {x: [0, 0, 1], y: [0.4, 1, 0]}}]",
                          {}));
  list.push_back(touching("box, cylinder, across an edge",
                          "shapes: [{node: a, box: [3, 1.4, 1.4], rounding: 0.5, axes: {x: [1, 0, 0], y: [0, 1, 1]}}, "
                          "{node: b, cylinder: [0.9, 4], rounding: 0.5, axes: {x: [0, 0, 1], y: [1, 0.3, 0]}}]",
                          {{"shapes.0.rounding", "1", ""}}));
  list.push_back(touching("box, cylinder, corner on an end",
                          "shapes: [{node: a, box: [1.6, 1.6, 1.6], rounding: 0.6, axes: {x: [1, 0.2, 1], y: [-1, 2, "
                          "1]}}, {node: b, cylinder: [1.5, 1.6], rounding: 0.6, at: [0.27, 0.08, 0.25]}]",
                          {{"shapes.1.cylinder", "[1, x]", ""}}));
}

}  // namespace

std::vector<Sample> contact_samples() {
  std::vector<Sample> list;
  list.push_back(touching("sphere, sphere", "shapes: [{node: a, sphere: 1.1, at: [0.1, 0, 0]}, {node: b, sphere: 0.9}]",
                          {bad_node, {"shapes", "[{node: a}, {node: b, sphere: 1}]", "give the shape"}}));
  list.push_back(touching("sphere, plane",
                          "shapes: [{node: a, plane: [0, 0.1, 1], at: [0, 0, 0.2]}, {node: b, sphere: 2}]",
                          {bad_node,
                           {"shapes.0.plane", "[0, 0, 0]", ""},
                           {"shapes", "[{node: a, plane: [0, 0, 1]}, {node: b, plane: [0, 0, 1]}]",
                            "a plane can touch: sphere, capsule, cylinder, box, surface"}}));
  list.push_back(touching("sphere, capsule",
                          "shapes: [{node: a, capsule: [1, 3], axes: {x: [0, 0, 1], y: [0.1, 1, 0]}}, "
                          "{node: b, sphere: 1}]",
                          {bad_node,
                           {"shapes.0.axes", "{x: [0, 0, 1]}", "two of the axes"},
                           {"shapes.0.axes.x", "[0, 0, 0]", ""},
                           {"shapes.0.axes.y", "[0, 0, 1]", "parallel"}}));
  for (const bool side : {true, false})
    list.push_back(touching(
        side ? "sphere, side of a cylinder" : "sphere, end of a cylinder",
        std::string("shapes: [{node: a, cylinder: [1.2, ") + (side ? "6" : "1.2") + "], rounding: 0.5, axes: {" +
            (side ? "x: [0, 0, 1], y: [0.1, 1, 0]" : "x: [1, 0, 0.1], y: [0, 1, 0]") + "}}, {node: b, sphere: 1}]",
        {{"shapes.0.rounding", "1.3", "less than half"},
         {"shapes", "[{node: a, surface: none.stl}, {node: b, cylinder: [1, 1]}]", "there is no such file"}}));
  list.push_back(touching("sphere, box",
                          "shapes: [{node: a, box: [1.2, 1.1, 1.3], rounding: 0.3}, {node: b, sphere: 1.2}]",
                          {{"shapes.0.rounding", "0.55", ""}}));
  list.push_back(touching("sphere, surface",
                          "shapes: [{node: a, surface: roof.stl, units: mm}, {node: b, sphere: 1.9}]",
                          {{"shapes.0.surface", "none.stl", "there is no such file"},
                           {"shapes.0.surface", "model.yaml", "no STL file"},
                           {"shapes", "[{node: a, surface: roof.stl}, {node: b, surface: roof.stl}]",
                            "a surface can touch: sphere, plane, capsule, cylinder, box"}}));
  list.back().files = write_roof;
  add_on_surfaces(list);
  add_cylinders(list);
  list.push_back(touching("capsule, plane",
                          "shapes: [{node: a, plane: [0, 0, 1]}, {node: b, capsule: [1.2, 2], at: "
                          "[0.1, 0, -1], axes: {x: [0, 0, 1], y: [0, 1, 0]}}]",
                          {}));
  list.push_back(touching("cylinder, plane, standing",
                          "shapes: [{node: a, plane: [0, 0, 1]}, {node: b, cylinder: [0.8, 2], at: [0, 0, -1]}]", {}));
  list.push_back(touching("cylinder, plane, lying",
                          "shapes: [{node: a, plane: [0, 0, 1], at: [0, 0, 1]}, {node: b, "
                          "cylinder: [1.2, 2], axes: {z: [1, 0, 0], y: [0, 1, 0]}}]",
                          {{"shapes.1.axes.z", "[0, 0, 0]", ""}}));
  list.push_back(touching("box, plane",
                          "shapes: [{node: a, plane: [0, 0, 1], at: [0, 0, 0.6]}, {node: b, box: [2, 1.5, 2.4]}]",
                          {{"shapes.1.box", "[1, 2, x]", ""}}));
  list.push_back(
      touching("capsule, capsule, crossing",
               "shapes: [{node: a, capsule: [0.9, 4], axes: {x: [0, 0, 1], y: [0, 1, 0]}}, {node: b, capsule: "
               "[0.9, 4], axes: {x: [0, 0, 1], y: [1, 0.2, 0]}}]",
               {}));
  list.push_back(
      touching("capsule, capsule, nearly parallel",
               "shapes: [{node: a, capsule: [0.9, 2], axes: {x: [0, 0, 1], y: [0, 1, 0]}}, {node: b, capsule: "
               "[0.9, 3], axes: {x: [0, 0, 1], y: [0.1, 1, 0]}}]",
               {}));
  list.push_back(touching("capsule, side of a cylinder",
                          "shapes: [{node: a, cylinder: [1.2, 5], rounding: 0.4, axes: {x: [0, 0, 1], y: [0, 1, 0]}}, "
                          "{node: b, capsule: [0.9, 4], axes: {x: [0, 0, 1], y: [1, 0.4, 0]}}]",
                          {{"shapes.0.rounding", "1.2", ""}}));
  list.push_back(touching("capsule, rim of a cylinder",
                          "shapes: [{node: a, capsule: [0.9, 5], axes: {x: [0, 0, 1], y: [0.2, 1, 0]}}, {node: b, "
                          "cylinder: [1.2, 1.6], rounding: 0.4, axes: {z: [0.5, 0.1, 1], x: [1, 0, 0]}}]",
                          {}));
  list.push_back(touching("capsule, nearly parallel to a cylinder",
                          "shapes: [{node: a, cylinder: [1.1, 4], rounding: 0.4, axes: {x: [0, 0, 1], y: [0, 1, 0]}}, "
                          "{node: b, capsule: [0.9, 3], axes: {x: [0, 0, 1], y: [0.05, 1, 0]}}]",
                          {}));
  list.push_back(touching("capsule, box",
                          "shapes: [{node: a, box: [3, 2, 1.6], rounding: 0.6}, {node: b, capsule: [0.9, 2.5], "
                          "axes: {x: [0, 0, 1], y: [0.5, 1, 0]}}]",
                          {{"shapes.0.rounding", "1", ""}}));
  list.push_back(touching("box, box, faces",
                          "shapes: [{node: a, box: [2, 2.2, 1.6], rounding: 0.7}, {node: b, box: [3, 2.6, "
                          "1.7], rounding: 0.7}]",
                          {}));
  list.push_back(
      touching("box, box, edges",
               "shapes: [{node: a, box: [3, 1.6, 1.6], rounding: 0.7, axes: {x: [1, 0, 0], y: [0, 1, 1]}}, {node: "
               "b, box: [1.6, 3, 1.6], rounding: 0.7, axes: {x: [1, 0, 1], y: [0, 1, 0]}}]",
               {}));
  // The damping follows from the speed at which the shapes touch; there is no damping before that.
  list.push_back(
      touching("restitution, groups",
               "between: [[{node: a, sphere: 0.9}, {node: a, sphere: 1, at: [1, 0, 0]}], [{node: b, sphere: 1}, "
               "{node: ground, plane: [0, 0, 1], at: [0, 0, -0.2]}]], exponent: 2, restitution: 0.6",
               {{"between", "[[{node: a, sphere: 1}], [{node: a, sphere: 1}]]", "same node"},
                {"between.0.0.node", "c", "no node"},
                {"shapes", "[{node: a, sphere: 1}, {node: b, sphere: 1}]", "either `shapes`"},
                {"damping", "1", "either `damping` or `restitution`"}},
               "stiffness: 3, friction: {coefficient: 0.4, static: 0.6, stribeck_velocity: 2, velocity: 1.5, "
               "viscous: 0.1}"));
  // Bristles that have bent within a step: tests/benchmarks/contacts/test_bristles.cpp.
  list.push_back(touching("bristles",
                          "shapes: [{node: a, capsule: [0.9, 4], axes: {x: [0, 0, 1], y: [0, 1, 0]}}, {node: b, "
                          "capsule: [0.9, 4], axes: {x: [0, 0, 1], y: [1, 0.2, 0]}}]",
                          {{"friction.bristle_stiffness", "", ""}, {"friction.velocity", "1", "model: coulomb"}},
                          "stiffness: 3, damping: 0.1, friction: {model: lugre, coefficient: 0.4, static: 0.6, "
                          "stribeck_velocity: 2, viscous: 0.1, bristle_stiffness: 1.5, bristle_damping: 0.8}"));
  // Surfaces whose material moves on their bodies, and rolling resistance.
  list.push_back(touching(
      "belts and rolling resistance",
      "shapes: [{node: a, sphere: 1.1, at: [0.1, 0, 0], velocity: [0.5, -0.4, 0.3], angular_velocity: [0.2, 0.3, "
      "-0.6]}, "
      "{node: b, box: [1.2, 1.1, 1.3], rounding: 0.3, angular_velocity: [-0.5, 0.1, 0.7]}], rolling_resistance: 0.3, "
      "rolling_rate: 1.2",
      {{"friction.model", "lugre", ""},
       {"friction", "", "has an effect only with `friction`"},
       {"rolling_resistance", "", "belongs to a `rolling_resistance`"}}));
  // Quantities of a contact in formulas: a spring between the nodes uses them.
  Sample measured{Section::elements,
                  "spring_damper",
                  "measures of a contact",
                  R"yaml(
nodes:
  a: {position: [0.1, 0.05, -0.1], rotation_vector: [0.1, -0.2, 0.3]}
  b: {position: [0.2, 0.1, 1.3], rotation_vector: [-0.2, 0.1, 0.2]}
joints:
  c: {type: contact, shapes: [{node: a, sphere: 1.1, at: [0.1, 0, 0]}, {node: b, box: [1.2, 1.1, 1.3], rounding: 0.3}], )yaml" +
                      contact_law + R"yaml(}
elements:
  it: {type: spring_damper, nodes: [a, b], at: [[0.2, 0.1, -0.3], [0.1, 0.3, 0.2]], force: "2*c.gap + 0.3*c.force.x - 0.2*c.force.y*c.gap + 0.4*c.force.z + 0.1*c.force + c.touching"}
)yaml",
                  {{"nodes", "[a, a]", "two different nodes"},
                   {"nodes", "[a, c]", "no node 'c'"},
                   {"force", "c.gapp", "did you mean 'gap'"}}};
  measured.inertial = true;  // components of the force
  measured.scales.deformation = 0.12;
  measured.scales.smooth_within = 0.02;
  list.push_back(std::move(measured));
  return list;
}

}  // namespace bielle::laws
