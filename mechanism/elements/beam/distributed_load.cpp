#include "mechanism/elements/beam/distributed_load.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mechanism/math/gauss.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::size_t along_beam = 0, in_time = 1;  // argument numbers of the formulas

Vector3 evaluate(const FormulaVector& vector, double s, double t) {
  const std::array<double, 2> values{s, t};
  return {vector[0](values), vector[1](values), vector[2](values)};
}

/// Returns positions inside an element, 0 < z < 1, at which a formula of s jumps or has a kink, with 0 and 1.
std::vector<double> pieces(const LineLoad& load, double s_A, double s_B) {
  std::vector<double> ends{0, 1};
  std::vector<double> places;
  for (const FormulaVector* vector : {&load.force, &load.moment}) add_break_points(*vector, along_beam, places);
  for (const double s : places) {
    const double z = (s - s_A) / (s_B - s_A);
    if (z > 1e-9 && z < 1 - 1e-9) ends.push_back(z);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

/// Integrates a formula, or its magnitude, over the beam, by three Gauss points in each of `parts` equal parts of the
/// pieces between kinks of each element.
template <class Value>
double integral(const std::vector<double>& ends, int parts, const Value& value) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    for (int part = 0; part < parts; ++part)
      for (std::size_t g = 0; g < 3; ++g) {
        const double length = (ends[k + 1] - ends[k]) / parts;
        sum += length * Gauss3::weight[g] * value(ends[k] + length * (part + Gauss3::place[g]));
      }
  return sum;
}

}  // namespace

DistributedLoad::DistributedLoad(std::string name, const BeamSpan& span, LineLoad load)
    : SpanLoad(std::move(name), span, pieces(load, span.s_A, span.s_B)), load_(std::move(load)) {}

void DistributedLoad::declare(Declaration& declaration) const {
  declaration.nodes = {span().node_a, span().node_b};
  declaration.stiffness = true;
}

DistributedLoad::Given DistributedLoad::given(const LocalState& state, const SpanPoint& point) const {
  const double s = point.along(span()), factor = state.environment().load_factor;
  return {factor * evaluate(load_.force, s, state.time()), factor * evaluate(load_.moment, s, state.time())};
}

SpanForce DistributedLoad::on_line(const Given& given, const SpanSection& at) const {
  SpanForce force;
  force.f = load_.follower ? Vector3(at.S * given.F) : given.F;
  force.n =
      (load_.follower ? given.M : Vector3(at.S.transpose() * given.M)) + load_.at.cross(at.S.transpose() * force.f);
  return force;
}

SpanForce DistributedLoad::load(const LocalState& state, const SpanPoint& point, const SpanSection& at) const {
  return on_line(given(state, point), at);
}

/// df = -S F~ dTheta(z) for followers, else 0;  dn = ((S^T M)~ + c~ (S^T F)~) dTheta(z) for dead loads, else 0.
void DistributedLoad::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  for (const SpanPoint& point : points()) {
    const SpanSection at = span_section(span(), point, state);
    const Given here = given(state, point);
    Matrix3 f_turn = Matrix3::Zero(), n_turn = Matrix3::Zero();
    if (load_.follower)
      f_turn = -at.S * skew(here.F);
    else
      n_turn = skew(at.S.transpose() * here.M) + skew(load_.at) * skew(at.S.transpose() * here.F);
    add_span_tangent(span(), point, at, on_line(here, at), f_turn, n_turn, state, tangent.K.dense());
  }
}

void DistributedLoad::add_break_points(std::vector<double>& times) const {
  for (const FormulaVector* vector : {&load_.force, &load_.moment})
    mechanism::add_break_points(*vector, in_time, times);
}

std::vector<TimeDependent::Formula> DistributedLoad::time_formulas() const {
  std::vector<Formula> formulas;
  for (std::size_t k = 0; k < 6; ++k) {
    const Expression& component = (k < 3 ? load_.force : load_.moment)[k % 3];
    if (!component.uses(in_time)) continue;
    formulas.push_back(
        {fmt::format("{} per length {}", k < 3 ? "force" : "moment", "xyz"[k % 3]), k < 3 ? "N/m" : "N"});
  }
  return formulas;
}

void DistributedLoad::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  const std::array<double, 2> at{0.5 * (span().s_A + span().s_B), state.time()};
  std::size_t next = 0;
  for (const FormulaVector* vector : {&load_.force, &load_.moment})
    for (const Expression& component : *vector)
      if (component.uses(in_time)) values[next++] = component(at);
}

void DistributedLoad::describe(const LocalState& /*state*/, Description& description) const {
  if (span().s_A > 0) return;  // equal on all elements
  std::string text;
  if (load_.has_force) text += fmt::format("force {} N/m", format_vector(load_.force));
  if (load_.has_force && !load_.at.isZero(0))
    text += fmt::format(" at y {:.6g} m, z {:.6g} m of the section", load_.at.y(), load_.at.z());
  if (load_.has_moment) text += fmt::format("{}moment {} N m/m", text.empty() ? "" : ", ", format_vector(load_.moment));
  description.add_line(
      fmt::format("load per length: {}, {}", text, load_.follower ? "turning with the section" : "fixed in space"));
}

std::vector<OutputField> DistributedLoad::output_fields() const {
  constexpr bool summed = true;
  return {{"distributed_force", {3}, "N", "sum of the loads per length, inertial components", summed},
          {"distributed_moment", {3}, "N m", "their moment about the inertial origin, inertial components", summed}};
}

void DistributedLoad::write_output(const LocalState& state, double* values) const {
  Vector3 F = Vector3::Zero(), m = Vector3::Zero();
  for (const SpanPoint& point : points()) {
    const SpanSection at = span_section(span(), point, state);
    const SpanForce here = load(state, point, at);
    F += point.w * here.f;
    m += point.w * (span_position(point, state).cross(here.f) + at.S * here.n);
  }
  Eigen::Map<Vector6>(values) << F, m;
}

namespace {

FormulaVector vector_along(const YamlValue& value) {
  return read_formula_vector(value,
                             "three components per length, numbers or expressions of s (0 to 1 along the beam) and t");
}

LineLoad read_line_load(const YamlValue& value) {
  const auto force = value.find("force"), moment = value.find("moment"), at = value.find("at");
  if (!force && !moment) value.fail("a distributed load needs `force` or `moment`, per length");
  LineLoad load;
  load.has_force = force.has_value();
  load.has_moment = moment.has_value();
  if (force) load.force = vector_along(*force);
  if (moment) load.moment = vector_along(*moment);
  if (at) {
    if (!force) at->fail("`at` is the point of the section where a `force` acts, and there is none");
    const Vector2 point = read_numbers(*at, 2, "the point [y, z] of the section, from the node line");
    load.at = {0, point[0], point[1]};
  }
  load.follower = value.at("follower").boolean();
  return load;
}

/// Rejects a formula that the points of the elements do not integrate: a part of it would be lost without a message.
void check_integrals(const YamlValue& value, const LineLoad& load, const Expression& formula, int elements) {
  if (formula.is_constant()) return;
  std::vector<double> times = formula.break_points(in_time);
  times.push_back(0);
  times.push_back(1);
  for (const double t : times) {
    const auto value_at = [&](double s) { return formula(std::array<double, 2>{s, t}); };
    double coarse = 0, fine = 0, size = 0;
    try {
      for (int k = 0; k < elements; ++k) {
        const double s_A = static_cast<double>(k) / elements, s_B = static_cast<double>(k + 1) / elements;
        std::vector<double> ends = pieces(load, s_A, s_B);
        for (double& z : ends) z = s_A + z * (s_B - s_A);
        constexpr int many = 32;
        coarse += integral(ends, 1, value_at);
        fine += integral(ends, many, value_at);
        size += integral(ends, many, [&](double s) { return std::abs(value_at(s)); });
      }
    } catch (const ComputationError& error) {
      value.fail(error.what());
    }
    constexpr double allowed = 1e-2;
    if (std::abs(coarse - fine) > allowed * size)
      value.fail(
          fmt::format("with {} the beam gets {:.4g} of the load's integral, which is {:.4g} (at t = {:.4g} s): write "
                      "jumps as comparisons of `s` with numbers, or give more elements",
                      counted(elements, "element"), coarse, fine, t));
  }
}

}  // namespace

const KeyTable& line_load_keys() {
  using namespace keys;
  static const KeyTable table{
      "a distributed load",
      "A force and a moment per length of a beam, as formulas of s, from 0 at its start to 1 at its end, and the time "
      "t.",
      {{"force", list_of(3, formula("N/m", {"s", "t"})).as_vector().in_inertial_axes(), optional,
        "Components of the force per length."},
       {"moment", list_of(3, formula("N m/m", {"s", "t"})).as_axial().in_inertial_axes(), optional,
        "Components of the moment per length."},
       {"at", list_of(2, number("m")), otherwise("[0, 0]"),
        "Point of the section at which the force acts, from the node line along y and z."},
       {"follower", boolean(), otherwise("false"),
        "Whether the components are along the axes of the section and turn with it; otherwise they are inertial."}}};
  return table;
}

std::vector<LineLoad> read_line_loads(const YamlValue& value, int elements) {
  const std::vector<YamlValue> items = value.is_sequence() ? value.items() : std::vector<YamlValue>{value};
  if (items.empty()) value.fail("expected at least one load");
  std::vector<LineLoad> loads;
  for (const YamlValue& item : items) {
    loads.push_back(read_line_load(item));
    const LineLoad& load = loads.back();
    for (std::size_t k = 0; k < 3; ++k) {
      if (item.has("force")) check_integrals(item.at("force").at(k), load, load.force[k], elements);
      if (item.has("moment")) check_integrals(item.at("moment").at(k), load, load.moment[k], elements);
    }
  }
  return loads;
}

}  // namespace bielle::mechanism
