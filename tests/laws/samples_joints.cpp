// Samples of joints and drives.
#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

/// Two nodes turned against each other; the joint's axes are those of neither.
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
                                         {"position", "[1, 2]", ""},
                                         {"axis", "[0, 0, 0]", ""},
                                         {"second_axis", "[1, 2, 3]", ""}};

Sample lower_pair(const std::string& type) {
  return {Section::joints, type, "",
          pair("  it: {type: " + type +
               ", nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3], second_axis: [0, 1, -1]}\n"),
          bad_joint};
}

Sample drive(const std::string& joint_type, const std::string& law, const std::string& value,
             std::vector<BadValue> bad) {
  bad.push_back({"joint", "axis", "no 'axis'"});
  bad.push_back({law, "'x*t'", "x"});
  return {Section::drives, "drive", law + " of a " + joint_type,
          pair("  axle: {type: " + joint_type + ", nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3]}\n",
               "drives:\n  it: {joint: axle, " + law + ": \"" + value + "\"}\n"),
          std::move(bad)};
}

}  // namespace

std::vector<Sample> joint_samples() {
  std::vector<Sample> list;
  for (const char* type : {"rigid", "hinge", "prismatic", "cylindrical", "spherical", "planar"})
    list.push_back(lower_pair(type));
  list.push_back(drive("hinge", "angle", "0.3*t + 0.1*sin(t)", {}));
  list.push_back(drive("prismatic", "displacement", "0.3*t^2", {}));
  list.push_back(drive("hinge", "rate", "0.3*cos(t)", {}));
  list.push_back(drive("prismatic", "speed", "0.3*t", {}));
  list.push_back(drive("hinge", "torque", "2 + t", {}));
  list.push_back(drive("cylindrical", "force", "2 + t", {}));
  return list;
}

}  // namespace bielle::laws
