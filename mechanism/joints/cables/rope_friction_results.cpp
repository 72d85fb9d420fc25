// Results of a rope's friction on a pulley: recorded quantities, description and measures.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/cables/rope_friction.hpp"
#include "mechanism/measures/nested.hpp"
#include "mechanism/measures/own_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

std::vector<OutputField> RopeFriction::output_fields() const {
  const std::vector<std::size_t> shape{count_};
  std::vector<OutputField> fields = {
      {"slip", shape, "m", "rope that has slid over each pulley with friction, in the direction of the rope"},
      {"slip_velocity", shape, "m/s", "rate of the slip"},
      {"slips", shape, "-", "1 for pulleys on which the rope slips, else 0"},
      {"friction", shape, "N", "tension after each pulley with friction less that before it"},
      {"friction_limit", shape, "N", "largest friction at the smaller of the two tensions"},
      {"wrap", shape, "rad", "angle by which the rope is wound on each pulley with friction"}};
  for (OutputField& field : fields) field.summed = true;  // each pulley writes its own value
  return fields;
}

void RopeFriction::write_output(const LocalState& state, double* values) const {
  std::fill(values, values + 6 * count_, 0.0);
  const LocalState slip = slip_of(state);
  const Sides& sides = calc_sides(state);
  const double before = sides.stretch[0].tension, after = sides.stretch[1].tension, rate = RopeSlip::rate(slip).value;
  const double lower = std::min(before, after);
  double* value = values + number_;
  for (const double each : {RopeSlip::slip(slip), rate, rate != 0 ? 1.0 : 0.0, after - before,
                            lower > 0 ? lower * std::expm1(coefficient_ * sides.wrap) : 0.0, sides.wrap}) {
    *value = each;
    value += count_;
  }
}

void RopeFriction::describe(const LocalState& state, Description& description) const {
  const Sides& sides = calc_sides(state);
  description.add(
      fmt::format("friction {:.6g} on '{}', wrap {:.6g} rad: slips if one tension is {:.6g} times the other",
                  coefficient_, wrap_.pulley(), sides.wrap, 1 / sides.reduction));
}

void RopeFriction::hold(const LocalState& state, std::vector<char>& held) const {
  held[static_cast<std::size_t>(slip_of(state).slots().first_order_begin)] = 1;
}

std::string RopeFriction::describe_overload(const LocalState& state) const {
  const Sides& sides = calc_sides(state);
  if (excess(sides, 0) <= 0 && excess(sides, 1) <= 0) return {};
  const double before = sides.stretch[0].tension, after = sides.stretch[1].tension;
  return fmt::format(
      "slips on pulley '{}': if it stuck there, its tensions would be {:.4g} N before and {:.4g} N after it, but "
      "friction {:.4g} with a wrap of {:.4g} rad holds only {:.4g} times the smaller one: give it more friction, more "
      "turns, or a smaller difference of loads, or compute the slip by a dynamic analysis",
      wrap_.pulley(), before, after, coefficient_, sides.wrap, 1 / sides.reduction);
}

namespace {

class RopeFrictionMeasure final : public OwnMeasure {
 public:
  using Calc = double (RopeFriction::*)(const LocalState&, MeasureGradient&) const;
  RopeFrictionMeasure(std::string name, const RopeFriction& friction, std::string units, Calc quantity)
      : OwnMeasure(std::move(name), friction), friction_(friction), units_(std::move(units)), calc_(quantity) {}
  std::string units() const override { return units_; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    return (friction_.*calc_)(own, gradient);
  }
  const RopeFriction& friction_;
  std::string units_;
  Calc calc_;
};

struct NamedMeasure {
  const char* name;
  const char* units;
  RopeFrictionMeasure::Calc calc;
};
constexpr NamedMeasure friction_measures[] = {{"slip", "m", &RopeFriction::calc_slip},
                                              {"slip.rate", "m/s", &RopeFriction::calc_slip_rate},
                                              {"friction", "N", &RopeFriction::calc_friction},
                                              {"wrap", "rad", &RopeFriction::calc_wrap}};

}  // namespace

std::vector<std::string> RopeFriction::measure_names() const {
  std::vector<std::string> names;
  for (const NamedMeasure& each : friction_measures) names.push_back(fmt::format("{}.{}", wrap_.pulley(), each.name));
  return names;
}

std::unique_ptr<Measure> RopeFriction::make_measure(const std::string& name, const std::string& measure) const {
  const auto is_named = [&](const NamedMeasure& each) {
    return measure == fmt::format("{}.{}", wrap_.pulley(), each.name);
  };
  const NamedMeasure& found = *std::find_if(std::begin(friction_measures), std::end(friction_measures), is_named);
  return std::make_unique<RopeFrictionMeasure>(name, *this, found.units, found.calc);
}

}  // namespace bielle::mechanism
