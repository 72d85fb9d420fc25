// The rates of a control block: adds -(A x + B u) to the equations x' + .. = 0 of its unknowns, with formulas u of time
// and state. A differential equation of the user is x' = u, where u may depend on x.
//
// In a static analysis the rates are zero, except for unknowns that this condition does not determine (State::held).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/elements/control/linear_block.hpp"
#include "mechanism/elements/control/state_unknowns.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class StateEquation final : public Component, public TimeDependent {
 public:
  /// @param rest   G of a start at rest, x = G u at the start, instead of the start values of the unknowns
  /// @param about  description of the block, for `--check`: "first-order filter, 0.01 s"
  StateEquation(const StateUnknowns& unknowns, LinearBlock block, std::optional<MatrixX> rest, std::string about);
  /// Reads one more input, after the model has been read.
  void read_input(const YamlValue& formula, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void add_break_points(std::vector<double>& times) const override;
  void describe(const LocalState& state, Description& description) const override;
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;

 private:
  VectorX input(const LocalState& state) const;
  int size() const { return static_cast<int>(block_.A.rows()); }
  const StateUnknowns& unknowns_;
  LinearBlock block_;
  std::optional<MatrixX> rest_;
  std::string about_;
  References references_;  ///< the unknowns are the first
  std::vector<StateFormula> inputs_;
};

}  // namespace bielle::mechanism
