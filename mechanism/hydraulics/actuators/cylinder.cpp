#include "mechanism/hydraulics/actuators/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/hydraulics/actuators/stroke_watch.hpp"
#include "mechanism/measures/nested.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

namespace {

constexpr double unknown = -1;  ///< initial value in the search for a pressure, see Volume [Pa]
/// A cylinder whose pressures follow from the load has this compliance in the tangent only ([m/N] in statics, [1/kg] in
/// motion, far below the compliance of machines). If several cylinders hold the same length, their forces are not
/// unique: each step of Newton's method is then the change of smallest norm (a proximal step), and the first one starts
/// from zero force.
constexpr double give = 1e-11;

}  // namespace

/// "boom.length", "boom.force", "boom.pressure_1"
class CylinderMeasure final : public Measure {
 public:
  CylinderMeasure(std::string name, const Cylinder& cylinder, std::string quantity)
      : Measure(std::move(name)), cylinder_(cylinder), quantity_(std::move(quantity)) {}
  std::string units() const override {
    return quantity_ == "length" ? "m" : quantity_ == "length.rate" ? "m/s" : quantity_ == "force" ? "N" : "Pa";
  }
  double value(const LocalState& state) const override {
    Nested<MeasureGradient> unused;
    return calc(state, *unused);
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    const LocalState of = state.of(0);
    const int row = state.slots().reference_row(0);
    auto by_position = gradient.position().segment<12>(row);
    auto by_rate = gradient.rate().segment<12>(row);
    if (quantity_.starts_with("pressure_")) {
      const int port = quantity_.back() - '1';
      gradient.position()[row + cylinder_.ports_.pressure_row(of, port)] = 1;
      return cylinder_.ports_.pressure(of, port);
    }
    const PairMeasure l = cylinder_.length(of);
    const Vector12 v = pair_rate(of.node(0), of.node(1));
    if (quantity_ == "length") {
      by_position = l.gradient;
      return l.value;
    }
    const Vector12 of_rate = l.second.transpose() * v;
    if (quantity_ == "length.rate") {
      by_position = of_rate;
      by_rate = l.gradient;
      return l.rate(v);
    }
    const Cylinder::Push push = cylinder_.push(of, l.value, l.rate(v));
    by_position = push.by_length * l.gradient + push.by_rate * of_rate;
    by_rate = push.by_rate * l.gradient;
    for (std::size_t k = 0; k < cylinder_.chambers_.size(); ++k)
      gradient.position()[row + cylinder_.ports_.pressure_row(of, static_cast<int>(k))] +=
          cylinder_.chambers_[k].space.at(l.value).V_l;
    return push.total();
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&cylinder_}; }
  const Cylinder& cylinder_;
  std::string quantity_;
};

Cylinder::Cylinder(std::string name, Geometry geometry, double fluid_ambient)
    : Component("hydraulic_actuator", std::move(name)), geometry_(std::move(geometry)), ambient_(fluid_ambient) {}

void Cylinder::add_chamber(const PressureNode& place, ChamberSpace space) {
  ports_.add(place, references_);
  volumes_.push_back(dynamic_cast<const Volume*>(&place));
  chambers_.push_back({std::move(space)});
}

void Cylinder::declare(Declaration& declaration) const {
  declaration.nodes = {geometry_.node_a, geometry_.node_b};
  references_.declare(declaration);
  declaration.stiffness = true;
  declaration.damping = geometry_.friction || geometry_.stop_damping > 0;
  declaration.mass = tank_.has_value();  // the row of a start that follows from the load contains accelerations
  declaration.starts_by_state = tank_.has_value();
  declaration.memory = {0, 0};
  if (geometry_.stop_stiffness == 0) return;
  declaration.kinks = true;  // the force of a stop has a kink at zero
  declaration.event_functions = {{"the long end of its stroke is reached"}, {"the short end of its stroke is reached"}};
}

PairMeasure Cylinder::length(const LocalState& state) const {
  const NodeState &A = state.node(0), &B = state.node(1);
  PairMeasure squared;
  for (int k = 0; k < 3; ++k)
    squared += square(measure_position(A, B, Vector3::Unit(k), geometry_.at_a, geometry_.at_b));
  if (!(squared.value > 0))
    throw ComputationError(
        fmt::format("t = {:.6g} s: the ends of hydraulic_actuator '{}' have met: its force has no "
                    "direction",
                    state.time(), name()));
  return sqrt(squared);
}

Cylinder::Stop Cylinder::stop(const LocalState& state, double l, double rate) const {
  Stop stop;
  if (geometry_.stop_stiffness == 0) return stop;
  if (state.environment().statics)
    stop.side = l > geometry_.longest ? 1 : l < geometry_.shortest ? -1 : 0;
  else
    stop.side = state.memory()[memory_side];
  if (stop.side == 0) return stop;
  stop.way = stop.side > 0 ? l - geometry_.longest : geometry_.shortest - l;
  stop.push = std::max(0.0, geometry_.stop_stiffness * stop.way + geometry_.stop_damping * stop.side * rate);
  return stop;
}

Cylinder::Push Cylinder::push(const LocalState& state, double l, double rate) const {
  Push push;
  for (std::size_t k = 0; k < chambers_.size(); ++k) {
    const ChamberSpace::Value space = chambers_[k].space.at(l);
    const double over = chamber_pressure(state, k) - ambient_;
    push.fluid += over * space.V_l;
    push.by_length += over * space.V_ll;
  }
  if (geometry_.friction) {
    const FrictionLaw::Sliding sliding = geometry_.friction->sliding(std::abs(rate));
    push.friction = -sliding.h * rate;
    push.by_rate -= sliding.h + sliding.slope_over_speed * rate * rate;
  }
  if (const Stop end = stop(state, l, rate); end.push > 0) {
    push.stop = -end.side * end.push;
    push.by_length -= geometry_.stop_stiffness;
    push.by_rate -= geometry_.stop_damping;
  }
  return push;
}

bool Cylinder::waits(const LocalState& state) const { return tank_ && volumes_[0]->waits(state.of(0)); }

int Cylinder::space_row(const LocalState& state, std::size_t k) const {
  return volumes_[k] ? state.slots().reference_row(static_cast<int>(k)) + Volume::space_row : -1;
}

void Cylinder::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const PairMeasure l = length(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  r.head<12>() -= push(state, l.value, l.rate(v)).total() * l.gradient;
  for (std::size_t k = 0; k < chambers_.size(); ++k)
    if (const int row = space_row(state, k); row >= 0) r[row] -= chambers_[k].space.at(l.value).V;
  if (!waits(state)) return;
  // The first chamber's pressure is determined by zero acceleration of the length; in statics, where all accelerations
  // are zero, by an unchanged length.
  double& row = r[ports_.pressure_row(state, 0)];
  row += l.acceleration(v, pair_acceleration(state.node(0), state.node(1)));
  if (state.environment().statics) row += l.value - state.memory()[memory_length];
  if (chamber_pressure(state, 0) == unknown) row += give * chambers_[0].space.at(l.value).V_l * (unknown - ambient_);
  if (chambers_.size() > 1) r[ports_.pressure_row(state, 1)] += chamber_pressure(state, 1) - *tank_;
}

void Cylinder::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const PairMeasure l = length(state);
  const Vector12 v = pair_rate(state.node(0), state.node(1)), &g = l.gradient;
  const Push F = push(state, l.value, l.rate(v));
  if (tangent.wants_C && F.by_rate != 0) tangent.C.dense().topLeftCorner<12, 12>() -= F.by_rate * g * g.transpose();
  const bool waiting = waits(state);
  if (tangent.wants_M && waiting) tangent.M.dense().block<1, 12>(ports_.pressure_row(state, 0), 0) += g.transpose();
  if (!tangent.wants_K) return;
  auto K = tangent.K.dense();
  K.topLeftCorner<12, 12>() -= F.total() * l.second + F.by_length * g * g.transpose();
  if (F.by_rate != 0) K.topLeftCorner<12, 12>() -= F.by_rate * g * (l.second.transpose() * v).transpose();
  for (std::size_t k = 0; k < chambers_.size(); ++k) {
    const double V_l = chambers_[k].space.at(l.value).V_l;
    K.block<12, 1>(0, ports_.pressure_row(state, static_cast<int>(k))) -= V_l * g;
    if (const int row = space_row(state, k); row >= 0) K.block<1, 12>(row, 0) -= V_l * g.transpose();
  }
  if (!waiting) return;
  const int first = ports_.pressure_row(state, 0);
  K(first, first) += give * chambers_[0].space.at(l.value).V_l;
  if (state.environment().statics) K.block<1, 12>(first, 0) += g.transpose();
  if (chambers_.size() > 1) K(ports_.pressure_row(state, 1), ports_.pressure_row(state, 1)) += 1;
}

void Cylinder::add_energy(const LocalState& state, Energy& energy) const {
  const PairMeasure l = length(state);
  const double rate = l.rate(pair_rate(state.node(0), state.node(1)));
  const Push F = push(state, l.value, rate);
  energy.dissipation -= F.friction * rate;
  for (std::size_t k = 0; k < chambers_.size(); ++k)
    if (!volumes_[k])
      energy.input += (chamber_pressure(state, k) - ambient_) * chambers_[k].space.at(l.value).V_l * rate;
  const Stop end = stop(state, l.value, rate);
  if (end.side == 0) return;
  // The damper dissipates the energy of a spring that it prevents from pushing.
  energy.elastic += 0.5 * geometry_.stop_stiffness * end.way * end.way;
  energy.dissipation += (end.push - geometry_.stop_stiffness * end.way) * end.side * rate;
}

// -- start

void Cylinder::add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const {
  if (!waits(state) || chamber_pressure(state, 0) == unknown) return;
  const double l = length(state).value;
  std::vector<double> p(chambers_.size(), *tank_);
  p[0] = chamber_pressure(state, 0);
  if (p[0] < *tank_ && chambers_.size() > 1) {
    // The load pulls, and the pressure of the other chamber carries it.
    const double ratio = -chambers_[0].space.at(l).V_l / chambers_[1].space.at(l).V_l;
    p[1] += (*tank_ - p[0]) * ratio;
    p[0] = *tank_;
  }
  if (p[0] <= volumes_[0]->fluid().vacuum())
    throw ComputationError(
        fmt::format("t = {:.6g} s: the load pulls hydraulic_actuator '{}', whose only chamber can only push (its "
                    "pressure would be {:.4g} Pa): give it a second one, or `pressures` to start from",
                    state.time(), name(), p[0]));
  for (std::size_t k = 0; k < chambers_.size(); ++k) {
    const int begin = state.slots().reference_row(static_cast<int>(k));
    const LocalState own = state.of(static_cast<int>(k));
    change[begin + Volume::pressure_row] += p[k] - volumes_[k]->pressure(own);
    change[begin + Volume::fluid_row] +=
        volumes_[k]->fluid_at(p[k], volumes_[k]->space(own)) - own.first_order()[Volume::fluid_row];
  }
}

void Cylinder::begin_motion(const LocalState& state, bool /*known*/, Eigen::Ref<VectorX> memory) const {
  memory[memory_length] = length(state).value;
}

// -- stops

void Cylinder::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  if (values.size() == 0) return;
  const double l = length(state).value;
  values[0] = l - geometry_.longest;
  values[1] = geometry_.shortest - l;
}

// Stops of joints follow the same rule (joints/actions/joint_stop.cpp).
void Cylinder::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                            Eigen::Ref<VectorX> memory) const {
  if (geometry_.stop_stiffness == 0) return;
  const PairMeasure l = length(state);
  const double rate = l.rate(pair_rate(state.node(0), state.node(1)));
  const auto beyond = [](double way, double speed) { return way > 0 || (way == 0 && speed >= 0); };
  memory[memory_side] = beyond(l.value - geometry_.longest, rate)     ? 1
                        : beyond(geometry_.shortest - l.value, -rate) ? -1
                                                                      : 0;
}

bool Cylinder::leaves_branch(const LocalState& state) const { return stop(state, length(state).value, 0).way < 0; }

// -- results

std::vector<OutputField> Cylinder::output_fields() const {
  const std::size_t n = chambers_.size();
  return {{"pressure", {n}, "Pa", "of the chambers: extending, drawing in"},
          {"flow", {n}, "m^3/s", "net flow into the places that the chambers open into"},
          {"length", {}, "m", "distance of the attachment points"},
          {"rate", {}, "m/s", "rate of the length"},
          {"force", {}, "N", "pushes the attachment points apart"},
          {"friction_force", {}, "N", "part of the seals"},
          {"stop_force", {}, "N", "part of the stops"}};
}

void Cylinder::write_output(const LocalState& state, double* values) const {
  const PairMeasure l = length(state);
  const double rate = l.rate(pair_rate(state.node(0), state.node(1)));
  const Push F = push(state, l.value, rate);
  const std::size_t n = chambers_.size();
  for (std::size_t k = 0; k < n; ++k) {
    values[k] = chamber_pressure(state, k);
    values[n + k] =
        volumes_[k] ? volumes_[k]->net_flow(state.of(static_cast<int>(k))) : chambers_[k].space.at(l.value).V_l * rate;
  }
  double* next = values + 2 * n;
  for (const double value : {l.value, rate, F.total(), F.friction, F.stop}) *next++ = value;
}

void Cylinder::describe(const LocalState& state, Description& description) const {
  description.add(
      fmt::format("between nodes {} and {}", description.node(geometry_.node_a), description.node(geometry_.node_b)));
  const double l = length(state).value;
  description.add(fmt::format("length {:.6g} m, stroke {:.6g} to {:.6g} m", l, geometry_.shortest, geometry_.longest));
  for (std::size_t k = 0; k < chambers_.size(); ++k) {
    const ChamberSpace::Value space = chambers_[k].space.at(l);
    description.add_line(fmt::format("chamber {}: area {:.6g} m^2, {:.6g} m^3, {:.6g} Pa, opens into '{}'", k + 1,
                                     std::abs(space.V_l), space.V, chamber_pressure(state, k),
                                     ports_.node(static_cast<int>(k)).name()));
  }
  if (geometry_.stop_stiffness > 0)
    description.add_line(fmt::format("stops of stiffness {:.6g} N/m, damping {:.6g} N s/m", geometry_.stop_stiffness,
                                     geometry_.stop_damping));
}

std::unique_ptr<StepRecorder> Cylinder::make_step_recorder() const {
  if (geometry_.stop_stiffness > 0) return nullptr;
  return std::make_unique<StrokeWatch>(*this);
}

std::vector<std::string> Cylinder::measure_names() const {
  std::vector<std::string> names = {"length", "length.rate", "force"};
  for (std::size_t k = 0; k < chambers_.size(); ++k) names.push_back(fmt::format("pressure_{}", k + 1));
  return names;
}

std::unique_ptr<Measure> Cylinder::make_measure(const std::string& name, const std::string& measure) const {
  return std::make_unique<CylinderMeasure>(name, *this, measure);
}

void Cylinder::draw(Drawing& drawing) const {
  double area = 0;
  for (const Chamber& chamber : chambers_) area = std::max(area, chamber.space.largest_area());
  drawing.add_between("jack", {geometry_.node_a, {geometry_.at_a, Matrix3::Identity()}},
                      {geometry_.node_b, {geometry_.at_b, Matrix3::Identity()}},
                      {{"stroke", std::vector<double>{geometry_.shortest, geometry_.longest}},
                       {"radius", std::sqrt(area / std::numbers::pi)}});
}

}  // namespace bielle::mechanism
