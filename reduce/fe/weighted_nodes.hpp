// Nodes with weights in place of a surface: ties of decks (RBE2, RBE3, couplings) hold nodes, not faces.
#pragma once

#include <string>

#include "reduce/fe/surface.hpp"

namespace bielle::reduce {

/// Sums over the nodes of a group of dimension 0, in the form of the integrals of a surface: `area` is the sum of the
/// weights, and each node is a point. There are no normals.
/// @throws InputError if the nodes stand in one line, about which their tie could turn; the caller gives it a subject
SurfaceIntegrals sum_over_nodes(const Mesh& mesh, const Group& nodes);

/// Integrals over a surface group, or sums over a group of nodes. @throws as integrate_surface and sum_over_nodes
SurfaceIntegrals integrate_tied(const Mesh& mesh, const std::string& group);

}  // namespace bielle::reduce
