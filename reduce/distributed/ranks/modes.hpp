// The lowest modes of the held body by SLEPc: Krylov-Schur on the inverted operator, vectors distributed over the
// ranks.
//
// A Krylov sequence contains one vector of each eigenspace; others appear late, by rounding errors. Each search is
// therefore followed by one in the complement of the found vectors, until it finds nothing lower: repeated eigenvalues
// are found with their multiplicity. V. Hernandez, J. E. Roman, V. Vidal, ACM Trans. Math. Softw. 31 (2005) 351; G. W.
// Stewart, SIAM J. Matrix Anal. Appl. 23 (2002) 601.
#pragma once

#include <functional>
#include <vector>

#include "reduce/distributed/ranks/team.hpp"

namespace bielle::reduce {

struct ModesRequest {
  int size = 0, count = 0;
  double tolerance = 1e-10;  ///< bound of the residuals, relative to the inverted operator's eigenvalues
  int restarts = 300;
};

/// Serves commands until the answer to a request has arrived.
using ServeUntilAnswered = std::function<void()>;

/// Called by all ranks together: it requests products and solutions from bielle-reduce, and finally sends it `none`,
/// the outcome, and the results: eigenvalues, then vectors, ascending.
void find_modes(Team& team, const ModesRequest& request, const ServeUntilAnswered& serve);

}  // namespace bielle::reduce
