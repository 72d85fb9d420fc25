#include "mechanism/reading/start_motion.hpp"

#include <algorithm>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the motion of a node without a carrier.
StartMotion own_motion(const Node& node) {
  StartMotion motion{node.frame.x, node.velocity, node.frame.R * node.angular_velocity};
  for (int k = 0; k < 3; ++k)
    if (node.freedom[static_cast<std::size_t>(k)] == Freedom::prescribed)
      motion.v[k] = node.motion[static_cast<std::size_t>(k)].derivative(0, 1);
  // Prescribed rotations are prescribed together, with those that are fixed at zero.
  if (std::count(node.freedom.begin() + 3, node.freedom.end(), Freedom::prescribed) == 0) return motion;
  Vector3 psi, rate;
  for (int k = 0; k < 3; ++k) {
    psi[k] = node.motion[static_cast<std::size_t>(3 + k)](0);
    rate[k] = node.motion[static_cast<std::size_t>(3 + k)].derivative(0, 1);
  }
  motion.omega = tangent(psi).transpose() * rate;
  return motion;
}

void follow(Model& model, const std::function<void()>& rule, int rounds) {
  rule();
  if (rounds > 1) model.when_read(Model::Stage::formulas, [&model, rule, rounds] { follow(model, rule, rounds - 1); });
}

}  // namespace

StartMotion start_motion(const Model& model, int node) {
  const StartMotion motion = own_motion(model.node(model.root_carrier(node)));
  const Vector3 x = model.node(node).frame.x;
  return {x, motion.at(x), motion.omega};
}

void set_start_motion(Model& model, int node, const StartMotion& motion) {
  Node& own = model.node(node);
  own.velocity = motion.v;
  own.angular_velocity = own.frame.R.transpose() * motion.omega;
  if (std::count(own.freedom.begin() + 3, own.freedom.end(), Freedom::fixed) == 3) own.angular_velocity.setZero();
}

void when_motion_is_known(Model& model, const std::function<void()>& rule) {
  constexpr int rounds = 8;
  model.when_read(Model::Stage::connections, [&model, rule] { follow(model, rule, rounds); });
}

}  // namespace bielle::mechanism
