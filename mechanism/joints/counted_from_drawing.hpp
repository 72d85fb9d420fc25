// Turns that are counted from where a model is drawn, by components that know nothing of the joints which bear them.
#pragma once

#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

/// Refuses joints of some nodes that start beyond half a turn from where they are drawn: meshes of teeth and ropes
/// would not know of the turns. Looks when all entries are read.
/// @param nodes  wheels, pulleys
inline void refuse_starts_beyond_half_a_turn(const YamlValue& entry, std::vector<int> nodes, Model& model) {
  model.when_read(Model::Stage::formulas, [entry, nodes = std::move(nodes), &model] {
    for (const Member& member : model.members()) {
      const auto* joint = dynamic_cast<const Joint*>(member.component.get());
      if (joint == nullptr) continue;
      bool bears = false;
      for (const int node : nodes)
        bears = bears || (node != 0 && (node == joint->frames().first || node == joint->frames().second));
      if (!bears || nodes.empty()) continue;
      for (std::size_t k = 0; k < joint->coordinates().size(); ++k)
        if (joint->coordinates()[k].kind == JointCoordinate::Kind::angle && std::abs(joint->starts_at(k)) > M_PI)
          entry.fail(
              fmt::format("counts turns from where the model is drawn, and joint '{}' starts {:.6g} rad from there: "
                          "start within half a turn (pi)",
                          joint->name(), joint->starts_at(k)));
    }
  });
}

}  // namespace bielle::mechanism
