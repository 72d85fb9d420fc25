#include "mechanism/contacts/pair_force.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace bielle::mechanism {
namespace {

using Twelve = AutoDiff<12, 1>;

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

/// Returns h of the law `coulomb` as a function of |v|^2.
template <class T>
T friction_slope(const FrictionLaw& law, const T& squared) {
  const FrictionLaw::Sliding sliding = law.sliding(std::sqrt(std::max(0.0, value_of(squared))));
  return compose(squared, sliding.h, 0.5 * sliding.slope_over_speed);
}

/// Positions and rates of the second shape relative to the first node, along the increments
/// [ds; dphi (R_12 -> exp(dphi~) R_12); d(sdot); d(turning)].
template <class T>
struct SeenFromFirst {
  using Gradient = Eigen::Matrix<double, 3, 12>;
  PlacedShape<T> first, second;
  std::array<Triple<T>, 3> node_axes;  ///< axes of the second node
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
    ContactShape at_node;  // its frame is that of the node
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

/// Returns the velocity of a surface's material relative to its node.
template <class T>
Triple<T> belt_at(const PlacedShape<T>& placed, const Triple<T>& place) {
  Triple<T> velocity, spin;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    velocity += T(placed.shape->belt_velocity[i]) * placed.axes[k];
    spin += T(placed.shape->belt_spin[i]) * placed.axes[k];
  }
  return velocity + cross(spin, place - placed.origin);
}

/// Returns the relative velocity of the two surfaces' materials that is due to their motions on the bodies (belts).
template <class T>
Triple<T> velocity_of_belts(const SeenFromFirst<T>& seen, const Triple<T>& place) {
  Triple<T> u;
  if (seen.second.shape->has_belt()) u += belt_at(seen.second, place);
  if (seen.first.shape->has_belt()) u = u - belt_at(seen.first, place);
  return u;
}

/// The motion from the last accepted state to this one, relative to the first body.
template <class T>
class StepOfPair {
 public:
  StepOfPair(const SeenFromFirst<T>& seen, const Bristles& bristles) : seen_(seen), bristles_(bristles) {
    if (!bristles.known) return;
    // The rotation of the second body is R_12 R_12_before^T; the sums are 4 w^2 and 4 w q of its quaternion [w, q].
    T trace(1);
    for (std::size_t k = 0; k < 3; ++k) {
      const Triple<T> before(column(k));
      trace += dot(seen.node_axes[k], before);
      turn_ += cross(before, seen.node_axes[k]);
    }
    constexpr double half_a_turn = 1e-6;
    if (value_of(trace) > half_a_turn) turn_ = (T(1) / trace) * turn_;
  }
  /// Returns the displacement of the second body's material at a place.
  Triple<T> way_to(const Triple<T>& place) const {
    if (!bristles_.known) return {};
    const Triple<T> arm = place - seen_.s;
    Triple<T> was(bristles_.s);
    for (std::size_t k = 0; k < 3; ++k) was += dot(seen_.node_axes[k], arm) * Triple<T>(column(k));
    return place - was;
  }
  /// Rotates a vector normal to n by half of the second body's rotation about n.
  Triple<T> turned_by_half(const Triple<T>& across, const Triple<T>& n) const {
    const T tangent = dot(n, turn_);  // tangent of half the angle
    return (T(1) / sqrt(T(1) + tangent * tangent)) * (across + tangent * cross(n, across));
  }

 private:
  Vector3 column(std::size_t k) const { return bristles_.R_12.col(static_cast<Eigen::Index>(k)); }
  const SeenFromFirst<T>& seen_;
  const Bristles& bristles_;
  Triple<T> turn_;  ///< q/w
};

/// Returns the magnitude |v|. It has no derivative at v = 0; zero is used there, because no result depends on it.
template <class T>
T size_of(const Triple<T>& v) {
  const T squared = dot(v, v);
  return value_of(squared) > 0 ? sqrt(squared) : T(0);
}

/// A bristle z at the end of the step and its rate u.
template <class T>
struct MovedBristle {
  Triple<T> z, u;
  T speed{};
  /// @param before  z at the beginning of the step @param v  sliding velocity, normal to the contact normal
  MovedBristle(const Touch<T>& touch, const StepOfPair<T>& step, const FrictionLaw& law, const Vector3& before,
               const Triple<T>& v)
      : speed(size_of(v)) {
    const Triple<T>& n = touch.normal;
    const auto [mu, slope] = law.level(value_of(speed));
    const T stiffness = T(law.bristle_stiffness) * compose(speed, 1 / mu, -slope * value_of(speed) / (mu * mu));
    const Triple<T> way = step.way_to(touch.place), across = way - dot(n, way) * n, was(before);
    z = (T(1) / (T(1) + stiffness * size_of(across))) * step.turned_by_half(was - dot(n, was) * n + across, n);
    u = v - stiffness * speed * z;
  }
};

template <class T>
void add_touch(const Touch<T>& touch, const SeenFromFirst<T>& seen, const SurfaceLaw& law, double damping,
               const StepOfPair<T>& step, const Vector3& bristle_before, Wrench<T>& wrench) {
  const Triple<T> v = velocity_at(seen, touch.place);
  const T along = dot(touch.normal, v);  // -pdot
  const T push = positive_part(T(1) - T(damping) * along);
  Triple<T> force = (touch.force + touch.load * (push - T(1))) * touch.normal;
  wrench.dissipation += value_of(touch.load) * (1 - value_of(push)) * value_of(along);
  if (law.friction && law.friction->model == FrictionLaw::Model::lugre && value_of(touch.load) > 0) {
    const FrictionLaw& friction = *law.friction;
    const Triple<T> across = v - along * touch.normal;
    const MovedBristle<T> bristle(touch, step, friction, bristle_before, across);
    const auto [sigma, slope] = friction.bristle_damping_at(value_of(bristle.speed));
    const T damping_now = compose(bristle.speed, sigma, slope * value_of(bristle.speed));
    const T load = touch.load * push, stiffness(friction.bristle_stiffness);
    const Triple<T> pull = stiffness * bristle.z + damping_now * bristle.u + T(friction.viscous) * across;
    const double stored = friction.bristle_stiffness * value_of(dot(bristle.z, bristle.u));
    force = force - load * pull;
    wrench.input -= value_of(load) * stored;
    wrench.dissipation += value_of(load) * (value_of(dot(pull, across)) - stored);
  } else if (law.friction && value_of(touch.load) > 0) {
    const Triple<T> belts = velocity_of_belts(seen, touch.place), moving = v + belts;
    const Triple<T> across = moving - dot(touch.normal, moving) * touch.normal;
    const T squared = dot(across, across);
    const T slope = touch.load * push * friction_slope(*law.friction, squared);
    force = force - slope * across;
    wrench.dissipation += value_of(slope) * value_of(squared);
    wrench.input += value_of(slope) * value_of(dot(across, belts));
  }
  if (law.rolling && value_of(touch.load) > 0) {
    const Triple<T> rolls = seen.turning - dot(touch.normal, seen.turning) * touch.normal;
    const T squared = dot(rolls, rolls);
    const T slope = touch.load * push * friction_slope(*law.rolling, squared);
    wrench.moment = wrench.moment - slope * rolls;
    wrench.dissipation += value_of(slope) * value_of(squared);
  }
  wrench.force += force;
  wrench.moment += cross(touch.place - seen.s, force);
}

/// @param before  bristle of each touch, as PairForce::match gives it
Vector3 bristle_before(const Bristles& bristles, const std::vector<int>& before, std::size_t touch) {
  const int known = before[touch];
  return known < 0 ? Vector3(Vector3::Zero()) : bristles.before[static_cast<std::size_t>(known)].z;
}

template <class T>
Wrench<T> wrench_of(const PairTouches<T>& found, const SeenFromFirst<T>& seen, const SurfaceLaw& law, double damping,
                    const Bristles& bristles, const std::vector<int>& before) {
  Wrench<T> wrench;
  const StepOfPair<T> step(seen, bristles);
  for (std::size_t k = 0; k < found.touches.size(); ++k)
    add_touch(found.touches[k], seen, law, damping, step, bristle_before(bristles, before, k), wrench);
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
  const Wrench<double> wrench = wrench_of(found, seen, law, damping, bristles, match(found.touches, bristles));
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

// With the derivatives J of (s, phi) by the increments of the nodes and the wrench y = (f, m), the residual is r = -J^T
// y; the wrench is a function of (s, phi) and of the rates (sdot, turning) only.
void PairForce::calc_tangent(const SurfaceLaw& law, double damping, const Bristles& bristles, Matrix12& K,
                             Matrix12& C) const {
  const SeenFromFirst<Twelve> seen(first_, second_, s_, R_12_, s_rate_, turning_);
  thread_local PairTouches<Twelve> found;
  find_touches(seen.first, seen.second, law.normal, found);
  K.setZero();
  C.setZero();
  if (found.touches.empty()) return;
  const Wrench<Twelve> wrench = wrench_of(found, seen, law, damping, bristles, match(found.touches, bristles));
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
  // Derivatives of the rates (sdot, turning) by the increments of positions at fixed velocities of the nodes.
  Eigen::Matrix<double, 6, 12> W;
  W.topRows<3>() = -skew(node_1_.Omega) * J.topRows<3>();
  W.block<3, 3>(0, 3) += skew(node_1_.R.transpose() * (node_2_.v - node_1_.v));
  W.bottomRows<3>() = -skew(R_12_ * node_2_.Omega) * J.bottomRows<3>();

  const Eigen::Matrix<double, 6, 12> by_position = G.leftCols<6>() * J + G.rightCols<6>() * W,
                                     by_rate = G.rightCols<6>() * J;
  K.noalias() = -J.transpose() * by_position;
  C.noalias() = -J.transpose() * by_rate;
  // The same wrench along axes and lever arms that rotate.
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
  const std::vector<int>& before = match(found.touches, bristles);
  const StepOfPair<double> step(seen, bristles);
  for (std::size_t k = 0; k < found.touches.size(); ++k) {
    const Touch<double>& touch = found.touches[k];
    if (touch.load <= 0) continue;
    Vector3 z = bristle_before(bristles, before, k);
    if (law.friction) {
      const Triple<double> v = velocity_at(seen, touch.place);
      z = value_of(MovedBristle<double>(touch, step, *law.friction, z, v - dot(touch.normal, v) * touch.normal).z);
    }
    now.push_back({touch.id, z, kept_place(value_of(touch.place))});
  }
}

/// Returns the place in the axes in which it is stored: those of the surface if one of the shapes is a surface.
Vector3 PairForce::kept_place(const Vector3& place) const {
  const bool on_second = second_.kind == ContactShape::Kind::surface;
  return on_second ? Vector3(R_12_.transpose() * (place - s_)) : place;
}

/// Returns for each touch the number of its earlier bristle, -1: none. The reference is valid until the next call in
/// the same thread.
template <class T>
const std::vector<int>& PairForce::match(const std::vector<Touch<T>>& touches, const Bristles& bristles) const {
  thread_local std::vector<int> result;
  result.assign(touches.size(), -1);
  const std::vector<Bristle>& before = bristles.before;
  if (before.empty()) return result;
  const bool surface = first_.kind == ContactShape::Kind::surface || second_.kind == ContactShape::Kind::surface;
  // A bristle beyond this distance belongs to another place. On a ball, the limit is less than a sixth of the
  // circumference.
  const double skin = first_.skin() + second_.skin();
  const double most = surface ? skin * skin : std::numeric_limits<double>::infinity();
  const auto nearest_before = [&](std::size_t touch) {
    const Vector3 place = kept_place(value_of(touches[touch].place));
    int nearest = -1;
    double least = most;
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double distance = (before[k].place - place).squaredNorm();
      if (before[k].id != touches[touch].id || value_of(touches[touch].load) <= 0 || !(distance < least)) continue;
      least = distance;
      nearest = static_cast<int>(k);
    }
    return std::pair(nearest, least);
  };
  // If one bristle is the nearest to several touches, the nearest touch takes it.
  thread_local std::vector<double> distance;
  thread_local std::vector<int> taken;
  distance.assign(before.size(), std::numeric_limits<double>::infinity());
  taken.assign(before.size(), -1);
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const auto [nearest, least] = nearest_before(k);
    if (nearest < 0 || !(least < distance[static_cast<std::size_t>(nearest)])) continue;
    distance[static_cast<std::size_t>(nearest)] = least;
    taken[static_cast<std::size_t>(nearest)] = static_cast<int>(k);
  }
  for (std::size_t k = 0; k < before.size(); ++k)
    if (taken[k] >= 0) result[static_cast<std::size_t>(taken[k])] = static_cast<int>(k);
  return result;
}

PairForce::Nearest PairForce::nearest() const {
  const SeenFromFirst<double> seen(first_, second_, s_, R_12_, s_rate_, turning_);
  const Touch<double> touch = find_nearest_place(seen.first, seen.second);
  return {-touch.depth, dot(touch.normal, velocity_at(seen, touch.place)),
          node_1_.x + node_1_.R * value_of(touch.place), node_1_.R * value_of(touch.normal)};
}

}  // namespace bielle::mechanism
