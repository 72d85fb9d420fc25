// An output of a control block as a measure:   y = c x + d u.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/control/state_unknowns.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

class StateOutput final : public Measure, public TimedMeasure {
 public:
  /// One term of the direct feed-through: d_k u_k.
  struct Through {
    double factor;
    StateFormula input;
  };
  /// @param references  references of the unknowns first, then those of the inputs
  /// @param c           row vector over the unknowns
  StateOutput(std::string name, const StateUnknowns& unknowns, References references, VectorX c,
              std::vector<Through> through, std::string units);
  std::string units() const override { return units_; }
  void set_units(std::string units) { units_ = std::move(units); }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;
  bool reads_reactions() const override;
  bool holds_time() const override;
  void add_break_points(std::vector<double>& times) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  void declare_subjects(Declaration& declaration) const override { references_.declare(declaration); }
  References references_;
  VectorX c_;
  std::vector<Through> through_;
  std::string units_;
};

}  // namespace bielle::mechanism
