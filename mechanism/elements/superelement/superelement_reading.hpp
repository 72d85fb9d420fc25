// What the readers of whole superelements and of bodies in pieces share.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/superelement/superelement_body.hpp"

namespace bielle::mechanism {

/// Checks the keys of `name: {type: superelement, ...}`.
void check_superelement_keys(const YamlValue& entry);

/// C~ of `damping: {ratio: ..}` or `{rayleigh: ..}`, in place of the file's.
MatrixX read_superelement_damping(const YamlValue& damping, const Superelement& body);

/// `frame: mean`, `frame: mean_axes` or `frame: {interface: name}`.
void read_body_frame(const YamlValue& frame, const Superelement& body, SuperelementPlacement& setup);

/// `loads: {pattern: factor}`, of the patterns that the body has.
std::vector<SuperelementPlacement::Load> read_superelement_loads(const YamlValue& loads, const Superelement& body);

/// Nodes of a body that others of it follow where a motion begins.
struct RigidlyFollowed {
  std::vector<int> nodes;
  std::vector<bool> turns;  ///< of each, whether its rotation is the body's: it is not where it carries forces alone
  double size = 0;          ///< of the body [m]: rotations count at this arm
  void add(int node, bool rotation) {
    nodes.push_back(node);
    turns.push_back(rotation);
  }
};

/// A node starts with the rigid motion that is nearest to those of others; where there are none, as it is.
void follow_rigidly(int node, const RigidlyFollowed& followed, Model& model);

/// The model's node of each interface: those under `nodes`, which must stand where the interfaces are, and new ones
/// `<name>.<interface>` for the others, which start with the rigid motion of the named ones.
std::vector<int> read_interface_nodes(const std::string& name, const YamlValue& entry, const Superelement& body,
                                      const Frame& placement, Model& model);

/// How the body stands on its nodes, without loads.
/// @param nodes  of its interfaces @param placement  of the mesh's origin and axes
SuperelementPlacement place_superelement(std::vector<int> nodes, const Frame& placement, const Model& model);

/// A body that is cut into pieces, in one entry; see superelement_pieces_reader.cpp.
void read_superelement_pieces(const std::string& name, const YamlValue& entry, const std::string& path, Model& model);

}  // namespace bielle::mechanism
