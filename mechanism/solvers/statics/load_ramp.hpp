// Fractions of loads, gravity and prescribed motions that a static analysis has applied, and its equations at rest.
//
// Loads and gravity are multiplied by the load factor s. The fraction of the prescribed motions that is applied is
//     m(s) = 1 - (1 - m_0) (1 - s)/(1 - s_0)
// which grows with the factor from the fraction m_0 at the analysis's start, s_0, to the whole at s = 1. If the start
// has all of the loads (after a motion), it has all of the motions too.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Fractions that preceding analyses have applied.
struct Loaded {
  double factor = 0;   ///< load factor of the state
  double motions = 0;  ///< applied fraction of the prescribed motions
};

class LoadRamp {
 public:
  /// @param full  environment with gravity of load factor 1
  LoadRamp(const System& system, const Environment& full, const Loaded& start)
      : system_(system), full_(full), start_(start) {}

  const System& system() const { return system_; }
  /// Sets a state to rest (including prescribed velocities and accelerations), with the motions applied so far.
  void set_off(State& state) const;
  double begin() const { return start_.factor; }
  Environment environment(double factor) const;
  double motion(double factor) const { return 1 - motion_rate() * (1 - factor); }
  /// Computes dr/ds (size) at a state at rest under a load factor.
  void factor_derivative(const State& state, double factor, Eigen::Ref<VectorX> result) const;
  /// Computes the part of it due to loads and gravity, with fixed prescribed motions.
  void load_derivative(const State& state, double factor, Eigen::Ref<VectorX> result) const;
  /// Computes dr/dm (size), accurate to some 1e-8, by central differences of the positions.
  void motion_derivative(const State& state, const Environment& environment, Eigen::Ref<VectorX> result) const;

 private:
  double motion_rate() const { return start_.factor == 1 ? 0 : (1 - start_.motions) / (1 - start_.factor); }

  const System& system_;
  Environment full_;
  Loaded start_;
};

/// Moves prescribed directions to a fraction of their motion (0..1); the other unknowns are not changed.
void apply_motions(const System& system, double part, State& state);

/// Computes the residual (size) at rest: rows of constraints on velocities are satisfied at rest, and therefore zero.
void residual_at_rest(const System& system, const Environment& environment, const State& state, Eigen::Ref<VectorX> r,
                      ResidualScale* scale = nullptr);

}  // namespace bielle::mechanism
