// A direct-current motor with a gear on a joint's coordinate, c' the rate of the coordinate:
//
//     L di/dt + R i + k_e n c' = V(t, state),     Q = s (n k i - n^2 b c')
// V is the voltage [V], i the current, L and R inductance and resistance, k the torque constant, k_e that of the back
// electromotive force, n the gear ratio (turns of the motor per turn of the joint), b the viscous friction of the
// motor, s the load factor of a static analysis, in which di/dt and c' are zero. Without inductance i is an algebraic
// unknown. After its release the motor has neither torque nor back electromotive force. The motor does not include the
// inertia J of its rotor: the model has a body for it, or adds n^2 J to the driven body.
//
// Energies: input V i + (k - k_e) n c' i, dissipation R i^2 + n^2 b c'^2, stored energy of the magnetic field L i^2/2
// (among the elastic energies).
//
// Reference: A. E. Fitzgerald, C. Kingsley, S. D. Umans, Electric Machinery, 2003, ch. 7.
#pragma once

#include "mechanism/joints/actions/drive.hpp"
#include "mechanism/joints/actions/motor_current.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

/// Data of a motor; for a linear motor N/A replaces "N m/A", V s/m replaces "V s/rad", and so on.
struct MotorData {
  double resistance = 1;       ///< R [Ohm] > 0
  double inductance = 0;       ///< L [H] >= 0
  double torque_constant = 1;  ///< k [N m/A]
  double back_emf = 1;         ///< k_e [V s/rad]
  double gear_ratio = 1;       ///< n
  double friction = 0;         ///< b [N m s/rad] >= 0, on the motor's shaft
};

class MotorDrive final : public Drive, public TimeDependent {
 public:
  MotorDrive(std::string name, const Joint& joint, std::size_t coordinate, const MotorData& data,
             const MotorCurrent& current);
  /// Reads its voltage, after the model has been read.
  void read(const YamlValue& voltage, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;

  /// Returns the electrical power V i [W], with derivatives over the drive's local layout. @param gradient  zero on
  /// entry
  double calc_power(const LocalState& state, MeasureGradient& gradient) const;

 private:
  double force(const LocalState& state) const override;
  double voltage(const LocalState& state) const;
  double current(const LocalState& state) const { return state.of(current_).first_order()[0]; }
  int current_row(const LocalState& state) const { return state.slots().reference_row(current_); }
  /// Returns n k_e, or zero after the release.
  double back_emf(const LocalState& state) const { return released(state) ? 0 : data_.gear_ratio * data_.back_emf; }
  /// Returns the divisor of the equation of the current.
  double divisor() const { return data_.inductance > 0 ? data_.inductance : data_.resistance; }
  void add_force_tangent(const LocalState& state, CoordinateDerivatives& jet, LocalTangent& tangent) const;
  void add_kinks(std::vector<double>& times) const override { voltage_.add_break_points(0, times); }
  LawText law_text() const override;

  MotorData data_;
  int current_ = 0;  ///< number of the current among the references
  StateFormula voltage_;
};

/// The electrical power of a motor as a measure.
class MotorPower final : public OwnMeasure {
 public:
  MotorPower(std::string name, const MotorDrive& motor) : OwnMeasure(std::move(name), motor), motor_(motor) {}
  std::string units() const override { return "W"; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return motor_.calc_power(own, gradient);
  }
  const MotorDrive& motor_;
};

/// Reads `motor` of a drive, bound to motor_keys, and announces its measures.
std::unique_ptr<Drive> make_motor(const std::string& name, const YamlValue& entry, const Joint& joint,
                                  std::size_t coordinate, Model& model);

}  // namespace bielle::mechanism
