// Load steps past a limit point: a shallow truss of two springs (R. von Mises), whose apex goes down between them. With
// the half span a, the height y, free length L0 and length L = sqrt(a^2 + y^2) it carries P = 2 k (L0 - L) y/L; the
// most where L^3 = L0 a^2.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle;
using namespace bielle::mechanism;

namespace test_jumps {
namespace {

constexpr double a = 1, h = 0.3, k = 1e5;
const double L0 = std::hypot(a, h), L_limit = std::cbrt(L0 * a * a), y_limit = std::sqrt(L_limit * L_limit - a * a);

double carried(double y) {
  const double L = std::hypot(a, y);
  return 2 * k * (L0 - L) * y / L;
}

std::string truss(double load, const std::string& output = "") {
  return fmt::format(
      "nodes:\n  left: {{position: [-1, 0, 0], fixed: true}}\n  right: {{position: [1, 0, 0], fixed: true}}\n"
      "  apex: {{position: [0, 0.3, 0], fixed: [x, z, rx, ry, rz]}}\n"
      "elements:\n  a: {{type: spring_damper, nodes: [left, apex], stiffness: 1e5}}\n"
      "  b: {{type: spring_damper, nodes: [right, apex], stiffness: 1e5}}\n"
      "loads: {{weight: {{node: apex, force: [0, {:.17g}, 0]}}}}\nanalysis: [{{type: static}}]\n{}",
      -load, output);
}

StaticsReport run(const std::string& text, int steps) {
  const MechanismFile file = read_mechanism_text(text, "truss.yaml");
  Session session(file.model);
  StaticsOptions options;
  options.steps = steps;
  return compute_statics(session, options);
}

}  // namespace

TEST_CASE("an increment that jumps past a limit point says where, and how far") {
  for (const int steps : {0, 1, 10, 17}) {
    const StaticsReport report = run(truss(1.3 * carried(y_limit)), steps);
    CAPTURE(steps);
    REQUIRE(report.log.jumps.size() == 1);
    const LoadJump& jump = report.log.jumps[0];
    CHECK(jump.factor == Approx(1 / 1.3).epsilon(1e-5));
    CHECK(jump.node == "apex");
    // At the same load the apex hangs below, and its springs are stretched.
    double low = -2, high = -h;
    while (high - low > 1e-12) {
      const double y = 0.5 * (low + high);
      (carried(y) > carried(y_limit) ? low : high) = y;
    }
    // Just below the limit load it has not moved all the way yet; the rest is the root of the missing load: 1e-6 of the
    // load.
    CHECK(jump.distance == Approx(y_limit - low).epsilon(5e-3));
  }
}

TEST_CASE("a jump is told whatever the load and the steps, in any unit of length") {
  // Half of the truss: its apex at height h next to a support, on one spring. For some of these loads Newton's method
  // goes straight to the far equilibrium (a tangent of a cubic meets it once more).
  constexpr double height = 0.1, stiffness = 1e4;
  const double free = std::hypot(1, height), shortest = std::cbrt(free), y = std::sqrt(shortest * shortest - 1);
  const double limit = stiffness * (free - shortest) * y / shortest;  // 1.9149 N
  for (const double unit : {1.0, 1e-9, 1e3})
    for (const double load : {2.5, 10.0, 30.0, 40.0})
      for (const int steps : {0, 1, 2, 4, 8}) {
        CAPTURE(unit, load, steps);
        const StaticsReport report =
            run(fmt::format(
                    "nodes: {{a: {{fixed: true}}, c: {{position: [{:.17g}, 0, {:.17g}], fixed: [x, y, rx, ry, rz]}}}}\n"
                    "elements: {{s: {{type: spring_damper, nodes: [a, c], stiffness: {:.17g}}}}}\n"
                    "loads: {{l: {{node: c, force: [0, 0, {:.17g}]}}}}\nanalysis: [{{type: static}}]\n",
                    unit, height * unit, stiffness, -load * unit),
                steps);
        REQUIRE(report.log.jumps.size() == 1);
        CHECK(report.log.jumps[0].factor == Approx(limit / load).epsilon(1e-5));
        CHECK(report.log.jumps[0].node == "c");
        CHECK(report.log.unstable == 0);
      }
}

TEST_CASE("a jump in one of many members is told, and where the others go on as before") {
  // The load of the truss also bends a cantilever of the same size.
  const auto both = [](double load) {
    return fmt::format(
        "nodes:\n  a: {{fixed: true}}\n  c: {{position: [1, 0, 0.1], fixed: [x, y, rx, ry, rz]}}\n"
        "  root: {{position: [0, 1, 0], fixed: true}}\n  tip: {{position: [1, 1, 0]}}\n"
        "elements:\n  s: {{type: spring_damper, nodes: [a, c], stiffness: 1e4}}\n"
        "  b: {{type: beam, nodes: [root, tip], elements: 8, section: {{EA: 1e5, GAy: 1e5, GAz: 1e5, GJ: 10, EIy: 10, "
        "EIz: 10}}}}\nloads:\n  l: {{node: c, force: [0, 0, {:.17g}]}}\n  p: {{node: tip, force: [0, 0, 10]}}\n"
        "analysis: [{{type: static}}]\n",
        -load);
  };
  for (const int steps : {1, 4}) {
    CAPTURE(steps);
    const StaticsReport jumps = run(both(10), steps);
    REQUIRE(jumps.log.jumps.size() == 1);
    CHECK(jumps.log.jumps[0].node == "c");
    CHECK(run(both(1), steps).log.jumps.empty());
  }
}

TEST_CASE("a path that softens, however steeply, is no jump") {
  for (const int steps : {1, 4}) {
    CAPTURE(steps);
    CHECK(run(truss(0.9999 * carried(y_limit)), steps).log.jumps.empty());
  }
}

TEST_CASE("rows of statics stand at the load factors that the output asks for") {
  const auto record = [](double load, const StaticsOptions& options, const std::string& factors) {
    const MechanismFile file =
        read_mechanism_text(truss(load, "output: {load_factors: " + factors + "}\n"), "truss.yaml");
    Session session(file.model);
    MemorySink memory(session.model());
    session.add_sink(memory);
    session.set_recording(file.output.recording);
    session.begin_analysis("static");
    compute_statics(session, options);
    session.end_analysis();
    return std::pair(memory.read(0, "time"), memory.read(0, "nodes/apex/position"));
  };
  const auto check_balance = [](double load, const std::vector<double>& factor, const std::vector<double>& position) {
    for (std::size_t i = 0; i < factor.size(); ++i)
      CHECK(carried(position[3 * i + 1]) == Approx(factor[i] * load).margin(1e-6 * load));
  };
  StaticsOptions increments;
  for (const int steps : {0, 1, 4}) {
    CAPTURE(steps);
    increments.steps = steps;
    const double load = 0.95 * carried(y_limit);
    const auto [factor, position] = record(load, increments, "[0.1, 0.45, 0.7]");
    CHECK(factor == std::vector<double>{0.1, 0.45, 0.7});
    check_balance(load, factor, position);
  }
  StaticsOptions path;
  path.path.emplace();
  path.path->end.load_factor = 0.9;
  const double load = 2 * carried(y_limit);  // the limit at load factor 0.5
  const auto [factor, position] = record(load, path, "[-0.2, 0.1, 0.45, 0.9]");
  // The load rises to the upper limit, falls to the lower one, and rises again.
  CHECK_THAT(factor, Catch::Approx(std::vector<double>{0.1, 0.45, 0.5, 0.45, 0.1, -0.2, -0.5, -0.2, 0.1, 0.45, 0.9}));
  check_balance(load, factor, position);
}

}  // namespace test_jumps
