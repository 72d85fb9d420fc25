// Load patterns on surfaces: the forces on their nodes, and their generalised forces on the reduced body.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reduce/fe/solid.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// The nodal forces of a pattern on its surface.
struct PatternForces {
  std::vector<int> nodes;
  Eigen::Matrix3Xd forces;  ///< [N] on each of the nodes
};

/// @throws InputError about the request: an unknown surface, a pressure on faces inside the body
PatternForces pattern_forces(const Mesh& mesh, const LoadRequest& request);

/// Reduced load patterns: row l of force[k] is sum over nodes of f_k,a times component l of T at node a.
/// @throws InputError as pattern_forces, and for two loads of the same name
std::map<std::string, LoadPattern> reduce_loads(const Solid& solid, const std::vector<LoadRequest>& requests,
                                                const RowMatrix& shapes);

}  // namespace bielle::reduce
