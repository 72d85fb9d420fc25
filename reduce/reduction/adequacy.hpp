// The accuracy of a reduction: the reduced body is compared with its mesh.
//
// Omitted modes. A free mode u = T v at lambda = omega^2 leaves the interior with the residual r = K u - lambda M u, to
// which the kept modes are orthogonal. The answers z = K_ii^-1 r of the held body to the residuals of the lowest modes
// are added to the shapes (enrichment.hpp). They give the frequencies without the truncation, to second order and from
// above: the true error is at least the stated one. The
// modes with the answers also give the MAC of the shapes. Mesh. See fe/mesh_error.hpp; the fields are the lowest free
// modes, and the free body under loads on its interfaces. Rigid ties. See tie_release.hpp.
#pragma once

#include "reduce/reduction/basis.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// The mesh's matrices and all objects that use their factorisation.
struct FullModel {
  const Solid& solid;
  const BodyMatrices& matrices;
  const Ties& ties;
  const FixedInterfaceBody& held;
  const Basis& basis;
};

/// @param load_fields  (3 points, directions) displacement of the free body under a unit load on each kept direction;
///                     it may have no columns
Adequacy measure_adequacy(const FullModel& model, const Superelement& body, const RowMatrix& load_fields, int threads);

}  // namespace bielle::reduce
