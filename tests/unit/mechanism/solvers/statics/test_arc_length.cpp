// Paths of equilibria past limit points, against the closed forms of von Mises' truss: span 2 b, rise h, w the apex's
// way down, P(w) = 2 EA (h - w) (1/L - 1/L0), L^2 = b^2 + (h - w)^2 (engineering strain); dP/dw = 0 at L^3 = b^2 L0.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/solvers/statics/arc_length.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::ComputationError;
using bielle::InputError;
using bielle::test::message_of;
using bielle::test::ReadyModel;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double b = 3, h = 1, EA = 7;
const double L0 = std::hypot(b, h);

double truss_load(double w) { return 2 * EA * (h - w) * (1 / std::hypot(b, h - w) - 1 / L0); }

/// Returns the load at which P(w) + k w is largest (sign 1) or least (-1): dP/dw = -k.
double truss_limit(int sign, double k = 0) {
  return h - sign * std::sqrt(std::pow(b * b / (k / (2 * EA) + 1 / L0), 2.0 / 3) - b * b);
}

const std::string truss = fmt::format(
    "  l: {{type: spring_damper, nodes: [left, apex], stiffness: {0:.17g}}}\n"
    "  r: {{type: spring_damper, nodes: [right, apex], stiffness: {0:.17g}}}\n",
    EA / L0);
const std::string supports =
    "  left: {position: [-3, 0, 0], fixed: true}\n  right: {position: [3, 0, 0], fixed: true}\n"
    "  apex: {position: [0, 1, 0], fixed: [x, z, rx, ry, rz]}\n";

/// The apex carries the load.
const std::string loaded_truss =
    "nodes:\n" + supports + "elements:\n" + truss + "loads: {p: {node: apex, force: [0, -0.2, 0]}}\n";
constexpr double load = 0.2;

ContinuationOptions until(const ReadyModel& model, const std::string& node, const Vector3& direction,
                          double displacement, int steps = 0) {
  ContinuationOptions options;
  options.end.node = *model.file.model.find_node(node);
  options.end.direction = direction;
  options.end.displacement = displacement;
  options.steps = steps;
  return options;
}

ContinuationOptions until(double factor, int steps = 0) {
  ContinuationOptions options;
  options.end.load_factor = factor;
  options.steps = steps;
  return options;
}

struct Followed {
  Loaded end;
  State state;
  std::vector<PathPoint> points;
  std::vector<double> limits;
};

Followed follow(const ReadyModel& model, const ContinuationOptions& options,
                const std::function<void(const State&, const PathPoint&)>& check = {}) {
  Followed result;
  result.state = model.system.start(0);
  result.end = follow_by_continuation(model.system, model.environment(), {}, options, NewtonOptions{}, result.state,
                                      [&](const State& state, const PathPoint& point) {
                                        result.points.push_back(point);
                                        if (point.limit) result.limits.push_back(point.load_factor);
                                        if (check) check(state, point);
                                      });
  return result;
}

}  // namespace

TEST_CASE("a truss snaps through along its closed form, with both limit points, to the demanded displacement") {
  const ReadyModel model(loaded_truss);
  for (const int steps : {0, 5, 40}) {
    const Followed path =
        follow(model, until(model, "apex", -Vector3::UnitY(), 2.5, steps), [&](const State& state, const PathPoint& p) {
          CHECK_THAT(p.load_factor * load, WithinAbs(truss_load(h - model.node(state, "apex").x.y()), 1e-10));
        });
    CHECK_THAT(model.node(path.state, "apex").x.y(), WithinAbs(h - 2.5, 1e-11));
    CHECK(path.end.factor == path.points.back().load_factor);
    CHECK(path.points.back().done == 1);
    REQUIRE(path.limits.size() == 2);
    CHECK_THAT(path.limits[0] * load, WithinRel(truss_load(truss_limit(1)), 1e-10));
    CHECK_THAT(path.limits[1] * load, WithinRel(truss_load(truss_limit(-1)), 1e-10));
    if (steps == 40) CHECK(path.points.size() >= 12);  // no step is longer than four fortieths of the path
  }
}

TEST_CASE("a path ends exactly at a load factor, before and past limit points, and at zero and below it") {
  const ReadyModel model(loaded_truss);
  const double first = truss_load(truss_limit(1)) / load;
  CHECK(follow(model, until(0.999 * first)).end.factor == 0.999 * first);
  CHECK(follow(model, until(-0.3)).end.factor == -0.3);  // the path begins in the other direction
  // The path continues from its last point: over both limit points to the rising branch.
  Followed path = follow(model, until(model, "apex", -Vector3::UnitY(), 1.9));
  REQUIRE(path.limits.size() == 2);
  const Loaded end =
      follow_by_continuation(model.system, model.environment(), path.end, until(1), NewtonOptions{}, path.state);
  CHECK(end.factor == 1);
  CHECK(end.motions == 1);
  CHECK_THAT(truss_load(h - model.node(path.state, "apex").x.y()), WithinAbs(load, 1e-10));
  CHECK(model.node(path.state, "apex").x.y() < -1);
}

TEST_CASE("load steps take up a path where it ended") {
  const ReadyModel model(loaded_truss);
  Followed path = follow(model, until(model, "apex", -Vector3::UnitY(), 1.9));
  std::vector<double> factors;
  solve_statics(model.system, model.environment(), LoadSteps(2, path.end), NewtonOptions{}, path.state,
                [&](const State& state, double factor, int) {
                  factors.push_back(factor);
                  CHECK_THAT(factor * load, WithinAbs(truss_load(h - model.node(state, "apex").x.y()), 1e-10));
                });
  REQUIRE(factors.size() == 2);
  CHECK_THAT(factors[0], WithinAbs(0.5 * (1 + path.end.factor), 1e-15));
  CHECK(factors[1] == 1);
}

TEST_CASE("snap-back: through a soft spring the load's own displacement turns back, and the path follows") {
  // The load hangs on the apex by a spring: u = w + P/k. Its least stiffness is negative where k is below.
  const double k = 0.15;
  const ReadyModel model("nodes:\n" + supports +
                         "  load: {position: [0, -4, 0], fixed: [x, z, rx, ry, rz]}\nelements:\n" + truss +
                         fmt::format("  s: {{type: spring_damper, nodes: [apex, load], stiffness: {}}}\n", k) +
                         "loads: {p: {node: load, force: [0, -0.2, 0]}}\n");
  double farthest = 0, turned = 0;
  const Followed path =
      follow(model, until(model, "load", -Vector3::UnitY(), 3.2, 40), [&](const State& state, const PathPoint& p) {
        const double w = h - model.node(state, "apex").x.y(), u = -4 - model.node(state, "load").x.y();
        CHECK_THAT(p.load_factor * load, WithinAbs(truss_load(w), 1e-10));
        CHECK_THAT(u, WithinAbs(w + truss_load(w) / k, 1e-9));
        farthest = std::max(farthest, u);
        turned = std::max(turned, farthest - u);
      });
  const double high = truss_limit(1, k), low = truss_limit(-1, k);
  const double exact = high + truss_load(high) / k - low - truss_load(low) / k;
  CHECK(turned > 0.8 * exact);  // its extremes lie between the points
  CHECK(turned < exact);
  CHECK(path.limits.size() == 2);
  CHECK_THAT(-4 - model.node(path.state, "load").x.y(), WithinAbs(3.2, 1e-11));
}

TEST_CASE("motions of nodes and drives take the factor as loads do, past limit points of it") {
  // A moved end pulls the apex down by a spring of stiffness k: k (d s - w) = P(w), s = (w + P(w)/k)/d.
  const double k = 0.15, d = 2;
  const std::string spring = fmt::format("  s: {{type: spring_damper, nodes: [apex, end], stiffness: {}}}\n", k);
  const std::string moved =
      "nodes:\n" + supports +
      fmt::format("  end: {{position: [0, -4, 0], motion: {{x: 0, y: {}, z: 0, rx: 0, ry: 0, rz: 0}}}}\n", -d) +
      "elements:\n" + truss + spring;
  const std::string driven = "nodes:\n" + supports + "  end: {position: [0, -4, 0], fixed: [rx, ry, rz]}\nelements:\n" +
                             truss + spring +
                             "joints: {guide: {type: prismatic, nodes: [ground, end], axis: [0, 1, 0]}}\n" +
                             fmt::format("drives: {{ram: {{joint: guide, displacement: {}}}}}\n", -d);
  for (const std::string& text : {moved, driven}) {
    const ReadyModel model(text);
    const Followed path = follow(model, until(1), [&](const State& state, const PathPoint& p) {
      const double w = h - model.node(state, "apex").x.y();
      CHECK_THAT(p.load_factor, WithinAbs((w + truss_load(w) / k) / d, 1e-9));
      CHECK_THAT(model.node(state, "end").x.y(), WithinAbs(-4 - d * p.load_factor, 1e-9));
    });
    CHECK(path.end.factor == 1);
    CHECK(path.end.motions == 1);
    REQUIRE(path.limits.size() == 2);
    for (const int sign : {1, -1}) {
      const double w = truss_limit(sign, k);
      CHECK_THAT(path.limits[sign > 0 ? 0 : 1], WithinAbs((w + truss_load(w) / k) / d, 1e-10));
    }
    const Followed far = follow(model, until(model, "apex", -Vector3::UnitY(), 0.9));
    CHECK(far.limits.size() == 1);
    CHECK(far.end.motions == far.end.factor);
  }
}

namespace {

/// Returns a hinged shallow arch of beams in units of 1/scale of a metre.
std::string arch(double scale) {
  const std::string section = fmt::format(
      ", elements: 4, section: {{EA: 1e6, GAy: 4e5, GAz: 4e5, GJ: {0}, EIy: {0}, EIz: {0}}}}}\n", 40 * scale * scale);
  return fmt::format(
             "nodes:\n  a: {{position: [{}, 0, 0], fixed: [x, y, z, rx, ry]}}\n"
             "  top: {{position: [0, {}, 0], fixed: [z, rx, ry]}}\n"
             "  c: {{position: [{}, 0, 0], fixed: [x, y, z, rx, ry]}}\nelements:\n",
             -scale, 0.1 * scale, scale) +
         "  l: {type: beam, nodes: [a, top]" + section + "  r: {type: beam, nodes: [top, c]" + section +
         "loads: {p: {node: top, force: [0, -1000, 0]}}\n";
}

}  // namespace

TEST_CASE("a limit point at a kink, and limit points at load factor zero and far from the full load") {
  // A law that rises to 5 N at an elongation of 0.1 and falls from there; unloaded at 0.2, where a stiffer branch
  // begins.
  const auto spring = [](double force) {
    return fmt::format(
        "nodes: {{m: {{position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}}}\nelements:\n  s: {{type: spring_damper, "
        "nodes: "
        "[ground, m], force: \"if(e < 0.1, 50*e, if(e < 0.2, 50*(0.2 - e), 200*(e - 0.2)))\", length: 1}}\n"
        "loads: {{f: {{node: m, force: [{}, 0, 0]}}}}\n",
        force);
  };
  for (const double force : {5.0, 1e-6, 1e6}) {
    const ReadyModel model(spring(force));
    const Followed path = follow(model, until(model, "m", Vector3::UnitX(), 0.25));
    REQUIRE(path.limits.size() == 2);
    CHECK_THAT(path.limits[0] * force, WithinAbs(5, 1e-6));
    CHECK_THAT(path.limits[1] * force, WithinAbs(0, 1e-6));
    CHECK_THAT(path.end.factor * force, WithinAbs(10, 1e-6));
  }
}

TEST_CASE("a path does not depend on units") {
  std::vector<Followed> paths;
  std::vector<double> ends;
  for (const double scale : {1.0, 1000.0, 1.0 / 1024}) {
    const ReadyModel model(arch(scale));
    paths.push_back(follow(model, until(model, "top", -Vector3::UnitY(), 0.21 * scale)));
    ends.push_back(model.node(paths.back().state, "top").x.y() / scale);
  }
  REQUIRE(paths[0].limits.size() == 2);
  CHECK(paths[0].limits[0] > 0);
  CHECK(paths[0].limits[1] < paths[0].limits[0]);
  for (std::size_t k = 1; k < paths.size(); ++k) {
    REQUIRE(paths[k].points.size() == paths[0].points.size());
    for (std::size_t i = 0; i < paths[0].points.size(); ++i) {
      CHECK(paths[k].points[i].iterations == paths[0].points[i].iterations);
      CHECK_THAT(paths[k].points[i].load_factor, WithinRel(paths[0].points[i].load_factor, 1e-6));
    }
    CHECK_THAT(ends[k], WithinAbs(-0.11, 1e-11));
  }
}

TEST_CASE("a path ends at the displacement of a point that a body carries, and at a distance") {
  // A hinged arm of length 1 pulled up by a spring, its weight growing; `tip` is carried 0.5 beyond.
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {arm: {position: [1, 0, 0]}, tip: {position: [1.5, 0, 0]}, top: {position: [1, 0, 1], fixed: true}}
elements:
  arm: {type: rigid_body, node: arm, mass: 20, inertia: [0.1, 0.1, 0.1], also: [tip]}
  spring: {type: spring_damper, nodes: [top, arm], stiffness: 300, length: 1}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 1, 0], position: [0, 0, 0]}}
)yaml");
  const auto tip = [&](const Followed& path) { return model.node(path.state, "tip").x; };
  CHECK_THAT(tip(follow(model, until(model, "tip", -Vector3::UnitZ(), 0.4))).z(), WithinAbs(-0.4, 1e-11));
  const Vector3 oblique = Vector3(-1, 0, -2).normalized();
  CHECK_THAT(oblique.dot(tip(follow(model, until(model, "tip", oblique, 0.3))) - Vector3(1.5, 0, 0)),
             WithinAbs(0.3, 1e-11));
  const Followed path = follow(model, until(model, "tip", Vector3::Zero(), 0.5));
  CHECK_THAT((tip(path) - Vector3(1.5, 0, 0)).norm(), WithinAbs(0.5, 1e-11));
  CHECK_THAT(tip(path).norm(), WithinAbs(1.5, 1e-12));
}

TEST_CASE("why a path cannot be followed is said in one sentence") {
  const ReadyModel model(loaded_truss);
  const auto why = [](const ReadyModel& of, const ContinuationOptions& options) {
    return message_of<ComputationError>([&] { follow(of, options); });
  };
  ContinuationOptions few = until(model, "apex", -Vector3::UnitY(), 2.5, 100);
  few.most_points = 7;
  CHECK_THAT(why(model, few), Contains("not met in 7 points") && Contains("load factor") &&
                                  Contains("of the 2.5 m that node 'apex' is to move"));
  CHECK_THAT(why(model, until(0)), Contains("its end is where it begins"));
  CHECK_THAT(why(model, until(model, "apex", -Vector3::UnitY(), -1e9)), Contains("1000 points"));
  const ReadyModel unloaded("nodes:\n" + supports + "elements:\n" + truss);
  CHECK_THAT(why(unloaded, until(1)), Contains("nothing moves with the load factor"));
  const ReadyModel loose(
      "nodes: {m: {position: [1, 0, 0]}}\nelements: {m: {type: point_mass, node: m, mass: 1}}\n"
      "loads: {f: {node: m, force: [0, 1, 0]}}\n");
  CHECK_THAT(why(loose, until(1)), Contains("load factor 0") && Contains("nothing holds displacement y of node 'm'"));
  // The formula ends at an elongation of 0.5.
  const ReadyModel brittle(R"yaml(
nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements: {s: {type: spring_damper, nodes: [ground, m], force: "20*e*sqrt(0.5 - e) + 10*e", length: 1}}
loads: {f: {node: m, force: [10, 0, 0]}}
)yaml");
  CHECK_THAT(why(brittle, until(1)), Contains("no further point found beyond load factor 0.5") && Contains("formula"));
}

TEST_CASE("the end of a path is refused where it makes no sense, in one sentence") {
  const auto refusal = [](const std::string& arc_length) {
    return message_of<InputError>([&] {
      read_mechanism_text(loaded_truss + "analysis:\n  - {type: static, arc_length: " + arc_length + "}\n",
                          "truss.yaml");
    });
  };
  CHECK_THAT(refusal("{}"), Contains("until"));
  CHECK_THAT(refusal("{until: {}}"), Contains("either at a `load_factor` or at the `displacement` of a `node`"));
  CHECK_THAT(refusal("{until: {load_factor: 1, node: apex, displacement: 1}}"), Contains("give one of the two"));
  CHECK_THAT(refusal("{until: {node: apx, displacement: 1}}"),
             Contains("there is no node 'apx'") && Contains("did you mean 'apex'"));
  CHECK_THAT(refusal("{until: {node: apex}}"), Contains("displacement"));
  CHECK_THAT(refusal("{until: {node: apex, displacement: -1}}"), Contains("distance from where the node is drawn"));
  CHECK_THAT(refusal("{until: {node: apex, displacement: -1, direction: q}}"), Contains("x, y, z or a vector"));
  CHECK_THAT(refusal("{until: {node: apex, displacement: -1, direction: [0, 0, 0]}}"), Contains("direction"));
  CHECK_THAT(refusal("{until: {node: apex, displacement: 1, direction: x}}"), Contains("this node is fixed"));
  CHECK_THAT(refusal("{until: {node: left, displacement: 1}}"), Contains("this node is fixed"));
  CHECK_THAT(refusal("{until: {load_factor: 1}, points: 0}"), Contains("at least 1"));
  CHECK_THAT(refusal("{until: {load_factor: 1}, point: 10}"), Contains("did you mean 'points'"));
}
