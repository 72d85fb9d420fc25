// Types of analysis by name, and their keys.
#include <catch2/catch.hpp>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/campbell_analysis.hpp"
#include "mechanism/analyses/dynamic_analysis.hpp"
#include "mechanism/analyses/eigen_analysis.hpp"
#include "mechanism/analyses/frequency_response_analysis.hpp"
#include "mechanism/analyses/state_space_analysis.hpp"
#include "mechanism/analyses/static_analysis.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using Catch::Contains;

namespace {

std::unique_ptr<Analysis> read(const std::string& text) {
  return read_analysis(YamlValue::parse(text, "model.yaml"), Model());
}

std::string refusal(const std::string& text) {
  return test::message_of<InputError>([&] { read(text); });
}

}  // namespace

TEST_CASE("each type of the table gives an analysis of its name") {
  CHECK(read("{type: assembly}")->type() == "assembly");
  CHECK(read("{type: static}")->type() == "static");
  const auto dynamic = read("{type: dynamic, duration: 2, step: 0.1, start: equilibrium}");
  CHECK(dynamic->type() == "dynamic");
  CHECK(dynamic->duration() == 2);
  CHECK(dynamic->can_go_on());
  CHECK(dynamic_cast<const DynamicAnalysis&>(*dynamic).options().equilibrium);
  CHECK(read("{type: campbell, rotation: {axis: [0, 0, 1]}, speeds: {to: 9}}")->type() == "campbell");
  CHECK(analysis_table().size() == 9);
}

TEST_CASE("keys of statics are read") {
  const auto options = [](const std::string& text) {
    return dynamic_cast<const StaticAnalysis&>(*read(text)).options();
  };
  CHECK(options("{type: static}").steps == 1);
  CHECK(options("{type: static, steps: 5}").steps == 5);
  CHECK(options("{type: static, steps: auto}").steps == 0);
  CHECK(options("{type: static, arc_length: {until: {load_factor: 2}}}").path->end.load_factor == 2);
  CHECK(read("{type: static, steps: 5}")->expected_rows({}) == 6);
  CHECK(read("{type: static, steps: auto}")->expected_rows({}) == 0);
}

TEST_CASE("types that do not exist are refused") {
  CHECK_THAT(refusal("{type: dynamc}"), Contains("did you mean 'dynamic'"));
  CHECK_THAT(refusal("{type: assembly, steps: 2}"), Contains("'steps'") && Contains("the analysis 'assembly'"));
}

TEST_CASE("the analysis `eigen` reads how many modes, where, and about which rotation") {
  const auto options = [&](const std::string& text) {
    return dynamic_cast<const EigenAnalysis&>(*read(text)).options();
  };
  CHECK(options("{type: eigen}").search.count == 20);
  CHECK_FALSE(options("{type: eigen}").rotation);
  CHECK(options("{type: eigen, count: 5, near: 12.5}").search.near == 12.5);
  CHECK(options("{type: eigen, below: 100}").search.below == 100);
  const SteadyRotation turns =
      *options("{type: eigen, rotation: {rate: 3, axis: [0, 0, 2], position: [1, 0, 0]}}").rotation;
  CHECK(turns.omega == Vector3(0, 0, 3));
  CHECK(turns.through == Vector3(1, 0, 0));
  CHECK_FALSE(dynamic_cast<const EigenAnalysis&>(*read("{type: eigen, shapes: false}")).shapes());

  CHECK_THAT(refusal("{type: eigen, modes: 3}"), Contains("'modes' is not a key of the analysis 'eigen'"));
  CHECK_THAT(refusal("{type: eigen, count: 0}"), Contains("at least 1"));
  CHECK_THAT(refusal("{type: eigen, count: 2.5}"), Contains("count"));
  CHECK_THAT(refusal("{type: eigen, near: 0}"), Contains("near"));
  CHECK_THAT(refusal("{type: eigen, below: -1}"), Contains("below"));
  CHECK_THAT(refusal("{type: eigen, near: 1, below: 2}"), Contains("either `near`") && Contains("or `below`"));
  CHECK_THAT(refusal("{type: eigen, count: 1, below: 2}"), Contains("leave `count` out"));
  CHECK_THAT(refusal("{type: eigen, shapes: 3}"), Contains("shapes"));
  CHECK_THAT(refusal("{type: eigen, rotation: {rate: 0, axis: [0, 0, 1]}}"), Contains("other than 0"));
  CHECK_THAT(refusal("{type: eigen, rotation: {rate: 1, axis: [0, 0, 0]}}"), Contains("axis"));
  CHECK_THAT(refusal("{type: eigen, rotation: {rate: 1}}"), Contains("axis"));
  CHECK_THAT(refusal("{type: eigen, rotation: {rate: 1, axis: [0, 0, 1], position: 3}}"), Contains("position"));
  CHECK_THAT(refusal("{type: eigen, rotation: {speed: 1, axis: [0, 0, 1]}}"), Contains("'speed'"));
}

TEST_CASE("the analysis `frequency_response` says what it does not understand") {
  const auto with = [](const std::string& inputs, const std::string& outputs, const std::string& frequencies) {
    return refusal("{type: frequency_response, inputs: " + inputs + ", outputs: " + outputs +
                   ", frequencies: " + frequencies + "}");
  };
  const std::string force = "[{node: ground, direction: x}]", moves = "[{node: ground, direction: [0, 3, 4]}]",
                    some = "{from: 1, to: 10, count: 5}";
  const auto read_all = [&](const std::string& frequencies) {
    return dynamic_cast<const FrequencyResponseAnalysis&>(*read("{type: frequency_response, inputs: " + force +
                                                                ", outputs: " + moves +
                                                                ", frequencies: " + frequencies + "}"))
        .options();
  };
  CHECK(read_all(some).frequencies.size() == 5);
  CHECK(read_all("{from: 1, to: 100, count: 3}").frequencies[1] == Approx(10));
  CHECK(read_all("{from: 0, to: 100, count: 3, spacing: even}").frequencies[1] == Approx(50));
  CHECK(read_all("{from: 1, to: 100}").frequencies.size() == 200);
  CHECK(read_all("[3, 1]").frequencies == std::vector<double>{3, 1});
  CHECK(read_all(some).outputs[0].direction.y() == Approx(0.6));
  CHECK(read_all(some).inputs[0].name == "force x of node 'ground'");
  CHECK_THAT(with("[psh]", moves, some), Contains("there is no input 'psh'"));
  CHECK_THAT(with(force, "[psh]", some), Contains("there is no measure 'psh'"));
  CHECK_THAT(with("[]", moves, some), Contains("at least one input"));
  CHECK_THAT(with(force, "[]", some), Contains("at least one output"));
  CHECK_THAT(with("[{node: gruond, direction: x}]", moves, some), Contains("did you mean 'ground'"));
  CHECK_THAT(with("[{node: ground, direction: u}]", moves, some), Contains("direction"));
  CHECK_THAT(with("[{node: ground, direction: x, quantity: displacement}]", moves, some), Contains("quantity"));
  CHECK_THAT(with("[{node: ground}]", moves, some), Contains("direction"));
  CHECK_THAT(with("[{node: ground, direction: x, at: 3}]", moves, some), Contains("'at'"));
  CHECK_THAT(with(force, moves, "{from: 5, to: 1}"), Contains("expected more than `from`"));
  CHECK_THAT(with(force, moves, "{from: 0, to: 1}"), Contains("from"));
  CHECK_THAT(with(force, moves, "{from: -1, to: 1, spacing: even}"), Contains("at least 0"));
  CHECK_THAT(with(force, moves, "{from: 1, to: 2, count: 1}"), Contains("at least 2"));
  CHECK_THAT(with(force, moves, "{from: 1, to: 2, spacing: uneven}"), Contains("spacing"));
  CHECK_THAT(with(force, moves, "[]"), Contains("at least one frequency"));
  CHECK_THAT(with(force, moves, "[-1]"), Contains("at least 0"));
}

TEST_CASE("the analysis `state_space` reads inputs and outputs as `frequency_response` does") {
  const std::string force = "[{node: ground, direction: x}]";
  const auto read_analysis = read("{type: state_space, inputs: " + force + ", outputs: " + force.substr(0, 1) +
                                  "{node: ground, direction: z, quantity: rotation}]}");
  const auto& options = dynamic_cast<const StateSpaceAnalysis&>(*read_analysis).options();
  CHECK(options.inputs[0].name == "force x of node 'ground'");
  CHECK(options.outputs[0].rotation);
  CHECK_THAT(refusal("{type: state_space, inputs: " + force + "}"), Contains("outputs"));
  CHECK_THAT(refusal("{type: state_space, inputs: [psh], outputs: " + force + "}"),
             Contains("there is no input 'psh'"));
  CHECK_THAT(refusal("{type: state_space, inputs: " + force + ", outputs: " + force + ", frequencies: [1]}"),
             Contains("'frequencies' is not a key of the analysis 'state_space'"));
}

TEST_CASE("analyses take values with units, and refuse others") {
  Model model;
  Node node;
  node.name = "tip";
  model.add_node(node);
  model.parameters["speed"] = 100;
  const auto read_of = [&](const std::string& text) {
    YamlValue entry = YamlValue::parse(text, "model.yaml");
    entry.set_parameters(model.parameters);
    return read_analysis(entry, model);
  };
  const auto refused = [&](const std::string& text, const std::string& unit, const std::string& given) {
    CHECK_THAT(test::message_of<InputError>([&] { read_of(text); }),
               Contains("expected a value in " + unit + ", found one in '" + given + "'"));
  };
  const auto path = read_of("{type: static, arc_length: {until: {node: tip, displacement: 12 mm}}}");
  CHECK(dynamic_cast<const StaticAnalysis&>(*path).options().path->end.displacement == Approx(0.012));
  refused("{type: static, arc_length: {until: {node: tip, displacement: 12 deg}}}", "m", "deg");

  const auto motion = read_of("{type: dynamic, duration: 2 min, step: 5 ms, tolerance: 1e-6, largest_step: 1 s}");
  const DynamicsOptions& options = dynamic_cast<const DynamicAnalysis&>(*motion).options();
  CHECK(options.duration == 120);
  CHECK(options.stepping.size == Approx(0.005));
  CHECK(options.stepping.largest == 1);
  refused("{type: dynamic, duration: 2 m, step: 1}", "s", "m");
  CHECK(read_of("{type: kinematic, duration: 500 ms, step: 1 ms}")->duration() == Approx(0.5));
  refused("{type: inverse_dynamics, duration: 2, step: 3 m}", "s", "m");

  const auto modes =
      read_of("{type: eigen, near: 2 kHz, rotation: {rate: 60 rev/min, axis: [0, 0, 1], position: [10 cm, 0, 0]}}");
  const ModesOptions& sought = dynamic_cast<const EigenAnalysis&>(*modes).options();
  CHECK(*sought.search.near == Approx(2000));
  CHECK(sought.rotation->omega.z() == Approx(2 * M_PI));
  CHECK(sought.rotation->through.x() == Approx(0.1));
  refused("{type: eigen, below: 3 rad/s}", "Hz", "rad/s");
  refused("{type: eigen, rotation: {rate: 3 Hz, axis: [0, 0, 1]}}", "rad/s", "Hz");

  const std::string ends = "inputs: [{node: tip, direction: x}], outputs: [{node: tip, direction: z}]";
  const auto responses = read_of("{type: frequency_response, " + ends + ", frequencies: [1 kHz, 2 kHz]}");
  CHECK(dynamic_cast<const FrequencyResponseAnalysis&>(*responses).options().frequencies[1] == Approx(2000));
  refused("{type: frequency_response, " + ends + ", frequencies: {from: 1, to: 2 m}}", "Hz", "m");
  refused("{type: state_space, " + ends + ", rotation: {rate: 1, axis: [0, 0, 1], position: [1 s, 0, 0]}}", "m", "s");

  const auto speeds = [&](const std::string& text) {
    return dynamic_cast<const CampbellAnalysis&>(*read_of("{type: campbell, " + text + "}")).options();
  };
  CHECK(speeds("rotation: {axis: [0, 0, 1]}, speeds: {to: 60 rev/min, count: 3}").values[1] == Approx(M_PI));
  refused("{type: campbell, rotation: {axis: [0, 0, 1]}, speeds: {to: 3 Hz}}", "rad/s", "Hz");
  CHECK(speeds("parameter: speed, speeds: [1, 60 rev/min]").values[1] == Approx(2 * M_PI));
  const std::string rate = "parameter: speed, speeds: {to: 9}, rotation: {axis: [0, 0, 1], rate: ";
  CHECK(speeds(rate + "2*speed}").rate == "2*speed");
  CHECK(std::stod(speeds(rate + "60 rev/min}").rate) == Approx(2 * M_PI));
  refused("{type: campbell, " + rate + "3 m}}", "rad/s", "m");
}

TEST_CASE("defaults of the tables are those of the analyses' options") {
  const auto motion = read("{type: dynamic, duration: 1, step: 0.1, newton: {line_search: true}}");
  const NewtonOptions& newton = dynamic_cast<const DynamicAnalysis&>(*motion).options().newton;
  CHECK(newton.tolerance == NewtonOptions().tolerance);
  CHECK(newton.iterations == NewtonOptions().iterations);
  CHECK(newton.line_search == NewtonOptions().line_search);
  CHECK(newton.tangent == NewtonOptions().tangent);
  const auto path = read("{type: static, arc_length: {until: {load_factor: 2}}}");
  CHECK(dynamic_cast<const StaticAnalysis&>(*path).options().path->most_points == ContinuationOptions().most_points);
  const auto modes = read("{type: eigen}");
  CHECK(dynamic_cast<const EigenAnalysis&>(*modes).options().search.count == ModeOptions().count);
  const auto sweep = read("{type: campbell, rotation: {axis: [0, 0, 1]}, speeds: {to: 9}}");
  const CampbellOptions& swept = dynamic_cast<const CampbellAnalysis&>(*sweep).options();
  CHECK(swept.modes == CampbellOptions().modes);
  CHECK(swept.orders == CampbellOptions().orders);
  CHECK(swept.values.size() == 41);
}

TEST_CASE("values of analyses out of range are refused") {
  CHECK_THAT(refusal("{type: static, steps: 0}"), Contains("steps") && Contains("at least 1"));
  CHECK_THAT(refusal("{type: static, steps: some}"), Contains("steps"));
  CHECK_THAT(refusal("{type: static, branch: 0.6}"), Contains("branch") && Contains("at most 0.5"));
  CHECK_THAT(refusal("{type: static, newton: {tangent: reused}}"), Contains("'tangent' is not a key of `newton`"));
  CHECK_THAT(refusal("{type: static, newton: {tolerance: 0.1}}"), Contains("tolerance") && Contains("at most 0.001"));
  CHECK_THAT(refusal("{type: static, newton: {iterations: 1}}"), Contains("iterations") && Contains("at least 2"));
  CHECK_THAT(refusal("{type: dynamic, duration: 1, step: 0.1, newton: {tangent: reusd}}"),
             Contains("'reusd' is not a way with the tangent; did you mean 'reused'?"));
  CHECK_THAT(refusal("{type: dynamic, duration: 1, step: 0.1, rho: 1.1}"),
             Contains("rho") && Contains("between 0 and 1"));
  CHECK_THAT(refusal("{type: dynamic, duration: 1, step: 0.1, scheme: hht, alpha: 0.5}"),
             Contains("alpha") && Contains("between 0 and 0.333"));
  CHECK_THAT(refusal("{type: dynamic, duration: 1, step: 0.1, alpha: 0.1}"), Contains("is no parameter of the scheme"));
  CHECK_THAT(refusal("{type: campbell, rotation: {axis: [0, 0, 1]}, speeds: {to: 9}, modes: 0}"), Contains("modes"));
  CHECK_THAT(refusal("{type: campbell, rotation: {axis: [0, 0, 1]}, speeds: {to: 9}, orders: [0]}"),
             Contains("orders[1]") && Contains("greater than 0"));
}
