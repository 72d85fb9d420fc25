// The samplers of a mechanism: their instants, and the values that they compute there.
#pragma once

#include <vector>

#include "mechanism/model/sampler.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the first of these instants after a time, `first` itself if the time is before it.
/// @param time      [s] @param rounding  times that differ by less are the same [s]
double next_instant(const Sampler::Instants& instants, double time, double rounding);

/// The samplers of a mechanism. The system must outlive it.
class Samplers {
 public:
  explicit Samplers(const System& system);
  bool none() const { return samplers_.empty(); }
  /// Returns the instants of all samplers, each sequence once.
  std::vector<Sampler::Instants> instants() const;
  /// Computes the values that are due at the time of an accepted state, in the order of the file: a sampler sees the
  /// new values of those before it.
  /// @returns whether a value that others read has changed
  bool take(State& state, const Environment& environment) const;

 private:
  struct Placed {
    const Sampler* sampler;
    std::size_t member;
  };
  const System& system_;
  std::vector<Placed> samplers_;
};

}  // namespace bielle::mechanism
