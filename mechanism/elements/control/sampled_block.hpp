// A sampled controller: at the instants of its clock it computes outputs from formulas of the state, which keep their
// values until the next instant, or until `delay` after it. Samples whose outputs are still delayed wait in a ring,
// which is part of the memory.
//
// Blocks with the same instant are evaluated in the order of the file, like the statements of a program: a formula
// reads the new outputs of the blocks above it, and the previous outputs of its own block and of the blocks below it.
#pragma once

#include <memory>
#include <vector>

#include "mechanism/elements/control/held_value.hpp"
#include "mechanism/elements/control/sample_clock.hpp"
#include "mechanism/elements/control/sampled_law.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class SampledBlock final : public Component, public Sampler {
 public:
  SampledBlock(const std::string& name, const SampleClock& clock, const OutputStage& stage,
               std::unique_ptr<SampledLaw> law);
  /// Returns the number of values in the memory of a block.
  static Eigen::Index memories(const SampleClock& clock, const SampledLaw& law);
  /// Adds the next output, before the inputs.
  void add_output(const Measure& output);
  /// Reads one more input, after the model has been read.
  void read_input(const YamlValue& formula, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}
  void add_break_points(std::vector<double>& times) const override;
  bool knows_memory(const LocalState& state) const override;
  void describe(const LocalState& state, Description& description) const override;
  std::vector<Instants> instants() const override { return clock_.instants(); }
  bool sample(const LocalState& state, Eigen::Ref<VectorX> memory) const override;

 private:
  VectorX input(const LocalState& state) const;
  bool put_out(const LocalState& state, const Eigen::Ref<const VectorX>& y, Eigen::Ref<VectorX> memory) const;
  bool put_out_waiting(const LocalState& state, Eigen::Ref<VectorX> own, Eigen::Ref<VectorX> memory) const;
  Eigen::Index place_of(double oldest, Eigen::Index k) const;

  SampleClock clock_;
  OutputStage stage_;
  std::unique_ptr<SampledLaw> law_;
  Eigen::Index places_;    ///< places of the ring
  References references_;  ///< the outputs are the first
  std::vector<StateFormula> inputs_;
};

}  // namespace bielle::mechanism
