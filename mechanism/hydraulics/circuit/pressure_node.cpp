#include "mechanism/hydraulics/circuit/pressure_node.hpp"

#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {
namespace {

/// "pump.pressure"
class PressureMeasure final : public Measure {
 public:
  PressureMeasure(std::string name, const PressureNode& node) : Measure(std::move(name)), node_(node) {}
  std::string units() const override { return "Pa"; }
  double value(const LocalState& state) const override { return node_.pressure(state.of(0)); }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    gradient.position()[state.slots().reference_row(0) + node_.rows().pressure] = 1;
    return value(state);
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&node_}; }
  const PressureNode& node_;
};

}  // namespace

std::unique_ptr<Measure> PressureNode::make_measure(const std::string& name, const std::string& /*measure*/) const {
  return std::make_unique<PressureMeasure>(name, *this);
}

}  // namespace bielle::mechanism
