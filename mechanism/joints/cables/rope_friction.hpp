// Friction of a rope on a pulley between two of its sections, by Euler and Eytelwein (the capstan equation).
//
// The rope slips towards the section with the larger tension T_b as soon as
//     T_b > exp(mu theta) T_a,
// with the smaller tension T_a, the coefficient mu and the present wrap theta (rope_wrap.hpp); while it slips both
// sides are equal. Otherwise it sticks: the slip s of rope_slip.hpp keeps its value exactly. With a = exp(-mu theta),
// the increment d = s - s_0 of a step of size h, and the tensions T_1 before and T_2 after the pulley, this is
//     0 = median(-k d, F, -R),   F = a T_2 - T_1 - (1e-9 k_0 + c/h) d,   R = a T_1 - T_2 + (1e-9 k_0 + c/h) d.
// All three terms decrease as d grows. The factor k only decides which of them Newton's method takes at a distant
// iterate: with the derivative of both tensions by d, damping included, an iterate beyond a kink of F (a slack side
// becomes taut) stays on the slipping branch, from which the next one finds the solution; with a smaller factor the
// method would alternate between sticking and slipping. The terms with c = 1e-10 s/m EA and with the stiffness k_0 of
// both sections do not model friction. They keep a negligible tension greater than zero in a rope that slides while its
// other side is slack, and make the slip unique if several pulleys of a belt slip at once. A negative wrap counts as
// zero, and both tensions are then equal. The friction T_2 - T_1 acts on the rim of the pulley by the tensions
// themselves.
//
// The rope passes the pulley with its strain energy w = T^2/(2 EA) per unloaded length. With the velocity v of the rim
// and the flow q = v + ds/dt of unloaded rope, the friction dissipates the integral of the relative velocity
// q (1 + T/EA) - v over the tensions,
//     (T_2 - T_1) ds/dt + (w_2 - w_1) q.
// The part (w_2 - w_1) v is due to the rim: because elastic creep is neglected, the sections assume that the rim
// carries the unloaded length v instead of v/(1 + T/EA). This part is negative on a pulley that drives. A cable that
// slips dissipates the other part, (w_2 - w_1) f with f = median(0, q, ds/dt): all of it on a pulley at rest, and none
// of it if the rope rests and the pulley turns below it. A belt returns to the pulleys that it grips, so that the parts
// of all pulleys add up to zero if it runs steadily: it dissipates (T_2 - T_1) ds/dt.
//
// At the beginning of a branch the unknown of this equation is the rate of the slip, instead of d, if the rope is
// damped: the accelerations with which the branch begins need the tensions after the discontinuity.
//
// The rope has no mass, and so no centrifugal tension. Its elastic creep on the pulley is neglected.
// L. Euler, Remarques sur l'effet du frottement dans l'equilibre (1762); J. A. Eytelwein, Handbuch der Statik fester
// Koerper (1808).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/joints/cables/rope_wrap.hpp"
#include "mechanism/model/sticking_part.hpp"

namespace bielle::mechanism {

class RopeFriction final : public Component, public StickingPart {
 public:
  /// @param before,after  sections that end and begin at the pulley; both refer to its slip
  /// @param number,count  number of the pulley among those of the rope with friction
  /// @param closed        whether it is a belt
  RopeFriction(const RopeSection& before, const RopeSection& after, RopeWrap wrap, double coefficient,
               std::size_t number, std::size_t count, bool closed);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  /// Outputs, one for each pulley with friction: `slip` [m], `slip_velocity` [m/s], `slips` [-], `friction` [N],
  /// `friction_limit` [N], `wrap` [rad].
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  /// Measures: `p.slip`, `p.slip.rate`, `p.friction`, `p.wrap` of the pulley p.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

  void hold(const LocalState& state, std::vector<char>& held) const override;
  std::string describe_overload(const LocalState& state) const override;

  /// Computes a quantity with its derivatives over the local layout.
  /// @param gradient  zero on entry
  double calc_slip(const LocalState& state, MeasureGradient& gradient) const;
  double calc_slip_rate(const LocalState& state, MeasureGradient& gradient) const;
  double calc_friction(const LocalState& state, MeasureGradient& gradient) const;
  double calc_wrap(const LocalState& state, MeasureGradient& gradient) const;

 private:
  /// Both sections at a state, before (0) and after (1) the pulley.
  struct Sides {
    RopeSection::Stretch stretch[2];
    double wrap = 0;       ///< not negative [rad]
    double reduction = 1;  ///< a
  };
  LocalState slip_of(const LocalState& state) const { return before_.slip_at(state.of(0), RopeSection::last_end); }
  /// Returns the row of an unknown of the slip. The unknown occurs twice in the local layout, once for each section;
  /// the returned row is that of the section before the pulley.
  int slip_row(const Slots& slots, int unknown) const {
    return slots.reference_row(0) + before_.slip_row(*slots.references[0], RopeSection::last_end) + unknown;
  }
  int change_row(const LocalState& state) const {
    return slip_row(state.slots(), RopeSlip::change(slip_of(state)).unknown);
  }
  /// Returns the factor on the equation of the second unknown [N s/m].
  double rate_factor() const { return after_.material().damping * stiffness_; }
  bool damped() const { return after_.material().damping > 0; }
  const RopeSection& section(int side) const { return side == 0 ? before_ : after_; }
  /// @param order  2 with second derivatives, which `add_pull` needs
  const Sides& calc_sides(const LocalState& state, int order = 1) const;
  /// Returns the tension that draws the rope towards a side, less the largest one that friction can hold there [N].
  static double excess(const Sides& sides, int towards);
  /// Returns the side to which the rope slips in this step, 0 or 1, according to the median; -1 if it sticks.
  int slips_towards(const LocalState& state, const Sides& sides) const;
  double stiffness(const LocalState& state, const Sides& sides, int side) const;
  double stiffness(const LocalState& state, const Sides& sides) const;
  static double scale(const Sides& sides, int towards);
  void add_held(const LocalState& state, const Sides& sides, LocalTangent& tangent) const;
  void add_other_tangent(const LocalState& state, LocalTangent& tangent) const;
  double resistance(const LocalState& state) const;
  double strain_flow(const Sides& sides, double slip_rate) const;
  void add_pull(const LocalState& state, const Sides& sides, int side, double factor, MeasureGradient& gradient) const;
  void add_wrap(const LocalState& state, const Sides& sides, double factor, MeasureGradient& gradient) const;

  const RopeSection &before_, &after_;
  RopeWrap wrap_;
  double coefficient_;
  std::size_t number_, count_;
  bool closed_;
  double stiffness_;  ///< k_0 [N/m]
  double viscosity_;  ///< c [N s/m]
};

}  // namespace bielle::mechanism
