// Formulas of time between the ends of steps: adaptive steps resolve them, fixed steps report them.
#include <functional>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/beam_superelement.hpp"
#include "tests/support/march_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

constexpr double end = 1, tp = 0.5051;

/// Returns a pulse of 2 N s within 1 ms, a bump of 10 mm.
std::string with_pulse(const std::string& text, double w = 1e-3) {
  const std::string shape = fmt::format("exp(-((t - {})/{})^2)", tp, w);
  std::string result = text;
  for (const auto& [word, formula] :
       {std::pair<std::string, std::string>{"PULSE", fmt::format("2/({}*sqrt(pi))*{}", w, shape)}, {"SHAPE", shape}})
    for (std::size_t at = result.find(word); at != std::string::npos; at = result.find(word))
      result.replace(at, word.size(), formula);
  return result;
}

struct Struck {
  std::string name;  ///< in the sentence about fixed steps
  std::string text;
  std::function<double(const ReadyModel&, const State&)> found;
  double expected;
};

double velocity_of(const ReadyModel& model, const State& state) { return model.node(state, "a").v.x(); }
/// Returns a function for the velocity less that due to the rest of the load.
std::function<double(const ReadyModel&, const State&)> velocity_beyond(double rest) {
  return [=](const ReadyModel& model, const State& state) { return velocity_of(model, state) - rest; };
}
/// Returns the amplitude of the motion about a place [m]; the phase would contain the errors of the steps after the
/// pulse.
std::function<double(const ReadyModel&, const State&)> amplitude_about(double x) {
  return [=](const ReadyModel& model, const State& state) {
    const NodeState& node = model.node(state, "a");
    return std::hypot(node.x.x() - 0.3 - x, node.v.x() / std::sqrt(1000.0));
  };
}
double pressure_of(const ReadyModel& /*model*/, const State& state) { return state.first_order[1]; }

/// 2 kg on a slide along x.
const std::string slide = R"yaml(
nodes: {a: {position: [0.3, 0, 0]}}
elements: {m: {type: point_mass, node: a, mass: 2}%ELEMENTS%}
joints: {s: {type: prismatic, nodes: [ground, a], position: [0.3, 0, 0], axis: [1, 0, 0]%JOINT%}}
)yaml";

std::string sliding(const std::string& more, const std::string& elements = "", const std::string& joint = "") {
  std::string text = slide;
  text.replace(text.find("%ELEMENTS%"), 10, elements);
  text.replace(text.find("%JOINT%"), 7, joint);
  return text + more;
}

/// Returns a mass of 2 kg on a spring of 2000 N/m that is attached to a moving part: omega^2 = 1000 1/s^2.
std::string carried(const std::string& node, const std::string& more, const std::string& joint = "") {
  return "nodes: {r: {position: [0, 0, 0]" + node + "}, a: {position: [0.3, 0, 0]}}\n" +
         "elements: {n: {type: point_mass, node: r, mass: 1}, m: {type: point_mass, node: a, mass: 2}}\n"
         "joints: {s: {type: prismatic, nodes: [r, a], position: [0.3, 0, 0], axis: [1, 0, 0], stiffness: 2e3}" +
         joint + "}\n" + more;
}

/// Duhamel's integral z = omega int u(s) sin omega(t - s) ds of u = A exp(-((t - tp)/w)^2), all of which has passed.
double after_bump(double A, double w) {
  const double omega = std::sqrt(1000.0);
  return omega * A * w * std::sqrt(M_PI) * std::exp(-std::pow(omega * w / 2, 2));
}

std::vector<Struck> struck_by_forces() {
  const double v = 1;  // 2 N s on 2 kg
  return {
      {"load 'l': force x", sliding("loads: {l: {node: a, force: [\"PULSE\", 0, 0]}}\n"), velocity_of, v},
      {"load 'l': force x", sliding("loads: {l: {node: a, force: [\"1e4 + PULSE\", 0, 0]}}\n"),
       velocity_beyond(1e4 / 2 * end), v},
      {"load 'l': force x", sliding("loads: {l: {node: a, force: [\"1e3*t + PULSE\", 0, 0]}}\n"),
       velocity_beyond(1e3 / 4 * end * end), v},
      {"load 'l': force x",
       sliding("measures: {p: \"PULSE + 0*s.displacement\"}\nloads: {l: {node: a, force: [p, 0, 0]}}\n"), velocity_of,
       v},
      {"element 'f': force", sliding("", ", f: {type: spring_damper, nodes: [ground, a], force: \"-PULSE\"}"),
       velocity_of, v},
      {"joint 's': spring on displacement", sliding("", "", ", damping: \"-PULSE + 0*v\""), velocity_of, v},
      {"drive 'd': force on displacement", sliding("drives: {d: {joint: s, force: \"PULSE\"}}\n"), velocity_of, v},
      {"drive 'd': target", sliding("drives: {d: {joint: s, pid: {target: \"0.01*SHAPE\", kp: 2000, ki: 0, kd: 0}}}\n"),
       amplitude_about(0), after_bump(0.01, 1e-3)},
      // 2 N s/m along 1 m of 2 kg/m.
      {"element 'a': force per length x", R"yaml(
nodes: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0]}}
elements: {a: {type: beam, nodes: [a, b], elements: 2, section: {rectangle: [0.02, 0.02], young: 2e11, poisson: 0.3, density: 5000}, distributed: {force: ["PULSE", 0, 0]}}}
)yaml",
       [](const ReadyModel& model, const State& state) {
         return 0.5 * (model.node(state, "a").v.x() + model.node(state, "b").v.x());
       },
       v},
      // The fluid is so stiff that all of 2e-6 m^3 is pressure: B dV/V.
      {"flow_source 'p': flow", R"yaml(
nodes: {n: {position: [0, 0, 0], fixed: true}}
hydraulics:
  ambient_pressure: 0
  fluid: {bulk_modulus: 1.4e9, density: 850}
  volumes: {a: {volume: 1e-3, pressure: 0}}
  supplies: {p: {to: a, flow: "1e-6*PULSE"}}
)yaml",
       pressure_of, 1.4e9 * 2e-6 / 1e-3},
      // pdot = (p_s - p)/tau, tau = V/(B G).
      {"pressure_source 'p': pressure", R"yaml(
nodes: {n: {position: [0, 0, 0], fixed: true}}
hydraulics:
  ambient_pressure: 0
  fluid: {bulk_modulus: 1.4e7, density: 850}
  volumes: {a: {volume: 1e-3, pressure: 0}}
  supplies: {p: {pressure: "1e7*SHAPE"}}
  lines: {gap: {from: p, to: a, laminar: {conductance: 1e-10}}}
)yaml",
       pressure_of, 1e7 * 1e-3 * std::sqrt(M_PI) * 1.4 * std::exp(-(end - tp) * 1.4 + std::pow(1e-3 * 1.4 / 2, 2))},
  };
}

std::vector<Struck> struck_by_motions() {
  const std::string driven = ", q: {type: prismatic, nodes: [ground, r], position: [0, 0, 0], axis: [1, 0, 0]}";
  return {
      {"drive 'd': displacement", carried("", "drives: {d: {joint: q, displacement: \"0.01*SHAPE\"}}\n", driven),
       amplitude_about(0), after_bump(0.01, 1e-3)},
      {"drive 'd': rate of displacement", carried("", "drives: {d: {joint: q, speed: \"0.005*PULSE\"}}\n", driven),
       amplitude_about(0.01), 0.01},
      {"node 'r': motion x", carried(", motion: {x: \"0.01*SHAPE\", y: 0, z: 0, rx: 0, ry: 0, rz: 0}", ""),
       amplitude_about(0), after_bump(0.01, 1e-3)},
      {"joint 'q': length",
       carried(", fixed: [y, z, rx, ry, rz]", "",
               ", q: {type: distance, nodes: [ground, r], at: [[-1, 0, 0], [0, 0, 0]], length: \"1 + 0.01*SHAPE\"}"),
       amplitude_about(0), after_bump(0.01, 1e-3)},
  };
}

void check_felt(const Struck& struck) {
  const ReadyModel model(with_pulse(struck.text));
  const Course motion = march(model, end, adaptive_steps(0.02, 1e-6));
  INFO(struck.name << ", " << motion.log.steps << " steps");
  // Local errors of 1e-6 of the model's size (0.3 m, 1 litre) in some 20 steps within the pulse, at random.
  CHECK(struck.found(model, motion.end) == Approx(struck.expected).epsilon(1e-2));
  CHECK(motion.warnings.empty());
}

void check_told(const Struck& struck) {
  const ReadyModel model(with_pulse(struck.text));
  const std::vector<std::string> coarse = march(model, end, fixed_steps(0.02)).warnings;
  INFO(struck.name);
  REQUIRE(coarse.size() == 1);
  CHECK_THAT(coarse[0], Catch::StartsWith(struck.name) && Catch::Contains("t = 0.52 s"));
  // Steps of a fifth of the pulse's width resolve it.
  CHECK(march(model, 0.52, fixed_steps(2e-4)).warnings.empty());
}

}  // namespace

TEST_CASE("a pulse of a force between the ends of steps is felt with a tolerance, and told of fixed steps") {
  for (const Struck& struck : struck_by_forces()) {
    check_felt(struck);
    check_told(struck);
  }
}

TEST_CASE("a bump of a prescribed motion between the ends of steps is felt with a tolerance, and told of fixed steps") {
  for (const Struck& struck : struck_by_motions()) {
    check_felt(struck);
    check_told(struck);
  }
}

TEST_CASE("a bump of a tenth of a second is not jumped over by longer steps") {
  const std::string driven = ", q: {type: prismatic, nodes: [ground, r], position: [0, 0, 0], axis: [1, 0, 0]}";
  const ReadyModel model(
      with_pulse(carried("", "drives: {d: {joint: q, displacement: \"0.01*SHAPE\"}}\n", driven), 0.1));
  const Course motion = march(model, end, adaptive_steps(0.4, 1e-6));
  CHECK(amplitude_about(0)(model, motion.end) == Approx(after_bump(0.01, 0.1)).epsilon(5e-3));
}

TEST_CASE("a bump of less than rounding is not told") {
  const ReadyModel model(with_pulse(carried(", motion: {x: \"1e-30*SHAPE\", y: 0, z: 0, rx: 0, ry: 0, rz: 0}", "")));
  CHECK(march(model, end, fixed_steps(0.02)).warnings.empty());
}

TEST_CASE("a ripple of a valve that the fluid smooths out makes no step smaller") {
  const auto steps = [](const std::string& ripple) {
    const ReadyModel model(R"yaml(
nodes: {n: {position: [0, 0, 0], fixed: true}}
hydraulics:
  fluid: {bulk_modulus: 1.4e9, density: 850}
  volumes: {a: {volume: 1e-3, pressure: 1e6}}
  supplies: {p: {pressure: 1e7}, tank: {pressure: 101325}}
  lines:
    v: {from: p, to: a, valve: {area: 1e-6, command: "0.5)yaml" +
                           ripple + R"yaml("}}
    o: {from: a, to: tank, orifice: {diameter: 1e-3}}
)yaml");
    return march(model, end, adaptive_steps(0.01, 1e-5)).log.steps;
  };
  CHECK(static_cast<double>(steps(" + 1e-3*sin(6e3*t)")) < 1.2 * static_cast<double>(steps("")));
}

TEST_CASE("a pulse in the load pattern of a superelement is felt and told") {
  const TemporaryFolder folder;
  BeamChain beam = straight_beam();  // 1 kg
  beam.loads = {{"push", 10, {1, 0, 0}}};
  bielle::write_superelement(beam.reduced().body, folder / "beam.h5");
  check_told({"element 'e': factor of load 'push'",
              fmt::format("nodes: {{a: {{position: [0, 0, 0]}}, b: {{position: [1, 0, 0]}}}}\nelements: {{e: {{type: "
                          "superelement, file: {}, nodes: {{a: a, b: b}}, loads: {{push: \"PULSE\"}}}}}}\n",
                          folder / "beam.h5"),
              nullptr, 0});
}

TEST_CASE("what pulses miss is told in numbers") {
  // 1 kg at 1 m/s, and a pulse of 1e6 N 1 ms sqrt(pi) = 1772.45 N s.
  const double pulse = 1e3 * std::sqrt(M_PI);
  const auto model_of = [](const std::string& force) {
    return ReadyModel(R"yaml(
nodes: {m: {position: [1, 0, 0], velocity: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements: {m: {type: point_mass, node: m, mass: 1}}
loads: {l: {node: m, force: [")yaml" +
                      force + "\", 0, 0]}}\n");
  };
  const ReadyModel struck = model_of("1e6*exp(-((t - 0.55)/0.001)^2)");
  for (const double tolerance : {1e-4, 1e-6}) {
    const Course motion = march(struck, 1, adaptive_steps(0.1, tolerance));
    CHECK(struck.node(motion.end, "m").v.x() == Approx(1 + pulse).epsilon(1e-3));
    CHECK(motion.log.steps < 3000);
  }
  const Course coarse = march(struck, 1, fixed_steps(0.1));
  REQUIRE(coarse.warnings.size() == 1);
  CHECK_THAT(coarse.warnings[0], Catch::Contains("load 'l': force x changes between steps"));
  CHECK_THAT(coarse.warnings[0], Catch::Contains("1772 N s, they miss 1772 N s") && Catch::Contains("to t = 0.6 s"));
  // Steps of a fifth of its width resolve it.
  const Course fine = march(struck, 1, fixed_steps(2e-4));
  CHECK(fine.warnings.empty());
  CHECK(struck.node(fine.end, "m").v.x() == Approx(1 + pulse).epsilon(1e-3));
  // A formula that steps resolve gives no warning: 12 steps in a period miss (omega h)^2/12 = 2 %.
  CHECK(march(model_of("3*sin(2*pi*t)"), 1, fixed_steps(1.0 / 12)).warnings.empty());
  CHECK(march(model_of("3*sin(2*pi*t)"), 1, fixed_steps(1.0 / 3)).warnings.size() == 1);
  CHECK(march(model_of("1e4 + 3*sin(2*pi*t)"), 1, fixed_steps(1.0 / 12)).warnings.empty());
  // A ripple of 3e-5 is negligible.
  CHECK(march(model_of("1e5 + 3*sin(2*pi*t)"), 1, fixed_steps(1.0 / 3)).warnings.empty());
}

TEST_CASE("formulas that steps resolve, or that move nothing, make no step smaller") {
  const auto model_of = [](const std::string& more) {
    return ReadyModel(
        "nodes: {r: {position: [1, 0, 0], motion: {x: \"0.01*sin(2*pi*t)\"}, fixed: [y, z, rx, ry, rz]}, "
        "m: {position: [2, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
        "elements: {m: {type: point_mass, node: m, mass: 1}, s: {type: spring_damper, nodes: [r, m], "
        "stiffness: 20, length: 1}}\nloads: {l: {node: m, force: [\"3*sin(2*pi*t)" +
        more + "\", 0, 0]}}\n");
  };
  const StepOptions options = adaptive_steps(0.01, 1e-5);
  const ReadyModel smooth = model_of("");
  const Course motion = march(smooth, 1, options);
  const long rippled = march(model_of(" + 1e-4*sin(5e4*t)"), 1, options).log.steps;
  CHECK(static_cast<double>(rippled) < 1.2 * static_cast<double>(motion.log.steps));
  // No step that the local error accepts is refused because of its error in smooth formulas.
  const ErrorNorm norm(smooth.system, smooth.environment(), motion.end);
  PulseWatch watch(smooth.system, 0, 1, norm.length());
  double before = 0;
  for (const Visit& visit : motion.visits) {
    watch.look(motion.end, smooth.environment(), before, visit.time);
    CHECK(watch.error(smooth.environment(), norm, options.tolerance) < 1);
    before = visit.time;
  }
}
