#include "mechanism/io/idle_joints.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {
namespace {

/// Returns whether a node is fixed in all directions, without a motion.
bool stands_still(const Node& node) {
  return std::all_of(node.freedom.begin(), node.freedom.end(), [](Freedom f) { return f == Freedom::fixed; });
}

}  // namespace

void warn_of_idle_joints(const Model& model, const YamlValue& root) {
  for (const Member& member : model.members()) {
    const auto* joint = dynamic_cast<const Joint*>(member.component.get());
    if (joint == nullptr || member.entry.section != Section::joints) continue;
    const int first = joint->frames().first, second = joint->frames().second;
    const int carries_first = model.root_carrier(first), carries_second = model.root_carrier(second);
    const char* why = nullptr;
    if (carries_first == carries_second)
      why = "belong to the same rigid part";
    else if (stands_still(model.node(carries_first)) && stands_still(model.node(carries_second)))
      why = "are both held";
    if (why == nullptr) continue;
    root.at("joints")
        .at(member.entry.name)
        .warn(fmt::format(
            "its nodes '{}' and '{}' {}: it holds nothing that could move; a part that it should connect needs a "
            "node of its own",
            model.node(first).name, model.node(second).name, why));
  }
}

}  // namespace bielle::mechanism
