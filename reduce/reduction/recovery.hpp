// The superelement's data of the mesh: displacement and stress recovery, and the mesh for drawing.
#pragma once

#include "reduce/fe/solid.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Fills mesh, displacement_recovery, stress_recovery, stress_nodes and stress_origin.
/// @throws InputError if stress is requested at nodes whose displacements are not kept
void add_recovery(const Solid& solid, const ReductionOptions& options, const RowMatrix& shapes, int threads,
                  Superelement& result);

}  // namespace bielle::reduce
