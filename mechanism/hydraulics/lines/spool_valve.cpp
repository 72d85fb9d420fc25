#include "mechanism/hydraulics/lines/spool_valve.hpp"

#include <fmt/format.h>

#include "mechanism/hydraulics/lines/opening.hpp"
#include "mechanism/measures/nested.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void SpoolValve::add_edge(const std::string& name, int from, int to, double direction, double area) {
  edges_.push_back({name, from, to, direction, area});
  add_path(from, to, name);
}

SpoolValve::SpoolValve(std::string name, const PressureNode& from, const PressureNode& to, const OrificeLaw& law,
                       double area, double overlap)
    : Line("valve", std::move(name)), law_(law), overlap_(overlap), spool_(0) {
  const int a = add_port(from), b = add_port(to);
  add_edge("", a, b, 1, area);
}

SpoolValve::SpoolValve(std::string name, const std::array<const PressureNode*, 4>& places, const OrificeLaw& law,
                       const std::array<double, 4>& areas, double overlap)
    : Line("servo_valve", std::move(name)), law_(law), overlap_(overlap), spool_(-1) {
  const int P = add_port(*places[0]), T = add_port(*places[1]), A = add_port(*places[2]);
  add_edge("P to A", P, A, 1, areas[0]);
  if (places[3]) {
    const int B = add_port(*places[3]);
    add_edge("B to T", B, T, 1, areas[1]);
    add_edge("P to B", P, B, -1, areas[2]);
  }
  add_edge("A to T", A, T, -1, areas[3]);
}

void SpoolValve::declare(Declaration& declaration) const {
  Line::declare(declaration);
  spool_.declare(declaration);
}

void SpoolValve::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  Line::add_residual(state, r);
  spool_.add_residual(state, r);
}

void SpoolValve::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  Line::add_tangent(state, tangent);
  spool_.add_tangent(state, tangent);
}

void SpoolValve::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  Line::add_pattern(slots, pattern);
  spool_.add_pattern(slots, pattern);
}

void SpoolValve::calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const {
  const Edge& edge = edges_[path];
  Nested<MeasureGradient> of_opening;
  of_opening->prepare(state.slots().size());
  const double y = edge.direction * spool_.opening(state, *of_opening), range = 1 - overlap_;
  Opening open = edge_opening((y - overlap_) / range, smoothing);
  // The opening is limited to full opening, beyond which a spool may oscillate.
  const Opening beyond = edge_opening((y - overlap_) / range - 1, smoothing);
  open = {open.value - beyond.value, open.slope - beyond.slope};
  if (open.value == 0) return;
  const double D = ports().pressure(state, edge.from) - ports().pressure(state, edge.to);
  const OrificeLaw::Flow law = law_.calc(edge.area * open.value, D);
  flow.Q = law.Q;
  add_by_pressure(state, edge.from, law.Q_D, flow);
  add_by_pressure(state, edge.to, -law.Q_D, flow);
  const double by_opening = law.Q_A * edge.area * open.slope * edge.direction / range;
  flow.by.position() += by_opening * of_opening->position();
  flow.by.rate() += by_opening * of_opening->rate();
}

void SpoolValve::add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const {
  spool_.add_start_values(state, change);
}

void SpoolValve::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  spool_.check(state, name());
  memory[OpeningLock::begun] = 1;
}

void SpoolValve::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                              Eigen::Ref<VectorX> memory) const {
  OpeningLock::follow(spool_.speed(state), memory);
}

void SpoolValve::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  calc_time_formula(spool_.command_formula(), state, values);
  if (OpeningLock::is_locked(state)) values[0] = 0;  // a locked valve does not follow its command
}

std::vector<OutputField> SpoolValve::own_fields() const { return {{"opening", {}, "-", "share of the full opening"}}; }

double SpoolValve::calc_own_measure(const LocalState& state, const std::string& /*measure*/,
                                    MeasureGradient& gradient) const {
  return spool_.opening(state, gradient);
}

std::string SpoolValve::describe_law() const { return spool_.describe() + ", " + law_.describe(); }

void SpoolValve::describe(const LocalState& state, Description& description) const {
  Line::describe(state, description);
  for (const Edge& edge : edges_)
    description.add_line(
        fmt::format("{}{:.6g} m^2 at full opening", edge.name.empty() ? "" : edge.name + ": ", edge.area));
  if (overlap_ != 0) description.add(fmt::format("overlap {:.6g}", overlap_));
}

}  // namespace bielle::mechanism
