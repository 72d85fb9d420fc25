// A reduced elastic body in a mechanism: interface nodes and modal amplitudes, small local displacements in a corotated
// frame, large motions.
//
//   T = s^T M~ s / 2 + s^T G(Om_0) eps + eps^T H(Om_0) eps / 2
//   V = eps^T K~ eps / 2,      dissipation epsdot^T C~ epsdot
//
// The kinetic energy is exact for the displacement field of the reduction; the equations are Lagrange's, so that energy
// and momenta are conserved and forces are objective. Residual and all three tangents K, C, M are exact. Frame:
// corotated_frame.hpp; coordinates: linear_coordinates.hpp; matrices: superelement_body_matrices.hpp; forces:
// superelement_body_motion.hpp.
//
// Prestress: linear elasticity contains neither the stiffening of a body under tension nor the shortening of a bent
// body. The file's geometric stiffness provides both: the part of the centrifugal field is contained in H, that of
// interface loads in the relation of eps to the positions of the interfaces, which makes V a potential of third order
// without memory.
//
// Limits: strains and rotations within the body are small (to about 0.2 rad from the mean of its interfaces; larger
// bending requires several superelements); load patterns do not prestress it; the membrane forces of a plate that bends
// by more than its thickness are missing; damping acts only on eps.
//
// Reference: A. Cardona, M. Geradin, Modelling of superelements in mechanism analysis, IJNME 32 (1991) 1565, for the
// role of a superelement among nodes; the inertia differs from that paper (whose nodal velocities are not Galilean
// invariant).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/elements/superelement/attached_point.hpp"
#include "mechanism/elements/superelement/body_deformation.hpp"
#include "mechanism/elements/superelement/recovery/recovered_outputs.hpp"
#include "mechanism/elements/superelement/superelement_body_motion.hpp"
#include "mechanism/model/mesh_fields.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "reduce/common/formula/expression.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Conditions of a body's frame, see frame_conditions.hpp.
enum class BodyFrame { mean, mean_axes, carried };

/// Position of a superelement in a mechanism.
struct SuperelementPlacement {
  std::vector<int> nodes;                    ///< node of the model for each interface
  std::vector<Vector3> reference_positions;  ///< positions of these nodes in the undeformed body [m], body axes
  std::vector<Matrix3> reference_rotations;  ///< node axes -> body axes of the undeformed body

  struct Load {
    std::string pattern;  ///< name of the pattern in the file
    Expression factor;    ///< factor as a function of t
    bool follows = true;  ///< whether directions rotate with the body (a pressure); otherwise they are fixed in space
  };
  std::vector<Load> loads;
  std::vector<std::string> node_names;  ///< names for the results file
  BodyFrame frame = BodyFrame::mean;
  std::size_t frame_interface = 0;  ///< interface for BodyFrame::carried
  /// Damping matrix in the file's coordinates, which replaces the file's; empty: the file's is used.
  MatrixX damping;
  std::shared_ptr<const SuperelementMatrices> matrices;  ///< matrices shared by the bodies of one file; created if null
  SuperelementPlace file;                                ///< file of the superelement
  std::optional<double> largest_error;  ///< relative error of its deformation beyond which a run fails (validity.hpp)
};

class SuperelementBody : public Component, public TimeDependent, public MeshFields {
 public:
  /// A point inside the body that carries its own node.
  struct Point {
    std::string name;
    int node = 0;  ///< node of the model
    PointPlace place;
    /// Whether the basis contains the static response to each force and moment on the point, body axes.
    std::array<bool, 6> residual{};
  };
  /// @throws InputError if arrays of the superelement are inconsistent or a pattern does not exist
  SuperelementBody(std::string name, const Superelement& superelement, SuperelementPlacement placement);

  ~SuperelementBody() override;

  /// Attaches one more node to the body. It is called while the model is read.
  void attach(Point point) { points_.push_back(std::move(point)); }

  void declare(Declaration& declaration) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  std::vector<std::pair<std::string, std::string>> attributes() const override;
  void add_break_points(std::vector<double>& times) const override;
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;
  MeshFields* mesh_fields() override { return this; }
  std::vector<std::string> field_names() const override;
  void record_field(const std::string& field) override;
  void record_quantity(const std::string& name) override;
  std::vector<std::string> point_field_names() const override;
  void record_at(const std::string& field, const std::string& name, const MeshPlace& place) override;
  std::vector<std::string> peak_names() const override;
  void record_peaks(const std::vector<std::string>& quantities) override;
  bool outputs_together() const override { return recovered_.large(); }
  void write_outputs(std::span<const LocalState> states, std::span<double* const> values) const override;
  std::unique_ptr<StepRecorder> make_step_recorder() const override;
  /// Describes file, mass, modes with the range of their frequencies, interfaces with their nodes, loads.
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

  const SuperelementMatrices& matrices() const { return *matrices_; }
  const MatrixX& damping() const { return damping_.size() > 0 ? damping_ : matrices_->C; }  ///< C~ of this body
  const CorotatedFrame& frame() const { return frame_; }
  const SuperelementPlace& file() const { return file_; }
  const std::vector<int>& nodes() const { return nodes_; }  ///< interface nodes in the model

 private:
  struct Workspace;
  class Workspaces;
  class Loan;
  /// Returns working memory with the frame and the linear coordinates at a state.
  Loan evaluate_positions(const LocalState& state) const;
  /// Returns working memory with positions, the motion and the attached points.
  Loan evaluate_motion(const LocalState& state) const;
  /// Returns working memory with positions, motion and forces.
  Loan evaluate(const LocalState& state) const;
  /// Computes further parts of an evaluation unless they have been computed before.
  void complete_velocities(const Loan& work, const LocalState& state) const;
  void complete_products(const Loan& work) const;
  void complete_mean_turning(const Loan& work, const LocalState& state) const;
  void complete_loads(const Loan& work, const LocalState& state) const;
  void read_deformation(const LocalState& state, BodyDeformation& deformation) const;
  Eigen::Index coordinates() const;  ///< number of local coordinates in the file's order
  /// Writes the outputs that do not require the mesh. @returns the local coordinates among the values
  const double* write_small_outputs(const LocalState& state, double* values) const;

  /// Describes one of the pieces of a body that one entry of the file cuts.
  void describe_piece(Description& description) const;
  void describe_attachments(Description& description) const;  ///< describes interfaces with their nodes, and loads
  std::string describe_modes() const;

  struct Load {
    std::size_t pattern;
    Expression factor;
    bool follows;
  };
  std::shared_ptr<const SuperelementMatrices> matrices_;
  MatrixX damping_;  ///< C~ of this body; empty: that of the matrices
  CorotatedFrame frame_;
  std::vector<int> nodes_;
  std::vector<Load> loads_;
  std::vector<Point> points_;
  std::vector<std::pair<std::string, std::string>> attributes_;
  SuperelementPlace file_;
  std::optional<double> largest_error_;
  std::vector<std::string> interfaces_;  ///< names of interfaces, in the order of the nodes
  VectorX frequencies_;                  ///< frequencies of the fixed-boundary modes [Hz]
  Eigen::Index residual_vectors_ = 0;    ///< number of additional modes that are residual vectors
  MatrixX mode_turns_;                   ///< as in Superelement
  InertiaAnswer inertia_answer_;         ///< as in Superelement
  RecoveredOutputs recovered_;
  std::vector<std::string> peaks_;  ///< requested peaks
  std::unique_ptr<Workspaces> workspaces_;
};

const KeyTable& superelement_keys();
/// Reads `name: {type: superelement, ...}` of the elements; see superelement_body_reader.cpp.
void read_superelement_body(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
