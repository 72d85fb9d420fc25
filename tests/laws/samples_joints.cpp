// Samples of joints and of actions in them.
#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

/// Returns two nodes turned against each other; the joint's axes are those of neither.
std::string pair(const std::string& joint, const std::string& more = "") {
  return R"yaml(
nodes:
  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}
joints:
)yaml" + joint +
         more;
}

const std::vector<BadValue> bad_joint = {{"nodes", "[a, a]", "two different nodes"},
                                         {"nodes", "[a, c]", "no node 'c'"},
                                         {"axis", "[0, 0, 0]", ""},
                                         {"second_axis", "[1, 2, 3]", ""}};

Sample lower_pair(const std::string& type) {
  return {Section::joints, type, "",
          pair("  it: {type: " + type +
               ", nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3], second_axis: [0, 1, -1]}\n"),
          bad_joint};
}

/// Actions in a joint with one coordinate; the components have the joint's name.
Sample with_actions(const std::string& type, const std::string& variant, const std::string& keys,
                    std::vector<BadValue> bad) {
  for (const BadValue& each : bad_joint)
    if (each.key != "second_axis") bad.push_back(each);
  return {Section::joints, type, variant,
          pair("  it: {type: " + type + ", nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3], " + keys + "}\n"),
          std::move(bad)};
}

/// Returns the values of springs that this model makes wrong; for a joint with several coordinates those of
/// `coordinate`.
std::vector<BadValue> bad_actions(const std::string& coordinate = "") {
  const std::string of = coordinate.empty() ? "" : "." + coordinate;
  std::vector<BadValue> bad = {{"rest" + of, "much", ""}, {"preload" + of, "'5*x'", "x"}};
  if (!coordinate.empty())
    for (const char* key : {"stiffness", "damping", "rest", "preload"})
      bad.push_back({key, "5", "several coordinates"});
  return bad;
}

}  // namespace

std::vector<Sample> joint_samples() {
  std::vector<Sample> list;
  for (const char* type : {"rigid", "hinge", "prismatic", "cylindrical", "spherical", "planar"})
    list.push_back(lower_pair(type));
  // Springs, dampers and locks on each coordinate of each type. (test_joint_stop.cpp tests stops in contact.)
  std::vector<BadValue> of_hinge = bad_actions();
  for (const BadValue& each : std::vector<BadValue>{{"stops", "{range: [1, -1], stiffness: 5}", "lower end first"},
                                                    {"locked", "{to: 1, until: 2}", "until"},
                                                    {"locked.from", "-1", ""},
                                                    {"locked.to", "0.05", "after"},
                                                    {"locked.release", "0", ""}})
    of_hinge.push_back(each);
  list.push_back(
      with_actions("hinge", "spring, stops, lock",
                   "stiffness: 3, damping: 0.5, rest: 0.2, preload: 1.5, stops: {range: [-9, 9], stiffness: 5, "
                   "damping: 1}, locked: {from: 0.1, to: 0.2, release: 4}",
                   of_hinge));
  list.push_back(with_actions(
      "hinge", "clutch",
      "clutch: {normal_force: \"3 + sin(t) + 0.3*it.angle^2 + 0.2*it.angle.rate^2\", coefficient: 0.4, radius: 0.8, "
      "surfaces: 2, static_ratio: 1.2}",
      {{"clutch", "{capacity: -1}", "at least 0"},
       {"clutch", "{capacity: 1, normal_force: 1}", "either"},
       {"clutch", "{static_ratio: 1.1}", "either"},
       {"clutch", "{normal_force: 1, radius: 1}", "`coefficient`"},
       {"clutch", "{normal_force: 1, coefficient: 1}", "`radius`"},
       {"clutch", "{capacity: 1, radius: 1}", "belongs to the `normal_force`"},
       {"clutch", "{capacity: it.angel}", "did you mean 'angle'"}}));
  list.push_back(with_actions("prismatic", "one-way, rigid",
                              "one_way: {direction: backwards, pitch: 0.1}, clutch: {capacity: 2}",
                              {{"one_way", "{damping: 1}", "needs the `stiffness`"},
                               {"clutch", "{normal_force: 1, coefficient: 1, radius: 1}", "that turns"}}));
  list.push_back(with_actions("hinge", "one-way, elastic", "one_way: {stiffness: 3, damping: 0.4}", {}));
  // A lock that events close and open.
  list.push_back({Section::joints,
                  "hinge",
                  "locked by events",
                  pair("  it: {type: hinge, nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3], locked: {from: "
                       "{event: there}, to: {event: back}, release: 4}, active: false}\n",
                       "events:\n  there: {when: it.angle, crosses: 1}\n  back: {when: it.angle, crosses: 0.5, do: "
                       "[{lock: it}, {activate: it}]}\n"),
                  {{"locked.from", "{event: the}", "no 'the' among the events"}}});
  // A point and axes in each node's own axes; and a start, whose values and rates are conditions, not components.
  list.push_back(
      {Section::joints,
       "hinge",
       "at, start",
       pair("  it: {type: hinge, nodes: [a, b], at: [[0.2, 0.1, 0.3], [-0.6, -0.2, -0.1]], axis: [[1, 2, 3], [3, 1, "
            "2]], second_axis: [[0, 1, -1], [1, 0, 0]], start: 0.3, start_rate: 0.2}\n"),
       {{"nodes", "[a, a]", "two different nodes"},
        {"position", "[0, 0, 0]", "give one of them"},
        {"axis", "[[1, 2, 3], [0, 0, 0]]", ""},
        {"second_axis", "[[0, 1, -1], [3, 1, 2]]", "parallel"},
        {"start", "much", ""},
        {"start", "{turn: 0.3}", ""},
        {"start_rate", "'x'", ""}}});
  list.push_back(with_actions("cylindrical", "start", "start: {displacement: 0.1, angle: 4}, start_rate: {angle: 1}",
                              {{"start", "1", "several coordinates"},
                               {"start", "{turn: 1}", "turn"},
                               {"start.displacement", "far", ""},
                               {"start.angle", "'x'", ""},
                               {"start_rate", "1", "several coordinates"}}));
  list.push_back(with_actions("spherical", "start", "start: {rx: 0.1}",
                              {{"start", "{r: 0.1}", "r"}, {"start.rx", "3.2", "half a turn"}}));
  list.push_back(with_actions("rigid", "no start", "second_axis: [0, 1, 0]",
                              {{"second_axis", "[1, 2, 3]", ""},
                               {"start", "0.1", "no coordinate"},
                               {"start_rate", "{angle: 0.1}", "no coordinate"}}));
  list.push_back(with_actions("prismatic", "formulas", "stiffness: \"3*q + 2*q^3\", damping: \"0.5*v + 0.1*v^3\"",
                              {{"stiffness", "'3*x'", "x"}, {"damping", "'w'", "w"}}));
  list.push_back(with_actions("hinge", "actuator", "stiffness: \"3*q*(1 + 0.2*sin(t)) + 0.5*v\"", {}));
  list.push_back(with_actions("cylindrical", "springs",
                              "stiffness: {displacement: 4, angle: \"2*q + q^2*v\"}, damping: {angle: 0.3}, rest: "
                              "{displacement: 0.1}, preload: {angle: 1}, locked: {angle: {from: 1}}",
                              {{"stiffness", "4", "several coordinates"},
                               {"stiffness.angle", "'x'", "x"},
                               {"damping", "{turn: 1}", "turn"},
                               {"rest.displacement", "far", ""},
                               {"stiffness", "", "give its `stiffness`"},
                               {"preload", "1", "several coordinates"},
                               {"preload.angle", "'q'", "q"},
                               {"locked", "{from: 1}", "from"},
                               {"locked.angle", "{to: 0}", "after"}}));
  list.push_back(with_actions(
      "planar", "springs", "stiffness: {x: 4, y: \"3*q + q^3\", angle: 2}, damping: {x: 0.2, y: 0.4, angle: 0.3}",
      {{"stiffness", "{z: 4}", "z"}, {"stiffness.y", "'x'", "x"}, {"damping", "1", "several coordinates"}}));
  list.push_back(with_actions(
      "spherical", "springs", "stiffness: {rx: 4, ry: \"3*q + q^3\", rz: 2}, damping: {rx: 0.2, ry: 0.4, rz: 0.3}",
      {{"stiffness", "{r: 4}", "r"}, {"stiffness.ry", "'x'", "x"}, {"damping", "1", "several coordinates"}}));
  return list;
}

}  // namespace bielle::laws
