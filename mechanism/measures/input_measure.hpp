// Inputs: numbers that a program sets while the model moves (Session::set_input), and that formulas use by name.
//
//     inputs: {command: 0}
// The value is part of the state, as a component's memory: it is saved, restored and restarted with the state.
#pragma once

#include "mechanism/model/measure.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class InputMeasure final : public Measure {
 public:
  InputMeasure(std::string name, double start, std::string units)
      : Measure(std::move(name)), start_(start), units_(std::move(units)) {}
  std::string units() const override { return units_; }
  double value(const LocalState& state) const override { return state.memory()[0]; }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    return value(state);
  }
  void describe(const LocalState& state, Description& description) const override;

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.memory = {start_}; }
  double start_;
  std::string units_;
};

const KeyTable& input_keys();
/// Reads an entry of `inputs`: the value at the start, or `{start, units}`. @throws InputError
void read_input(const std::string& name, const YamlValue& given, Model& model);

}  // namespace bielle::mechanism
