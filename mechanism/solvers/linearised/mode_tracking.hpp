// Tracking of modes: modes of neighbouring states of a mechanism are identified by their shapes.
//
// The correlation of two complex shapes u and v in the norm of the mass matrix M (modal assurance criterion, R. J.
// Allemang, D. L. Brown, Proc. 1st IMAC, 1982, with M for weight) is
//     |u^H M v|^2 / ((u^H M u) (v^H M v)),
// It is 1 for equal shapes, for any phase. A whirl and its mirror image, the conjugate shape, are orthogonal.
//
// If frequencies coincide (a rotor at rest, lines that cross), shapes are arbitrary within a space: a mode then
// continues as its own projection on that space. A frequency that passes through zero, like that of a forward whirl in
// rotating axes, continues with the conjugate shape and a negative imaginary part.
//
// Frequencies that nearly coincide at rest have definite shapes there, which change within a small speed: there sets of
// modes are identified by their spaces.
#pragma once

#include <complex>
#include <vector>

#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

/// A tracked mode at one of the states.
struct TrackedMode {
  bool found = false;
  std::complex<double> s;  ///< [1/s]; Im s < 0 after a passage through zero
  double uncertainty = 0;  ///< uncertainty of s [1/s], see Mode
  bool grows = false;      ///< growth exceeds the uncertainty
  Eigen::VectorXcd u;      ///< its shape; if the mode was not found, the last known one
  double correlation = 0;  ///< correlation with itself at the previous state, 0..1; 1 at the first state
  double whirl = 0;        ///< that of Im s >= 0, see whirl.hpp; NaN without a sense, or if frequencies coincide
  int open = -1;  ///< group of modes with equal frequencies since the first state: shapes are arbitrary in their space
};

/// Oscillating modes about a state, among which the tracked modes are searched for.
struct ModeSample {
  std::vector<Mode> modes;    ///< with Im s > 0, |s| ascending
  std::vector<double> whirl;  ///< for each mode
  LinearisedEquations::Sparse M;
  bool all = false;  ///< there are no other oscillating modes
};

/// Returns |u^H M v|^2 / ((u^H M u) (v^H M v)).
double shape_correlation(const LinearisedEquations::Sparse& M, const Eigen::VectorXcd& u, const Eigen::VectorXcd& v);

/// Begins tracking with the slowest modes of a first state. @param count  largest number of modes
std::vector<TrackedMode> begin_tracks(const ModeSample& sample, int count);

/// Finds the same modes at the next state. Each mode of the sample is assigned to at most one of them.
std::vector<TrackedMode> follow_tracks(const std::vector<TrackedMode>& before, const ModeSample& sample);

/// Does the same as `follow_tracks` across a change that mixes shapes at once, however small it is: a rotor that is
/// nearly the same in all directions vibrates in planes at rest, and whirls at any speed; gravity across the axis makes
/// its blades differ only at rest. The modes of a set are identified as a whole if as many modes after the change are
/// in the space of the set; within it each one continues as the mode that is most similar.
/// @param from  the sample that the tracks were found in
std::vector<TrackedMode> follow_mixed_tracks(const std::vector<TrackedMode>& before, const ModeSample& from,
                                             const ModeSample& sample);

}  // namespace bielle::mechanism
