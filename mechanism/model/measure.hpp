// Measures: named scalar functions of the state. Forces, controllers, events and results use them.
//
// A measure is a component that adds nothing to the equations. It declares its arguments as every component does:
// nodes, or references to the components whose unknowns it reads. A component that uses a measure refers to it, and
// finds its gradient in its own local layout from Slots::reference_row on.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// Derivatives of a measure over its local layout. The object is reused from call to call: it allocates memory only
/// when it grows.
class MeasureGradient {
 public:
  void prepare(int size) {
    size_ = size;
    for (std::vector<double>* part : {&position_, &rate_}) part->assign(static_cast<std::size_t>(size), 0.0);
  }
  using Map = Eigen::Map<VectorX>;
  Map position() { return {position_.data(), size_}; }  ///< by positions, amplitudes, first-order unknowns, multipliers
  Map rate() { return {rate_.data(), size_}; }          ///< by node velocities and rates of scalars

 private:
  int size_ = 0;
  std::vector<double> position_, rate_;
};

class Measure : public Component {
 public:
  /// @param name  name as in the results and in messages: "main.angle"
  explicit Measure(std::string name) : Component("measure", std::move(name)) {}

  virtual std::string units() const = 0;
  virtual double value(const LocalState& state) const = 0;
  /// @param gradient  resized to the measure's size and zeroed by this function
  virtual double calc(const LocalState& state, MeasureGradient& gradient) const = 0;
  /// Returns whether the measure depends on multipliers.
  virtual bool reads_reactions() const { return false; }

  void declare(Declaration& declaration) const final {
    declaration.passive = true;
    declaration.reads_reactions = reads_reactions();
    declare_subjects(declaration);
  }
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const final {}
  std::vector<OutputField> output_fields() const final { return {{name(), {}, units(), ""}}; }
  void write_output(const LocalState& state, double* values) const final { *values = value(state); }

 protected:
  /// Declares the nodes or references.
  virtual void declare_subjects(Declaration& declaration) const = 0;
};

}  // namespace bielle::mechanism
