#include "mechanism/joints/pairs/links.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/joints/pairs/read_pair.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// @throws ComputationError if a function of time becomes an invalid length
double length_at(const Expression& length, double t, const std::string& name) {
  const double L = length(t);
  if (!(L > 0))
    throw ComputationError(
        fmt::format("the length of joint '{}' is {:.6g} m at t = {:.6g} s: expected one greater than 0", name, L, t));
  return L;
}

using RowList = std::vector<MeasuredPair::Row>;

/// Returns (d . d - L^2)/(2 L).
template <class Measure>
Measure length_row(const Measure& dd, double L) {
  return (0.5 / L) * (dd - L * L);
}

/// Returns the angular velocity of the line between the two points [rad/s].
double turning_of_rod(const LocalState& state, const JointFrames& frames) {
  const NodeState &first = state.node(0), &second = state.node(1);
  const PointGap gap(first, second, frames.on_first.x, frames.on_second.x);
  const double squared = gap.value().squaredNorm();
  return squared > 0 ? gap.value().cross(gap.rate(first, second)).norm() / squared : 0;
}

Vector3 point_of(const NodeState& node, const Vector3& c) { return node.x + node.R * c; }

}  // namespace

// -- distance

DistanceJoint::DistanceJoint(std::string type, std::string name, JointFrames frames, Expression length,
                             const Model& model)
    : MeasuredRows(std::move(type), std::move(name), std::move(frames), {}, RowList{{"tension", "N"}}, model),
      length_(std::move(length)) {}

template <int order>
void DistanceJoint::rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const {
  rows[0] = length_row(squared_distance<order>(state), length_at(length_, state.time(), name()));
}

// The derivative L' d/dL of the row is -L' (1 + d.d/L^2)/2; it is applied once more along the motion.
void DistanceJoint::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                         Eigen::Ref<VectorX> acceleration) const {
  MeasuredPair::add_constraint_rates(state, velocity, acceleration);
  if (length_.is_constant()) return;
  const double t = state.time(), L = length_(t), L1 = length_.derivative(t, 1), L2 = length_.derivative(t, 2);
  const PairSlope dd = squared_distance<1>(state);
  const double u = dd.value / (L * L), dd_rate = dd.rate(pair_rate(state.node(0), state.node(1)));
  velocity[0] -= 0.5 * L1 * (1 + u);
  acceleration[0] += -0.5 * L2 * (1 + u) + L1 * L1 * u / L - L1 * dd_rate / (L * L);
}

void DistanceJoint::add_energy(const LocalState& state, Energy& energy) const {
  if (length_.is_constant()) return;
  const double t = state.time(), L = length_(t);
  const Vector3 d = point_of(state.node(1), frames().on_second.x) - point_of(state.node(0), frames().on_first.x);
  energy.input -= state.reaction()[0] * 0.5 * length_.derivative(t, 1) * (1 + d.squaredNorm() / (L * L));
}

void DistanceJoint::add_break_points(std::vector<double>& times) const {
  const std::vector<double> points = length_.break_points();
  times.insert(times.end(), points.begin(), points.end());
}

std::vector<TimeDependent::Formula> DistanceJoint::time_formulas() const {
  if (length_.is_constant()) return {};
  return {{"length", "m", Part::position}};
}

void DistanceJoint::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  values[0] = length_(state.time());
}

double DistanceJoint::turning_rate(const LocalState& state) const { return turning_of_rod(state, frames()); }

void DistanceJoint::describe(const LocalState& state, Description& description) const {
  const Vector3 from = point_of(state.node(0), frames().on_first.x), to = point_of(state.node(1), frames().on_second.x);
  description.add(fmt::format("nodes '{}' and '{}'", first_name(), second_name()));
  description.add(fmt::format("from {} m to {} m", format_vector(from), format_vector(to)));
  description.add(fmt::format("length {} [m]", length_.text()));
}

// -- hinge and ball

RevoluteSphericalLink::RevoluteSphericalLink(std::string name, JointFrames frames, double length, double offset,
                                             const Model& model)
    : MeasuredRows("revolute_spherical", std::move(name), std::move(frames),
                   {{"angle", JointCoordinate::Kind::angle, JointCoordinate::by_type}},
                   RowList{{"tension", "N"}, {"axial", "N"}}, model),
      length_(length),
      offset_(offset) {}

template <int order>
void RevoluteSphericalLink::rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const {
  rows[0] = length_row(squared_distance<order>(state), length_);
  rows[1] = position<order>(2, state) - offset_;
}

PairMeasure RevoluteSphericalLink::calc_own_coordinate(std::size_t /*index*/, const LocalState& state) const {
  return atan2(position(1, state), position(0, state));
}

PairSlope RevoluteSphericalLink::calc_own_slope(std::size_t /*index*/, const LocalState& state) const {
  return atan2(position<1>(1, state), position<1>(0, state));
}

double RevoluteSphericalLink::turning_rate(const LocalState& state) const { return turning_of_rod(state, frames()); }

void RevoluteSphericalLink::describe(const LocalState& state, Description& description) const {
  MeasuredPair::describe(state, description);
  description.add(fmt::format("length {:.6g} m", length_));
}

// -- readers

namespace {

/// The frames of a link: initial inertial axes, at the two points; with the vector between them.
struct LinkFrames {
  JointFrames frames;
  Vector3 d;
};

/// Returns the keys that `read_link_frames` reads, with `type`.
std::vector<Key> link_frame_keys() {
  using namespace keys;
  return {type_key(),
          {"nodes", list_of(2, name_of("node")), required, "First and second node."},
          {"at", list_of(2, vector3("m").as_point()), otherwise("[[0, 0, 0], [0, 0, 0]]"),
           "End points of the link, each in the axes of its node."}};
}

KeyTable rod_table(const std::string& type) {
  using namespace keys;
  return {fmt::format("a {} joint", type), "A rod without mass and with a ball joint at either end.",
          joined({link_frame_keys(),
                  {{"length", formula("m", {"t"}).positive(), computed("the distance as drawn"),
                    "Distance of the two points, which may be a formula of t."}}})};
}

LinkFrames read_link_frames(const YamlValue& entry, const Model& model) {
  LinkFrames link;
  const std::vector<int> nodes = nodes_named_by(entry.at("nodes"), 2, model);
  link.frames.first = nodes[0];
  link.frames.second = nodes[1];
  if (nodes[0] == nodes[1]) entry.at("nodes").fail("a joint needs two different nodes");
  const Frame &first = model.node(nodes[0]).frame, &second = model.node(nodes[1]).frame;
  const YamlValue at = entry.at("at");
  if (!at.is_sequence() || at.size() != 2) at.fail("expected two points, each in the axes of its node");
  link.frames.on_first.x = at.at(std::size_t{0}).vector3();
  link.frames.on_second.x = at.at(1).vector3();
  link.frames.on_first.R = first.R.transpose();
  link.frames.on_second.R = second.R.transpose();
  link.d = second.x + second.R * link.frames.on_second.x - first.x - first.R * link.frames.on_first.x;
  return link;
}

void check_drawn_length(const YamlValue& entry, const Vector3& d, const char* what) {
  if (d.norm() == 0)
    entry.fail(
        fmt::format("{} has no length: its two points are drawn at the same place; give `at`, or take a "
                    "spherical joint",
                    what));
}

void read_rod(const char* type, const std::string& name, const YamlValue& entry, Model& model) {
  LinkFrames link = read_link_frames(entry, model);
  if (!entry.has("length")) check_drawn_length(entry, link.d, "the rod");
  Expression length = entry.has("length") ? entry.at("length").expression() : Expression(link.d.norm());
  if (!(length(0) > 0)) entry.at("length").fail("expected a length greater than 0");
  model.add(std::make_unique<DistanceJoint>(type, name, std::move(link.frames), std::move(length), model),
            Entry{Section::joints, name});
}

}  // namespace

const KeyTable& distance_keys() {
  static const KeyTable table = rod_table("distance");
  return table;
}

const KeyTable& spherical_spherical_keys() {
  static const KeyTable table = rod_table("spherical_spherical");
  return table;
}

const KeyTable& revolute_spherical_keys() {
  using namespace keys;
  static const KeyTable table{
      "a revolute_spherical link", "A rod without mass that hinges on the first node, with a ball joint on the second.",
      joined({link_frame_keys(),
              {{"axis", direction().as_axial().in_inertial_axes(), required,
                "Axis of the hinge on the first node, as drawn."},
               {"length", number("m").positive(), computed("the distance as drawn"), "Distance of the two points."}},
              joint_action_keys(Moves::turns)})};
  return table;
}

void read_distance(const std::string& name, const YamlValue& entry, Model& model) {
  read_rod("distance", name, entry, model);
}

void read_spherical_spherical(const std::string& name, const YamlValue& entry, Model& model) {
  read_rod("spherical_spherical", name, entry, model);
}

void read_revolute_spherical(const std::string& name, const YamlValue& entry, Model& model) {
  LinkFrames link = read_link_frames(entry, model);
  const Vector3 z = entry.at("axis").direction();
  const double offset = z.dot(link.d);
  const Vector3 arm = link.d - z * offset;
  if (arm.norm() <= 1e-9 * link.d.norm())
    entry.at("axis").fail("the ball is drawn on the hinge's axis: give `at`, a point on the axis and the ball");
  double length = link.d.norm();
  if (const auto given = entry.find("length")) {
    length = given->number();
    if (length <= std::abs(offset))
      given->fail(fmt::format("the ball is drawn {:.6g} m along the axis: no link as short as that reaches it",
                              std::abs(offset)));
  }
  Matrix3 axes;
  axes << arm.normalized(), z.cross(arm.normalized()), z;
  link.frames.on_first.R = model.node(link.frames.first).frame.R.transpose() * axes;
  link.frames.on_second.R = model.node(link.frames.second).frame.R.transpose() * axes;
  add_pair(std::make_unique<RevoluteSphericalLink>(name, std::move(link.frames), length, offset, model), entry, model);
}

void DistanceJoint::draw(Drawing& drawing) const {
  drawing.add_between("bar", {frames().first, frames().on_first}, {frames().second, frames().on_second});
}

void RevoluteSphericalLink::draw(Drawing& drawing) const {
  Joint::draw(drawing);
  drawing.add_between("bar", {frames().first, frames().on_first}, {frames().second, frames().on_second});
}

}  // namespace bielle::mechanism
