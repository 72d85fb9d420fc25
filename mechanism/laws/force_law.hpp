// Force law of a spring and damper along one coordinate, either between two points or in a joint.
//
// With the coordinate x relative to the unloaded position of the spring and its rate v, the resisting force (positive
// against growing x) is
//     N = N_0 + k x + d v + sum of formulas N_i(x, v, t, measures).
// A law of x and v alone stores V = integral of N(x, 0) dx and dissipates (N(x, v) - N(x, 0)) v; one that depends on t
// or on measures is an actuator, whose power -N v is counted as input.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// A force with its derivatives.
struct LawForce {
  double N = 0;          ///< resisting force [N] or [N m]
  double N_x = 0;        ///< derivative by x
  double N_v = 0;        ///< derivative by v
  double N_elastic = 0;  ///< N(x, 0); for an actuator N itself
  double N_elastic_x = 0;
};

class ForceLaw {
 public:
  ForceLaw() = default;
  ForceLaw(double stiffness, double damping, double preload = 0)
      : stiffness_(stiffness), damping_(damping), preload_(preload) {}
  void add(double stiffness, double damping) {
    stiffness_ += stiffness;
    damping_ += damping;
  }
  /// Adds a formula of x, v, t in this order, and measures.
  void add(StateFormula formula);

  bool is_linear() const { return formulas_.empty(); }
  bool has_damping() const;
  bool is_actuator() const { return actuator_; }
  bool holds_time() const;
  bool reads_state() const;
  bool reads_reactions() const;
  double stiffness() const { return stiffness_; }
  double damping() const { return damping_; }

  /// @param state  state of the component that owns the law
  double force(const LocalState& state, double x, double v) const;
  /// @param split  whether the elastic part is computed; otherwise it keeps its value
  LawForce calc(const LocalState& state, double x, double v, bool split) const;
  /// Adds the derivatives of the force through measures, times the column `direction`, to rows of K and C from `row`
  /// on.
  void add_measures(const LocalState& state, double x, double v, const Eigen::Ref<const VectorX>& direction, int row,
                    LocalTangent& tangent) const;
  /// Returns V(x) [J]. An actuator has no such energy.
  double elastic_energy(const LocalState& state, double x) const;
  void add_break_points(std::vector<double>& times) const;
  /// Describes the law in words: "stiffness 10 N/m", "force 3*e + v N". @param turning  whether the coordinate is an
  /// angle, not a displacement
  std::vector<std::string> describe(bool turning) const;

 private:
  double stiffness_ = 0, damping_ = 0, preload_ = 0;
  std::vector<StateFormula> formulas_;
  bool actuator_ = false;
};

/// Names of the variables in a law's formulas: the coordinate and its rate.
struct LawVariables {
  std::string coordinate;  ///< "q", or "e" for a spring_damper
  std::string rate;        ///< "v"
};

/// Returns the forms of one key of a law. @param unit  of a number, which multiplies x or v: "N/m", "N m s/rad"
KeyForms forms_of_law(const std::string& unit, const LawVariables& variables);

/// Adds the term of one key: a number (times x or v), `{table: file.csv}` of x or v, or a formula of coordinate, rate,
/// t and measures. Formulas are looked up when the model has been read: call this within
/// Model::when_read(Stage::formulas).
/// @param of_rate  whether the key is `damping`
void read_law(const YamlValue& value, const LawVariables& variables, bool of_rate, Model& model, References& references,
              ForceLaw& law);

}  // namespace bielle::mechanism
