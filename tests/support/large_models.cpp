#include "tests/support/large_models.hpp"

#include <fmt/format.h>

namespace bielle::test {
namespace {

/// Sections of a mechanism file, filled side by side.
struct Sections {
  std::string nodes, elements, joints, drives, measures;

  void body(int k, double x, double z) {
    nodes += fmt::format("  n{}: {{position: [{}, 0, {}]}}\n", k, x, z);
    elements += fmt::format("  e{0}: {{type: rigid_body, node: n{0}, mass: 1, inertia: [1e-3, 0.08, 0.08]}}\n", k);
  }
  /// @param first  number of a body, or -1: the ground
  void joint(const std::string& name, const char* type, int first, int second, double x, double z) {
    joints += fmt::format("  {}: {{type: {}, nodes: [{}, n{}], position: [{}, 0, {}]}}\n", name, type,
                          first < 0 ? "ground" : fmt::format("n{}", first), second, x, z);
  }
  std::string text() const {
    std::string text = "gravity: [9.81, 0, 0]\n";
    const auto add = [&](const char* name, const std::string& entries) {
      if (!entries.empty()) text += fmt::format("{}:\n{}", name, entries);
    };
    add("nodes", nodes);
    add("elements", elements);
    add("joints", joints);
    add("drives", drives);
    add("measures", measures);
    return text;
  }
};

constexpr const char* hinge = "hinge, axis: [0, 1, 0]";

}  // namespace

std::string hinged_links(int n) {
  Sections sections;
  for (int k = 0; k < n; ++k) {
    sections.body(k, k + 0.5, 0);
    sections.joint(fmt::format("j{}", k), "hinge, axis: [0, 1, 0], stiffness: 1000", k - 1, k, k, 0);
  }
  return sections.text();
}

std::string driven_links(int n) {
  Sections sections;
  for (int k = 0; k < n; ++k) {
    sections.body(k, k + 0.5, 0);
    sections.joint(fmt::format("j{}", k), hinge, k - 1, k, k, 0);
    sections.drives += fmt::format("  d{0}: {{joint: j{0}, angle: \"1e-3*t^2\"}}\n", k);
    sections.measures += fmt::format("  m{0}: \"2*j{0}.angle\"\n", k);
  }
  return sections.text();
}

std::string masses_on_joints(int n) {
  Sections sections;
  for (int k = 0; k < n; ++k) {
    const bool last = k == n - 1;
    sections.nodes += fmt::format("  n{}: {{position: [{}, 0, 0]}}\n", k, k);
    sections.elements += fmt::format("  e{0}: {{type: {1}, node: n{0}, mass: 1, centre: [0.5, 0, -0.1]{2}}}\n", k,
                                     last ? "rigid_body" : "point_mass", last ? ", inertia: [0.01, 0.01, 0.01]" : "");
    sections.joint(fmt::format("j{}", k), "spherical", k - 1, k, k, 0);
  }
  return sections.text();
}

std::string masses_on_springs(int n) {
  Sections sections;
  for (int k = 0; k < n; ++k) {
    sections.nodes += fmt::format("  n{}: {{position: [{}, 0, 0], fixed: [rx, ry, rz]}}\n", k, k + 1);
    sections.elements += fmt::format("  e{0}: {{type: point_mass, node: n{0}, mass: 1}}\n", k);
    sections.elements += fmt::format(
        "  s{0}: {{type: spring_damper, nodes: [{1}, n{0}], stiffness: 1e4, damping: 1, "
        "length: 0.9}}\n",
        k, k == 0 ? "ground" : fmt::format("n{}", k - 1));
  }
  return sections.text();
}

std::string beam_of_elements(int n) {
  return fmt::format(R"yaml(
gravity: [0, 0, -0.01]
nodes: {{a: {{position: [0, 0, 0], fixed: true}}, b: {{position: [100, 0, 0]}}}}
elements:
  beam: {{type: beam, nodes: [a, b], elements: {}, section: {{circle: 0.5, young: 2.1e11, poisson: 0.3, density: 7800}}}}
)yaml",
                     n);
}

std::string ladder_of_loops(int n) {
  Sections sections;
  // Bodies 3k, 3k+1, 3k+2: upper bar, lower bar, rung of loop k.
  for (int k = 0; k < n; ++k) {
    sections.body(3 * k, k + 0.5, 1);
    sections.body(3 * k + 1, k + 0.5, 0);
    sections.body(3 * k + 2, k + 1, 0.5);
  }
  for (const int side : {0, 1}) {
    const double z = 1 - side;
    const char* name = side == 0 ? "upper" : "lower";
    for (int k = 0; k < n; ++k) {
      sections.joint(fmt::format("{}{}a", name, k), "hinge, axis: [0, 1, 0], stiffness: 1000", 3 * k - 1, 3 * k + side,
                     k, z);
      sections.joint(fmt::format("{}{}b", name, k), hinge, 3 * k + side, 3 * k + 2, k + 1, z);
    }
  }
  return sections.text();
}

std::string links_of_parts(int n) {
  return fmt::format(R"yaml(gravity: [9.81, 0, 0]
definitions:
  link:
    parameters: {{length: 1, mass: length}}
    nodes:
      root: {{}}
      middle: {{position: [length/2, 0, 0]}}
      end: {{position: [length, 0, 0], carried_by: body}}
      anchor: {{position: [length, 0, -1], fixed: true}}
    elements:
      body: {{type: rigid_body, node: middle, mass: mass, inertia: [1e-3, 0.08*mass, 0.08*mass]}}
      spring: {{type: spring_damper, nodes: [anchor, end], stiffness: 1000}}
    joints:
      pivot: {{type: hinge, nodes: [root, middle], position: [0, 0, 0], axis: [0, 1, 0]}}
    measures: {{angle: pivot.angle}}
nodes: {{link_0.end: {{fixed: true}}}}
parts:
  "link_{{k}}":
    repeat: {{count: {}, as: k}}
    part: link
    position: [k-1, 0, 0]
    merge: {{root: "link_{{k-1}}.end"}}
)yaml",
                     n);
}

const std::vector<LargeModel>& large_models() {
  static const std::vector<LargeModel> models = {
      {"hinges", "rigid links on hinges with springs", hinged_links},
      {"driven", "rigid links on driven hinges, each measured", driven_links},
      {"joints", "masses off their nodes on spherical joints", masses_on_joints, false},
      {"springs", "point masses on springs", masses_on_springs},
      {"beam", "a beam of n elements", beam_of_elements},
      {"loops", "a ladder of planar four-bars", ladder_of_loops},
      {"parts", "links that are placed parts, with merged nodes", links_of_parts},
  };
  return models;
}

}  // namespace bielle::test
