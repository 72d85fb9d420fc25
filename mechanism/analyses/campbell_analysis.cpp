#include "mechanism/analyses/campbell_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/campbell_arrays.hpp"
#include "mechanism/analyses/rotation_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/session/interrupted.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

std::vector<Key> range_keys(const char* unit) {
  using namespace keys;
  return {{"from", number(unit), otherwise("0"), "The first value."},
          {"to", number(unit), required, "The last value, greater than `from`."},
          {"count", integer().at_least(2), otherwise("41"), "Number of equidistant values."}};
}

const KeyTable& rates_keys() {
  static const KeyTable table{"`speeds`", "A range of rates of the rotation.", range_keys("rad/s")};
  return table;
}

const KeyTable& values_keys() {
  static const KeyTable table{"`speeds`", "A range of values of the parameter.", range_keys("any")};
  return table;
}

Key swept_rate_key() {
  using namespace keys;
  return {"rate", number("rad/s"), computed("the parameter, or the `speeds` themselves"),
          "Angular velocity about the axis, or rate of the joint's angle: a formula of the parameters."};
}

const KeyTable& swept_joint_keys() {
  static const KeyTable table{"`rotation` of a sweep behind a joint",
                              "Steady rotation of the part behind a joint at each value; the rest stands still.",
                              {turning_joint_key(), swept_rate_key(), turning_state_key()}};
  return table;
}

const KeyTable& swept_rotation_keys() {
  using namespace keys;
  static const KeyTable table{
      "`rotation` of a sweep",
      "Steady rotation of all free parts about an axis, into which the mechanism is brought at each value.",
      {{"axis", direction().as_axial().in_inertial_axes(), required, "Direction of the axis, in inertial components."},
       {"position", vector3("m").as_point().in_inertial_axes(), otherwise("[0, 0, 0]"), "A point of the axis."},
       swept_rate_key()},
      {{"joint", "", swept_joint_keys}}};
  return table;
}

/// Returns the keys of a sweep, with or without a parameter.
std::vector<Key> sweep_keys(const char* unit, const KeyTable& (*range)()) {
  using namespace keys;
  return {analysis_type_key("campbell"),
          {"parameter", name_of("parameter"), optional,
           "Parameter of the model that the `speeds` are values of; without it they are rates of the `rotation`."},
          {"rotation", nested(swept_rotation_keys), optional,
           "Steady rotation of everything free, or of the part behind a joint, at each value."},
          {"speeds",
           {list_of(number(unit)).items_at_least(2), nested(range)},
           required,
           "Values of the parameter or of the rate of the rotation, ascending, as a list or a range."},
          {"modes", integer().at_least(1), otherwise("8"),
           "Number of modes that are tracked: the slowest that oscillate at the first value."},
          {"orders", list_of(number().positive()), otherwise("[1]"), "Multiples of the speed, for critical speeds."},
          {"node", name_of("node"), computed("the node that turns fastest"),
           "Node whose angular velocity about the axis is the speed."}};
}

const KeyTable& parameter_sweep_keys() {
  static const KeyTable table{"the analysis 'campbell'", "Modes over the values of a parameter, and critical speeds.",
                              sweep_keys("any", values_keys)};
  return table;
}

/// Reads `{from: 0, to: 300, count: 61}`, or a list.
std::vector<double> read_speeds(const YamlValue& entry) {
  std::vector<double> values;
  if (entry.is_sequence()) {
    for (const YamlValue& item : entry.items()) {
      if (!values.empty() && item.number() <= values.back()) item.fail("expected more than the value before it");
      values.push_back(item.number());
    }
    if (values.size() < 2) entry.fail("expected at least two values");
    return values;
  }
  const double from = entry.at("from").number(), to = entry.at("to").number();
  if (to <= from) entry.at("to").fail("expected more than `from`");
  const int count = entry.at("count").integer();
  for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * k / (count - 1));
  return values;
}

std::string read_swept_parameter(const YamlValue& entry, const Model& model) {
  const std::string name = entry.text();
  std::vector<std::string> names;
  for (const auto& [known, value] : model.parameters) names.push_back(known);
  if (std::find(names.begin(), names.end(), name) == names.end())
    entry.fail(fmt::format("the model has no parameter '{}'{}", name, did_you_mean(name, names)));
  return name;
}

/// Reads `{axis: [0, 0, 1], position: [0, 0, 0], rate: "rpm*pi/30"}`.
void read_swept_rotation(const YamlValue& entry, const Model& model, CampbellOptions& options) {
  options.rotation = true;
  if (const auto joint = entry.find("joint")) {
    options.joint = read_turning_joint(*joint, model);
    options.mean = read_mean(entry);
  } else {
    options.axis = Vector3(entry.at("axis").direction());
    options.through = entry.at("position").vector3();
  }
  const auto rate = entry.find("rate");
  if (!rate) return;
  if (options.parameter.empty())
    rate->fail("the rates are the `speeds`: give a formula where a `parameter` is swept that is no speed in rad/s");
  rate->number();  // refuses a text that is no formula of the parameters
  options.rate = rate->formula_text({}, {}).replaced;
}

std::string format_frequency(const TrackedMode& mode) {
  return mode.found ? fmt::format("{:.6g}", std::abs(mode.s.imag()) / (2 * std::numbers::pi)) : "lost";
}

std::string format_mode_lines(const SweptModes& swept, const std::vector<std::string>& names) {
  const SweepPoint &first = swept.points.front(), &last = swept.points.back();
  std::string text = fmt::format("  {:>4}  {:>12}  {:>12}  {:>11}  {:13}  {}\n", "mode", "first [Hz]", "last [Hz]",
                                 "damping", "whirl at last", "name");
  for (std::size_t k = 0; k < first.tracks.size(); ++k) {
    const TrackedMode& mode = last.tracks[k];
    const double ratio = mode.found ? -mode.s.real() / std::abs(mode.s) : NAN;
    const double rounding = mode.found ? std::max(1e-10, mode.uncertainty / std::abs(mode.s)) : 0;
    text += fmt::format("  {:>4}  {:>12}  {:>12}  {:>11.4g}  {:13}  {}\n", k + 1, format_frequency(first.tracks[k]),
                        format_frequency(mode), std::abs(ratio) < rounding ? 0 : ratio,
                        mode.found ? whirl_name(mode.whirl) : "", names[k]);
  }
  return text;
}

}  // namespace

std::string CampbellAnalysis::at(double value, double speed) const {
  return options_.parameter.empty() ? fmt::format("{:.6g} rad/s", speed)
                                    : fmt::format("{} = {:.6g} ({:.6g} rad/s)", options_.parameter, value, speed);
}

std::string CampbellAnalysis::format(const Campbell& found) const {
  const SweptModes& swept = found.swept;
  std::string text = format_setting(found, "modes");
  if (!found.turning && found.steadiness && found.unsteady.empty() && found.axes == ModeAxes::turning)
    text += "  frequencies and senses of whirl are those seen from what turns\n";
  if (!found.unsteady.empty())
    text += fmt::format(
        "  the motion is not steady at {} of the values, the first {:.6g}: critical speeds are not sought (`rotation: "
        "{{joint: ..}}` brings what is behind a joint into steady rotation, with its centrifugal forces)\n",
        found.unsteady.size(), *std::min_element(found.unsteady.begin(), found.unsteady.end()));
  if (swept.points.front().tracks.empty())
    return text + "  nothing oscillates at the first value: there is nothing to track\n";
  text += format_mode_lines(swept, found.names);
  for (const CriticalSpeed& each : swept.critical)
    text += fmt::format("  critical at {}: mode {}, {:.6g} Hz = {:g} x speed{}{}\n", at(each.value, each.speed),
                        each.mode + 1, each.frequency, each.order, std::isnan(each.whirl) ? "" : ", ",
                        whirl_name(each.whirl));
  if (swept.critical.empty() && found.unsteady.empty()) text += "  no critical speeds\n";
  for (const ModeMeeting& each : swept.meetings)
    text += each.veering ? fmt::format(
                               "  modes {} and {} veer around {}, {:.6g} Hz: they come within {:.3g} Hz, turn away and "
                               "exchange their shapes\n",
                               each.first + 1, each.second + 1, at(each.value, each.speed), each.frequency, each.gap)
                         : fmt::format("  modes {} and {} cross at {}, {:.6g} Hz\n", each.first + 1, each.second + 1,
                                       at(each.value, each.speed), each.frequency);
  for (std::size_t k = 0; k < swept.points.front().tracks.size(); ++k) {
    for (const SweepPoint& point : swept.points) {
      const TrackedMode& mode = point.tracks[k];
      if (!mode.found || !mode.grows) continue;
      text += fmt::format("  UNSTABLE: mode {} grows at {}, the first value of the sweep at which it does\n", k + 1,
                          at(point.value, point.speed));
      break;
    }
  }
  for (const UncertainTrack& each : swept.uncertain)
    text += each.lost
                ? fmt::format(
                      "  mode {} was lost between {:.9g} and {:.9g}: nothing that oscillates there has its "
                      "shape (it no longer oscillates, or changes within less than that)\n",
                      each.mode + 1, each.from, each.to)
                : fmt::format(
                      "  mode {} is tracked with little certainty between {:.9g} and {:.9g}: {:.0f} % of its shape "
                      "goes on\n",
                      each.mode + 1, each.from, each.to, 100 * each.correlation);
  return text;
}

const KeyTable& campbell_keys() {
  static const KeyTable table{"the analysis 'campbell'",
                              "Modes over the speed of a rotor, each followed by its shape, and critical speeds.",
                              sweep_keys("rad/s", rates_keys),
                              {{"parameter", "", parameter_sweep_keys}}};
  return table;
}

std::unique_ptr<Analysis> read_campbell(const YamlValue& entry, const Model& model) {
  CampbellOptions options;
  if (const auto parameter = entry.find("parameter")) options.parameter = read_swept_parameter(*parameter, model);
  if (const auto rotation = entry.find("rotation")) read_swept_rotation(*rotation, model, options);
  if (options.parameter.empty() && !options.rotation)
    entry.fail(
        "expected the `parameter` whose values are swept, or a `rotation` about an axis in which everything free "
        "turns");
  options.values = read_speeds(entry.at("speeds"));
  options.modes = entry.at("modes").integer();
  options.orders.clear();
  for (const YamlValue& item : entry.at("orders").items()) options.orders.push_back(item.number());
  if (const auto node = entry.find("node")) {
    if (!options.joint.empty())
      node->fail("the speed is the rate of the joint that `rotation` names: leave `node` out");
    options.node = node_named_by(*node, model);
  }
  return std::make_unique<CampbellAnalysis>(std::move(options));
}

void CampbellAnalysis::solve(Session& session, AnalysisSummary& summary) const {
  const Campbell found = compute_campbell(session, options_);
  const SweptModes& swept = found.swept;
  const auto given =
      std::count_if(swept.points.begin(), swept.points.end(), [](const SweepPoint& point) { return point.given; });
  const bool empty = swept.points.empty() || swept.points.front().tracks.empty();
  if (!empty) write_campbell(session, found, options_.parameter);
  if (found.interrupted)
    throw Interrupted(fmt::format("interrupted after {} of {} {}{}", given, options_.values.size(),
                                  options_.parameter.empty() ? "speeds" : "values",
                                  empty ? "" : "; the results file holds these, and nothing of the others"));
  for (const CriticalSpeed& each : swept.critical) {
    summary.numbers["critical_speed"].push_back(each.speed);
    summary.numbers["critical_frequency"].push_back(each.frequency);
    summary.numbers["critical_mode"].push_back(each.mode + 1);
    summary.numbers["critical_order"].push_back(each.order);
  }
  summary.text =
      fmt::format("campbell, {} from {} to {}, {} ({} computed)\n", counted(swept.points.front().tracks.size(), "mode"),
                  at(swept.points.front().value, swept.points.front().speed),
                  at(swept.points.back().value, swept.points.back().speed), counted(given, "value"), swept.solved);
  summary.text += format(found);
  summary.text += found.gathered;
}

}  // namespace bielle::mechanism
