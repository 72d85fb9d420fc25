// The samplers of a mechanism: their instants, and the values that they compute there.
#pragma once

#include <vector>

#include "mechanism/model/sampler.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the instants of all samplers, each sequence once.
std::vector<Sampler::Instants> sample_instants(const System& system);

/// Returns the first of these instants after a time, `first` itself if the time is before it.
/// @param time      [s] @param rounding  times that differ by less are the same [s]
double next_instant(const Sampler::Instants& instants, double time, double rounding);

/// Computes the values that are due at the time of an accepted state, in the order of the file: a sampler sees the new
/// values of those before it.
/// @returns whether a value that others read has changed
bool take_samples(const System& system, State& state, const Environment& environment);

}  // namespace bielle::mechanism
