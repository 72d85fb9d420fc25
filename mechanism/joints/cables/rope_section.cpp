#include "mechanism/joints/cables/rope_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/measures/turns.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {
namespace {

constexpr int per_span = 4;  ///< memory: two angles with their rates

/// Angle, from 0 to one turn, by which the rope turns about a pulley in its own sense.
double arc_angle(double turn, double radius) {
  const double angle = std::fmod(radius > 0 ? turn : -turn, 2 * M_PI);
  const double positive = angle < 0 ? angle + 2 * M_PI : angle;
  return positive > 2 * M_PI - 1e-9 ? 0 : positive;  // it just touches
}

}  // namespace

RopeSection::RopeSection(std::string type, std::string name, std::vector<int> nodes, std::vector<std::string> names,
                         std::vector<Pulley> pulleys, const RopeMaterial& material, const std::vector<Frame>& drawn)
    : Component(std::move(type), std::move(name)),
      nodes_(std::move(nodes)),
      names_(std::move(names)),
      pulleys_(std::move(pulleys)),
      material_(material) {
  const auto at = [&](std::size_t k) {
    NodeState node;
    node.x = drawn[k].x;
    node.R = drawn[k].R;
    return node;
  };
  double length = 0;
  for (std::size_t s = 0; s < spans(); ++s) {
    const Pulley &from = pulleys_[s], &to = pulleys_[s + 1];
    const NodeState first = at(s), second = at(s + 1);
    const double way = (second.x + second.R * to.on_node.x - first.x - first.R * from.on_node.x).norm();
    if (way <= std::abs(to.radius - from.radius))
      throw std::domain_error(
          fmt::format("there is no straight way from '{}' to '{}': the pulleys overlap", names_[s], names_[s + 1]));
    const SpanMeasures span = measure_span(first, second, from, to);
    length += span.length.value;
    drawn_turns_.insert(drawn_turns_.end(), {span.first_turn.value, span.second_turn.value});
    turns_drawn_ += from.radius * span.first_turn.value - to.radius * span.second_turn.value;
    if (s == 0 || from.radius == 0) continue;
    const SpanMeasures before = measure_span(at(s - 1), first, pulleys_[s - 1], from);
    arcs_drawn_ += std::abs(from.radius) * arc_angle(span.first_turn.value - before.second_turn.value, from.radius);
  }
  spans_drawn_ = length;
  E_drawn_ = material_.pretension * (length + arcs_drawn_) / (material_.EA + material_.pretension);
}

void RopeSection::declare(Declaration& declaration) const {
  declaration.nodes = nodes_;
  declaration.stiffness = declaration.kinks = true;
  declaration.damping = material_.damping > 0;
  declaration.memory.assign(per_span * spans(), 0.0);  // angles beyond those drawn
  declaration.memory.push_back(std::numeric_limits<double>::quiet_NaN());
  declaration.memory.push_back(E_drawn_ > 0 ? 1 : 0);  // whether it is taut
  declaration.crossings = {{"becomes taut or slack"}};
}

namespace {

/// An angle of a span beyond the drawn one, counted over turns.
double beyond_drawn(const PairMeasure& angle, double drawn, const Eigen::Vector2d& before, double time_before,
                    double rate, const LocalState& state) {
  return counted_angle({angle.value - drawn, rate}, {before[0], before[1]}, time_before, state);
}

}  // namespace

void RopeSection::calc_stretch(const LocalState& state, Stretch& stretch) const {
  const auto n = static_cast<Eigen::Index>(6 * nodes_.size());
  const auto memory = state.memory();
  const double time_before = memory[time_memory()];
  stretch.E_gradient.setZero(n);
  stretch.L_gradient.setZero(n);
  stretch.E_second.setZero(n, n);
  stretch.E = E_drawn_ - spans_drawn_ - turns_drawn_;
  stretch.L = arcs_drawn_;
  stretch.E_rate = 0;
  for (std::size_t s = 0; s < spans(); ++s) {
    const int k = static_cast<int>(s);
    const NodeState &first = state.node(k), &second = state.node(k + 1);
    const Pulley &from = pulleys_[s], &to = pulleys_[s + 1];
    const SpanMeasures span = measure_span(first, second, from, to);
    const Vector12 v = pair_rate(first, second);
    PairMeasure first_turn = span.first_turn, second_turn = span.second_turn;
    const Eigen::Index at = per_span * k;
    first_turn.value = drawn_turns_[2 * s] + beyond_drawn(first_turn, drawn_turns_[2 * s], memory.segment<2>(at),
                                                          time_before, first_turn.rate(v), state);
    second_turn.value =
        drawn_turns_[2 * s + 1] + beyond_drawn(second_turn, drawn_turns_[2 * s + 1], memory.segment<2>(at + 2),
                                               time_before, second_turn.rate(v), state);
    const PairMeasure e = span.length + from.radius * first_turn - to.radius * second_turn;
    stretch.E += e.value;
    stretch.E_rate += e.rate(v);
    stretch.E_gradient.segment<12>(6 * k) += e.gradient;
    stretch.E_second.block<12, 12>(6 * k, 6 * k) += e.second;
    PairMeasure l = span.length;
    if (s > 0) l += from.radius * (first_turn - drawn_turns_[2 * s]);
    if (s + 1 < spans()) l -= to.radius * (second_turn - drawn_turns_[2 * s + 1]);
    stretch.L += l.value;
    stretch.L_gradient.segment<12>(6 * k) += l.gradient;
  }
  const double natural = stretch.L - stretch.E;
  if (!(natural > 0)) {
    stretch.taut = stretch.stretched = false;
    stretch.tension = std::numeric_limits<double>::quiet_NaN();  // wound up to its end: no trial state
    return;
  }
  const bool stretched = state.environment().statics ? stretch.E >= 0 : memory[time_memory() + 1] != 0;
  const double T = material_.EA * (stretch.E + material_.damping * stretch.E_rate) / natural;
  stretch.stretched = stretched;
  stretch.taut = stretched && T >= 0;
  stretch.tension = stretch.taut ? T : 0;
}

void RopeSection::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  thread_local Stretch stretch;
  calc_stretch(state, stretch);
  if (stretch.taut || std::isnan(stretch.tension))
    r.head(stretch.E_gradient.size()) += stretch.tension * stretch.E_gradient;
}

// dT = EA/N (dE + tau dEdot) + T/N (dE - dL),   N = L - E
void RopeSection::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  thread_local Stretch s;
  calc_stretch(state, s);
  if (!s.taut) return;
  const auto n = s.E_gradient.size();
  const double natural = s.L - s.E, k = material_.EA / natural, by_rate = k * material_.damping;
  if (tangent.wants_K) {
    thread_local VectorX slope, v;
    slope = (k + s.tension / natural) * s.E_gradient - (s.tension / natural) * s.L_gradient;
    if (by_rate != 0) {
      v.resize(state.slots().size());
      get_local_velocities(state, v);
      slope.noalias() += by_rate * (s.E_second.transpose() * v.head(n));
    }
    auto K = tangent.K.dense();
    K.topLeftCorner(n, n) += s.tension * s.E_second;
    K.topLeftCorner(n, n).noalias() += s.E_gradient * slope.transpose();
  }
  if (tangent.wants_C && by_rate != 0)
    tangent.C.dense().topLeftCorner(n, n).noalias() += by_rate * s.E_gradient * s.E_gradient.transpose();
}

void RopeSection::add_energy(const LocalState& state, Energy& energy) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  if (!s.stretched) return;
  VectorX v(state.slots().size());
  get_local_velocities(state, v);
  const double natural = s.L - s.E, L_rate = s.L_gradient.dot(v.head(s.L_gradient.size()));
  const double strain = s.E / natural, elastic_tension = material_.EA * strain;
  energy.elastic += 0.5 * elastic_tension * s.E;
  // d/dt (EA E^2/(2 N)) = EA strain Edot - EA strain^2/2 Ndot
  energy.input -= 0.5 * elastic_tension * strain * (L_rate - s.E_rate);
  energy.dissipation += (s.tension - elastic_tension) * s.E_rate;
}

void RopeSection::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const auto before = state.memory();
  const double time_before = before[time_memory()];
  for (std::size_t s = 0; s < spans(); ++s) {
    const int k = static_cast<int>(s);
    const NodeState &first = state.node(k), &second = state.node(k + 1);
    const SpanMeasures span = measure_span(first, second, pulleys_[s], pulleys_[s + 1]);
    const Vector12 v = pair_rate(first, second);
    for (const int end : {0, 1}) {
      const PairMeasure& turn = end == 0 ? span.first_turn : span.second_turn;
      const Eigen::Index at = per_span * k + 2 * end;
      const double rate = turn.rate(v);
      memory[at] = beyond_drawn(turn, drawn_turns_[2 * s + static_cast<std::size_t>(end)], before.segment<2>(at),
                                time_before, rate, state);
      memory[at + 1] = rate;
    }
  }
  memory[time_memory()] = state.time();
}

bool RopeSection::leaves_branch(const LocalState& state) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  return s.stretched && s.E < 0;
}

void RopeSection::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                               Eigen::Ref<VectorX> memory) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  memory[time_memory() + 1] = s.E > 0 || (s.E == 0 && s.E_rate >= 0) ? 1 : 0;
}

void RopeSection::calc_crossings(const LocalState& state, Eigen::Ref<VectorX> values) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  values[0] = s.E;
}

std::vector<OutputField> RopeSection::output_fields() const {
  return {{"tension", {}, "N", "of the rope"},
          {"elongation", {}, "m", "by which the section is longer than its rope without load"},
          {"length", {}, "m", "of the section, arcs on pulleys between its ends included"}};
}

void RopeSection::write_output(const LocalState& state, double* values) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  values[0] = s.tension;
  values[1] = s.E;
  values[2] = s.L;
}

void RopeSection::describe(const LocalState& state, Description& description) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  description.add(fmt::format("from '{}' to '{}': length {:.6g} m, stiffness {:.6g} N/m, tension {:.6g} N",
                              names_.front(), names_.back(), s.L, material_.EA / (s.L - s.E), s.tension));
  if (names_.size() > 2)
    description.add(fmt::format("slides on {}", fmt::join(names_.begin() + 1, names_.end() - 1, ", ")));
}

namespace {

class TensionMeasure final : public Measure {
 public:
  TensionMeasure(std::string name, const RopeSection& rope) : Measure(std::move(name)), rope_(rope) {}
  std::string units() const override { return "N"; }
  double value(const LocalState& state) const override {
    thread_local RopeSection::Stretch s;
    rope_.calc_stretch(state.of(0), s);
    return s.tension;
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    thread_local RopeSection::Stretch s;
    const LocalState of_rope = state.of(0);
    rope_.calc_stretch(of_rope, s);
    if (!s.taut) return s.tension;
    const int row = state.slots().reference_row(0);
    const auto n = s.E_gradient.size();
    const double natural = s.L - s.E, k = rope_.material().EA / natural, by_rate = k * rope_.material().damping;
    VectorX v(of_rope.slots().size());
    get_local_velocities(of_rope, v);
    gradient.position().segment(row, n) = (k + s.tension / natural) * s.E_gradient -
                                          (s.tension / natural) * s.L_gradient +
                                          by_rate * (s.E_second.transpose() * v.head(n));
    gradient.rate().segment(row, n) = by_rate * s.E_gradient;
    return s.tension;
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&rope_}; }
  const RopeSection& rope_;
};

}  // namespace

std::vector<std::string> RopeSection::measure_names() const { return {"tension"}; }

std::unique_ptr<Measure> RopeSection::make_measure(const std::string& name, const std::string& /*measure*/) const {
  return std::make_unique<TensionMeasure>(name, *this);
}

}  // namespace bielle::mechanism
