// How much of loads, gravity and prescribed motions a static analysis has applied, and its equations at rest.
//
// Loads and gravity are multiplied by the load factor s. Of the prescribed motions the part
//     m(s) = 1 - (1 - m_0) (1 - s)/(1 - s_0)
// is applied: it grows with the factor from the part m_0 applied at the analysis's start, s_0, to the whole at s = 1.
// Where the start has all of the loads (after a motion), it has all of the motions too.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// What preceding analyses have applied already.
struct Loaded {
  double factor = 0;   ///< load factor that the state stands under
  double motions = 0;  ///< part of the prescribed motions that is applied
};

class LoadRamp {
 public:
  /// @param full  environment with gravity of load factor 1
  LoadRamp(const System& system, const Environment& full, const Loaded& start)
      : system_(system), full_(full), start_(start) {}

  const System& system() const { return system_; }
  /// Puts a state at rest (prescribed velocities and accelerations included), with the motions applied so far.
  void set_off(State& state) const;
  double begin() const { return start_.factor; }
  Environment environment(double factor) const;
  double motion(double factor) const { return 1 - motion_rate() * (1 - factor); }
  /// dr/ds (size) at a state at rest under a load factor.
  void factor_derivative(const State& state, double factor, Eigen::Ref<VectorX> result) const;
  /// The part of it that loads and gravity make, prescribed motions left where they are.
  void load_derivative(const State& state, double factor, Eigen::Ref<VectorX> result) const;
  /// dr/dm (size): exact to some 1e-8, by central differences of the positions.
  void motion_derivative(const State& state, const Environment& environment, Eigen::Ref<VectorX> result) const;

 private:
  double motion_rate() const { return start_.factor == 1 ? 0 : (1 - start_.motions) / (1 - start_.factor); }

  const System& system_;
  Environment full_;
  Loaded start_;
};

/// Moves what is prescribed to a part of its motion (0..1); the other unknowns stay.
void apply_motions(const System& system, double part, State& state);

/// The residual (size) at rest: rows of constraints on velocities are satisfied at rest, hence zero.
void residual_at_rest(const System& system, const Environment& environment, const State& state, Eigen::Ref<VectorX> r,
                      ResidualScale* scale = nullptr);

}  // namespace bielle::mechanism
