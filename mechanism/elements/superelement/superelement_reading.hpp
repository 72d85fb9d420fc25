// Common functions of the readers of whole superelements and of bodies in pieces.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/superelement/superelement_body.hpp"

namespace bielle::mechanism {

/// Reads C~ from `damping: {ratio: ..}` or `{rayleigh: ..}`, which replaces that of the file.
MatrixX read_superelement_damping(const YamlValue& damping, const Superelement& body);

/// Reads `frame: mean`, `frame: mean_axes` or `frame: {interface: name}`.
void read_body_frame(const YamlValue& frame, const Superelement& body, SuperelementPlacement& setup);

/// Reads `loads: {pattern: factor}`, for patterns of the body.
std::vector<SuperelementPlacement::Load> read_superelement_loads(const YamlValue& loads, const Superelement& body);

/// Nodes of a body whose start motion determines that of its other nodes.
struct RigidlyFollowed {
  std::vector<int> nodes;
  /// For each node, whether it rotates with the body; false for an interface that only transmits forces.
  std::vector<bool> turns;
  double size = 0;  ///< size of the body [m]: lever arm for rotations
  void add(int node, bool rotation) {
    nodes.push_back(node);
    turns.push_back(rotation);
  }
};

/// Sets the start motion of a node to the rigid motion that is closest to the motions of the nodes in `followed`; if
/// there are none, the node is not changed.
void follow_rigidly(int node, const RigidlyFollowed& followed, Model& model);

/// Returns the model's node of each interface: the nodes under the key `nodes`, which must be at the interfaces, and
/// new nodes `<name>.<interface>` for the other interfaces, which start with the rigid motion of the given nodes.
std::vector<int> read_interface_nodes(const std::string& name, const YamlValue& entry, const Superelement& body,
                                      const Frame& placement, Model& model);

/// Returns the placement of the body on its nodes, without loads.
/// @param nodes  nodes of its interfaces @param placement  frame of the mesh's origin and axes
SuperelementPlacement place_superelement(std::vector<int> nodes, const Frame& placement, const Model& model);

/// Reads one entry with a body that is cut into pieces; see superelement_pieces_reader.cpp.
void read_superelement_pieces(const std::string& name, const YamlValue& entry, const std::string& path, Model& model);

}  // namespace bielle::mechanism
