// A reduced elastic body in a mechanism: interface nodes and modal amplitudes, small local displacements in a corotated
// frame, large motions.
//
//   T = s^T M~ s / 2 + s^T G(Om_0) q + q^T H(Om_0) q / 2
//   V = q^T (K~ + F_j K_load,j) q / 2,      dissipation qdot^T C~ qdot
//
// The kinetic energy is exact for the displacement field of the reduction; equations are Lagrange's, so that energy and
// momenta are conserved and every observer sees the same forces. Residual and all three tangents K, C, M are exact.
// Frame and coordinates: corotated_frame.hpp; matrices: superelement_body_matrices.hpp; forces:
// superelement_body_motion.hpp.
//
// Prestress. Linear elasticity lacks the stiffening of a body under tension. The file's geometric stiffness brings it
// back: that of the centrifugal field inside H, that of interface loads F_j with the values of the last accepted state
// (memory), which makes V a potential within a step and lets the energy balance show what a changing F_j adds.
//
// Limits: strains and rotations within the body are small (what bends by more than a few per cent of its length wants
// several superelements); load patterns and gravity do not prestress it; damping acts on q alone.
//
// Reference: A. Cardona, M. Geradin, Modelling of superelements in mechanism analysis, IJNME 32 (1991) 1565, for the
// place of a superelement among nodes; the inertia is not theirs (their nodal velocities are not Galilean invariant).
#pragma once

#include "mechanism/elements/recovered_field.hpp"
#include "mechanism/elements/superelement_body_motion.hpp"
#include "mechanism/system/model.hpp"
#include "reduce/common/expression.hpp"

namespace bielle::mechanism {

/// How a superelement stands in a mechanism.
struct SuperelementPlacement {
  std::vector<int> nodes;                    ///< model's node of each interface
  std::vector<Vector3> reference_positions;  ///< of these nodes in the undeformed body [m], body axes
  std::vector<Matrix3> reference_rotations;  ///< node axes -> body axes of the undeformed body

  struct Load {
    std::string pattern;  ///< name in the file
    Expression factor;    ///< of t
    bool follows = true;  ///< turns with the body (a pressure); else its directions stay fixed in space
  };
  std::vector<Load> loads;
  std::vector<std::string> node_names;  ///< for the results file
  std::string file;                     ///< where the superelement was read from
};

class SuperelementBody : public Component {
 public:
  /// @throws InputError when arrays of the superelement do not fit each other or a pattern does not exist
  SuperelementBody(std::string name, const Superelement& superelement, SuperelementPlacement placement);

  ~SuperelementBody() override;

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  std::vector<std::pair<std::string, std::string>> attributes() const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void add_break_points(std::vector<double>& times) const override;
  std::vector<std::string> optional_fields() const override;
  void record_field(const std::string& field) override;

  const SuperelementMatrices& matrices() const { return matrices_; }
  const CorotatedFrame& frame() const { return frame_; }

 private:
  struct Workspace;
  class Workspaces;
  class Loan;
  /// Working memory with motion and forces at a state.
  Loan evaluate(const LocalState& state) const;

  struct Load {
    std::size_t pattern;
    Expression factor;
    bool follows;
  };
  SuperelementMatrices matrices_;
  CorotatedFrame frame_;
  std::vector<int> nodes_;
  std::vector<Load> loads_;
  std::vector<std::pair<std::string, std::string>> attributes_;
  std::string file_;
  std::vector<RecoveredField> fields_;
  std::unique_ptr<Workspaces> workspaces_;
};

/// Reads `name: {type: superelement, ...}` of the elements; see superelement_body_reader.cpp.
void read_superelement_body(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
