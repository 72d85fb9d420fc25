// The reduction of a mesh to a superelement, as the user requests it.
#pragma once

#include <vector>

#include "reduce/common/progress.hpp"
#include "reduce/mesh/mesh.hpp"
#include "reduce/reduction/body_matrices.hpp"
#include "reduce/reduction/checks.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/sparse/factor.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Report of a reduction in addition to its result.
struct ReductionReport {
  Eigen::Index points = 0, cells = 0;
  FactorStatistics factor;
  std::string method;         ///< by which modes were found, in words; empty: there are none
  int solves = 0;             ///< columns that the eigenvalue iteration solved for
  int sweeps = 0;             ///< calls that it took: each reads the factor once
  std::vector<Check> checks;  ///< those of the superelement and those that only the mesh could answer
};

/// Reduces a solid body.
///
/// Without a request for modes the body keeps its constraint modes only. Geometric stiffness of interface
/// loads is left out, with a note, for bodies with more than 60 kept directions. The superelement contains the whole
/// mesh, or its skin if displacements are to be recovered on the surface only.
/// @param mesh      one connected piece of solid cells that fit together, surface cells oriented outward
/// @param progress  shows the phases; gets warnings
/// @param threads   >= 1
/// @param report    filled when given
/// @param make      makes the object that stores the mesh's matrices and their factors
/// @throws InputError about requests that do not fit the mesh, ComputationError if the computation or a check fails
Superelement reduce_body(const Mesh& mesh, const ReductionOptions& options, Progress& progress, int threads = 1,
                         ReductionReport* report = nullptr, const MatrixMaker& make = assembled_matrices);

}  // namespace bielle::reduce
