// Rayleigh-Ritz frequencies of the free body when shapes are added to those of the reduced one.
#pragma once

#include "reduce/reduction/adequacy.hpp"
#include "reduce/reduction/reduced_matrices.hpp"

namespace bielle::reduce {

/// The lowest modes of the body with the added shapes.
struct EnrichedModes {
  Eigen::VectorXd eigenvalues;  ///< omega^2, ascending [rad^2/s^2]
  /// (count) MAC of each of the lowest free modes with its counterpart among these, in the metric of the mass; modes
  /// whose frequencies differ by less than 1 % count together.
  Eigen::VectorXd assurance;
};

/// All frequencies are upper bounds of the frequencies of any body whose motions include both kinds of shapes (Courant
/// and Fischer), and none exceeds that of the reduced body.
/// @param free    elastic modes of the reduced body
/// @param shapes  added shapes (3 points, p), which may be linearly dependent or zero
/// @param count   number of requested frequencies
EnrichedModes enriched_modes(const FullModel& model, const Superelement& body, const FreeModes& free,
                             const RowMatrix& shapes, Eigen::Index count);

}  // namespace bielle::reduce
