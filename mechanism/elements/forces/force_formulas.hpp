// The formulas of a force and of a moment: each has three components, which depend on time and state.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class ForceFormulas {
 public:
  /// Reads three components of the force [N] or of the moment [N m], after the model has been read.
  /// @param expected    description of the expected list, for the message
  /// @param references  references of the component that owns the formulas
  void read(const YamlValue& components, bool moment, const char* expected, Model& model, References& references);
  void declare(Declaration& declaration) const;  ///< declares the owner's dependence on the state by the formulas
  void add_break_points(std::vector<double>& times) const;

  /// Returns the formulas that contain t, as TimeDependent requires.
  std::vector<TimeDependent::Formula> time_formulas() const;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const;

  bool has_force() const { return has_force_; }
  bool has_moment() const { return has_moment_; }
  /// Computes the components with the load factor, in the axes in which the formulas are given.
  void evaluate(const LocalState& state, Vector3& force, Vector3& moment) const;
  /// Returns a component, of the force (0 to 2) or of the moment (3 to 5).
  const StateFormula& component(std::size_t k) const { return components_[k]; }
  std::string force_text() const { return text(0); }  ///< "(0, 5*t, 2)"
  std::string moment_text() const { return text(3); }

 private:
  std::string text(std::size_t first) const;
  std::array<StateFormula, 6> components_;
  bool has_force_ = false, has_moment_ = false;
};

}  // namespace bielle::mechanism
