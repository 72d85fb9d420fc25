#include "mechanism/elements/forces/stiffness_field.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/laws/read_elastic_law.hpp"
#include "mechanism/measures/middle_frame.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_frame.hpp"

namespace bielle::mechanism {

StiffnessField::StiffnessField(std::string name, std::array<int, 2> nodes, std::array<Frame, 2> frames,
                               const Vector3& way, const Matrix6& K, const Matrix6& D)
    : Component("stiffness_field", std::move(name)),
      nodes_(nodes),
      frames_(frames),
      way_(way),
      law_({"x", "y", "z", "rx", "ry", "rz"}, {false, false, false, true, true, true}) {
  law_.K = K;
  law_.D = D;
}

ElasticLaw::Measures StiffnessField::measures(const LocalState& state, bool second) const {
  ElasticLaw::Measures measures;
  MiddleFrame(state.node(0), state.node(1), frames_[0], frames_[1], way_).calc(measures, second);
  return measures;
}

void StiffnessField::declare(Declaration& declaration) const {
  declaration.nodes.assign(nodes_.begin(), nodes_.end());
  law_.declare(declaration);
  declaration.memory = {0, 0, 0};
}

void StiffnessField::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const Vector3 psi = PairRotation(state.node(0), state.node(1), frames_[0].R, frames_[1].R).psi();
  check_half_turn(state, fmt::format("stiffness_field '{}'", name()), psi, memory.head<3>(),
                  "For a part that turns freely about an axis, take a `bearing` or a hinge");
  memory.head<3>() = psi;
}

void StiffnessField::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  law_.add_residual(state, measures(state, false), r);
}

void StiffnessField::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  law_.add_tangent(state, measures(state, true), tangent);
}

void StiffnessField::add_energy(const LocalState& state, Energy& energy) const {
  law_.add_energy(state, measures(state, false), energy);
}

std::vector<OutputField> StiffnessField::output_fields() const {
  return {{"deformation",
           {6},
           "m, m, m, rad, rad, rad",
           "displacement and rotation vector of the second node relative to the first, along the matrix's axes halfway "
           "between the two"},
          {"force", {3}, "N", "on the second node, inertial components"},
          {"moment", {3}, "N m", "on the second node, inertial components"}};
}

void StiffnessField::write_output(const LocalState& state, double* values) const {
  const ElasticLaw::Measures m = measures(state, false);
  for (std::size_t k = 0; k < 6; ++k) values[k] = m[k].value;
  thread_local VectorX r;
  r.setZero(state.slots().size());
  law_.add_residual(state, m, r);
  Eigen::Map<Vector6> force(values + 6);
  force << -r.segment<3>(6), -(state.node(1).R * r.segment<3>(9));
}

void StiffnessField::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("nodes {} and {}", description.node(nodes_[0]), description.node(nodes_[1])));
  description.add(fmt::format("{:.6g} m apart", way_.norm()));
  for (const std::string& fact : law_.describe()) description.add_line(fact);
}

namespace {

using FieldMap = Eigen::Matrix<double, 12, 6>;

/// Returns B of q = B e.
FieldMap ends_of_deformation() {
  FieldMap B;
  B << -0.5 * Matrix6::Identity(), 0.5 * Matrix6::Identity();
  return B;
}

/// Returns the largest force of each kind that is due to unit rigid motions about the middle of the pair, relative to
/// the size of its terms without cancellation.
double resistance_to_rigid_motions(const MatrixX& K, const Vector3& way) {
  FieldMap rigid = FieldMap::Zero();
  for (const int node : {0, 1}) {
    rigid.block<3, 3>(6 * node, 0).setIdentity();
    rigid.block<3, 3>(6 * node, 3) = -skew((node == 0 ? -0.5 : 0.5) * way);
    rigid.block<3, 3>(6 * node + 3, 3).setIdentity();
  }
  const MatrixX left = (K * rigid).cwiseAbs(), terms = K.cwiseAbs() * rigid.cwiseAbs();
  double most = 0;
  for (const int motion : {0, 3})  // translations, rotations
    for (const int kind : {0, 3}) {
      const auto largest = [&](const MatrixX& A) {
        return std::max(A.block<3, 3>(kind, motion).maxCoeff(), A.block<3, 3>(6 + kind, motion).maxCoeff());
      };
      if (const double size = largest(terms); size > 0) most = std::max(most, largest(left) / size);
    }
  return most;
}

/// Reads a 12x12 matrix A that only connects the two nodes, and returns B^T A B.
Matrix6 read_field(const YamlValue& value, const Vector3& way, bool symmetric, const char* what) {
  MatrixX A = read_square_matrix(value, 12);
  if (symmetric) make_symmetric(value, A);
  // Rigid motions must cause no forces, and the sum of forces must be zero.
  const double rigid = std::max(resistance_to_rigid_motions(A, way), resistance_to_rigid_motions(A.transpose(), way));
  constexpr double rounding = 1e-6, most = 1e-2;
  if (rigid > most)
    value.fail(
        fmt::format("resists rigid motions of the pair by {:.2g} of its entries: it is no field between two nodes "
                    "(are its rows in the order x y z rx ry rz of the first node, then of the second, along the "
                    "axes as drawn, in N and m?). Springs to the ground are joints with `ground`",
                    rigid));
  if (rigid > rounding)
    value.warn(
        fmt::format("resists rigid motions of the pair by {:.2g} of its entries; that part has no effect", rigid));
  const FieldMap B = ends_of_deformation();
  const Matrix6 reduced = B.transpose() * A * B;
  check_semidefinite(value, 0.5 * (reduced + reduced.transpose()), what);
  return reduced;
}

}  // namespace

const KeyTable& stiffness_field_keys() {
  using namespace keys;
  KeyForms damping = forms_of_matrix(12, "N s/m or N s or N s/rad or N m s/rad");
  damping.insert(damping.begin(), number("s").non_negative());
  static const KeyTable table{
      "a stiffness_field", "A part between two nodes with the stiffness matrix of another program.",
      joined({{type_key(),
               {"nodes", list_of(2, name_of("node")), required, "The two nodes."},
               {"stiffness", forms_of_matrix(12, "N/m or N or N/rad or N m/rad"), required,
                "Symmetric matrix in the order x y z rx ry rz of the first node, then of the second."},
               {"damping", damping, optional, "Matrix in the same order, or a time that multiplies the stiffness."}},
              inertial_orientation_keys()})};
  return table;
}

void read_stiffness_field(const std::string& name, const YamlValue& entry, Model& model) {
  const std::vector<int> nodes = nodes_named_by(entry.at("nodes"), 2, model);
  if (nodes[0] == nodes[1]) entry.at("nodes").fail("a stiffness_field joins two different nodes");
  const Frame &a = model.node(nodes[0]).frame, &b = model.node(nodes[1]).frame;
  const Matrix3 axes = read_orientation(entry);
  const Vector3 way = axes.transpose() * (b.x - a.x);
  const Matrix6 K = read_field(entry.at("stiffness"), way, true, "a field that pushes away from its free position");
  Matrix6 D = Matrix6::Zero();
  if (const auto damping = entry.find("damping"))
    D = damping->is_scalar() ? Matrix6(damping->number() * K)
                             : read_field(*damping, way, false, "a damper that drives the motion");
  if (K.isZero(0) && D.isZero(0)) entry.at("stiffness").fail("does nothing: all of its stiffness and damping is zero");
  const auto on = [&](const Frame& node) { return Frame{Vector3::Zero(), node.R.transpose() * axes}; };
  model.add(std::make_unique<StiffnessField>(name, std::array<int, 2>{nodes[0], nodes[1]},
                                             std::array<Frame, 2>{on(a), on(b)}, way, K, D),
            Entry{Section::elements, name});
}

void StiffnessField::draw(Drawing& drawing) const {
  drawing.add({.shape = "stiffness", .places = {{nodes_[0], {}}, {nodes_[1], {}}}});
}

}  // namespace bielle::mechanism
