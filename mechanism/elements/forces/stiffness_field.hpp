// A 12x12 stiffness and damping matrix between two nodes, as computed by another program for a part with two ends.
//
// The matrix acts on displacements and small rotations of the two nodes from their initial positions, in the order
// [x_a, theta_a, x_b, theta_b], along initial axes. It moves with the pair: in the frame halfway between the nodes'
// rotations (measures/middle_frame.hpp), with its origin halfway between them, the nodes have the displacements
//     q = [-u/2, -psi/2, u/2, psi/2] = B e,   e = [u; psi],
// Here u is the change of the vector from a to b in this frame, and psi the rotation of b relative to a. Energy and
// dissipation are functions of q,
//     V = q . K q/2 = e . (B^T K B) e/2,    dissipated power  qdot . D qdot,
// so that rigid motions of any size need no energy, and small displacements have the forces K [x_a, ..] exactly if K
// has the six rigid motions in its null space. The part of K that resists them has no effect, and a warning is given
// when the model is read. The law is linear in e: relative rotations must be small (0.1 rad or a little more), as in
// the program that computed K.
#pragma once

#include <array>

#include "mechanism/laws/elastic_law.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class StiffnessField final : public Component {
 public:
  /// @param frames  frames of the matrix's axes on each node, with their origins in the nodes @param way  initial
  ///                vector from a to b [m], in these axes
  StiffnessField(std::string name, std::array<int, 2> nodes, std::array<Frame, 2> frames, const Vector3& way,
                 const Matrix6& K, const Matrix6& D);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Checks psi and stores it. @throws ComputationError for nearly half a turn or more
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  /// Outputs `deformation` e; `force` [N] and `moment` [N m] on the second node, inertial components.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

 private:
  ElasticLaw::Measures measures(const LocalState& state, bool second) const;
  std::array<int, 2> nodes_;
  std::array<Frame, 2> frames_;
  Vector3 way_;
  ElasticLaw law_;
};

const KeyTable& stiffness_field_keys();
/// Reads `{nodes: [a, b], stiffness: 12x12 | {file}, damping: time | 12x12 | {file}, an orientation of the matrix's
/// axes}`.
void read_stiffness_field(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
