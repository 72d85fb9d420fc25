#include "mechanism/joints/pairs/point_on_curve.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/joints/lift_off.hpp"
#include "mechanism/joints/pairs/read_pair.hpp"
#include "mechanism/joints/path_press.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/read_file.hpp"
#include "reduce/common/files/table_file.hpp"

namespace bielle::mechanism {
namespace {
constexpr int parameter = 12;  ///< local row of u
constexpr int first_row = 13;  ///< first row of the constraints

/// Returns the coordinates. A roller has in addition the angle of the part that carries its pin.
std::vector<JointCoordinate> coordinates_of(double roller) {
  std::vector<JointCoordinate> all = {{"displacement", JointCoordinate::Kind::displacement, JointCoordinate::by_type}};
  if (roller > 0) all.push_back({"angle", JointCoordinate::Kind::angle, 2});
  return all;
}
}  // namespace

PointOnCurve::PointOnCurve(std::string type, std::string name, JointFrames frames, Curve curve, double start,
                           Guide guide, const Model& model, double roller)
    : Joint(std::move(type), std::move(name), std::move(frames), coordinates_of(roller), model),
      curve_(std::move(curve)),
      start_(start),
      length_to_start_(curve_.arc_length(start)),
      guide_(guide),
      roller_(roller) {}

void PointOnCurve::declare(Declaration& declaration) const {
  Joint::declare(declaration);
  declaration.stiffness = true;
  declaration.amplitudes = {{"place on the curve", "m", start_}};
  constexpr const char* names[] = {"x", "y", "z"};
  for (int axis = 0; axis < rows(); ++axis) declaration.multipliers.push_back({names[axis], "N"});
  if (guide_ == Guide::plane) {
    declaration.event_functions = {lift_off()};
    return;
  }
  if (curve_.closed()) return;
  EventFunction leaves{"leaves the curve at its end", EventFunction::Direction::falling};
  leaves.stops = true;
  EventFunction leaves_start{"leaves the curve at its beginning", EventFunction::Direction::falling};
  leaves_start.stops = true;
  declaration.event_functions = {leaves_start, leaves};
}

std::vector<SlidingSurface> PointOnCurve::sliding_surfaces() const {
  std::vector<SlidingSurface> all = Joint::sliding_surfaces();
  for (SlidingSurface& each : all) each.roller = roller_;
  return all;
}

Vector6 PointOnCurve::calc_press(const LocalState& state) const {
  if (roller_ > 0) return calc_reaction(state);
  return take_out_along_path(calc_reaction(state), curve_(state.amplitude()[0]).first);
}

Vector6 PointOnCurve::calc_press(const LocalState& state, MatrixX& derivatives) const {
  const Vector6 reaction = calc_reaction(state, derivatives);
  if (roller_ > 0) return reaction;
  const Curve::Place c = curve_(state.amplitude()[0]);
  thread_local Eigen::Matrix<double, 3, Eigen::Dynamic> by_position;
  by_position.setZero(3, derivatives.cols());
  by_position.col(parameter) = c.second;
  return take_out_along_path(reaction, c.first, by_position, derivatives);
}

void PointOnCurve::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Curve::Place c = curve_(state.amplitude()[0]);
  const auto lambda = state.multiplier();
  for (int axis = 0; axis < rows(); ++axis) {
    const PairSlope m = position<1>(axis, state);
    r.head<12>() += lambda[axis] * m.gradient;
    r[parameter] -= lambda[axis] * c.first[axis];
    r[first_row + axis] += m.value - c.point[axis];
  }
}

void PointOnCurve::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const Curve::Place c = curve_(state.amplitude()[0]);
  const auto lambda = state.multiplier();
  auto K = tangent.K.dense();
  for (int axis = 0; axis < rows(); ++axis) {
    const PairMeasure m = position(axis, state);
    const int row = first_row + axis;
    K.topLeftCorner<12, 12>() += lambda[axis] * m.second;
    K.block<12, 1>(0, row) += m.gradient;
    K.block<1, 12>(row, 0) += m.gradient.transpose();
    K(parameter, parameter) -= lambda[axis] * c.second[axis];
    K(parameter, row) -= c.first[axis];
    K(row, parameter) -= c.first[axis];
  }
}

void PointOnCurve::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                        Eigen::Ref<VectorX> acceleration) const {
  const Curve::Place c = curve_(state.amplitude()[0]);
  const double u1 = state.amplitude_rate()[0], u2 = state.amplitude_acceleration()[0];
  const Vector12 v = pair_rate(state.node(0), state.node(1)), a = pair_acceleration(state.node(0), state.node(1));
  for (int axis = 0; axis < rows(); ++axis) {
    const PairMeasure m = position(axis, state);
    velocity[axis] += m.rate(v) - c.first[axis] * u1;
    acceleration[axis] += m.acceleration(v, a) - c.first[axis] * u2 - c.second[axis] * u1 * u1;
  }
}

double PointOnCurve::turning_rate(const LocalState& state) const {
  // The curve's tangent rotates as the point moves along it.
  const Curve::Place c = curve_(state.amplitude()[0]);
  const double along = std::abs(state.amplitude_rate()[0]) * c.first.cross(c.second).norm() / c.first.squaredNorm();
  return Joint::turning_rate(state) + along;
}

CoordinateRate PointOnCurve::principal_coordinate(std::size_t index, const LocalState& state) const {
  if (index > 0) return Joint::principal_coordinate(index, state);
  const double u = state.amplitude()[0];
  return {curve_.arc_length(u) - length_to_start_, curve_(u).first.norm() * state.amplitude_rate()[0]};
}

void PointOnCurve::calc_coordinate(std::size_t index, const LocalState& state, CoordinateDerivatives& jet) const {
  if (index > 0) return Joint::calc_coordinate(index, state, jet);
  const Curve::Place c = curve_(state.amplitude()[0]);
  jet.prepare(state.slots().size());
  calc_slopes(index, state, jet);
  jet.S()(parameter, parameter) = jet.W()(parameter, parameter) = c.first.dot(c.second) / c.first.norm();
}

void PointOnCurve::calc_slopes(std::size_t index, const LocalState& state, CoordinateSlopes& slopes) const {
  if (index > 0) return Joint::calc_slopes(index, state, slopes);
  slopes.prepare(state.slots().size());
  const auto [value, rate] = principal_coordinate(index, state);
  slopes.value = slopes.principal = value;
  slopes.rate = rate;
  slopes.g()[parameter] = slopes.w()[parameter] = curve_(state.amplitude()[0]).first.norm();
}

void PointOnCurve::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  if (guide_ == Guide::plane) {
    const Vector3 along = curve_(state.amplitude()[0]).first;
    const auto lambda = state.reaction();
    values[0] = -(lambda[0] * along.y() - lambda[1] * along.x()) / along.norm();  // force along the outward normal
    return;
  }
  if (values.size() == 0) return;
  values[0] = state.amplitude()[0];
  values[1] = curve_.end() - state.amplitude()[0];
}

void PointOnCurve::describe(const LocalState& state, Description& description) const {
  Joint::describe(state, description);
  description.add(
      fmt::format("{} curve, length {:.6g} m", curve_.closed() ? "closed" : "open", curve_.arc_length(curve_.end())));
}

namespace {

/// Reads points that are given along the axes of the joint's frame.
/// @param origin  origin of the points, in that frame
Curve read_curve(const YamlValue& value, bool closed, const Vector3& origin) {
  return read_named_file(value, [&](const std::string& path) -> Curve {
    MatrixX points = read_table(path, 3);
    points.rowwise() += origin.transpose();
    return {points, closed, path};
  });
}

}  // namespace

const KeyTable& point_on_curve_keys() {
  using namespace keys;
  static const KeyTable table{
      "a point_on_curve joint", "A joint that holds a point on a curve of the first node and leaves turning free.",
      joined({joint_frame_keys(AxisNeed::optional),
              {{"curve", file("table of three columns"), required,
                "Points of the curve as drawn [m], along the axes of the joint's frame, which are the inertial ones "
                "unless `axis` or `second_axis` is given; a cubic spline joins them."},
               {"curve_origin", vector3("m").as_point().in_inertial_axes(), computed("the origin of the inertial axes"),
                "Origin of these points as drawn."},
               {"closed", boolean(), otherwise("false"), "Whether the curve returns to its first point."}},
              joint_action_keys(Moves::slides)})};
  return table;
}

void read_point_on_curve(const std::string& name, const YamlValue& entry, Model& model) {
  JointFrames frames = read_joint_frames(entry, model, AxisNeed::optional);
  // J_A is at the initial position of the point, or at its start (`at`).
  const Frame joint = model.node(frames.first).frame * frames.on_first;
  const std::optional<YamlValue> given = entry.find("curve_origin");
  const Vector3 origin = given ? given->vector3() : Vector3::Zero();
  Curve curve = read_curve(entry.at("curve"), entry.at("closed").boolean(), joint.R.transpose() * (origin - joint.x));
  const double start = curve.nearest(Vector3::Zero());
  add_pair(std::make_unique<PointOnCurve>("point_on_curve", name, std::move(frames), std::move(curve), start,
                                          PointOnCurve::Guide::space, model),
           entry, model);
}

void PointOnCurve::draw(Drawing& drawing) const {
  Joint::draw(drawing);
  if (drawing.shaped()) return;  // the curve is the contour of a cam, which draws it
  constexpr int points = 200;
  std::vector<std::vector<double>> line;
  const int last = curve_.closed() ? points - 1 : points;
  for (int k = 0; k <= last; ++k) line.push_back(numbers_of(curve_(curve_.end() * k / points).point));
  drawing.add({.shape = "curve",
               .places = {{frames().first, frames().on_first}},
               .values = {{"points", std::move(line)}, {"closed", curve_.closed()}}});
}

}  // namespace bielle::mechanism
