#include "mechanism/hydraulics/lines/line.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/measures/own_measure.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

/// "brake.flow", "main.opening"
class LineMeasure final : public OwnMeasure {
 public:
  LineMeasure(std::string name, const Line& line, std::string quantity)
      : OwnMeasure(std::move(name), line), line_(line), quantity_(std::move(quantity)) {}
  std::string units() const override { return quantity_ == "flow" ? "m^3/s" : "-"; }
  bool reads_reactions() const override { return line_.reads_reactions(); }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    if (quantity_ != "flow") return line_.calc_own_measure(own, quantity_, gradient);
    Nested<FlowDerivatives> jet;
    jet->prepare(own.slots().size());
    line_.calc_flow(own, 0, *jet);
    gradient = jet->by;
    return jet->Q;
  }
  const Line& line_;
  std::string quantity_;
};

void Line::declare(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.stiffness = true;
  declaration.damping = has_damping();
  declaration.reads_reactions = reads_reactions();
}

double Line::flow(const LocalState& state, std::size_t path) const {
  Nested<FlowDerivatives> jet;
  jet->prepare(state.slots().size());
  calc_flow(state, path, *jet);
  return jet->Q;
}

void Line::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  for (std::size_t k = 0; k < paths_.size(); ++k)
    ports_.add_flow(state, paths_[k].from, paths_[k].to, flow(state, k), r);
}

void Line::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  Nested<FlowDerivatives> jet;
  for (std::size_t k = 0; k < paths_.size(); ++k) {
    jet->prepare(state.slots().size());
    calc_flow(state, k, *jet);
    ports_.add_tangent(state, paths_[k].from, paths_[k].to, *jet, tangent);
  }
}

void Line::add_pattern(const Slots& slots, LocalPattern& pattern) const { ports_.add_pattern(slots, pattern); }

void Line::add_energy(const LocalState& state, Energy& energy) const {
  for (std::size_t k = 0; k < paths_.size(); ++k)
    energy.dissipation += ports_.power(state, paths_[k].from, paths_[k].to, flow(state, k));
}

void Line::add_by_pressure(const LocalState& state, int port, double factor, FlowDerivatives& flow) const {
  flow.by.position()[ports_.pressure_row(state, port)] += factor;
}

std::vector<OutputField> Line::output_fields() const {
  std::string which;
  for (const Path& path : paths_)
    if (!path.name.empty()) which += (which.empty() ? ": " : ", ") + path.name;
  const std::vector<std::size_t> shape =
      paths_.size() == 1 ? std::vector<std::size_t>{} : std::vector<std::size_t>{paths_.size()};
  std::vector<OutputField> fields = {
      {"flow", shape, "m^3/s", paths_.size() == 1 ? ports_.describe(paths_[0].from, paths_[0].to) : "of paths" + which},
      {"power", shape, "W", paths_.size() == 1 ? "lost on the way" : "lost on the paths" + which}};
  for (OutputField& field : own_fields()) fields.push_back(std::move(field));
  return fields;
}

void Line::write_output(const LocalState& state, double* values) const {
  const std::size_t n = paths_.size();
  for (std::size_t k = 0; k < n; ++k) {
    values[k] = flow(state, k);
    values[n + k] = ports_.power(state, paths_[k].from, paths_[k].to, values[k]);
  }
  write_own(state, values + 2 * n);
}

void Line::describe(const LocalState& /*state*/, Description& description) const {
  if (paths_.size() == 1) description.add(ports_.describe(paths_[0].from, paths_[0].to));
  for (const Path& path : paths_)
    if (!path.name.empty()) description.add_line(path.name + ": " + ports_.describe(path.from, path.to));
  description.add(describe_law());
}

std::vector<std::string> Line::measure_names() const {
  std::vector<std::string> names = {"flow"};
  for (std::string& name : own_measures()) names.push_back(std::move(name));
  return names;
}

std::unique_ptr<Measure> Line::make_measure(const std::string& name, const std::string& measure) const {
  return std::make_unique<LineMeasure>(name, *this, measure);
}

double Line::calc_own_measure(const LocalState&, const std::string& measure, MeasureGradient&) const {
  throw std::logic_error("line '" + name() + "' has no measure '" + measure + "'");
}

const PressureNode& place_named_by(const YamlValue& value, const Model& model) {
  const std::string wanted = value.text();
  for (const Component* component : model.components_of({Section::hydraulics, wanted}))
    if (const auto* node = dynamic_cast<const PressureNode*>(component); node && !node->is_part()) return *node;
  std::vector<std::string> names;
  for (const std::string& name : model.names_in(Section::hydraulics))
    for (const Component* component : model.components_of({Section::hydraulics, name}))
      if (const auto* node = dynamic_cast<const PressureNode*>(component); node && !node->is_part()) {
        names.push_back(name);
        break;
      }
  value.fail(fmt::format("'{}' is no place of the hydraulics (volumes, junctions, supplies, tanks){}", wanted,
                         did_you_mean(wanted, names)));
}

}  // namespace bielle::mechanism
