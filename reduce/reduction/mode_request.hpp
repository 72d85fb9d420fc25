// Fixed-boundary modes as a user asks for them: by number, up to a frequency, or by both.
#pragma once

#include <functional>
#include <optional>

#include "reduce/common/progress.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle::reduce {

/// The lowest `count` modes, those below `below` [Hz], or the lowest `count` of those below.
struct ModeRequest {
  std::optional<int> count;
  std::optional<double> below;
  EigenMethod method = EigenMethod::automatic;
  bool any() const { return count || below; }
};

/// Finds the requested modes of a held body, and the eigenvalue of the next one (Eigenpairs::next) where it is known;
/// none without a request.
/// @param problem  problem of the interior unknowns, K_ii phi = omega^2 M_ii phi, without a shift
/// @param search   finds the given number of pairs of this problem nearest to zero
/// @throws InputError if more modes are requested than there are unknowns inside, or if a frequency without a count
/// has too many modes below it; ComputationError if they do not converge
Eigenpairs requested_modes(const ModeRequest& request, const ShiftInvertProblem& problem,
                           const std::function<Eigenpairs(int count, const EigenpairOptions& options)>& search,
                           Progress& progress, int threads);

/// Cuts the lowest pairs of a body to those that are requested; without a request it keeps all. The user is told about
/// modes below the frequency limit that the count leaves out.
void keep_requested(const ModeRequest& request, Eigenpairs& pairs, Progress& progress);

/// @throws InputError if more modes are requested than `inside`, the number of unknowns
void check_mode_count(const ModeRequest& request, Eigen::Index inside);

}  // namespace bielle::reduce
