// A pair of meshing gear wheels whose tooth forces load the bearings.
//
// There are two forms, with the geometry of tooth_contact.hpp:
//   rigid (no `stiffness`)   u_1(t) - u_2(t) = 0, as pitch surfaces in rolling contact. Its multiplier lambda is
//   the
//                            force of wheel 1 on wheel 2 along t [N]. The loaded flank is inclined: the teeth
//                            push each other apart along nu by |lambda| tan(alpha) (GearSeparation, which reads the
//                            reaction)
//   elastic                  a flank of normal n is in contact if p = u_1(n) - u_2(n) - backlash/2 > 0 and pushes
//   with
//                            max(0, k p + d pdot): spring and damper of the teeth, with free play between the flanks
// With backlash, contact of a flank begins and ends when p changes its sign: steps end there. Both flanks may touch (if
// bearings press the wheels together).
#pragma once

#include "mechanism/joints/gears/tooth_contact.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Nodes, memory of angles, and description of both forms.
class GearMesh : public Component {
 public:
  /// @param nodes  carrier, wheel 1, wheel 2
  GearMesh(std::string name, std::array<int, 3> nodes, std::array<std::string, 3> names, const ToothGeometry& geometry);
  const ToothContact& contact() const { return contact_; }
  void declare(Declaration& declaration) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  /// Outputs: `approach`: u_1(t) - u_2(t) [m], the lead of wheel 1; `force`: normal forces [N] of the flanks n_+ and
  /// n_-.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

 protected:
  /// Normal forces of the flanks n_+, n_- [N].
  virtual std::array<double, 2> flank_forces(const LocalState& state) const = 0;

 private:
  std::array<int, 3> nodes_;
  std::array<std::string, 3> names_;
  ToothContact contact_;
};

class RigidGearMesh final : public GearMesh {
 public:
  using GearMesh::GearMesh;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;

 private:
  std::array<double, 2> flank_forces(const LocalState& state) const override;
};

/// Separating force on the wheels of a rigid mesh. Its work is input: zero as long as bearings do not move.
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
  double stiffness;  ///< stiffness of a pair of teeth along their normal [N/m]
  double damping;    ///< damping [N s/m]
  double backlash;   ///< free play along the normal, from flank to flank [m]
};

class ElasticGearMesh final : public GearMesh {
 public:
  ElasticGearMesh(std::string name, std::array<int, 3> nodes, std::array<std::string, 3> names,
                  const ToothGeometry& geometry, const ToothSpring& spring);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  struct Flank {
    MeshMeasure p;  ///< penetration p [m]
    double rate = 0;
    bool touches = false, pushes = false;
    double force = 0;  ///< normal force [N]
  };
  bool plays() const { return spring_.backlash > 0; }
  Flank flank(int side, const LocalState& state) const;
  Vector3 normal(int side) const;  ///< 0: n_+, 1: n_-
  std::array<double, 2> flank_forces(const LocalState& state) const override;
  ToothSpring spring_;
};

const KeyTable& gear_mesh_keys();
/// Reads `gear_mesh: {nodes: [wheel_1, wheel_2], carrier, axes, radii | position, internal, pressure_angle,
/// helix_angle, stiffness, damping, backlash}`.
void read_gear_mesh(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
