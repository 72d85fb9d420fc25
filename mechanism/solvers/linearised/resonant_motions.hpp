// Motions in parametric resonance with the rotation.
//
// The exponents of an oscillation are s and conj(s), and those of its copies s + i k rate. At a parametric resonance s
// and a copy of conj(s) meet: both become locked to the rotation, with the frequency m rate / 2 (decays for m = 0), and
// their real parts differ (instability intervals of Hill's equation: W. Magnus, S. Winkler, Hill's Equation (1966),
// ch. 2). One oscillation of the mean equations is then two motions, one of which decays less, or grows. Continuation
// from the mean equations finds one of them.
//
// An oscillation may have such a frequency by chance as well. Its shape and that of its conjugate copy have then the
// same exponent, and are one motion.
//
// A locked motion is the copy of its own conjugate: it is real in axes that turn by half of m turns. Several motions of
// one exponent have as many such real shapes, and a complex sum of two shapes contains both motions.
#pragma once

#include "mechanism/solvers/linearised/harmonic_continuation.hpp"

namespace bielle::mechanism {

/// Adds the locked motions that have the frequency of a locked mode, and are not among the modes. Modes with one locked
/// exponent get real, orthogonal shapes; those that are sums of others are removed. @returns whether any mode was added
/// or changed
bool add_resonant_motions(const PeriodicEquations& equations, const HarmonicShapes& shapes, HarmonicModes& modes);

}  // namespace bielle::mechanism
