// A pair of meshing gear wheels whose tooth forces load the bearings.
//
// There are two forms, with the geometry of tooth_contact.hpp and the error e of the teeth along their normal [m], a
// function of the wheels' angles (mesh_function.hpp):
//   rigid (no `stiffness`)   u_1(t) - u_2(t) + e/cos(alpha) = 0: pitch surfaces in rolling contact, but for the error.
//                            Its multiplier lambda is the force of wheel 1 on wheel 2 along t [N]. The loaded flank is
//                            inclined: the teeth push each other apart along nu by |lambda| tan(alpha)
//                            (GearSeparation, which reads the reaction)
//   elastic                  a flank of normal n is in contact if p = u_1(n) - u_2(n) +- e - backlash/2 > 0 and pushes
//                            with N = max(0, k p + d pdot): spring and damper of the teeth, with free play between the
//                            flanks. The error moves both flanks of a tooth alike (+ for n_+, - for n_-)
// The stiffness k may depend on the angles phi of the wheels. The elastic force derives from the potential V = k(phi)
// p^2/2: besides k p along the gradient of p it has the parametric torque k'(phi) p^2/2 on each such wheel, against the
// carrier. Energy is conserved at any motion; the torque is smaller than k p times the radius by about the deformation
// over the pitch of the teeth. The transmission error is the lead of wheel 2,
//     TE = cos(alpha) (u_2(t) - u_1(t))   [m, along the normal of the teeth];
// rigid teeth have TE = e, elastic ones under the load F TE = e - backlash/2 - F/k, if the bearings are at rest. With
// backlash, contact of a flank begins and ends when p changes its sign: steps end there. Both flanks may touch (if
// bearings press the wheels together).
#pragma once

#include "mechanism/joints/gears/mesh_function.hpp"
#include "mechanism/joints/gears/tooth_contact.hpp"
#include "mechanism/model/measure.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Nodes, memory of angles, and description of both forms.
class GearMesh : public Component {
 public:
  /// @param nodes  carrier, wheel 1, wheel 2
  /// @param errors  e [m]
  GearMesh(std::string name, std::array<int, 3> nodes, std::array<std::string, 3> names, const ToothGeometry& geometry,
           MeshFunction errors);
  const ToothContact& contact() const { return contact_; }
  void declare(Declaration& declaration) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  /// Outputs: `approach`: u_1(t) - u_2(t) [m], the lead of wheel 1; `force`: normal forces [N] of the two flanks n_+
  /// and n_-; `transmission_error` [m].
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;
  /// The names are "approach", "transmission_error", "force", "angle_1", "angle_2", and for elastic teeth also
  /// "deformation" and "stiffness".
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

  /// Computes TE.
  MeshSlope transmission_error(const LocalState& state) const;
  /// Computes the normal force, positive if wheel 1 drives wheel 2 forwards, with its derivatives over the local
  /// layout.
  /// @param gradient  zero on entry
  virtual double calc_force(const LocalState& state, MeasureGradient& gradient) const = 0;
  /// Tells whether that force is a reaction.
  virtual bool force_is_reaction() const = 0;

 protected:
  /// Returns the normal forces of the flanks n_+, n_- [N].
  virtual std::array<double, 2> flank_forces(const LocalState& state) const = 0;
  const MeshFunction& errors() const { return errors_; }
  /// Computes e. The order is 1 or 2.
  template <int order>
  MeshMeasureOf<order> error(const LocalState& state) const {
    return errors().calc<order>(contact(), state);
  }

 private:
  std::array<int, 3> nodes_;
  std::array<std::string, 3> names_;
  ToothContact contact_;
  MeshFunction errors_;
};

class RigidGearMesh final : public GearMesh {
 public:
  using GearMesh::GearMesh;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  double calc_force(const LocalState& state, MeasureGradient& gradient) const override;
  bool force_is_reaction() const override { return true; }

 private:
  template <int order>
  MeshMeasureOf<order> gap(const LocalState& state) const;  ///< u_1(t) - u_2(t) + e/cos(alpha)
  std::array<double, 2> flank_forces(const LocalState& state) const override;
};

/// Separating force on the wheels of a rigid mesh. Its work counts as input, and is zero as long as bearings do not
/// move.
class GearSeparation final : public Component {
 public:
  GearSeparation(std::string name, const RigidGearMesh& mesh);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;

 private:
  const RigidGearMesh& mesh_;
  double slope_;  ///< tan(alpha)
};

struct ToothSpring {
  MeshFunction stiffness;  ///< stiffness k of the teeth along their normal [N/m]
  double damping;          ///< damping [N s/m]
  double backlash;         ///< free play along the normal, from flank to flank [m]
};

class ElasticGearMesh final : public GearMesh {
 public:
  ElasticGearMesh(std::string name, std::array<int, 3> nodes, std::array<std::string, 3> names,
                  const ToothGeometry& geometry, MeshFunction errors, ToothSpring spring);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  void describe(const LocalState& state, Description& description) const override;
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  double calc_force(const LocalState& state, MeasureGradient& gradient) const override;
  bool force_is_reaction() const override { return false; }
  /// @throws ComputationError if it is not positive at these angles
  template <int order>
  MeshMeasureOf<order> stiffness(const LocalState& state) const;
  /// Computes p [m] of the flank that is deeper in contact or, without contact, nearer to it.
  MeshSlope deformation(const LocalState& state) const;

 private:
  template <int order>
  struct Flank {
    MeshMeasureOf<order> p;  ///< penetration p [m]
    double rate = 0;
    bool touches = false, pushes = false;
    double force = 0;    ///< normal force [N]
    double pressed = 0;  ///< p as far as it stores energy [m]
  };
  bool plays() const { return spring_.backlash > 0; }
  template <int order>
  MeshMeasureOf<order> penetration(int side, const MeshMeasureOf<order>& error, const LocalState& state) const;
  /// @param stiffness,error  k and e at the state
  template <int order>
  Flank<order> flank(int side, double stiffness, const MeshMeasureOf<order>& error, const LocalState& state) const;
  /// Computes N of a flank that pushes, with its derivatives by positions. (That by rates is d times the gradient of
  /// p.)
  MeshMeasure::Gradient force_gradient(const Flank<2>& flank, const MeshMeasure& stiffness,
                                       const LocalState& state) const;
  Vector3 normal(int side) const;  ///< 0: n_+, 1: n_-
  std::array<double, 2> flank_forces(const LocalState& state) const override;
  ToothSpring spring_;
};

const KeyTable& gear_mesh_keys();
/// Reads `gear_mesh: {nodes: [wheel_1, wheel_2], carrier, axes, radii | position, internal, pressure_angle,
/// helix_angle, stiffness, damping, backlash, errors}`.
void read_gear_mesh(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
