// What a reduction is good for: the body that was reduced against its mesh.
//
// Modes left out. A free mode u = T v at lambda = omega^2 leaves the inside with the residual r = K u - lambda M u,
// which the modes that were kept do not feel. The answers z = K_ii^-1 r of the held body to those of the lowest modes
// are added to the shapes (enrichment.hpp), which gives the frequencies without the truncation, to second order and
// from above: the error is at least what is said. Mesh. See fe/mesh_error.hpp; the fields are the lowest free modes,
// and the free body under loads on its interfaces. Rigid ties. See tie_release.hpp.
#pragma once

#include "reduce/reduction/basis.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// The mesh's matrices and all that rests on their factorisation.
struct FullModel {
  const Solid& solid;
  const BodyMatrices& matrices;
  const Ties& ties;
  const HeldBody& held;
  const Basis& basis;
};

/// @param load_fields  (3 points, directions) displacement of the free body under a unit load on each kept direction;
///                     may have no columns
Adequacy measure_adequacy(const FullModel& model, const Superelement& body, const RowMatrix& load_fields, int threads);

}  // namespace bielle::reduce
