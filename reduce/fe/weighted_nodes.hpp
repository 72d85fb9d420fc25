// Nodes with weights in place of a surface: ties of decks (RBE2, RBE3, couplings) hold nodes, not faces.
#pragma once

#include <string>
#include <vector>

#include "reduce/fe/surface.hpp"

namespace bielle::reduce {

/// Sums over nodes, in the form of the integrals of a surface: `area` is the sum of the weights, and each node is a
/// point. There are no normals.
/// @param nodes    ascending
/// @param weights  one for each node, positive, in any unit
SurfaceIntegrals sum_over_nodes(const Mesh& mesh, std::vector<int> nodes, const Eigen::VectorXd& weights);

/// Integrals over a surface group, or sums over the nodes of a group of dimension 0.
/// @throws InputError as integrate_surface, or if the nodes stand in one line, about which their tie could turn; the
///         caller gives it a subject
SurfaceIntegrals integrate_tied(const Mesh& mesh, const std::string& group);

}  // namespace bielle::reduce
