// Common functions of the readers of whole superelements and of bodies in pieces.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/superelement/superelement_body.hpp"

namespace bielle::mechanism {

/// Reads C~ from `damping: {ratio: ..}` or `{rayleigh: ..}`, instead of the file's.
MatrixX read_superelement_damping(const YamlValue& damping, const Superelement& body);

/// Reads `frame: mean`, `frame: mean_axes` or `frame: {interface: name}`.
void read_body_frame(const YamlValue& frame, const Superelement& body, SuperelementPlacement& setup);

/// Reads `loads: {pattern: factor}`, for the patterns that the body has.
std::vector<SuperelementPlacement::Load> read_superelement_loads(const YamlValue& loads, const Superelement& body);

/// Nodes of a body that others of it follow at the start of a motion.
struct RigidlyFollowed {
  std::vector<int> nodes;
  std::vector<bool> turns;  ///< for each node, whether it rotates with the body: false if it only transmits forces
  double size = 0;          ///< size of the body [m]: lever arm for rotations
  void add(int node, bool rotation) {
    nodes.push_back(node);
    turns.push_back(rotation);
  }
};

/// Starts a node with the rigid motion that is closest to those of others; without any, it is not changed.
void follow_rigidly(int node, const RigidlyFollowed& followed, Model& model);

/// Returns the model's node of each interface: those under `nodes`, which must be at the interfaces, and new ones
/// `<name>.<interface>` for the others, which start with the rigid motion of the named ones.
std::vector<int> read_interface_nodes(const std::string& name, const YamlValue& entry, const Superelement& body,
                                      const Frame& placement, Model& model);

/// Returns the placement of the body on its nodes, without loads.
/// @param nodes  nodes of its interfaces @param placement  frame of the mesh's origin and axes
SuperelementPlacement place_superelement(std::vector<int> nodes, const Frame& placement, const Model& model);

/// Reads a body that is cut into pieces, in one entry; see superelement_pieces_reader.cpp.
void read_superelement_pieces(const std::string& name, const YamlValue& entry, const std::string& path, Model& model);

}  // namespace bielle::mechanism
