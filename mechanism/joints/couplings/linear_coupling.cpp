#include "mechanism/joints/couplings/linear_coupling.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_numbers.hpp"

namespace bielle::mechanism {

void LinearCoupling::add_term(const NamedCoordinate& coordinate, double factor) {
  terms_.push_back({coordinate.joint, coordinate.index, factor, references_.add(*coordinate.joint)});
}

void LinearCoupling::declare(Declaration& declaration) const {
  references_.declare(declaration);
  declaration.stiffness = true;
  // The row has the units of the coordinate whose factor is one, or of the last.
  const auto one = std::find_if(terms_.begin(), terms_.end(), [](const Term& t) { return std::abs(t.factor) == 1; });
  const Term& unit = one == terms_.end() ? terms_.back() : *one;
  declaration.multipliers.push_back({"ratio", unit.description().force_units()});
}

void LinearCoupling::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  thread_local CoordinateDerivatives jet;
  const double lambda = state.multiplier()[0];
  long double sum = 0;  // angles of many turns cancel in the sum
  for (const Term& term : terms_) {
    term.joint->calc_coordinate(term.coordinate, state.of(term.reference), jet);
    r.segment(state.slots().reference_row(term.reference), jet.g().size()) += (lambda * term.factor) * jet.g();
    sum += static_cast<long double>(term.factor) * jet.value;
  }
  r[0] += static_cast<double>(sum);
}

void LinearCoupling::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  thread_local CoordinateDerivatives jet;
  const double lambda = state.multiplier()[0];
  auto K = tangent.K.dense();
  for (const Term& term : terms_) {
    term.joint->calc_coordinate(term.coordinate, state.of(term.reference), jet);
    const int at = state.slots().reference_row(term.reference);
    const auto n = jet.g().size();
    K.block(at, at, n, n) += (lambda * term.factor) * jet.S();
    K.block(at, 0, n, 1) += term.factor * jet.g();
    K.block(0, at, 1, n) += term.factor * jet.g().transpose();
  }
}

void LinearCoupling::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                          Eigen::Ref<VectorX> acceleration) const {
  thread_local CoordinateDerivatives jet;
  for (const Term& term : terms_) {
    const LocalState of_joint = state.of(term.reference);
    term.joint->calc_coordinate(term.coordinate, of_joint, jet);
    const auto [first, second] = Joint::calc_coordinate_rates(of_joint, jet);
    velocity[0] += term.factor * first;
    acceleration[0] += term.factor * second;
  }
}

double LinearCoupling::turning_rate(const LocalState& state) const {
  double rate = 0;
  for (const Term& term : terms_) rate = std::max(rate, term.joint->turning_rate(state.of(term.reference)));
  return rate;
}

std::vector<OutputField> LinearCoupling::output_fields() const {
  std::string units, names;
  for (const Term& term : terms_) {
    const char* separator = units.empty() ? "" : ", ";
    units += fmt::format("{}{}", separator, term.description().force_units());
    names += fmt::format("{}{}.{}", separator, term.joint->name(), term.description().name);
  }
  return {{"force", {terms_.size()}, units, fmt::format("force or torque of the coupling on {}", names)}};
}

void LinearCoupling::write_output(const LocalState& state, double* values) const {
  for (std::size_t k = 0; k < terms_.size(); ++k) values[k] = -terms_[k].factor * state.reaction()[0];
}

void LinearCoupling::describe(const LocalState& /*state*/, Description& description) const {
  std::string sum;
  for (const Term& term : terms_)
    sum +=
        fmt::format("{}{:.10g} '{}'.{}", sum.empty() ? (term.factor < 0 ? "-" : "") : (term.factor < 0 ? " - " : " + "),
                    std::abs(term.factor), term.joint->name(), term.description().name);
  description.add(sum + " = 0");
}

// -- readers

namespace {

using Kind = JointCoordinate::Kind;

LinearCoupling& add_coupling(const char* type, const std::string& name, Model& model) {
  auto made = std::make_unique<LinearCoupling>(type, name);
  LinearCoupling& coupling = *made;
  model.add(std::move(made), Entry{Section::joints, name});
  return coupling;
}

YamlValue joints_of(const YamlValue& entry, std::size_t count, const char* expected) {
  YamlValue joints = entry.at("joints");
  if (!joints.is_sequence() || joints.size() != count) joints.fail(fmt::format("expected {}", expected));
  return joints;
}

/// Looks up the coordinates of a coupling after all joints have been read.
void connect_later(LinearCoupling& coupling, const YamlValue& joints, std::vector<double> factors,
                   std::vector<std::optional<Kind>> kinds, Model& model) {
  model.when_read(Model::Stage::connections, [&coupling, joints, factors, kinds, &model] {
    std::vector<NamedCoordinate> named;
    for (std::size_t k = 0; k < factors.size(); ++k) {
      const NamedCoordinate each = coordinate_named_by(joints.at(k), model, kinds[k]);
      for (const NamedCoordinate& before : named)
        if (before.joint == each.joint && before.index == each.index)
          joints.at(k).fail("is coupled with itself: name each coordinate once");
      named.push_back(each);
      coupling.add_term(each, factors[k]);
    }
  });
}

double other_than_zero(const YamlValue& value) {
  const double number = value.number();
  if (number == 0) value.fail("expected a number other than 0");
  return number;
}

/// Returns the ratio of the second wheel's rate to the first's.
double ratio_of_gear(const YamlValue& entry) {
  if (entry.has("ratio") == entry.has("teeth"))
    entry.fail("a gear takes `ratio` (rate of the second joint over that of the first), or `teeth`, or `factors`");
  if (entry.has("ratio")) {
    if (const auto internal = entry.find("internal"))
      internal->fail("is a key of `teeth`: the sign of `ratio` says it");
    return other_than_zero(entry.at("ratio"));
  }
  const Eigen::VectorXd teeth = read_numbers(entry.at("teeth"), 2, "[teeth of the first wheel, of the second]");
  return (entry.at("internal").boolean() ? 1 : -1) * teeth[0] / teeth[1];
}

}  // namespace

const KeyTable& gear_keys() {
  using namespace keys;
  static const KeyTable table{
      "a gear",
      "Coordinates of joints in a fixed ratio.",
      {type_key(),
       {"joints", list_of(coordinate_forms()).items_at_least(2), required,
        "Coordinates that are coupled: angles of two joints; with `factors` any coordinates."},
       {"ratio", number(), optional, "Rate of the second coordinate over that of the first, with its sign; not 0."},
       {"teeth", list_of(2, number().positive()), optional, "Numbers of teeth of two wheels, in place of `ratio`."},
       {"internal", boolean(), otherwise("false"), "Whether one of two wheels with `teeth` is a ring."},
       {"factors", list_of(number("any")).items_at_least(2), optional,
        "Factors of the coordinates, in place of `ratio`: the sum of factor times coordinate is zero."}}};
  return table;
}

const KeyTable& differential_keys() {
  using namespace keys;
  static const KeyTable table{
      "a differential",
      "Angles of an input shaft and of two others that share its motion.",
      {type_key(),
       {"joints", list_of(3, coordinate_forms()), required, "Angles of the input, the left and the right shaft."},
       {"ratio", number(), otherwise("1"), "Rate of the input over the mean of the other two; not 0."}}};
  return table;
}

const KeyTable& rack_and_pinion_keys() {
  using namespace keys;
  static const KeyTable table{
      "a rack and pinion",
      "A displacement that is a radius times an angle.",
      {type_key(),
       {"joints", list_of(2, coordinate_forms()), required, "Angle of the pinion and displacement of the rack."},
       {"radius", number("m"), required, "Displacement of the rack over the angle of the pinion; not 0."}}};
  return table;
}

void read_gear(const std::string& name, const YamlValue& entry, Model& model) {
  LinearCoupling& coupling = add_coupling("gear", name, model);
  if (const auto given = entry.find("factors")) {
    for (const char* other : {"ratio", "teeth", "internal"})
      if (const auto too_much = entry.find(other)) too_much->fail("a gear has either `factors` or a ratio");
    const std::vector<YamlValue> items = given->items();
    if (items.size() < 2) given->fail("expected the factors of two or more coordinates, in the order of `joints`");
    std::vector<double> factors;
    for (const YamlValue& item : items) factors.push_back(other_than_zero(item));
    const YamlValue joints = joints_of(entry, items.size(), "as many coordinates of joints as `factors`");
    connect_later(coupling, joints, factors, std::vector<std::optional<Kind>>(items.size()), model);
    return;
  }
  const double ratio = ratio_of_gear(entry);
  connect_later(coupling, joints_of(entry, 2, "two joints (for more, give `factors`)"), {-ratio, 1},
                {Kind::angle, Kind::angle}, model);
}

void read_differential(const std::string& name, const YamlValue& entry, Model& model) {
  const double ratio = other_than_zero(entry.at("ratio"));
  connect_later(add_coupling("differential", name, model), joints_of(entry, 3, "three joints: [input, left, right]"),
                {1, -ratio / 2, -ratio / 2}, {Kind::angle, Kind::angle, Kind::angle}, model);
}

void read_rack_and_pinion(const std::string& name, const YamlValue& entry, Model& model) {
  const double radius = other_than_zero(entry.at("radius"));
  const YamlValue joints = joints_of(entry, 2, "two joints: [pinion, rack]");
  connect_later(add_coupling("rack_and_pinion", name, model), joints, {-radius, 1}, {Kind::angle, Kind::displacement},
                model);
  model.when_read(Model::Stage::connections, [name, joints, radius, &model] {
    const JointFrames& pinion = coordinate_named_by(joints.at(0), model, Kind::angle).joint->frames();
    model.add_shape({Section::joints, name}, {.shape = "gear",
                                              .places = {{pinion.second, pinion.on_second}},
                                              .values = {{"radius", std::abs(radius)}, {"inner", false}}});
  });
}

}  // namespace bielle::mechanism
