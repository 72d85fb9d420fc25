// Residual vectors: the part of the static answer to single loads that the modes do not represent.
//
// A load f inside moves the held body by u = K_ii^-1 f. The kept modes Phi represent Phi Omega^-2 Phi^T f of it. The
// rest,
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

/// Loads of one entry of the body file whose answer shall be exact.
struct ResidualRequest {
  std::string subject;        ///< key of the entry: "points.pin"
  SparseRows loads;           ///< (3 points, k)
  bool may_be_empty = false;  ///< no error if the modes already represent the answer
};

/// Returns the loads on points in the requested directions, and those of load patterns with `residual`: each component
/// of the pattern along each axis.
/// @throws InputError as pattern_forces
std::vector<ResidualRequest> residual_requests(const Solid& solid, const std::vector<LoadRequest>& loads,
                                               const std::vector<TiedPoint>& points);

/// Appends the residual vectors to the basis. If loads are linearly dependent, or the modes already represent their
/// answers, fewer vectors are made: energies below 1e-10 of the whole answer's count as zero.
/// @throws InputError about the request, if nothing is left of any of its loads, unless `may_be_empty` is set
void add_residual_vectors(const std::vector<ResidualRequest>& requests, const BodyMatrices& matrices,
                          const FixedInterfaceBody& held, Basis& basis);

}  // namespace bielle::reduce
