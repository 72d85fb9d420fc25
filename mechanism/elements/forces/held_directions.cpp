#include "mechanism/elements/forces/held_directions.hpp"

#include <algorithm>
#include <stdexcept>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/direction_words.hpp"

namespace bielle::mechanism {
namespace {

/// The row of one held rotation: its sign, and the axes that stay normal to each other.
struct OneRotation {
  double sign;
  int in_space, on_node;
};
constexpr OneRotation one_rotation[] = {{-1, 1, 2}, {1, 0, 2}, {-1, 0, 1}};

std::vector<std::string> names_of(const std::array<bool, 6>& held) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < 6; ++k)
    if (held[k]) names.emplace_back(direction_words[k]);
  return names;
}

}  // namespace

HeldDirections::HeldDirections(const Node& node, int index, const Matrix3& axes, std::array<bool, 6> held)
    : Component("support", node.name), node_(index), drawn_(node.frame.x), axes_(axes), held_(held) {
  for (int k = 0; k < 3; ++k)
    if (held[static_cast<std::size_t>(k)]) displacements_.push_back(k);
  const auto rotations = std::count(held.begin() + 3, held.end(), true);
  if (rotations == 3) throw std::logic_error("three held rotations are eliminated");
  if (rotations == 2) kept_ = static_cast<int>(std::find(held.begin() + 3, held.end(), false) - held.begin()) - 3;
  for (int k = 0; k < 3; ++k) {
    if (!held[static_cast<std::size_t>(3 + k)]) continue;
    if (rotations == 1) {
      const OneRotation& row = one_rotation[k];
      add_alignment(k, row.in_space, row.on_node, row.sign, node);
    } else {
      // A small rotation by c about q_k moves the kept axis b along q_k x b, which is parallel to the third axis.
      const int across = 3 - k - kept_;
      const double sign = axes.col(k).cross(axes.col(kept_)).dot(axes.col(across)) > 0 ? 1 : -1;
      add_alignment(k, across, kept_, sign, node);
    }
  }
}

void HeldDirections::add_alignment(int held, int in_space, int on_node, double sign, const Node& node) {
  alignments_.push_back({fmt::format("held rotation {}", direction_words[static_cast<std::size_t>(3 + held)]),
                         sign * axes_.col(in_space), node.frame.R.transpose() * axes_.col(on_node)});
}

void HeldDirections::declare(Declaration& declaration) const {
  declaration.nodes = {node_};
  declaration.stiffness = declaration.in_blocks = true;
  for (const int k : displacements_)
    declaration.multipliers.push_back(
        {fmt::format("held displacement {}", direction_words[static_cast<std::size_t>(k)]), "N"});
  for (const Alignment& each : alignments_) declaration.multipliers.push_back({each.name, "N m"});
}

//   a . R b,   g = b x R^T a,   dg = b~ (R^T a)~ dTheta
HeldDirections::Row HeldDirections::row(const Alignment& alignment, const LocalState& state) {
  const Vector3 a = state.node(0).R.transpose() * alignment.in_space;
  return {a.dot(alignment.on_node), alignment.on_node.cross(a), skew(alignment.on_node) * skew(a)};
}

void HeldDirections::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const auto lambda = state.multiplier();
  Eigen::Index k = 0;
  for (const int axis : displacements_) {
    r.head<3>() += lambda[k] * axes_.col(axis);
    r[6 + k] += axes_.col(axis).dot(state.node(0).x - drawn_);
    ++k;
  }
  for (const Alignment& each : alignments_) {
    const Row row = this->row(each, state);
    r.segment<3>(3) += lambda[k] * row.gradient;
    r[6 + k] += row.value;
    ++k;
  }
}

void HeldDirections::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const auto lambda = state.multiplier();
  Matrix3 turning = Matrix3::Zero();
  int k = 0;
  for (const int axis : displacements_) {
    tangent.K.add_column(0, 6 + k, axes_.col(axis));
    tangent.K.add_row(6 + k, 0, axes_.col(axis));
    ++k;
  }
  for (const Alignment& each : alignments_) {
    const Row row = this->row(each, state);
    turning += lambda[k] * row.second;
    tangent.K.add_column(3, 6 + k, row.gradient);
    tangent.K.add_row(6 + k, 3, row.gradient);
    ++k;
  }
  if (!alignments_.empty()) tangent.K.add(3, 3, turning);
}

void HeldDirections::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                          Eigen::Ref<VectorX> acceleration) const {
  const NodeState& node = state.node(0);
  Eigen::Index k = 0;
  for (const int axis : displacements_) {
    velocity[k] += axes_.col(axis).dot(node.v);
    acceleration[k] += axes_.col(axis).dot(node.a);
    ++k;
  }
  for (const Alignment& each : alignments_) {
    const Row row = this->row(each, state);
    velocity[k] += row.gradient.dot(node.Omega);
    acceleration[k] += row.gradient.dot(node.Omegadot) + node.Omega.dot(row.second * node.Omega);
    ++k;
  }
}

std::string HeldDirections::wrong_branch(const LocalState& state) const {
  // The axis that keeps its direction may point the opposite way. One held rotation has no other branch: R_x(a) R_y(b)
  // R_z(pi) is R_x(a + pi) R_y(pi - b).
  if (kept_ < 0) return {};
  const Vector3 axis = state.node(0).R * alignments_.front().on_node;
  return axis.dot(axes_.col(kept_)) < 0 ? "the node is turned over" : std::string();
}

void HeldDirections::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("holds {} along x {}, z {}", fmt::join(names_of(held_), ", "),
                              format_vector(axes_.col(0)), format_vector(axes_.col(2))));
}

void HeldDirections::draw(Drawing& drawing) const {
  DrawnItem support{
      .shape = "support", .places = {{node_, {}}}, .values = {{"fixed", names_of(held_)}}, .role = "support"};
  if (!axes_.isIdentity(0)) {
    const Eigen::Quaterniond q(axes_);
    support.values.emplace_back("axes", std::vector<double>{q.w(), q.x(), q.y(), q.z()});
  }
  drawing.add(std::move(support));
}

}  // namespace bielle::mechanism
