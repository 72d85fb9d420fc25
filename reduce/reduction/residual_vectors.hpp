// Residual vectors: what the static answer to single loads has and the modes have not.
//
// A load f inside moves the held body by u = K_ii^-1 f. Of this the kept modes Phi give Phi Omega^-2 Phi^T f. The rest,
//     r = u - Phi Omega^-2 Phi^T f = u - Phi Phi^T M u,
// is orthogonal to Phi in K and in M. All r together, R, are made orthonormal,
//     R^T K R v = omega^2 R^T M R v,   v^T R^T M R v = 1,
// and follow the modes as further columns of the basis with pseudo-frequencies omega: the reduced stiffness stays
// diagonal there, and the static answer to f is exact. Reference (modal truncation vectors): J. M. Dickens, J. M.
// Nakagawa, M. J. Wittbrodt, Computers & Structures 62 (1997) 985.
#pragma once

#include <string>
#include <vector>

#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/point_ties.hpp"

namespace bielle::reduce {

/// Loads that one entry of the body file wants answered exactly.
struct ResidualRequest {
  std::string located;        ///< "body.yaml:20: points.pin", put before messages about it
  SparseRows loads;           ///< (3 points, k)
  bool may_be_empty = false;  ///< whether it is no error that the modes have the answer already
};

/// Those of points, in the directions they ask for, and those of load patterns that have `residual`: each component of
/// the pattern along each axis.
/// @throws InputError as pattern_forces
std::vector<ResidualRequest> residual_requests(const Solid& solid, const std::vector<LoadRequest>& loads,
                                               const std::vector<TiedPoint>& points);

/// Appends the residual vectors to the basis. Of loads that depend on each other, or whose answer the modes have
/// already, as many are made as are left: energies below 1e-10 of the whole answer's count as nothing.
/// @throws InputError, with the place of the request, when nothing is left of any of its loads, unless it may be so
void add_residual_vectors(const std::vector<ResidualRequest>& requests, const BodyMatrices& matrices,
                          const HeldBody& held, Basis& basis);

}  // namespace bielle::reduce
