// A rigid mass on a node: rigid bodies and point masses.
//
// The body has mass m, centre of mass c and inertia J about the node, c and J in the node's axes. With x the node's
// position and R, Omega its axes and body angular velocity:
//     force   m (xddot - g) + m R (Omegadot~ c + Omega~ Omega~ c)          (inertial)
//     moment  J Omegadot + Omega~ J Omega + m c~ R^T (xddot - g)           (node axes)
//     T = m |xdot|^2/2 + m xdot . R Omega~ c + Omega . J Omega/2,   gravity -m g . (x + R c)
// Reference: M. Geradin, A. Cardona, Flexible Multibody Dynamics (Wiley, 2001), ch. 4.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mechanism/elements/rigid_body/mass_properties.hpp"
#include "mechanism/model/component.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Mass, centre and inertia rigidly fixed on one node; gravity acts at the centre. The tangents are exact.
class RigidBody final : public Component {
 public:
  /// @param type  type as in the input file: "rigid_body" or "point_mass"
  /// @param node_name  name of the node, for the results file
  RigidBody(std::string type, std::string name, int node, const MassProperties& properties,
            const std::string& node_name = "");

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Outputs, in inertial components: `centre` of mass (3) [m], `momentum` (3) [N s], `angular_momentum` (3) [N m s]
  /// about the inertial origin.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  /// Attributes `node`; `mass` [kg], `centre` x y z [m], `inertia` about the centre xx yy zz xy xz yz [kg m^2], in the
  /// node's axes.
  std::vector<std::pair<std::string, std::string>> attributes() const override { return attributes_; }

  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

  int node() const { return node_; }
  const MassProperties& properties() const { return properties_; }  ///< in the node's axes
  /// Adds inertia about the node's origin for rotations on which no component acts, so that their equations are
  /// regular; it is not a property of the body. @param inertia  node axes [kg m^2]
  void add_idle_inertia(const Matrix3& inertia) { J_ += inertia; }

 private:
  MassProperties properties_;
  int node_;
  double m_;
  Vector3 c_;
  Matrix3 J_;  ///< about the node's origin
  std::vector<std::pair<std::string, std::string>> attributes_;
};

const KeyTable& rigid_body_keys();
/// Reads `{type: rigid_body, node, mass, centre, inertia, inertia_about, inertia_axes, also}`, or the same with `solid`
/// instead of mass and inertia.
void read_rigid_body(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& point_mass_keys();
/// Reads `{type: point_mass, node, mass, centre}`.
void read_point_mass(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
