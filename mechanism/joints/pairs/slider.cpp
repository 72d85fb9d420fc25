#include "mechanism/joints/pairs/slider.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/joints/path_press.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr int slider = 1;  ///< local node of the slider

/// The four weights of Hermite's interpolation on an element, or their derivatives by u.
struct Weights {
  std::array<double, 2> N, M;
};

/// @param order  order of the derivative, 0 to 3
Weights weights(double xi, double L, int order) {
  const double scale = 1 / std::pow(L, order);
  switch (order) {
    case 0:
      return {{1 + xi * xi * (2 * xi - 3), xi * xi * (3 - 2 * xi)},
              {L * xi * (1 - xi) * (1 - xi), L * xi * xi * (xi - 1)}};
    case 1:
      return {{scale * 6 * xi * (xi - 1), scale * 6 * xi * (1 - xi)}, {1 + xi * (3 * xi - 4), xi * (3 * xi - 2)}};
    case 2:
      return {{scale * (12 * xi - 6), scale * (6 - 12 * xi)}, {(6 * xi - 4) / L, (6 * xi - 2) / L}};
    default:
      return {{scale * 12, -scale * 12}, {6 / (L * L), 6 / (L * L)}};
  }
}

}  // namespace

SliderJoint::SliderJoint(std::string name, JointFrames frames, SliderLine line, double start, bool tangent, Ends ends,
                         const Model& model)
    : Joint("slider", std::move(name), std::move(frames),
            {{"displacement", JointCoordinate::Kind::displacement, JointCoordinate::by_type}}, model),
      line_(std::move(line)),
      start_(start),
      tangent_(tangent),
      ends_(ends) {}

void SliderJoint::declare(Declaration& declaration) const {
  Joint::declare(declaration);
  declaration.nodes = {line_.nodes.front(), frames().second};
  declaration.nodes.insert(declaration.nodes.end(), line_.nodes.begin() + 1, line_.nodes.end());
  declaration.stiffness = true;
  declaration.amplitudes = {{"place on the beam", "m", start_}};
  for (const char* name : {"x", "y", "z"}) declaration.multipliers.push_back({name, "N"});
  if (tangent_)
    for (const char* name : {"ry", "rz"}) declaration.multipliers.push_back({name, "N m"});
  if (ends_ == Ends::error) return;
  EventFunction beginning{"reaches the beam's start", EventFunction::Direction::falling},
      end{"reaches the beam's end", EventFunction::Direction::falling};
  beginning.stops = end.stops = true;
  declaration.event_functions = {beginning, end};
}

std::size_t SliderJoint::element_at(double u) const {
  const auto next = std::upper_bound(line_.place.begin() + 1, line_.place.end() - 1, u);
  return static_cast<std::size_t>(next - line_.place.begin()) - 1;
}

namespace {

/// Adds factor times a measure of two local nodes, and the terms due to the variation of the factor along u.
void add_pair_part(const PairMeasure& m, int first, int second, double factor, double by_u, double by_uu, int u,
                   VectorX& gradient, MatrixX& curvature, double& value) {
  value += factor * m.value;
  gradient[u] += by_u * m.value;
  curvature(u, u) += by_uu * m.value;
  const std::array<int, 2> at{6 * first, 6 * second};
  for (int i = 0; i < 2; ++i) {
    const auto part = m.gradient.segment<6>(6 * i);
    gradient.segment<6>(at[static_cast<std::size_t>(i)]) += factor * part;
    curvature.block<6, 1>(at[static_cast<std::size_t>(i)], u) += by_u * part;
    curvature.block<1, 6>(u, at[static_cast<std::size_t>(i)]) += by_u * part.transpose();
    for (int j = 0; j < 2; ++j)
      curvature.block<6, 6>(at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)]) +=
          factor * m.second.block<6, 6>(6 * i, 6 * j);
  }
}

}  // namespace

void SliderJoint::calc_row(int row, const LocalState& state, Row& result) const {
  const int n = parameter() + 1;
  result.value = 0;
  result.gradient.setZero(n);
  result.second.setZero(n, n);
  if (row < 3)
    calc_position_row(row, state, result);
  else
    calc_tangent_row(row - 2, state, result);
}

// e . R_1^T (d - p): positions and tangents of the element's nodes as seen from the first node of the line.
void SliderJoint::calc_position_row(int axis, const LocalState& state, Row& result) const {
  const NodeState& first = state.node(0);
  const Vector3 e = frames().on_first.R.col(axis);
  const int u = parameter();
  const auto add = [&](const PairMeasure& m, int node, double factor, double by_u, double by_uu) {
    add_pair_part(m, 0, node, factor, by_u, by_uu, u, result.gradient, result.second, result.value);
  };
  add(measure_position(first, state.node(slider), e, Vector3::Zero(), frames().on_second.x), slider, 1, 0, 0);
  const double at = state.amplitude()[0];
  const std::size_t element = element_at(at);
  const double L = line_.place[element + 1] - line_.place[element], xi = (at - line_.place[element]) / L;
  const Weights w = weights(xi, L, 0), w1 = weights(xi, L, 1), w2 = weights(xi, L, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t end = element + k;
    if (end == 0) {  // the tangent of the first node is constant in its own axes
      const double along = e.dot(line_.tangent[0]);
      result.value -= w.M[k] * along;
      result.gradient[u] -= w1.M[k] * along;
      result.second(u, u) -= w2.M[k] * along;
      continue;
    }
    const NodeState& node = state.node(local(end));
    add(measure_position(first, node, e, Vector3::Zero(), Vector3::Zero()), local(end), -w.N[k], -w1.N[k], -w2.N[k]);
    add(measure_alignment(first, node, e, line_.tangent[end]), local(end), -w.M[k], -w1.M[k], -w2.M[k]);
  }
}

// e . R_s^T p'(u): the element's nodes as seen from the slider. The weights of positions add up to zero.
void SliderJoint::calc_tangent_row(int axis, const LocalState& state, Row& result) const {
  const NodeState& sliding = state.node(slider);
  const Vector3 e = frames().on_second.R.col(axis);
  const int u = parameter();
  const double at = state.amplitude()[0];
  const std::size_t element = element_at(at);
  const double L = line_.place[element + 1] - line_.place[element], xi = (at - line_.place[element]) / L;
  const Weights w = weights(xi, L, 1), w1 = weights(xi, L, 2), w2 = weights(xi, L, 3);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t end = element + k;
    const NodeState& node = state.node(local(end));
    const auto add = [&](const PairMeasure& m, double factor, double by_u, double by_uu) {
      add_pair_part(m, slider, local(end), factor, by_u, by_uu, u, result.gradient, result.second, result.value);
    };
    add(measure_position(sliding, node, e, Vector3::Zero(), Vector3::Zero()), w.N[k], w1.N[k], w2.N[k]);
    add(measure_alignment(sliding, node, e, line_.tangent[end]), w.M[k], w1.M[k], w2.M[k]);
  }
}

// p' along the axes of J_A is the derivative of the position rows by u.
Vector6 SliderJoint::calc_press(const LocalState& state) const {
  thread_local Row row;
  Vector3 along;
  for (int axis = 0; axis < 3; ++axis) {
    calc_row(axis, state, row);
    along[axis] = -row.gradient[parameter()];
  }
  return take_out_along_path(calc_reaction(state), along);
}

Vector6 SliderJoint::calc_press(const LocalState& state, MatrixX& derivatives) const {
  thread_local Row row;
  thread_local Eigen::Matrix<double, 3, Eigen::Dynamic> by_position;
  const Vector6 reaction = calc_reaction(state, derivatives);
  const int u = parameter();
  by_position.setZero(3, derivatives.cols());
  Vector3 along;
  for (int axis = 0; axis < 3; ++axis) {
    calc_row(axis, state, row);
    along[axis] = -row.gradient[u];
    by_position.row(axis).head(u + 1) = -row.second.row(u);
  }
  return take_out_along_path(reaction, along, by_position, derivatives);
}

void SliderJoint::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  thread_local Row row;
  const auto lambda = state.multiplier();
  const int n = parameter() + 1;
  for (int k = 0; k < rows(); ++k) {
    calc_row(k, state, row);
    r.head(n) += lambda[k] * row.gradient;
    r[n + k] += row.value;
  }
}

void SliderJoint::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  thread_local Row row;
  const auto lambda = state.multiplier();
  const int n = parameter() + 1;
  auto K = tangent.K.dense();
  for (int k = 0; k < rows(); ++k) {
    calc_row(k, state, row);
    K.topLeftCorner(n, n) += lambda[k] * row.second;
    K.block(0, n + k, n, 1) += row.gradient;
    K.block(n + k, 0, 1, n) += row.gradient.transpose();
  }
}

void SliderJoint::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                       Eigen::Ref<VectorX> acceleration) const {
  thread_local Row row;
  thread_local VectorX v, a;
  const int n = parameter() + 1;
  v.resize(state.slots().size());
  a.resize(state.slots().size());
  get_local_velocities(state, v);
  get_local_accelerations(state, a);
  for (int k = 0; k < rows(); ++k) {
    calc_row(k, state, row);
    velocity[k] += row.gradient.dot(v.head(n));
    acceleration[k] += row.gradient.dot(a.head(n)) + v.head(n).dot(row.second * v.head(n));
  }
}

double SliderJoint::turning_rate(const LocalState& state) const {
  // The beam's tangent rotates as the slider moves along: by the angle between the tangents of the element's nodes per
  // length.
  const std::size_t element = element_at(state.amplitude()[0]);
  const Vector3 first = state.node(local(element)).R * line_.tangent[element],
                second = state.node(local(element + 1)).R * line_.tangent[element + 1];
  const double bend = std::acos(std::clamp(first.dot(second), -1.0, 1.0));
  const double L = line_.place[element + 1] - line_.place[element];
  return Joint::turning_rate(state) + std::abs(state.amplitude_rate()[0]) * bend / L;
}

CoordinateRate SliderJoint::principal_coordinate(std::size_t /*index*/, const LocalState& state) const {
  return {state.amplitude()[0] - start_, state.amplitude_rate()[0]};
}

void SliderJoint::calc_coordinate(std::size_t index, const LocalState& state, CoordinateDerivatives& jet) const {
  jet.prepare(state.slots().size());
  calc_slopes(index, state, jet);
}

void SliderJoint::calc_slopes(std::size_t index, const LocalState& state, CoordinateSlopes& slopes) const {
  slopes.prepare(state.slots().size());
  const auto [value, rate] = principal_coordinate(index, state);
  slopes.value = slopes.principal = value;
  slopes.rate = rate;
  slopes.g()[parameter()] = slopes.w()[parameter()] = 1;
}

void SliderJoint::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  Joint::accept(state, memory);
  const double u = state.amplitude()[0], length = line_.place.back();
  if (ends_ == Ends::error && (u < -1e-9 * length || u > (1 + 1e-9) * length))
    throw ComputationError(
        fmt::format("slider '{}' leaves its beam at the {} (`ends: stop` would end the run there; "
                    "`stops` keep it on the beam)",
                    name(), u < 0 ? "start" : "end"));
}

void SliderJoint::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  if (values.size() == 0) return;
  values[0] = state.amplitude()[0];
  values[1] = line_.place.back() - state.amplitude()[0];
}

void SliderJoint::describe(const LocalState& state, Description& description) const {
  const NodeState& node = state.node(slider);
  description.add(
      fmt::format("node '{}' at {} m", second_name(), format_vector(node.x + node.R * frames().on_second.x)));
  description.add(
      fmt::format("{:.6g} m from the start of a beam of {:.6g} m", state.amplitude()[0], line_.place.back()));
}

/// Draws the frame of the slider only, which shows its place on the beam.
void SliderJoint::draw(Drawing& drawing) const {
  const DrawnPlace slider{frames().second, frames().on_second};
  drawing.add({.shape = "joint", .places = {slider, slider}});
}

}  // namespace bielle::mechanism
