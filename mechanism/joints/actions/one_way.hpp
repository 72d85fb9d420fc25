// A one-way clutch (freewheel, sprag clutch) or a ratchet on a coordinate q: it lets q move one way, s = +1 or -1.
//
//     free    no force; u = s q may grow
//     holds   u may not fall below the value u_0 at which it began to hold
// It begins to hold when udot falls to zero. A ratchet with a pitch holds only at multiples of the pitch: when u falls
// to the largest multiple that it has passed. There are two forms:
//     rigid     u = u_0 is a constraint that opens when its force would hold u back (its multiplier changes sign). A
//               ratchet stops its coordinate by an inelastic impulse; the lost energy is dissipated
//     elastic   N = max(0, k p + d pdot) along s, p = u_0 - u, until p falls to zero
// Steps end when it begins to hold and when it opens: the scheme keeps its order. A multiple that is passed and left
// again within a step is not seen. A closed constraint also transmits impulses in the free direction. In statics it is
// free.
//
// The rigid form yields to drives, locks and earlier one-way clutches that hold the same motion. It then has no force,
// and opens as soon as they move it in the free direction. If it would be moved against its sense, it holds in place of
// another one-way clutch (solvers/start/one_sided_holds.hpp).
//
// Complementarity: F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts (1996), chapter 6.
#pragma once

#include "mechanism/joints/actions/coordinate_action.hpp"

namespace bielle::mechanism {

struct OneWayRule {
  double sense = 1;  ///< s: +1 if the coordinate may grow
  double pitch = 0;  ///< [rad] or [m]; 0: it holds anywhere
};

/// The branches of both forms.
class OneWay : public CoordinateAction {
 public:
  OneWay(std::string name, const Joint& joint, std::size_t coordinate, const OneWayRule& rule)
      : CoordinateAction("one_way", std::move(name), joint, coordinate), rule_(rule) {}
  /// Outputs along the joint's coordinates: `one_way_force`; `one_way_holds`: 1 if it holds, else 0.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_motion(const LocalState& state, bool known, Eigen::Ref<VectorX> memory) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  void activate(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  bool knows_memory(const LocalState& state) const override;

 protected:
  enum Event { closes, opens, takes_over };
  enum Memory { holding, held_at, has_moved, passed, memories };
  /// Declares the memory, and the event at which it begins to hold. The rigid and the elastic form define the event at
  /// which it opens.
  void declare_one_way(Declaration& declaration, EventFunction opening) const;
  static bool holds(const LocalState& state) { return state.memory()[holding] != 0; }
  /// Returns the value of the coordinate at which it holds.
  static double held_value(const LocalState& state) { return state.memory()[held_at]; }
  double sense() const { return rule_.sense; }
  /// Returns the rounding error of the distance of a ratchet from its multiples.
  double rounding(double q) const;

 private:
  /// Returns the event function of the holding clutch, which changes its sign when it opens.
  virtual double opening(const LocalState& state) const = 0;
  /// Returns the constant value of the event function `opening` while it is free.
  virtual double not_opening() const = 0;
  /// Returns the force or torque on the coordinate.
  virtual double force(const LocalState& state) const = 0;
  virtual std::string form() const = 0;  ///< in words
  /// Returns the clearance below which a ratchet that has just opened is still at its multiple. It is zero for the
  /// elastic form, which opens and closes exactly at zero elongation.
  virtual double touching(double q) const = 0;
  /// Tells whether it stores energy. A motion that follows another keeps this energy.
  virtual bool is_wound(const LocalState& /*state*/) const { return false; }
  void hold_at(double value, Eigen::Ref<VectorX> memory) const;
  /// Returns the distance u - u_0 of a ratchet from the multiple at which it holds.
  double clearance(const LocalState& state, double q) const;
  OneWayRule rule_;
};

class RigidOneWay final : public OneWay {
 public:
  using OneWay::OneWay;
  void declare(Declaration& declaration) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  bool is_on(const LocalState& state, int row) const override;

 private:
  double opening(const LocalState& state) const override { return sense() * state.reaction()[0]; }
  double not_opening() const override { return -1; }
  double touching(double q) const override { return rounding(q); }
  double force(const LocalState& state) const override { return -state.reaction()[0]; }
  std::string form() const override { return "rigid"; }
};

class ElasticOneWay final : public OneWay {
 public:
  /// @param stiffness,damping  k [N/m] or [N m/rad], d
  ElasticOneWay(std::string name, const Joint& joint, std::size_t coordinate, const OneWayRule& rule, double stiffness,
                double damping)
      : OneWay(std::move(name), joint, coordinate, rule), stiffness_(stiffness), damping_(damping) {}
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  bool leaves_branch(const LocalState& state) const override;

 private:
  struct Contact {
    double p = 0, N = 0;
    bool pushes = false;
  };
  Contact contact(const LocalState& state, double q, double rate) const;
  double opening(const LocalState& state) const override;
  double not_opening() const override { return 1; }
  double touching(double /*q*/) const override { return 0; }
  double force(const LocalState& state) const override;
  std::string form() const override;
  bool is_wound(const LocalState& state) const override { return holds(state) && opening(state) > 0; }
  double stiffness_, damping_;
};

}  // namespace bielle::mechanism
