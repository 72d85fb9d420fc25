#include "mechanism/system/node_kinematics.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Returns for each node the one at the end of its chain of carriers, which is carried by none.
/// @throws InputError if carriers form a circle
std::vector<int> root_carriers(const Model& model) {
  constexpr int unknown = -1, under_way = -2;
  std::vector<int> root(model.nodes().size(), unknown), line;
  for (int start = 0; start < static_cast<int>(root.size()); ++start) {
    line.clear();
    int node = start;
    for (; root[static_cast<std::size_t>(node)] == unknown && model.node(node).carrier;
         node = *model.node(node).carrier) {
      root[static_cast<std::size_t>(node)] = under_way;
      line.push_back(node);
    }
    int& end = root[static_cast<std::size_t>(node)];
    if (end == under_way)
      throw InputError(fmt::format("node '{}' is carried by itself, through other nodes", model.node(node).name));
    if (end == unknown) end = node;
    for (const int each : line) root[static_cast<std::size_t>(each)] = end;
  }
  return root;
}

int count_rotations(const Node& node, Freedom kind) {
  return static_cast<int>(std::count(node.freedom.begin() + 3, node.freedom.end(), kind));
}

NodeFreedom freedom_of(const Node& node, int begin) {
  NodeFreedom f;
  f.begin = begin;
  for (int k = 0; k < 3; ++k)
    if (node.freedom[static_cast<std::size_t>(k)] == Freedom::free) f.G(k, f.count++) = 1;
  const int free_rotations = count_rotations(node, Freedom::free);
  if (free_rotations == 3) {
    for (int k = 0; k < 3; ++k) f.G(3 + k, f.count++) = 1;
  } else if (free_rotations == 1) {
    if (count_rotations(node, Freedom::prescribed) > 0)
      throw InputError(fmt::format(
          "node '{}': with one free rotation the other two must be fixed; prescribe all three rotations or use a joint",
          node.name));
    for (int k = 0; k < 3; ++k)
      if (node.freedom[static_cast<std::size_t>(3 + k)] == Freedom::free)
        f.G.col(f.count++).tail<3>() = node.frame.R.row(k).transpose();
  } else if (free_rotations == 2) {
    throw InputError(fmt::format(
        "node '{}': of its rotations all three, two or none can be eliminated; one alone is held by a constraint",
        node.name));
  }
  f.rotations = free_rotations;
  f.all_free = f.count == 6;
  return f;
}

}  // namespace

NodeKinematics::NodeKinematics(const Model& model) {
  const std::size_t count = model.nodes().size();
  freedom_.resize(count);
  carry_of_node_.assign(count, -1);
  start_.resize(count);
  // The error that a node is both held and carried is reported before a circle of carriers.
  for (const Node& node : model.nodes())
    if (node.carrier &&
        std::any_of(node.freedom.begin(), node.freedom.end(), [](Freedom f) { return f != Freedom::free; }))
      throw InputError(fmt::format("node '{}' is carried rigidly by '{}' and cannot be fixed or prescribed as well",
                                   node.name, model.node(*node.carrier).name));
  const std::vector<int> root = root_carriers(model);
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const Node& node = model.node(i);
    NodeState& start = start_[static_cast<std::size_t>(i)];
    start.x = node.frame.x;
    start.R = node.frame.R;
    start.v = node.velocity;
    start.Omega = node.angular_velocity;
    if (node.carrier)
      add_carried(model, i, root[static_cast<std::size_t>(i)]);
    else
      add_own(model, i);
  }
  set_force_rows();
}

void NodeKinematics::add_carried(const Model& model, int node, int root) {
  const Frame relative = inverse(model.node(root).frame) * model.node(node).frame;
  carry_of_node_[static_cast<std::size_t>(node)] = static_cast<int>(carries_.size());
  carries_.push_back({node, root, relative.x, relative.R});
}

void NodeKinematics::add_own(const Model& model, int index) {
  const Node& node = model.node(index);
  const NodeFreedom f = freedom_of(node, unknowns_);
  unknowns_ += f.count;
  node_of_unknown_.insert(node_of_unknown_.end(), static_cast<std::size_t>(f.count), index);
  freedom_[static_cast<std::size_t>(index)] = f;
  if (std::find(node.freedom.begin(), node.freedom.end(), Freedom::prescribed) != node.freedom.end())
    prescribed_.push_back(
        {index, node.frame, node.freedom, node.motion, count_rotations(node, Freedom::prescribed) > 0});
}

void NodeKinematics::set_force_rows() {
  for (std::size_t i = 0; i < freedom_.size(); ++i) {
    if (freedom_[i].all_free) {
      all_free_.push_back({i, freedom_[i].begin});
      force_row_.push_back(freedom_[i].begin);
    } else {
      force_row_.push_back(unknowns_ + 6 * static_cast<int>(held_.size()));
      held_.push_back(i);
    }
  }
}

const Carry* NodeKinematics::carry(int node) const {
  const int index = carry_of_node_[static_cast<std::size_t>(node)];
  return index < 0 ? nullptr : &carries_[static_cast<std::size_t>(index)];
}

void NodeKinematics::prescribe_positions(std::vector<NodeState>& nodes, double time, double motion_factor) const {
  for (const Prescribed& p : prescribed_) {
    NodeState& node = nodes[static_cast<std::size_t>(p.node)];
    for (std::size_t k = 0; k < 3; ++k)
      if (p.freedom[k] == Freedom::prescribed)
        node.x[static_cast<int>(k)] = p.start.x[static_cast<int>(k)] + motion_factor * p.motion[k](time);
    if (p.rotation)
      node.R = exp_so3(motion_factor * Vector3(p.motion[3](time), p.motion[4](time), p.motion[5](time))) * p.start.R;
  }
}

void NodeKinematics::follow_carriers(std::vector<NodeState>& nodes) const {
  for (const Carry& carry : carries_) {
    const NodeState& i = nodes[static_cast<std::size_t>(carry.carrier)];
    NodeState& j = nodes[static_cast<std::size_t>(carry.node)];
    const Vector3 arm_rate = i.Omega.cross(carry.c);
    j.x = i.x + i.R * carry.c;
    j.R = i.R * carry.R_c;
    j.v = i.v + i.R * arm_rate;
    j.Omega = carry.R_c.transpose() * i.Omega;
    j.a = i.a + i.R * (i.Omegadot.cross(carry.c) + i.Omega.cross(arm_rate));
    j.Omegadot = carry.R_c.transpose() * i.Omegadot;
  }
}

void NodeKinematics::start(std::vector<NodeState>& nodes, double time) const {
  nodes = start_;
  prescribe_positions(nodes, time, 1);
  VectorX v(unknowns_), a(unknowns_);
  get_rates(nodes, v, a);
  set_rates(nodes, v, a, time);
}

namespace {

void displace_node(NodeState& node, const NodeState& base, const double* dz) {
  node.x = base.x + Eigen::Map<const Vector3>(dz);
  node.R.noalias() = base.R * exp_so3(Eigen::Map<const Vector3>(dz + 3));
}

void set_node_rates(NodeState& node, const double* rate, const double* acceleration) {
  node.v = Eigen::Map<const Vector3>(rate);
  node.Omega = Eigen::Map<const Vector3>(rate + 3);
  node.a = Eigen::Map<const Vector3>(acceleration);
  node.Omegadot = Eigen::Map<const Vector3>(acceleration + 3);
}

}  // namespace

void NodeKinematics::displace(std::vector<NodeState>& nodes, const std::vector<NodeState>& base,
                              const Eigen::Ref<const VectorX>& dp, double time, double motion_factor) const {
  for (const auto [i, begin] : all_free_) displace_node(nodes[i], base[i], dp.data() + begin);
  for (const std::size_t i : held_) {
    const NodeFreedom& f = freedom_[i];
    if (f.count == 0) continue;
    const Vector6 dz = f.G.leftCols(f.count) * dp.segment(f.begin, f.count);
    displace_node(nodes[i], base[i], dz.data());
  }
  prescribe_positions(nodes, time, motion_factor);
  follow_carriers(nodes);
}

void NodeKinematics::set_rates(std::vector<NodeState>& nodes, const Eigen::Ref<const VectorX>& v,
                               const Eigen::Ref<const VectorX>& a, double time) const {
  for (const auto [i, begin] : all_free_) set_node_rates(nodes[i], v.data() + begin, a.data() + begin);
  for (const std::size_t i : held_) {
    const NodeFreedom& f = freedom_[i];
    const Vector6 rate = f.G.leftCols(f.count) * v.segment(f.begin, f.count);
    const Vector6 acceleration = f.G.leftCols(f.count) * a.segment(f.begin, f.count);
    set_node_rates(nodes[i], rate.data(), acceleration.data());
  }
  for (const Prescribed& p : prescribed_) {
    NodeState& node = nodes[static_cast<std::size_t>(p.node)];
    for (std::size_t k = 0; k < 3; ++k)
      if (p.freedom[k] == Freedom::prescribed) {
        node.v[static_cast<int>(k)] = p.motion[k].derivative(time, 1);
        node.a[static_cast<int>(k)] = p.motion[k].derivative(time, 2);
      }
    if (!p.rotation) continue;
    Vector3 psi, rate, acceleration;
    for (std::size_t k = 0; k < 3; ++k) {
      psi[static_cast<int>(k)] = p.motion[3 + k](time);
      rate[static_cast<int>(k)] = p.motion[3 + k].derivative(time, 1);
      acceleration[static_cast<int>(k)] = p.motion[3 + k].derivative(time, 2);
    }
    // The inertial angular velocity of exp(psi) is omega = T^T psidot; R_start only changes the axes of its components.
    const Matrix3 T = tangent(psi);
    node.Omega = node.R.transpose() * (T.transpose() * rate);
    node.Omegadot =
        node.R.transpose() * (T.transpose() * acceleration + tangent_derivative(psi, rate).transpose() * rate);
  }
  follow_carriers(nodes);
}

void NodeKinematics::get_rates(const std::vector<NodeState>& nodes, Eigen::Ref<VectorX> v,
                               Eigen::Ref<VectorX> a) const {
  for (std::size_t i = 0; i < freedom_.size(); ++i) {
    const NodeFreedom& f = freedom_[i];
    if (f.count == 0) continue;
    Vector6 rate, acceleration;
    rate << nodes[i].v, nodes[i].Omega;
    acceleration << nodes[i].a, nodes[i].Omegadot;
    // The columns of G are orthonormal.
    v.segment(f.begin, f.count) = f.G.leftCols(f.count).transpose() * rate;
    a.segment(f.begin, f.count) = f.G.leftCols(f.count).transpose() * acceleration;
  }
}

void NodeKinematics::carry_forces(const std::vector<NodeState>& nodes, Eigen::Ref<VectorX> forces) const {
  for (const Carry& carry : carries_) {
    const int from = force_row(carry.node), to = force_row(carry.carrier);
    const Vector3 force = forces.segment<3>(from), moment = forces.segment<3>(from + 3);
    const Matrix3& R = nodes[static_cast<std::size_t>(carry.carrier)].R;
    forces.segment<3>(to) += force;
    forces.segment<3>(to + 3) += carry.c.cross(R.transpose() * force) + carry.R_c * moment;
    forces.segment<6>(from).setZero();
  }
}

void NodeKinematics::reduce_forces(const Eigen::Ref<const VectorX>& forces, Eigen::Ref<VectorX> r) const {
  r = forces.head(unknowns_);
  for (const std::size_t i : held_)
    if (const NodeFreedom& f = freedom_[i]; f.count > 0)
      r.segment(f.begin, f.count).noalias() = f.G.leftCols(f.count).transpose() * forces.segment<6>(force_row_[i]);
}

double NodeKinematics::support_power(const std::vector<NodeState>& nodes,
                                     const Eigen::Ref<const VectorX>& forces) const {
  double power = 0;
  for (const Prescribed& p : prescribed_) {
    const NodeState& node = nodes[static_cast<std::size_t>(p.node)];
    const int row = force_row(p.node);
    for (int k = 0; k < 3; ++k)
      if (p.freedom[static_cast<std::size_t>(k)] == Freedom::prescribed) power += forces[row + k] * node.v[k];
    if (p.rotation) power += forces.segment<3>(row + 3).dot(node.Omega);
  }
  return power;
}

}  // namespace bielle::mechanism
