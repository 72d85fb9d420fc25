// What the superelement keeps of the mesh: load patterns, displacement and stress recovery, and the mesh to draw it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reduce/fe/solid.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/spectral/symmetric_matrix.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Reduced load patterns: row l of force[k] is sum over nodes of f_k,a times component l of T at node a.
/// @throws InputError, with the place of the request: no such surface, a pressure on faces inside the body
std::map<std::string, LoadPattern> reduce_loads(const Solid& solid, const std::vector<LoadRequest>& requests,
                                                const RowMatrix& shapes);

/// Fills mesh, displacement_recovery, stress_recovery and stress_nodes.
/// @throws InputError when stress is wanted at nodes whose displacements are not kept
void add_recovery(const Solid& solid, const ReductionOptions& options, const RowMatrix& shapes, int threads,
                  Superelement& result);

}  // namespace bielle::reduce
