// A rope, belt or chain between two places that grip it, over pulleys on which it slides without friction.
//
// Along a section the tension is one. With the elongation E, the sum of those of its spans (rope_span.hpp: what winds
// around a pulley between two spans cancels, so that only the ends take torque), and its present length L, arcs
// included:
//     T = max(0, EA (E + tau Edot)/(L - E)) while E > 0, and 0 otherwise;   L - E: how long that piece is without load.
// Drums take up and let out rope, so that the section's stiffness EA/(L - E) changes with its length. What is wound up
// keeps its strain: the energy 1/2 T^2/EA per length that goes with it is counted as input (negative when wound up).
// A belt is a chain of sections of one span each. A rope has no mass and does not push: steps
// end where it becomes slack or taut.
#pragma once

#include <string>
#include <vector>

#include "mechanism/joints/cables/rope_span.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/yaml_file.hpp"

namespace bielle::mechanism {

struct RopeMaterial {
  double EA;              ///< [N]
  double damping = 0;     ///< tau: time of its Kelvin-Voigt damping [s]
  double pretension = 0;  ///< as drawn [N]
};

class RopeSection final : public Component {
 public:
  /// @param nodes,names,pulleys  in the order in which the rope passes them, two at least
  /// @param drawn  frames of the nodes as drawn
  /// @throws std::domain_error  where pulleys overlap
  RopeSection(std::string type, std::string name, std::vector<int> nodes, std::vector<std::string> names,
              std::vector<Pulley> pulleys, const RopeMaterial& material, const std::vector<Frame>& drawn);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void calc_crossings(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  /// `tension` [N], `elongation` [m], `length` [m].
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

  /// The whole section at a state, along the increments of its nodes.
  struct Stretch {
    double E = 0, E_rate = 0, L = 0, tension = 0;
    VectorX E_gradient, L_gradient;
    MatrixX E_second;
    bool stretched = false;  ///< on the branch of E > 0
    bool taut = false;       ///< and under tension
  };
  void calc_stretch(const LocalState& state, Stretch& stretch) const;
  const RopeMaterial& material() const { return material_; }

 private:
  std::size_t spans() const { return pulleys_.size() - 1; }
  // Memory: two angles with their rates of each span, the time of the last accepted step, whether it is taut.
  Eigen::Index time_memory() const { return 4 * static_cast<Eigen::Index>(spans()); }
  std::vector<int> nodes_;
  std::vector<std::string> names_;
  std::vector<Pulley> pulleys_;
  RopeMaterial material_;
  double E_drawn_ = 0;               ///< by the pretension
  double spans_drawn_ = 0;           ///< sum of l as drawn
  double turns_drawn_ = 0;           ///< sum of rho_i (alpha_i + gamma) - rho_j (alpha_j + gamma) as drawn
  double arcs_drawn_ = 0;            ///< length on the pulleys between the ends, as drawn
  std::vector<double> drawn_turns_;  ///< alpha + gamma at both ends of each span as drawn
};

/// `belt: {nodes, radii, axis, EA, pretension, damping}`: closed, gripping every pulley.
void read_belt(const std::string& name, const YamlValue& entry, Model& model);
/// `cable: {nodes, radii, axis, at, grips, EA, pretension, damping}`: from the first node to the last.
void read_cable(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
