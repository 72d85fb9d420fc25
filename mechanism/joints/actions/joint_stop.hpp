// Stops at the ends of a coordinate's range [lower, upper]: linear spring and damper with unilateral force.
//
//     upper, p = q - upper:   N = max(0, k p + d qdot)  in contact, 0 otherwise;  lower stop similarly.
// Contact begins and ends when p changes its sign: steps end there (events), because the damper's force jumps. At rest
// only the sign of p matters. Reference of the model: linear Kelvin-Voigt contact without adhesion.
#pragma once

#include "mechanism/joints/actions/coordinate_action.hpp"

namespace bielle::mechanism {

struct StopRange {
  double lower, upper;  ///< ends [m] or [rad]; infinite: no stop
  double stiffness;     ///< [N/m] or [N m/rad]
  double damping;       ///< [N s/m] or [N m s/rad]
};

class JointStop final : public CoordinateAction {
 public:
  JointStop(std::string name, const Joint& joint, std::size_t coordinate, const StopRange& range)
      : CoordinateAction("stops", std::move(name), joint, coordinate), range_(range) {}

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  /// Distance to the nearer stop, negative beyond it, and force on the coordinate: "angle.stop_gap",
  /// "angle.stop_force".
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  /// Computes one of them, with its derivatives over the local layout.
  double calc_gap(const LocalState& state, MeasureGradient& gradient) const;
  double calc_force(const LocalState& state, MeasureGradient& gradient) const;

 private:
  struct Contact {
    double side = 0;         ///< +1 at the upper stop, -1 at the lower one, 0 at neither
    double penetration = 0;  ///< penetration p, positive in contact
    double N = 0;            ///< resisting force along the coordinate, with the sign of `side`
    bool pushes = false;
  };
  Contact contact(const LocalState& state, double q, double v) const;
  StopRange range_;
};

}  // namespace bielle::mechanism
