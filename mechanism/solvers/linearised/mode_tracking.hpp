// Which mode is which: modes of neighbouring states of a mechanism told apart by their shapes.
//
// The correlation of two complex shapes u and v in the norm of the mass matrix M (modal assurance criterion, R. J.
// Allemang, D. L. Brown, Proc. 1st IMAC, 1982, with M for weight) is
//     |u^H M v|^2 / ((u^H M u) (v^H M v)),
// 1 of one and the same shape, whatever its phase. A whirl and its mirror image, the conjugate shape, are orthogonal.
//
// Where frequencies coincide (a rotor at rest, lines that cross), shapes are any of a space: a mode then goes on as its
// own part in that space. A frequency that passes through zero, as that of a forward whirl does in axes that turn, goes
// on with the conjugate shape and a negative imaginary part.
#pragma once

#include <complex>
#include <vector>

#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

/// A mode at one of the states.
struct TrackedMode {
  bool found = false;
  std::complex<double> s;  ///< [1/s]; Im s < 0 after a passage through zero
  double uncertainty = 0;  ///< of s [1/s], see Mode
  bool grows = false;      ///< by more than that
  Eigen::VectorXcd u;      ///< its shape; of a mode that was not found, the last one known
  double correlation = 0;  ///< with itself at the state before, 0..1; 1 at the first state
  double whirl = 0;        ///< see whirl.hpp; NaN without a sense, or where frequencies coincide
  int open =
      -1;  ///< a group of modes whose frequencies have coincided since the first state: shapes are any of their space
};

/// Modes that oscillate about a state: what tracks are looked for among.
struct ModeSample {
  std::vector<Mode> modes;    ///< with Im s > 0, |s| ascending
  std::vector<double> whirl;  ///< of each
  LinearisedEquations::Sparse M;
  bool all = false;  ///< there are no others that oscillate
};

/// |u^H M v|^2 / ((u^H M u) (v^H M v)).
double shape_correlation(const LinearisedEquations::Sparse& M, const Eigen::VectorXcd& u, const Eigen::VectorXcd& v);

/// The slowest modes of a first state. @param count  at most so many
std::vector<TrackedMode> begin_tracks(const ModeSample& sample, int count);

/// The same modes at the next state. Each mode of the sample is one of them at most.
std::vector<TrackedMode> follow_tracks(const std::vector<TrackedMode>& before, const ModeSample& sample);

}  // namespace bielle::mechanism
