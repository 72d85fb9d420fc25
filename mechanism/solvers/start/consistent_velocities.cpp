#include "mechanism/solvers/start/consistent_velocities.hpp"

namespace bielle::mechanism {

void make_velocities_consistent(const System& system, const Environment& environment, State& state, StartReport& report,
                                KktMatrix& saddle) {
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  if (system.multipliers() > 0) {
    VectorX rate(system.multipliers()), unused(system.multipliers());
    system.constraint_rates(state, environment, rate, unused);
    VectorX r = VectorX::Zero(system.size()), step(system.size());
    r.tail(system.multipliers()) = rate;
    system.for_each_idle(state, [&](int k) { r[system.size() - system.multipliers() + k] = 0; });
    saddle.factor(environment, state);
    saddle.solve(r, step);
    report.note_change(system, v, step.head(system.dofs()));
    v += step.head(system.dofs());
    // Impulses -B^T mu do work during the change; constraints with a prescribed motion, B v + c = 0, take c mu from
    // their drive.
    system.set_rates(state, VectorX::Zero(system.dofs()), a);
    VectorX driven(system.multipliers());
    system.constraint_rates(state, environment, driven, unused);
    report.impulse_work = driven.dot(step.tail(system.multipliers()));
  }
  system.set_rates(state, v, a);
}

}  // namespace bielle::mechanism
