#include "mechanism/joints/contacts/pair_force.hpp"

#include <algorithm>
#include <array>

namespace bielle::mechanism {
namespace {

using Twelve = GradientNumber<12>;

Triple<double> number_of(const Vector3& v, const Eigen::Matrix<double, 3, 12>* /*gradient*/, double) {
  return Triple<double>(v);
}
Triple<Twelve> number_of(const Vector3& v, const Eigen::Matrix<double, 3, 12>* gradient, const Twelve&) {
  Triple<Twelve> result(v);
  if (!gradient) return result;
  result.x.gradient = gradient->row(0);
  result.y.gradient = gradient->row(1);
  result.z.gradient = gradient->row(2);
  return result;
}

/// Of `coulomb`: h of |v|^2.
template <class T>
T friction_slope(const FrictionLaw& law, const T& squared) {
  const FrictionLaw::Sliding sliding = law.sliding(std::sqrt(std::max(0.0, value_of(squared))));
  return composed(squared, sliding.h, 0.5 * sliding.slope_over_speed);
}

/// Positions and rates of the second shape as the first node sees them, along the increments
/// [ds; dphi (R_12 -> exp(dphi~) R_12); d(sdot); d(turning)].
template <class T>
struct SeenFromFirst {
  using Gradient = Eigen::Matrix<double, 3, 12>;
  PlacedShape<T> first, second;
  std::array<Triple<T>, 3> node_axes;  ///< of the second node
  Triple<T> s, s_rate, turning;

  static PlacedShape<T> place(const ContactShape& shape, const Vector3& s, const Matrix3& R, bool moves) {
    PlacedShape<T> placed;
    placed.shape = &shape;
    const auto moved = [&](const Vector3& v, bool displaced) {
      if (!moves) return number_of(v, nullptr, T(0));
      Gradient gradient = Gradient::Zero();
      if (displaced) gradient.leftCols<3>().setIdentity();
      gradient.middleCols<3>(3) = -skew(v);
      return number_of(displaced ? Vector3(s + v) : v, &gradient, T(0));
    };
    placed.origin = moved(R * shape.frame.x, moves);
    for (std::size_t k = 0; k < 3; ++k)
      placed.axes[k] = moved(R * shape.frame.R.col(static_cast<Eigen::Index>(k)), false);
    return placed;
  }
  static Triple<T> variable(const Vector3& v, int first) {
    Gradient gradient = Gradient::Zero();
    gradient.template middleCols<3>(first).setIdentity();
    return number_of(v, &gradient, T(0));
  }
  SeenFromFirst(const ContactShape& first_shape, const ContactShape& second_shape, const Vector3& at,
                const Matrix3& R_12, const Vector3& at_rate, const Vector3& turn)
      : first(place(first_shape, Vector3::Zero(), Matrix3::Identity(), false)),
        second(place(second_shape, at, R_12, true)),
        s(variable(at, 0)),
        s_rate(variable(at_rate, 6)),
        turning(variable(turn, 9)) {
    ContactShape at_node;  // its frame is the node's
    node_axes = place(at_node, at, R_12, true).axes;
  }
};

/// Force on the second body and its moment about the second node, in the axes of the first node.
template <class T>
struct Wrench {
  Triple<T> force, moment;
  double dissipation = 0, input = 0;
};

template <class T>
T positive_part(const T& a) {
  return value_of(a) > 0 ? a : T(0);
}

template <class T>
Triple<T> velocity_at(const SeenFromFirst<T>& seen, const Triple<T>& place) {
  return seen.s_rate + cross(seen.turning, place - seen.s);
}

/// How far the second body's material at a place has moved since the last accepted step, seen from the first body.
template <class T>
Triple<T> way_to(const Triple<T>& place, const SeenFromFirst<T>& seen, const Bristles& bristles) {
  if (!bristles.known) return {};
  const Triple<T> arm = place - seen.s;
  Triple<T> was(bristles.s);
  for (std::size_t k = 0; k < 3; ++k)
    was += dot(seen.node_axes[k], arm) * Triple<T>(Vector3(bristles.R_12.col(static_cast<Eigen::Index>(k))));
  return place - was;
}

/// |v|. It has no derivative at rest; nothing that depends on it changes there.
template <class T>
T size_of(const Triple<T>& v) {
  const T squared = dot(v, v);
  return value_of(squared) > 0 ? root_of(squared) : T(0);
}

/// A bristle z at the end of the step and its rate u.
template <class T>
struct MovedBristle {
  Triple<T> z, u;
  T speed{};
  /// @param v  across the normal
  MovedBristle(const Touch<T>& touch, const SeenFromFirst<T>& seen, const FrictionLaw& law, const Bristles& bristles,
               const Triple<T>& v)
      : speed(size_of(v)) {
    const Triple<T>& n = touch.normal;
    const auto [mu, slope] = law.level(value_of(speed));
    const T stiffness = T(law.bristle_stiffness) * composed(speed, 1 / mu, -slope * value_of(speed) / (mu * mu));
    const Triple<T> way = way_to(touch.place, seen, bristles), across = way - dot(n, way) * n,
                    before(bristles.of(touch.id));
    z = (T(1) / (T(1) + stiffness * size_of(across))) * (before - dot(n, before) * n + across);
    u = v - stiffness * speed * z;
  }
};

template <class T>
void add_touch(const Touch<T>& touch, const SeenFromFirst<T>& seen, const SurfaceLaw& law, double damping,
               const Bristles& bristles, Wrench<T>& wrench) {
  const Triple<T> v = velocity_at(seen, touch.place);
  const T along = dot(touch.normal, v);  // -pdot
  const T push = positive_part(T(1) - T(damping) * along);
  Triple<T> force = (touch.force + touch.load * (push - T(1))) * touch.normal;
  wrench.dissipation += value_of(touch.load) * (1 - value_of(push)) * value_of(along);
  if (law.friction && law.friction->model == FrictionLaw::Model::lugre && value_of(touch.load) > 0) {
    const FrictionLaw& friction = *law.friction;
    const Triple<T> across = v - along * touch.normal;
    const MovedBristle<T> bristle(touch, seen, friction, bristles, across);
    const auto [sigma, slope] = friction.bristle_damping_at(value_of(bristle.speed));
    const T damping_now = composed(bristle.speed, sigma, slope * value_of(bristle.speed));
    const T load = touch.load * push, stiffness(friction.bristle_stiffness);
    const Triple<T> pull = stiffness * bristle.z + damping_now * bristle.u + T(friction.viscous) * across;
    const double stored = friction.bristle_stiffness * value_of(dot(bristle.z, bristle.u));
    force = force - load * pull;
    wrench.input -= value_of(load) * stored;
    wrench.dissipation += value_of(load) * (value_of(dot(pull, across)) - stored);
  } else if (law.friction && value_of(touch.load) > 0) {
    const Triple<T> across = v - along * touch.normal;
    const T squared = dot(across, across);
    const T slope = touch.load * push * friction_slope(*law.friction, squared);
    force = force - slope * across;
    wrench.dissipation += value_of(slope) * value_of(squared);
  }
  wrench.force += force;
  wrench.moment += cross(touch.place - seen.s, force);
}

template <class T>
Wrench<T> wrench_of(const PairTouches<T>& found, const SeenFromFirst<T>& seen, const SurfaceLaw& law, double damping,
                    const Bristles& bristles) {
  Wrench<T> wrench;
  for (const Touch<T>& touch : found.touches) add_touch(touch, seen, law, damping, bristles, wrench);
  return wrench;
}

}  // namespace

PairForce::PairForce(const ContactShape& first, const ContactShape& second, const NodeState& first_node,
                     const NodeState& second_node)
    : first_(first), second_(second), node_1_(first_node), node_2_(second_node) {
  R_12_ = node_1_.R.transpose() * node_2_.R;
  s_ = node_1_.R.transpose() * (node_2_.x - node_1_.x);
  s_rate_ = node_1_.R.transpose() * (node_2_.v - node_1_.v) - node_1_.Omega.cross(s_);
  turning_ = R_12_ * node_2_.Omega - node_1_.Omega;
}

PairForce::Result PairForce::calc(const SurfaceLaw& law, double damping, const Bristles& bristles) const {
  const SeenFromFirst<double> seen(first_, second_, s_, R_12_, s_rate_, turning_);
  thread_local PairTouches<double> found;
  find_touches(seen.first, seen.second, law.normal, found);
  Result result;
  if (found.touches.empty()) return result;
  const Wrench<double> wrench = wrench_of(found, seen, law, damping, bristles);
  const Vector3 f = value_of(wrench.force), m = value_of(wrench.moment);
  result.force = node_1_.R * f;
  result.r << result.force, s_.cross(f) + m, -result.force, -(R_12_.transpose() * m);
  result.elastic = found.potential;
  result.dissipation = wrench.dissipation;
  result.input = wrench.input;
  const auto deepest = std::max_element(found.touches.begin(), found.touches.end(),
                                        [](const auto& a, const auto& b) { return a.depth < b.depth; });
  result.depth = deepest->depth;
  result.place = node_1_.x + node_1_.R * value_of(deepest->place);
  result.approach = -dot(deepest->normal, velocity_at(seen, deepest->place));
  return result;
}

// With J the derivatives of (s, phi) by the increments of the nodes and y = (f, m) the wrench, the residual is
// r = -J^T y, and the wrench a function of (s, phi) and of the rates (sdot, turning) alone.
void PairForce::calc_tangent(const SurfaceLaw& law, double damping, const Bristles& bristles, Matrix12& K,
                             Matrix12& C) const {
  const SeenFromFirst<Twelve> seen(first_, second_, s_, R_12_, s_rate_, turning_);
  thread_local PairTouches<Twelve> found;
  find_touches(seen.first, seen.second, law.normal, found);
  K.setZero();
  C.setZero();
  if (found.touches.empty()) return;
  const Wrench<Twelve> wrench = wrench_of(found, seen, law, damping, bristles);
  const Vector3 f = value_of(wrench.force), m = value_of(wrench.moment);
  Eigen::Matrix<double, 6, 12> G;
  G << wrench.force.x.gradient.transpose(), wrench.force.y.gradient.transpose(), wrench.force.z.gradient.transpose(),
      wrench.moment.x.gradient.transpose(), wrench.moment.y.gradient.transpose(), wrench.moment.z.gradient.transpose();

  const Matrix3 &R_1 = node_1_.R, one = Matrix3::Identity();
  Eigen::Matrix<double, 6, 12> J = Eigen::Matrix<double, 6, 12>::Zero();
  J.block<3, 3>(0, 0) = -R_1.transpose();
  J.block<3, 3>(0, 3) = skew(s_);
  J.block<3, 3>(0, 6) = R_1.transpose();
  J.block<3, 3>(3, 3) = -one;
  J.block<3, 3>(3, 9) = R_12_;
  // The rates (sdot, turning) by the increments of positions at fixed velocities of the nodes.
  Eigen::Matrix<double, 6, 12> W;
  W.topRows<3>() = -skew(node_1_.Omega) * J.topRows<3>();
  W.block<3, 3>(0, 3) += skew(node_1_.R.transpose() * (node_2_.v - node_1_.v));
  W.bottomRows<3>() = -skew(R_12_ * node_2_.Omega) * J.bottomRows<3>();

  const Eigen::Matrix<double, 6, 12> by_position = G.leftCols<6>() * J + G.rightCols<6>() * W,
                                     by_rate = G.rightCols<6>() * J;
  K.noalias() = -J.transpose() * by_position;
  C.noalias() = -J.transpose() * by_rate;
  // The same wrench along axes and arms that turn.
  const Matrix3 turned = R_1 * skew(f);
  K.block<3, 3>(0, 3) -= turned;
  K.block<3, 3>(6, 3) += turned;
  K.middleRows<3>(3) -= skew(f) * J.topRows<3>();
  K.middleRows<3>(9) -= R_12_.transpose() * skew(m) * J.bottomRows<3>();
}

void PairForce::add_bristles(const SurfaceLaw& law, const Bristles& bristles, std::vector<Bristle>& now) const {
  const SeenFromFirst<double> seen(first_, second_, s_, R_12_, s_rate_, turning_);
  thread_local PairTouches<double> found;
  find_touches(seen.first, seen.second, law.normal, found);
  for (const Touch<double>& touch : found.touches) {
    if (touch.load <= 0) continue;
    const Triple<double> v = velocity_at(seen, touch.place);
    const MovedBristle<double> moved(touch, seen, *law.friction, bristles, v - dot(touch.normal, v) * touch.normal);
    now.push_back({touch.id, value_of(moved.z)});
  }
}

PairForce::Nearest PairForce::nearest() const {
  const SeenFromFirst<double> seen(first_, second_, s_, R_12_, s_rate_, turning_);
  const Touch<double> touch = find_nearest_place(seen.first, seen.second);
  return {-touch.depth, dot(touch.normal, velocity_at(seen, touch.place)),
          node_1_.x + node_1_.R * value_of(touch.place), node_1_.R * value_of(touch.normal)};
}

}  // namespace bielle::mechanism
