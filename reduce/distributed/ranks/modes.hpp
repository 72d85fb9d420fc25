// The lowest modes of the held body by SLEPc: Krylov-Schur on the inverted operator, vectors distributed over the
// ranks.
//
// One Krylov sequence sees one vector of each eigenspace; others come in by rounding errors, late. Each search is
// therefore followed by one in the complement of what was found, until that finds nothing lower: repeated eigenvalues
// are found as often as they are there. V. Hernandez, J. E. Roman, V. Vidal, ACM Trans. Math. Softw. 31 (2005) 351; G.
// W. Stewart, SIAM J. Matrix Anal. Appl. 23 (2002) 601.
#pragma once

#include <functional>
#include <vector>

#include "reduce/distributed/ranks/team.hpp"

namespace bielle::reduce {

struct ModesRequest {
  int size = 0, count = 0;
  double tolerance = 1e-10;  ///< of the residuals, relative to the inverted operator's eigenvalues
  int restarts = 300;
};

/// Serves orders until the answer to a question has come.
using ServeUntilAnswered = std::function<void()>;

/// All ranks together: asks bielle-reduce for products and solutions, and at the end sends it `none`, the outcome, and
/// what was found: eigenvalues, then vectors, ascending.
void find_modes(Team& team, const ModesRequest& request, const ServeUntilAnswered& serve);

}  // namespace bielle::reduce
