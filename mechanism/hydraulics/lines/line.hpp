// A line: fluid flows through it from one place of a circuit to another, depending on the pressures there.
//
// A type of line defines the flow (calc_flow) and may have unknowns of its own (a spool); everything else is done here.
// A valve with more than two ports has several paths.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/hydraulics/circuit/ports.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Line : public Component {
 public:
  struct Path {
    int from, to;
    std::string name;  ///< "P to A"; empty if there is only one
  };
  Line(std::string type, std::string name) : Component(std::move(type), std::move(name)) {}

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Outputs: `flow` and `power` (dissipated) of each path, then own_fields.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  /// Returns "flow" of the first path, and the names of the type.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

  /// Computes the flow of a path with its derivatives. @param flow  prepared, zero on entry
  virtual void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const = 0;
  double flow(const LocalState& state, std::size_t path) const;

 protected:
  const Ports& ports() const { return ports_; }
  int add_port(const PressureNode& node) { return ports_.add(node, references_); }
  void add_path(int from, int to, std::string name = {}) { paths_.push_back({from, to, std::move(name)}); }
  const std::vector<Path>& paths() const { return paths_; }
  References& references() { return references_; }
  const References& references() const { return references_; }
  /// Adds `factor` to the derivative of a flow by the pressure of a port.
  void add_by_pressure(const LocalState& state, int port, double factor, FlowDerivatives& flow) const;
  /// Returns whether the flow of any path depends on rates.
  virtual bool has_damping() const { return false; }
  virtual bool reads_reactions() const { return false; }
  virtual std::vector<OutputField> own_fields() const { return {}; }
  virtual void write_own(const LocalState& /*state*/, double* /*values*/) const {}
  virtual std::string describe_law() const = 0;
  /// Opening of a valve with its derivatives, by name; only called for types that list it in own_measures.
  virtual std::vector<std::string> own_measures() const { return {}; }
  virtual double calc_own_measure(const LocalState& /*state*/, const std::string& /*measure*/,
                                  MeasureGradient& /*gradient*/) const;

 private:
  friend class LineMeasure;
  Ports ports_;
  References references_;
  std::vector<Path> paths_;
};

/// Returns the place of a circuit that a value names. @throws InputError naming the nearest name
const PressureNode& place_named_by(const YamlValue& value, const Model& model);

}  // namespace bielle::mechanism
