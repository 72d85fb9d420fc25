// Common functions of the readers of joints between two nodes.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/joints/actions/joint_actions.hpp"
#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

/// Adds the joint, and the actions in its entry. @param own  as read_joint_actions @returns the added joint
inline Joint& add_pair(std::unique_ptr<Joint> made, const YamlValue& entry, Model& model,
                       const std::vector<std::string>& own = {}) {
  Joint& joint = *made;
  model.add(std::move(made), Entry{Section::joints, joint.name()});
  read_joint_actions(entry, joint, model, own);
  return joint;
}

}  // namespace bielle::mechanism
