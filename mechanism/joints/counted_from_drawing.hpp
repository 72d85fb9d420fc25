// Check for components that count turns from the initial positions and do not know the joints that carry their nodes.
#pragma once

#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

/// Rejects joints of some nodes that start beyond half a turn from their initial positions: meshes of teeth and ropes
/// would miss the turns. The check runs after all entries have been read.
/// @param nodes  nodes of wheels or pulleys
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
