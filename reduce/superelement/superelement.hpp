// A reduced elastic body: the part of the reduction that the mechanism program uses. Its file is described in
// reduce/superelement/README.md.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "reduce/superelement/adequacy.hpp"
#include "reduce/superelement/recovered_quantity.hpp"

namespace bielle {

/// An interface: a node with up to 6 directions, in its own axes, by which the body is held.
struct Interface {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();           ///< interface axes -> body axes
  std::array<bool, 6> kept = {true, true, true, true, true, true};  ///< x y z rx ry rz, in the interface's axes
};

/// The body's mesh, kept for drawing. Node numbers start at 0; node order within a cell is gmsh's.
struct SuperelementMesh {
  Eigen::Matrix3Xd points;  ///< [m]
  std::map<int, Eigen::MatrixXi>
      cells;  ///< by gmsh element type (4 tet4, 17 hex20, 9 tri6, ...): nodes per cell x cells
  std::map<std::string, std::vector<int>> groups;  ///< nodes of each physical group, ascending
};

/// A load pattern on internal nodes.
struct LoadPattern {
  /// force[k].row(l): reduced generalised force (n) of component k of the pattern acting along body axis l, so that the
  /// pattern can follow the body (sum over k = l) or stay fixed in space.
  std::array<Eigen::Matrix3Xd, 3> force;
};

/// A point inside that the body file names, with the motion of the mesh there or the mean motion of a surface.
struct NamedPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], body axes
  Eigen::MatrixXd shapes;                              ///< (6,n): displacement and rotation, body axes
  /// Directions x y z rx ry rz, body axes, in which a load on the point has a residual vector, so that its static
  /// displacements are exact.
  std::array<bool, 6> residual{};
};

/// A material at nodes where stress is recovered.
struct StressMaterial {
  std::string name;
  Eigen::Matrix<double, 6, 6> elasticity = {};  ///< C [Pa], body axes, in the order xx yy zz yz xz xy
};

/// Materials and groups of the stress at nodes. Without materials (files of other programs) strain cannot be recovered.
struct StressOrigin {
  std::vector<StressMaterial> materials;
  std::vector<int> material_of;                    ///< (s) of each stress node, number in `materials`
  std::map<std::string, std::vector<int>> groups;  ///< by volume group: rows of `stress_nodes`, ascending
};

/// The deformation of the body, held at its interfaces, under its own inertia: energies of its static answer to
/// acceleration fields that are linear in space. Coordinate 4 i + j: direction i (body axes) times 1 [m/s^2], x, y, z
/// [1/s^2] from the centre of mass, so that rigid accelerations and centrifugal fields are combinations c.
struct InertiaAnswer {
  Eigen::MatrixXd whole;    ///< (12,12): c^T whole c / 2 is the energy of the mesh [J]; empty: not known
  Eigen::MatrixXd missing;  ///< the part of that energy that modes and residual vectors lack
};

/// Craig-Bampton model of a free body with n = (kept interface directions) + m (modes) generalised coordinates, ordered
/// interface by interface (translations, then rotations, those that are kept), then modal amplitudes (mass-normalised).
/// The last modes may be residual vectors, which make the static answer to single loads exact.
///
/// Symbols as in the theory: K~ (n,n) and M~ (n,n) symmetric; S_kl = T_k^T m T_l the inertia components with M~ = S_11
/// + S_22 + S_33 (+ rotary inertia of ties, which is in M~ alone).
struct Superelement {
  std::string name;
  std::string created_by;  ///< program and version
  std::string input;       ///< text of the body file

  std::vector<Interface> interfaces;
  Eigen::VectorXd frequencies;        ///< (m) of the fixed-boundary modes [Hz], then of the residual vectors
  Eigen::Index residual_vectors = 0;  ///< number of residual vectors, the last of the modes

  Eigen::MatrixXd stiffness;                          ///< K~ [N/m, N, N m and mixed with amplitudes]
  Eigen::MatrixXd mass;                               ///< M~
  Eigen::MatrixXd damping;                            ///< C~
  std::array<Eigen::MatrixXd, 6> inertia_components;  ///< S_11 S_22 S_33 S_23 S_13 S_12 (S_kl not symmetric for k != l)
  std::array<Eigen::MatrixXd, 6>
      spin_stiffness;  ///< K_sigma per unit Om_k Om_l, order as above; empty when not computed
  std::vector<Eigen::MatrixXd>
      load_stiffness;  ///< K_sigma per unit interface load of each kept direction; may be empty

  /// Rotation of each interface's surface in terms of the coordinates, body axes (3,n), released rotations included;
  /// zero for free ties. The checks of load_stiffness need it; it may be empty.
  std::vector<Eigen::MatrixXd> surface_rotations;

  Eigen::MatrixXd effective_mass;  ///< (m,6) of the modes: x y z [kg], rx ry rz about the centre [kg m^2]
  /// Rotations in each mode of places spread over the body, body axes (3 q,m); a mechanism uses them to judge how far
  /// the body bends in its modes; may be empty.
  Eigen::MatrixXd mode_turns;
  /// Strain xx yy zz yz xz xy (engineering shears) at places spread over the body, then its mean over the body, body
  /// axes (6 (q + 1),n); a mechanism uses it to judge how far the body is strained; may be empty.
  Eigen::MatrixXd strains;
  InertiaAnswer inertia_answer;  ///< a mechanism uses it to judge whether stress is complete; may be empty
  double total_mass = 0;         ///< integrated on the mesh [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< centre of mass [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre, body axes [kg m^2]

  std::map<std::string, LoadPattern> loads;
  std::map<std::string, NamedPoint> points;
  SuperelementMesh mesh;
  Eigen::MatrixXd
      displacement_recovery;  ///< (3p,n): displacement of every node, body axes; rows x y z of node 0, of node 1, ...
  Eigen::MatrixXd stress_recovery;  ///< (6 s,n): xx yy zz yz xz xy [Pa] at the nodes `stress_nodes`; may be empty
  std::vector<int> stress_nodes;    ///< (s) node numbers of the rows of stress_recovery
  StressOrigin stress_origin;
  RecoveredQuantities quantities;        ///< further numbers that another program's file recovers, by name
  std::map<std::string, double> checks;  ///< numbers of every check that the reduction made, by name
  std::optional<Adequacy> adequacy;      ///< its accuracy; absent in files of other programs

  Eigen::Index modes() const { return frequencies.size(); }
  Eigen::Index fixed_boundary_modes() const { return modes() - residual_vectors; }
  Eigen::Index size() const { return stiffness.rows(); }
  Eigen::Index interface_directions() const { return size() - modes(); }
};

/// Place of a superelement: a file, or a group of a file that holds the pieces of a cut body (cut_body.hpp).
struct SuperelementPlace {
  SuperelementPlace() = default;
  SuperelementPlace(std::string file, std::string group_in_file = "/")
      : path(std::move(file)), group(std::move(group_in_file)) {}
  SuperelementPlace(const char* file) : path(file) {}

  std::string path;
  std::string group = "/";
};

/// Version of the file format that this program writes; it reads no other version.
inline constexpr int superelement_version = 2;

/// Writes the whole superelement (under a temporary name, then renamed). @throws ComputationError
void write_superelement(const Superelement& superelement, const std::string& path);

/// Reads and checks shapes, symmetry, finiteness and completeness.
/// @throws InputError if the file is missing, truncated, no superelement, incomplete, or of another version
Superelement read_superelement(const SuperelementPlace& place);

}  // namespace bielle
