// Samples of states: users' differential equations and control blocks.
#include "tests/laws/sample.hpp"

namespace bielle::laws {
namespace {

using mechanism::Section;

/// Returns a hinge between two nodes turned against each other, and states.
std::string states(const std::string& text) {
  return R"yaml(
nodes:
  a: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}
  b: {position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}
joints:
  axle: {type: hinge, nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3]}
states:
)yaml" + text;
}

Sample rate() {
  return {Section::states,
          "state",
          "rate",
          states("  it: {rate: \"-(it - axle.angle)*(1 + t)/0.3 + 0.2*other*axle.angle.rate\", start: 0.2, units: rad, "
                 "scale: 2}\n"
                 "  other: {rate: \"it - other^2 + 0.1*axle.reaction.x\", start: 0.7}\n"),
          {{"rate", "'x*t'", "x"},
           {"rate", "axle.angel", "did you mean 'angle'"},
           {"rate", "", "needs a `rate`"},
           {"start", "much", ""},
           {"units", "[rad, m]", "one for each output"}}};
}

/// Returns the measures of a gear mesh.
Sample gear_measures(const std::string& variant, const std::string& mesh, const std::string& more) {
  Sample sample{
      Section::states,
      "state",
      "measures of " + variant,
      R"yaml(
nodes:
  a: {position: [0, 0, 0], rotation_vector: [-0.7, 0.2, 0.4]}
  b: {position: [0.6, 0.8, 0], rotation_vector: [0.1, 0.9, 0.4]}
joints:
  teeth: {type: gear_mesh, nodes: [a, b], axes: [0, 0, 1], radii: [0.4, 0.6], errors: 0.1*sin(3*phi))yaml" +
          mesh +
          "}\nstates:\n  it: {rate: \"teeth.transmission_error + 0.1*teeth.force^2 + 0.2*teeth.angle_1*teeth.angle_2" +
          more + " - it\"}\n",
      {{"rate", "teeth.froce", "did you mean 'force'"}}};
  sample.scales.kinks_unloaded = true;  // teeth push to either side
  sample.scales.smooth_within = 0.1;
  return sample;
}

Sample filter(const std::string& variant, const std::string& keys, std::vector<BadValue> bad) {
  bad.push_back({"filter", "axle.angel", "did you mean 'angle'"});
  return {Section::states, "state", variant,
          states("  it: {filter: \"axle.angle*(1 + t) + 0.1*axle.angle.rate\", " + keys + "}\n"), std::move(bad)};
}

Sample transfer_function() {
  return {Section::states,
          "state",
          "transfer function",
          states("  it: {transfer_function: {numerator: [2, 1, 3], denominator: [1, 4, 5]}, input: \"axle.angle*t\", "
                 "start: equilibrium, units: N m}\n"),
          {{"transfer_function.numerator", "[1, 2, 3, 4]", "degree"},
           {"transfer_function.numerator", "[0, 0]", "not all of them zero"},
           {"transfer_function.denominator", "[0, 3]", "no power of s"},
           {"transfer_function.denominator", "[1, 2, 0]", "equilibrium"},
           {"input", "'x'", "x"},
           {"units", "[N, m]", "one for each output"}}};
}

Sample state_space() {
  return {
      Section::states,
      "state",
      "state space",
      states("  it: {state_space: {A: [[-1, 2], [-3, -4]], B: [[1, 0], [0.5, 2]], C: [[1, 1], [0, 2]], D: [[0.3, 0], "
             "[0, 0]]}, inputs: [\"axle.angle\", \"it.y2*t - it.x1\"], start: [0.1, 0.2], units: [rad, N]}\n"),
      {{"state_space.A", "[[1, 2]]", ""},
       {"state_space.B", "[[1, 2]]", ""},
       {"state_space.C", "[[1, 2, 3]]", ""},
       {"state_space.D", "[[1]]", ""},
       {"inputs", "[it.y1, t]", "refers to itself"},
       {"inputs", "[it.y3, t]", "has no 'y3'"},
       {"start", "[1]", "list of 2 numbers"},
       {"units", "[N]", "one for each output"}}};
}

Sample sampled(const std::string& variant, const std::string& keys, std::vector<BadValue> bad) {
  bad.push_back({"delay", "1e9", "samples would wait"});
  bad.push_back({"limit", "[2, 1]", "lower limit first"});
  return {Section::states, "state", variant, states("  it: {period: 0.2, " + keys + "}\n"), std::move(bad)};
}

Sample delay() {
  return {Section::states,
          "state",
          "delay",
          states("  it: {delayed: \"axle.angle*axle.angle.rate\", time: 0.2, points: 20}\n"
                 "  other: {rate: \"it - other\"}\n"),
          {{"delayed", "axle.angel", "did you mean 'angle'"}, {"delayed", "it", "refers to itself"}}};
}

Sample delay_in_formula() {
  return {
      Section::states,
      "state",
      "rate with a delay",
      states("  it: {rate: \"delay(axle.angle*axle.angle.rate, 0.2)*axle.angle - delay(it^2, 0.1)\", start: 0.3}\n"),
      {{"rate", "'delay(axle.angel, 0.2)'", "did you mean 'angle'"},
       {"rate", "'delay(axle.angle, -1)'", "greater than 0 s"}}};
}

}  // namespace

std::vector<Sample> state_samples() {
  return {
      rate(),
      gear_measures("rigid teeth", "", ""),
      gear_measures("elastic teeth", ", stiffness: 5 + sin(phi), damping: 0.3", " + teeth.deformation*teeth.stiffness"),
      filter("filter of first order", "time_constant: 0.2",
             {{"time_constant", "", "time_constant"},
              {"frequency", "3", "one of the two"},
              {"damping", "0.5", "frequency"}}),
      filter("filter of second order", "frequency: 0.3, damping: 0.6, start: 0.4, scale: 3", {{"start", "much", ""}}),
      transfer_function(),
      state_space(),
      delay(),
      delay_in_formula(),
      sampled("sampled", "sampled: \"axle.angle*(1 + t) + 0.1*it\", delay: 0.1, quantum: 0.01, start: 0.3",
              {{"sampled", "axle.angel", "did you mean 'angle'"}, {"start", "[1, 2]", "a list of 1"}}),
      sampled("sampled PID controller",
              "sampled: axle.angle, pid: {kp: 2, ki: 3, kd: 0.1, filter: 0.1}, "
              "limit: [-1, 1]",
              {{"pid", "{}", "at least one"}}),
      sampled("sampled state space",
              "sampled: [axle.angle, it.y2], state_space: {A: [[0.5, 1], [0, 0.3]], B: [[1, 0], [0, 1]]}",
              {{"sampled", "[it.y3, t]", "has no 'y3'"}, {"units", "[N]", "one for each output"}})};
}

}  // namespace bielle::laws
