#include "mechanism/joints/cables/rope_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/measures/turns.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
RopeSection::RopeSection(std::string type, std::string name, RopePath path, const RopeMaterial& material,
                         EndSlips slips)
    : Component(std::move(type), std::move(name)),
      path_(std::move(path)),
      courses_(path_.pulleys),
      material_(material) {
  std::vector<NodeState> nodes(path_.nodes.size());
  std::vector<Frame> at;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    nodes[k].x = path_.drawn[k].x;
    nodes[k].R = path_.drawn[k].R;
    at.push_back(path_.drawn[k] * path_.pulleys[k].on_node);
    if (k == 0) continue;
    if ((at[k].x - at[k - 1].x).norm() <= std::abs(path_.pulleys[k].radius - path_.pulleys[k - 1].radius))
      throw std::domain_error(fmt::format("there is no straight way from '{}' to '{}': the pulleys overlap",
                                          path_.names[k - 1], path_.names[k]));
  }
  drawn_places_ = courses_.as_drawn(at, path_.turns);
  RopeCourse course;
  courses_.get_course(drawn_places_, course);
  for (std::size_t s = 0; s + 1 < course.places.size(); ++s) {
    const auto i = static_cast<std::size_t>(course.places[s]), j = static_cast<std::size_t>(course.places[s + 1]);
    const SpanMeasures<1> span = measure_span<1>(nodes[i], nodes[j], course.pulleys[s], course.pulleys[s + 1]);
    drawn_length_ += span.length.value;
    if (s == 0) drawn_ends_[first_end] = span.first_turn.value;
    if (s > 0) drawn_length_ += std::abs(course.pulleys[s].radius) * drawn_places_[i].wrap;
    if (s + 2 == course.places.size()) drawn_ends_[last_end] = span.second_turn.value;
  }
  for (int k = 1; k < courses_.last(); ++k)
    if (courses_.may_leave(k)) watched_.push_back(k);
  E_drawn_ = material_.pretension * drawn_length_ / (material_.EA + material_.pretension);
  for (const End end : {first_end, last_end})
    if (slips[end]) slip_references_[end] = references_.add(*slips[end]);
}

void RopeSection::declare(Declaration& declaration) const {
  declaration.nodes = path_.nodes;
  references_.declare(declaration);
  declaration.stiffness = declaration.kinks = true;
  declaration.damping = material_.damping > 0;
  declaration.memory.assign(places_memory + 3 * static_cast<std::size_t>(courses_.last() - 1), 0.0);
  declaration.memory[time_memory] = std::numeric_limits<double>::quiet_NaN();
  declaration.memory[taut_memory] = E_drawn_ > 0 ? 1 : 0;
  remember_places(drawn_places_,
                  Eigen::Map<VectorX>(declaration.memory.data(), static_cast<Eigen::Index>(declaration.memory.size())));
  declaration.event_functions = {{"becomes taut or slack"}};
  for (const int place : watched_) {
    const std::string& pulley = path_.names[static_cast<std::size_t>(place)];
    declaration.event_functions.push_back(
        {fmt::format("leaves pulley '{}'", pulley), EventFunction::Direction::falling});
    declaration.event_functions.push_back(
        {fmt::format("comes onto pulley '{}'", pulley), EventFunction::Direction::falling});
  }
}

// -- touched pulleys

void RopeSection::get_poses(const LocalState& state, std::vector<Frame>& at) const {
  at.resize(path_.pulleys.size());
  for (std::size_t k = 0; k < at.size(); ++k) {
    const NodeState& node = state.node(static_cast<int>(k));
    at[k] = Frame{node.x, node.R} * path_.pulleys[k].on_node;
  }
}

/// Computes the places of the present branch; in statics they follow from the position.
void RopeSection::get_places(const LocalState& state, std::vector<RopePlace>& places) const {
  const auto memory = state.memory();
  places.assign(path_.pulleys.size(), RopePlace());
  for (int k = 1; k < courses_.last(); ++k)
    places[static_cast<std::size_t>(k)] = {memory[memory_of(k)], memory[memory_of(k) + 1]};
  if (watched_.empty() || !state.environment().statics) return;
  thread_local std::vector<Frame> at;
  get_poses(state, at);
  courses_.settle(at, places);
}

void RopeSection::remember_places(const std::vector<RopePlace>& places, Eigen::Ref<VectorX> memory) const {
  for (int k = 1; k < courses_.last(); ++k) {
    memory[memory_of(k)] = places[static_cast<std::size_t>(k)].sense;
    memory[memory_of(k) + 1] = places[static_cast<std::size_t>(k)].wrap;
  }
}

// -- the section as a whole

void RopeSection::calc_stretch(const LocalState& state, Stretch& stretch, int order) const {
  get_places(state, stretch.places);
  calc_along(state, stretch, order);
}

/// @param act  takes the end, the state of its slip, and the elongation per slip: -1 or 1
template <class Act>
void RopeSection::for_each_slip(const LocalState& state, const Act& act) const {
  for (const End end : {first_end, last_end})
    if (slip_references_[end] >= 0) act(end, slip_at(state, end), end == last_end ? 1.0 : -1.0);
}

/// Returns whether the section is stretched. The elongation decides in statics and while a motion begins, the memory
/// afterwards.
bool RopeSection::is_stretched(const LocalState& state, double E) const {
  bool begins = state.environment().statics;
  for_each_slip(state, [&](End, const LocalState& slip, double) { begins = begins || !RopeSlip::has_begun(slip); });
  return begins ? E >= 0 : state.memory()[taut_memory] != 0;
}

/// @param stretch  contains the states of the places
void RopeSection::calc_along(const LocalState& state, Stretch& stretch, int order) const {
  thread_local RopeCourse course;
  courses_.get_course(stretch.places, course);
  const auto n = static_cast<Eigen::Index>(6 * path_.nodes.size());
  stretch.E_gradient.setZero(n);
  stretch.L_gradient.setZero(n);
  if (order == 2) stretch.E_second.setZero(n, n);
  for (VectorX& gradient : stretch.end_gradients) gradient.setZero(n);
  stretch.wrap_rates.assign(stretch.places.size(), 0.0);
  stretch.E = E_drawn_ - drawn_length_;
  stretch.L = stretch.E_rate = 0;
  CoordinateRate arriving;
  for (std::size_t s = 0; s + 1 < course.places.size(); ++s)
    arriving = order == 2 ? add_span<2>(state, course, s, arriving, stretch)
                          : add_span<1>(state, course, s, arriving, stretch);
  stretch.E += stretch.L;
  for_each_slip(state, [&](End, const LocalState& slip, double sign) {
    stretch.E += sign * RopeSlip::slip(slip);
    stretch.E_rate += sign * RopeSlip::rate(slip).value;
  });
  const double natural = stretch.natural = stretch.L - stretch.E;
  if (!(natural > 0))
    throw ComputationError(fmt::format(
        "t = {:.6g} s: {} '{}': no free rope is left between '{}' and '{}': one has been drawn to the other, "
        "or all rope is wound",
        state.time(), type(), name(), path_.names.front(), path_.names.back()));
  const bool stretched = is_stretched(state, stretch.E);
  stretch.pull = material_.EA * (stretch.E + material_.damping * stretch.E_rate) / natural;
  stretch.strain_energy = stretched ? 0.5 * material_.EA * (stretch.E / natural) * (stretch.E / natural) : 0;
  stretch.stretched = stretched;
  stretch.taut = stretched && stretch.pull >= 0;
  stretch.tension = stretch.taut ? stretch.pull : 0;
}

/// Adds a span and the wrap on the place at which it begins.
/// @param arriving  direction of the previous span at that place, with its rate
/// @returns the direction at the place at which the span ends
template <int order>
CoordinateRate RopeSection::add_span(const LocalState& state, const RopeCourse& course, std::size_t s,
                                     const CoordinateRate& arriving, Stretch& stretch) const {
  const int i = course.places[s], j = course.places[s + 1];
  const NodeState &first = state.node(i), &second = state.node(j);
  const Pulley &from = course.pulleys[s], &to = course.pulleys[s + 1];
  const bool begins = s == 0, ends = s + 2 == course.places.size();
  check_way(state, i, j, std::abs(from.radius - to.radius));
  const SpanMeasures<order> span = measure_span<order>(first, second, from, to);
  const Vector12 v = pair_rate(first, second);
  const PairMeasureOf<order> e = span.length + from.radius * span.first_turn - to.radius * span.second_turn;
  stretch.E_rate += e.rate(v);
  Vector12 L_gradient = span.length.gradient;
  if (!begins) L_gradient += from.radius * span.first_turn.gradient;
  if (!ends) L_gradient -= to.radius * span.second_turn.gradient;
  for (const auto& [place, at] : {std::pair(i, 0), std::pair(j, 6)}) {
    stretch.E_gradient.segment<6>(6 * place) += e.gradient.template segment<6>(at);
    stretch.L_gradient.segment<6>(6 * place) += L_gradient.segment<6>(at);
    if constexpr (order == 2)
      for (const auto& [other, by] : {std::pair(i, 0), std::pair(j, 6)})
        stretch.E_second.block<6, 6>(6 * place, 6 * other) += e.second.template block<6, 6>(at, by);
  }
  stretch.L += span.length.value;
  const CoordinateRate leaving{span.first_turn.value, span.first_turn.rate(v)};
  const CoordinateRate there{span.second_turn.value, span.second_turn.rate(v)};
  const auto memory = state.memory();
  const auto end = [&](End which, const CoordinateRate& angle, const Vector12& gradient) {
    stretch.end_gradients[which].segment<6>(6 * i) = gradient.head<6>();
    stretch.end_gradients[which].segment<6>(6 * j) = gradient.tail<6>();
    const double before = memory[ends_memory + 2 * which], rate = memory[ends_memory + 2 * which + 1];
    stretch.ends[which] = {
        counted_angle({angle.value - drawn_ends_[which], angle.rate}, {before, rate}, memory[time_memory], state),
        angle.rate};
    return stretch.ends[which].value;
  };
  if (begins)
    stretch.E += from.radius * end(first_end, leaving, span.first_turn.gradient);
  else if (from.radius != 0)
    stretch.L += std::abs(from.radius) * count_wrap(state, i, from.radius, leaving, arriving, stretch);
  if (ends) stretch.E -= to.radius * end(last_end, there, span.second_turn.gradient);
  return there;
}

/// @throws ComputationError if there is no straight path
void RopeSection::check_way(const LocalState& state, int i, int j, double least) const {
  const auto point = [&](int k) -> Vector3 {
    const NodeState& node = state.node(k);
    return node.x + node.R * path_.pulleys[static_cast<std::size_t>(k)].on_node.x;
  };
  if ((point(j) - point(i)).squaredNorm() > least * least) return;
  const auto name_of = [&](int k) { return path_.names[static_cast<std::size_t>(k)]; };
  const auto is_point = [&](int k) { return path_.pulleys[static_cast<std::size_t>(k)].radius == 0; };
  throw ComputationError(fmt::format(
      "t = {:.6g} s: {} '{}' has no straight way from '{}' to '{}': {}", state.time(), type(), name(), name_of(i),
      name_of(j), is_point(i) || is_point(j) ? "the end has reached the rim of the pulley" : "the pulleys overlap"));
}

/// Returns the wrap of a touched place at this state, from the directions in which the rope arrives and leaves.
double RopeSection::count_wrap(const LocalState& state, int place, double radius, const CoordinateRate& leaving,
                               const CoordinateRate& arriving, Stretch& stretch) const {
  const auto k = static_cast<std::size_t>(place);
  const auto memory = state.memory();
  const double sense = radius > 0 ? 1 : -1, rate = sense * (leaving.rate - arriving.rate);
  double expected = stretch.places[k].wrap;
  if (const double passed = state.time() - memory[time_memory]; passed > 0)
    expected += 0.5 * (memory[memory_of(place) + 2] + rate) * passed;
  stretch.wrap_rates[k] = rate;
  stretch.places[k].wrap = unwrap_angle(sense * (leaving.value - arriving.value), expected);
  return stretch.places[k].wrap;
}

void RopeSection::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  thread_local Stretch stretch;
  calc_stretch(state, stretch);
  if (stretch.taut) r.head(stretch.E_gradient.size()) += stretch.tension * stretch.E_gradient;
}

// dT = EA/N (dE + tau dEdot) + T/N (dE - dL),   N = L - E
void RopeSection::calc_pull_gradient(const LocalState& state, const Stretch& stretch, MeasureGradient& gradient) const {
  const auto n = stretch.E_gradient.size();
  const double natural = stretch.natural, k = material_.EA / natural, by_rate = k * material_.damping;
  const double strain_slope = stretch.pull / natural;
  gradient.prepare(state.slots().size());
  auto position = gradient.position();
  position.head(n) = (k + strain_slope) * stretch.E_gradient - strain_slope * stretch.L_gradient;
  for_each_slip(state, [&](End end, const LocalState& slip, double sign) {
    position[slip_row(state.slots(), end)] += sign * (k + strain_slope);
    position[change_row(state, end)] += sign * by_rate * RopeSlip::rate(slip).by_change;
  });
  if (by_rate == 0) return;
  thread_local VectorX v;
  v.resize(state.slots().size());
  get_local_velocities(state, v);
  position.head(n).noalias() += by_rate * (stretch.E_second.transpose() * v.head(n));
  gradient.rate().head(n) = by_rate * stretch.E_gradient;
}

void RopeSection::add_natural_gradient(const LocalState& state, const Stretch& stretch, double factor,
                                       Eigen::Ref<VectorX> gradient) const {
  gradient.head(stretch.E_gradient.size()) += factor * (stretch.L_gradient - stretch.E_gradient);
  for_each_slip(state, [&](End end, const LocalState& /*slip*/, double sign) {
    gradient[slip_row(state.slots(), end)] -= factor * sign;
  });
}

void RopeSection::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  thread_local Stretch s;
  calc_stretch(state, s, 2);
  if (!s.taut) return;
  thread_local MeasureGradient pull;
  calc_pull_gradient(state, s, pull);
  const auto n = s.E_gradient.size();
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.topLeftCorner(n, n) += s.tension * s.E_second;
    K.topRows(n).noalias() += s.E_gradient * pull.position().transpose();
  }
  if (tangent.wants_C && material_.damping > 0)
    tangent.C.dense().topRows(n).noalias() += s.E_gradient * pull.rate().transpose();
}

void RopeSection::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  pattern.add_block(0, 0, slots.own_size(), slots.size());
}

void RopeSection::add_energy(const LocalState& state, Energy& energy) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  if (!s.stretched) return;
  VectorX v(state.slots().size());
  get_local_velocities(state, v);
  const double natural = s.natural, L_rate = s.L_gradient.dot(v.head(s.L_gradient.size()));
  const double strain = s.E / natural, elastic_tension = material_.EA * strain;
  energy.elastic += 0.5 * elastic_tension * s.E;
  // d/dt (EA E^2/(2 N)) = EA strain Edot - w Ndot
  energy.input -= s.strain_energy * (L_rate - s.E_rate);
  energy.dissipation += (s.tension - elastic_tension) * s.E_rate;
  for_each_slip(state, [&](End, const LocalState& slip, double sign) {
    energy.input += sign * s.tension * RopeSlip::rate(slip).value;
  });
}

// -- memory

void RopeSection::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  thread_local Stretch s;
  thread_local std::vector<Frame> at;
  calc_stretch(state, s);
  get_poses(state, at);
  for (const int place : watched_)
    if (RopePlace& each = s.places[static_cast<std::size_t>(place)]; !RopeCourses::touches(each))
      each.wrap = courses_.side(at, s.places, place);
  remember_places(s.places, memory);
  for (int k = 1; k < courses_.last(); ++k) memory[memory_of(k) + 2] = s.wrap_rates[static_cast<std::size_t>(k)];
  for (const End end : {first_end, last_end}) {
    memory[ends_memory + 2 * end] = s.ends[end].value;
    memory[ends_memory + 2 * end + 1] = s.ends[end].rate;
  }
  memory[time_memory] = state.time();
  memory[taut_memory] = s.stretched ? 1 : 0;
}

bool RopeSection::leaves_branch(const LocalState& state) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  if (s.stretched && s.E < 0) return true;
  if (watched_.empty()) return false;
  thread_local std::vector<Frame> at;
  get_poses(state, at);
  return std::any_of(watched_.begin(), watched_.end(), [&](int place) {
    const auto k = static_cast<std::size_t>(place);
    // The limit is beyond the event.
    if (RopeCourses::touches(s.places[k])) return s.places[k].wrap < -2 * just_touching;
    return courses_.clearance(at, s.places, place) < -2 * just_touching * std::abs(path_.pulleys[k].radius);
  });
}

void RopeSection::begin_branch(const LocalState& state, std::span<const int> crossed,
                               Eigen::Ref<VectorX> memory) const {
  thread_local Stretch s;
  get_places(state, s.places);
  if (!watched_.empty()) {
    thread_local std::vector<Frame> at;
    get_poses(state, at);
    for (const int k : crossed) {
      if (k == 0) continue;
      RopePlace& place = s.places[static_cast<std::size_t>(watched_[static_cast<std::size_t>((k - 1) / 2)])];
      const bool leaves = k % 2 == 1;
      if (leaves == RopeCourses::touches(place)) place = leaves ? RopePlace{0, place.sense} : RopePlace{place.wrap, 0};
    }
    courses_.settle(at, s.places);
    remember_places(s.places, memory);
  }
  calc_along(state, s);
  memory[taut_memory] = s.E > 0 || (s.E == 0 && s.E_rate >= 0) ? 1 : 0;
}

void RopeSection::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  thread_local Stretch s;
  thread_local std::vector<Frame> at;
  calc_stretch(state, s);
  if (!watched_.empty()) get_poses(state, at);
  values.setConstant(-1);  // default: no untouched place touches, and no touched place leaves
  values[0] = s.E;
  for (std::size_t w = 0; w < watched_.size(); ++w) {
    const auto k = static_cast<std::size_t>(watched_[w]);
    const auto leaves = 1 + 2 * static_cast<Eigen::Index>(w);
    const double radius = std::abs(path_.pulleys[k].radius);
    if (RopeCourses::touches(s.places[k]))
      values[leaves] = radius * (s.places[k].wrap + just_touching);
    else
      values[leaves + 1] = courses_.clearance(at, s.places, watched_[w]) + just_touching * radius;
  }
}

}  // namespace bielle::mechanism
