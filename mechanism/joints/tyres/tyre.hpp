// A tyre on a wheel of the second node, which rolls on a road of the first: contact_patch.hpp has the measures,
// tyre_law.hpp the forces.
//
// The tyre is no constraint: it is a spring normal to the road that leaves the road and touches down (events), and two
// first-order unknowns, the deflections of the tread along its way and across it. In statics these keep their values,
// so that a tyre which has not run has no force along the road.
#pragma once

#include <memory>

#include "mechanism/joints/joint.hpp"
#include "mechanism/joints/tyres/contact_patch.hpp"
#include "mechanism/joints/tyres/tyre_law.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Tyre final : public Joint {
 public:
  /// @param radius  radius of the undeformed tyre [m] @param road  nullptr: the plane z = 0 of J_A
  Tyre(JointFrames frames, const std::string& name, double radius, SpringTyreLaw law,
       std::shared_ptr<const RoadProfile> road, const Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  /// @throws ComputationError if the middle of the wheel is below the road
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  bool reaction_has_rates() const override { return true; }
  /// Outputs `deflection` [m], `normal_force` [N], `tyre_force` (2) [N] along t and l, `slip` (2), `aligning_moment`
  /// [N m] and `camber` [rad].
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;
  /// The names are "deflection", "normal_force", "longitudinal_force", "lateral_force", "aligning_moment", and those of
  /// all joints.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

  enum class Quantity { deflection, normal_force, longitudinal_force, lateral_force, aligning_moment };
  /// Computes a quantity with its derivatives over the local layout.
  double calc_quantity(Quantity quantity, const LocalState& state, MeasureGradient& gradient) const;

 private:
  /// Everything about a state in which the tyre touches.
  template <int order>
  struct Contact {
    ContactPatch<order> patch;
    TyreForces forces;
    Eigen::Matrix<double, tyre_variables, 14> by_position,
        by_rate;  ///< derivatives of the variables, set by order 2 alone
  };
  static constexpr int unknowns_row = 12;
  bool touches(const LocalState& state) const;
  PairSlope deflection(const LocalState& state) const;
  TyreValues unknowns_alone(const LocalState& state) const;
  template <int order>
  Contact<order> calc_contact(const LocalState& state) const;
  TyreForces forces(const LocalState& state) const;
  double radius_;
  SpringTyreLaw law_;
  std::shared_ptr<const RoadProfile> road_;
};

const KeyTable& tyre_keys();
/// Reads `{type: tyre, nodes, position | at, normal, axis, radius, stiffness, damping, slip, rolling_resistance, speed,
/// road}`.
void read_tyre(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
