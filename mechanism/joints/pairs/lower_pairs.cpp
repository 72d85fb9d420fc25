#include "mechanism/joints/pairs/lower_pairs.hpp"

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/joints/pairs/read_pair.hpp"

namespace bielle::mechanism {

LowerPair::LowerPair(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
                     const LockedMotions& locked, const Model& model)
    : Joint(std::move(type), std::move(name), std::move(frames), std::move(coordinates), model),
      locks_point_(locked.translation == std::array{true, true, true}) {
  constexpr const char* force_names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    if (locked.translation[static_cast<std::size_t>(k)]) rows_.push_back({true, k, 0, force_names[k]});
  if (locked.rotation != LockedMotions::Rotation::none) {
    // y_A . z_B is a rotation about x, x_A . z_B one about y, x_A . y_B one about z.
    rows_.push_back({false, 1, 2, "rx"});
    rows_.push_back({false, 0, 2, "ry"});
  }
  if (locked.rotation == LockedMotions::Rotation::all) rows_.push_back({false, 0, 1, "rz"});
}

PairMeasure LowerPair::calc_row(const Row& row, const NodeState& first, const NodeState& second) const {
  const Frame &A = frames().on_first, &B = frames().on_second;
  return row.is_translation ? measure_position(first, second, A.R.col(row.first_axis), A.x, B.x)
                            : measure_alignment(first, second, A.R.col(row.first_axis), B.R.col(row.second_axis));
}

AxisPair LowerPair::axes(const Row& row, const Matrix3& R_12) const {
  return {R_12, frames().on_first.R.col(row.first_axis), frames().on_second.R.col(row.second_axis)};
}

void LowerPair::declare(Declaration& declaration) const {
  Joint::declare(declaration);
  declaration.stiffness = declaration.in_blocks = true;
  for (const Row& row : rows_) declaration.multipliers.push_back({row.name, row.is_translation ? "N" : "N m"});
}

void LowerPair::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const auto lambda = state.multiplier();
  const NodeState &first = state.node(0), &second = state.node(1);
  const Matrix3 R_12 = first.R.transpose() * second.R;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].is_translation) continue;
    const auto row = static_cast<Eigen::Index>(k);
    const AxisPair pair = axes(rows_[k], R_12);
    r.segment<3>(3) += lambda[row] * pair.first_gradient();
    r.segment<3>(9) += lambda[row] * pair.second_gradient();
    r[12 + row] += pair.value();
  }
  if (inertial(state)) {
    const PointGap gap(first, second, frames().on_first.x, frames().on_second.x);
    r.segment<3>(12) += gap.value();
    gap.add_forces(lambda.head<3>(), r);
    return;
  }
  const PointPair points(first, second, R_12, frames().on_second.x);
  Vector3 force = Vector3::Zero();  // force of the locked translations, first node's axes
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (!rows_[k].is_translation) continue;
    const auto row = static_cast<Eigen::Index>(k);
    const Vector3 e_hat = frames().on_first.R.col(rows_[k].first_axis);
    force += lambda[row] * e_hat;
    r[12 + row] += points.value(e_hat, frames().on_first.x);
  }
  r.head<12>() += points.gradient(force);
}

void LowerPair::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const auto lambda = state.multiplier();
  const NodeState &first = state.node(0), &second = state.node(1);
  const Matrix3 R_12 = first.R.transpose() * second.R;
  LocalMatrix& K = tangent.K;
  const auto add_gradient = [&](std::size_t row, int column, const Vector3& gradient) {
    const int constraint = 12 + static_cast<int>(row);
    K.add_column(column, constraint, gradient);
    K.add_row(constraint, column, gradient);
  };
  PairHessian second_derivatives;  // sum over all rows, each times its multiplier
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].is_translation) continue;
    const AxisPair pair = axes(rows_[k], R_12);
    pair.add_second(lambda[static_cast<Eigen::Index>(k)], second_derivatives);
    add_gradient(k, 3, pair.first_gradient());
    add_gradient(k, 9, pair.second_gradient());
  }
  if (inertial(state)) {
    const PointGap gap(first, second, frames().on_first.x, frames().on_second.x);
    gap.add_gradients(12, K);
    gap.add_second(lambda.head<3>(), second_derivatives);
  } else {
    const PointPair points(first, second, R_12, frames().on_second.x);
    Vector3 force = Vector3::Zero();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (!rows_[k].is_translation) continue;
      const Vector3 e_hat = frames().on_first.R.col(rows_[k].first_axis);
      force += lambda[static_cast<Eigen::Index>(k)] * e_hat;
      const Vector12 gradient = points.gradient(e_hat);
      for (const int column : {0, 3, 6, 9}) add_gradient(k, column, gradient.segment<3>(column));
    }
    points.add_second(force, second_derivatives);
  }
  second_derivatives.add_to(K, !inertial(state), couples_rotations(state.slots()));
}

void LowerPair::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  const auto count = static_cast<int>(rows_.size());
  const auto add_rows = [&](int begin, int end) {
    for (const int rotation : {3, 9}) {
      pattern.add_block(rotation, 12 + begin, 3, end - begin);
      pattern.add_block(12 + begin, rotation, end - begin, 3);
    }
  };
  int translations = 0;
  while (translations < count && rows_[static_cast<std::size_t>(translations)].is_translation) ++translations;
  add_rows(0, count);
  for (const int rotation : {3, 9}) pattern.add_block(rotation, rotation);
  if (couples_rotations(slots)) {
    pattern.add_block(3, 9);
    pattern.add_block(9, 3);
  }
  for (const int position : {0, 6}) {
    if (inertial(slots)) {
      pattern.add_diagonal(position, 12);
      pattern.add_diagonal(12, position);
      continue;
    }
    pattern.add_block(position, 12, 3, translations);
    pattern.add_block(12, position, translations, 3);
    pattern.add_block(position, 3);
    pattern.add_block(3, position);
  }
}

void LowerPair::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                     Eigen::Ref<VectorX> acceleration) const {
  const NodeState &first = state.node(0), &second = state.node(1);
  const Vector12 v = pair_rate(first, second), a = pair_acceleration(first, second);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].is_translation && inertial(state)) continue;
    const PairMeasure m = calc_row(rows_[k], first, second);
    velocity[static_cast<Eigen::Index>(k)] += m.rate(v);
    acceleration[static_cast<Eigen::Index>(k)] += m.acceleration(v, a);
  }
  if (!inertial(state)) return;
  const PointGap gap(first, second, frames().on_first.x, frames().on_second.x);
  velocity.head<3>() += gap.rate(first, second);
  acceleration.head<3>() += gap.acceleration(first, second);
}

std::string LowerPair::wrong_branch(const LocalState& state) const {
  // Rows of alignment are also zero for axes that are rotated by half a turn.
  const Matrix3 R_A = state.node(0).R * frames().on_first.R, R_B = state.node(1).R * frames().on_second.R;
  const auto opposite = [&](int axis) { return R_A.col(axis).dot(R_B.col(axis)) < 0; };
  for (const Row& row : rows_) {
    if (row.is_translation) continue;
    if (opposite(2)) return "its axes point in opposite directions";
    if (row.second_axis == 1 && opposite(1)) return "its parts are turned by half a turn about its axis";
  }
  return {};
}

Vector3 LowerPair::misalignment(const LocalState& state) const {
  if (rows_.empty() || rows_.back().is_translation) return Vector3::Zero();
  const Matrix3 R_A = state.node(0).R * frames().on_first.R, R_B = state.node(1).R * frames().on_second.R;
  if (rows_.back().second_axis == 1) return log_so3(Matrix3(R_A * R_B.transpose()));
  return smallest_turn(R_B.col(2), R_A.col(2), R_A.col(0));
}

namespace {

std::vector<Key> keys_of_pair(AxisNeed need, Moves moves) {
  const AxisUse use = moves == Moves::slides ? AxisUse::sliding : AxisUse::turning;
  return keys::joined({joint_frame_keys(need, "axis", use), joint_action_keys(moves)});
}

void read_lower_pair(const std::string& type, const std::string& name, const YamlValue& entry, Model& model,
                     AxisNeed need, std::vector<JointCoordinate> coordinates, const LockedMotions& locked) {
  add_pair(std::make_unique<LowerPair>(type, name, read_joint_frames(entry, model, need), std::move(coordinates),
                                       locked, model),
           entry, model);
}

using Rotation = LockedMotions::Rotation;
using CoordinateKind = JointCoordinate::Kind;
const JointCoordinate angle{"angle", CoordinateKind::angle, 2},
    displacement{"displacement", CoordinateKind::displacement, 2};

}  // namespace

const KeyTable& rigid_keys() {
  static const KeyTable table{"a rigid joint", "A joint that fixes two nodes to each other.",
                              keys_of_pair(AxisNeed::optional, Moves::both)};
  return table;
}

void read_rigid(const std::string& name, const YamlValue& entry, Model& model) {
  read_lower_pair("rigid", name, entry, model, AxisNeed::optional, {}, {{true, true, true}, Rotation::all});
}

const KeyTable& hinge_keys() {
  static const KeyTable table{"a hinge", "A joint that leaves turning about an axis free.",
                              keys_of_pair(AxisNeed::required, Moves::turns)};
  return table;
}

void read_hinge(const std::string& name, const YamlValue& entry, Model& model) {
  read_lower_pair("hinge", name, entry, model, AxisNeed::required, {angle}, {{true, true, true}, Rotation::tilt});
}

const KeyTable& prismatic_keys() {
  static const KeyTable table{"a prismatic joint", "A joint that leaves sliding along an axis free.",
                              keys_of_pair(AxisNeed::required, Moves::slides)};
  return table;
}

void read_prismatic(const std::string& name, const YamlValue& entry, Model& model) {
  read_lower_pair("prismatic", name, entry, model, AxisNeed::required, {displacement},
                  {{true, true, false}, Rotation::all});
}

const KeyTable& cylindrical_keys() {
  static const KeyTable table{"a cylindrical joint",
                              "A joint that leaves sliding along an axis and turning about it free.",
                              keys_of_pair(AxisNeed::required, Moves::both)};
  return table;
}

void read_cylindrical(const std::string& name, const YamlValue& entry, Model& model) {
  read_lower_pair("cylindrical", name, entry, model, AxisNeed::required, {displacement, angle},
                  {{true, true, false}, Rotation::tilt});
}

const KeyTable& spherical_keys() {
  static const KeyTable table{"a spherical joint", "A joint that holds a point and leaves turning free.",
                              keys_of_pair(AxisNeed::optional, Moves::turns)};
  return table;
}

void read_spherical(const std::string& name, const YamlValue& entry, Model& model) {
  read_lower_pair(
      "spherical", name, entry, model, AxisNeed::optional,
      {{"rx", CoordinateKind::rotation, 0}, {"ry", CoordinateKind::rotation, 1}, {"rz", CoordinateKind::rotation, 2}},
      {{true, true, true}, Rotation::none});
}

const KeyTable& planar_keys() {
  static const KeyTable table{"a planar joint", "A joint that leaves sliding across an axis and turning about it free.",
                              keys_of_pair(AxisNeed::required, Moves::both)};
  return table;
}

void read_planar(const std::string& name, const YamlValue& entry, Model& model) {
  read_lower_pair("planar", name, entry, model, AxisNeed::required,
                  {{"x", CoordinateKind::displacement, 0}, {"y", CoordinateKind::displacement, 1}, angle},
                  {{false, false, true}, Rotation::tilt});
}

void LowerPair::draw(Drawing& drawing) const {
  Joint::draw(drawing);
  if (type() == "point_on_plane") drawing.add({.shape = "plane", .places = {{frames().first, frames().on_first}}});
}

}  // namespace bielle::mechanism
