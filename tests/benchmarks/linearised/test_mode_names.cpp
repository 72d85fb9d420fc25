// Names of modes whose order, direction and pattern are known in closed form.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "mechanism/analyses/blade_pattern.hpp"
#include "mechanism/analyses/campbell.hpp"
#include "mechanism/analyses/mode_groups.hpp"
#include "mechanism/analyses/mode_names.hpp"
#include "mechanism/solvers/linearised/whirl.hpp"
#include "tests/benchmarks/linearised/turning_models.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_mode_names {
namespace {

std::vector<std::string> names_of(const ModesOf& model, const ModesReport& report, bool from_slowest = true) {
  return full_names(describe_modes(model.session.system(), report), from_slowest);
}

std::vector<std::string> names_of(const std::string& text, int count) {
  const ModesOf model(text);
  return names_of(model, model({.count = count}));
}

ModesReport behind_shaft(const ModesOf& model, double rate, int count) {
  ModesOptions options;
  options.search.count = count;
  options.rotation = SteadyRotation{};
  options.rotation->joint = model.file.model.members_of({Section::joints, "shaft"}).front();
  options.rotation->rate = rate;
  options.rotation->mean = true;
  return compute_modes(model.session, options);
}

/// Returns a beam from the origin whose sections have the given EIy and EIz, unit mass and length.
std::string cantilever(const Vector3& tip, const Vector3& orientation, double EIy, double EIz) {
  return fmt::format(
      "nodes: {{foot: {{fixed: true}}, tip: {{position: [{}, {}, {}]}}}}\n"
      "elements:\n  boom: {{type: beam, nodes: [foot, tip], elements: 24, orientation: [{}, {}, {}], section: {{EA: "
      "900, "
      "GAy: 1e6, GAz: 1e6, GJ: 0.3, EIy: {}, EIz: {}, mass_per_length: 1, Jx: 2e-3, Jy: 1e-6, Jz: 1e-6}}}}\n",
      tip[0], tip[1], tip[2], orientation[0], orientation[1], orientation[2], EIy, EIz);
}

/// Returns the angular frequencies of the cantilever with their names, by R. D. Blevins, Formulas for Natural Frequency
/// and Mode Shape (1979), tables 8-1, 8-16 and 8-19.
std::vector<std::pair<double, std::string>> cantilever_modes(double EIy, double EIz) {
  const char* const order[] = {"1st", "2nd", "3rd", "4th"};
  const double roots[] = {1.87510407, 4.69409113, 7.85475744, 10.99554073};
  std::vector<std::pair<double, std::string>> modes;
  for (int k = 0; k < 4; ++k) {
    const double quarter = (2 * k + 1) * M_PI / 2;
    modes.emplace_back(roots[k] * roots[k] * std::sqrt(EIy), fmt::format("{} boom bending about y", order[k]));
    modes.emplace_back(roots[k] * roots[k] * std::sqrt(EIz), fmt::format("{} boom bending about z", order[k]));
    modes.emplace_back(quarter * std::sqrt(0.3 / 2e-3), fmt::format("{} boom torsion", order[k]));
    modes.emplace_back(quarter * std::sqrt(900.0), fmt::format("{} boom extension", order[k]));
  }
  std::sort(modes.begin(), modes.end());
  return modes;
}

/// Returns a tower with a nacelle and three blades on a shaft through their middle; z up, the shaft along x.
/// @param turn  angle of everything about z [rad] @param pieces  whether each blade is an entry or two, of as many
/// elements
std::string turbine(double turn, const std::string& gravity = "gravity: [0, 0, -9.81]\n", int pieces = 1) {
  const double c = std::cos(turn), s = std::sin(turn);
  const auto vector = [&](double x, double y, double z) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", c * x - s * y, s * x + c * y, z);
  };
  std::string nodes = gravity + "nodes:\n  foot: {position: " + vector(0, 0, -40) +
                      ", fixed: true}\n  top: {position: " + vector(0, 0, 0) +
                      "}\n  hub: {position: " + vector(0, 0, 0) + "}\n";
  std::string elements =
      "elements:\n  tower: {type: beam, nodes: [foot, top], elements: 3, orientation: " + vector(1, 0, 0) +
      ", section: {EA: 3e10, GAy: 1e10, GAz: 1e10, GJ: 3e10, EIy: 2e10, EIz: 3e10, mass_per_length: 1400, Jx: 1500, "
      "Jy: 700, Jz: 700}}\n"
      "  nacelle: {type: rigid_body, node: top, mass: 7000, inertia: [9000, 9000, 9000]}\n"
      "  hub: {type: rigid_body, node: hub, mass: 2000, inertia: [2000, 2000, 2000]}\n";
  std::string joints = "joints:\n  shaft: {type: hinge, nodes: [top, hub], position: " + vector(0, 0, 0) +
                       ", axis: " + vector(1, 0, 0) + "}\n";
  for (int k = 0; k < 3; ++k) {
    const double angle = 2 * M_PI * k / 3;
    const auto radial = [&](double r) { return vector(0, -r * std::sin(angle), r * std::cos(angle)); };
    nodes += fmt::format("  root_{0}: {{position: {1}}}\n  tip_{0}: {{position: {2}}}\n", k, radial(1), radial(20));
    const auto add_beam = [&](const std::string& name, const std::string& ends, int count) {
      elements += fmt::format(
          "  {}: {{type: beam, nodes: [{}], elements: {}, orientation: {}, section: {{EA: 1e9, GAy: 1e9, GAz: 1e9, "
          "GJ: 1e8, EIy: 2.4e8, EIz: 6e7, mass_per_length: 60, Jx: 5, Jy: 2, Jz: 3}}}}\n",
          name, ends, count, vector(1, 0, 0));
    };
    if (pieces == 1) {
      add_beam(fmt::format("blade_{}", k), fmt::format("root_{0}, tip_{0}", k), 3);
    } else {
      nodes += fmt::format("  middle_{}: {{position: {}}}\n", k, radial(1 + 19.0 / 3));
      add_beam(fmt::format("blade_{}_1", k), fmt::format("root_{0}, middle_{0}", k), 1);
      add_beam(fmt::format("blade_{}_2", k), fmt::format("middle_{0}, tip_{0}", k), 2);
    }
    joints += fmt::format("  bolts_{0}: {{type: rigid, nodes: [hub, root_{0}]}}\n", k);
  }
  return nodes + elements + joints;
}

std::map<std::string, double> hertz_of(const ModesOf& model, const ModesReport& report) {
  const std::vector<std::string> names = names_of(model, report);
  std::map<std::string, double> found;
  for (std::size_t k = 0; k < names.size(); ++k) found[names[k]] = report.found.modes[k].damped_frequency();
  CHECK(found.size() == names.size());  // each name occurs once
  return found;
}

}  // namespace

TEST_CASE("modes of a cantilever have the order and the kind of their closed forms, however it is drawn",
          "[linearised]") {
  constexpr double EIy = 1, EIz = 1.9;
  const std::vector<std::pair<double, std::string>> expected = cantilever_modes(EIy, EIz);
  constexpr std::size_t count = 10;
  const Vector3 skew = Vector3(0.36, 0.48, 0.8), side = Vector3(0.8, -0.6, 0);
  for (const auto& [tip, orientation] :
       {std::pair(Vector3(1, 0, 0), Vector3(0, 1, 0)), std::pair(Vector3(0, 1, 0), Vector3(0, 0, 1)),
        std::pair(Vector3(0, 0, 1), Vector3(1, 0, 0)), std::pair(skew, side)}) {
    CAPTURE(tip.transpose());
    const ModesOf model(cantilever(tip, orientation, EIy, EIz));
    const ModesReport report = model({.count = static_cast<int>(count)});
    const std::vector<std::string> names = names_of(model, report);
    REQUIRE(names.size() == count);
    for (std::size_t k = 0; k < count; ++k) {
      CHECK(std::abs(report.found.modes[k].s) == Approx(expected[k].first).epsilon(5e-3));
      CHECK(names[k] == expected[k].second);
    }
  }
}

TEST_CASE("bending of a round cantilever has no plane: both modes of a frequency have one number", "[linearised]") {
  const std::vector<std::string> names = names_of(cantilever({0.6, 0.8, 0}, {0, 0, 1}, 1, 1), 5);
  CHECK(names == std::vector<std::string>{"1st boom bending, 1 of 2", "1st boom bending, 2 of 2", "1st boom torsion",
                                          "2nd boom bending, 1 of 2", "2nd boom bending, 2 of 2"});
}

TEST_CASE("equal modes of equal parts keep what they have in common", "[linearised]") {
  const std::vector<std::string> names = names_of(
      "nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}, c: {position: [0, 2, 0], fixed: true}, d: {position: [1, 2, "
      "0]}}\nelements:\n"
      "  boom_1: {type: beam, nodes: [a, b], elements: 3, section: {rectangle: [0.02, 0.03], young: 2e11, poisson: "
      "0.3, "
      "density: 7800}}\n"
      "  boom_2: {type: beam, nodes: [c, d], elements: 3, section: {rectangle: [0.02, 0.03], young: 2e11, poisson: "
      "0.3, "
      "density: 7800}}\n",
      4);
  CHECK(names == std::vector<std::string>{"1st boom bending about z, 1 of 2", "1st boom bending about z, 2 of 2",
                                          "1st boom bending about y, 1 of 2", "1st boom bending about y, 2 of 2"});
}

TEST_CASE("parts with equal shares of a mode are named together, in whatever order they are written", "[linearised]") {
  // Two masses on springs on a third mass whose own frequency equals theirs: w^2 = 25, 50, 100. In the slowest mode all
  // three masses have the same energy.
  const std::string mass = ", fixed: [y, z, rx, ry, rz]}", spring = ", stiffness: [25, 25, 25, 0, 0, 0]}";
  for (const auto& [first, second] : {std::pair("left", "right"), std::pair("right", "left")}) {
    const std::string a = first, b = second;
    const std::vector<std::string> names = names_of(
        "nodes: {s: {position: [0, 0, 0]" + mass + ", " + a + ": {position: [1, 0, 0]" + mass + ", " + b +
            ": {position: [-1, 0, 0]" + mass + "}\nelements:\n" + "  " + a + ": {type: point_mass, node: " + a +
            ", mass: 0.5}\n  " + b + ": {type: point_mass, node: " + b +
            ", mass: 0.5}\n  support: {type: point_mass, node: s, mass: 2}\njoints:\n"
            "  base: {type: bushing, nodes: [ground, s], stiffness: [100, 100, 100, 0, 0, 0]}\n  l: {type: bushing, "
            "nodes: [s, " +
            a + "], position: [0, 0, 0]" + spring + "\n  r: {type: bushing, nodes: [s, " + b +
            "], position: [0, 0, 0]" + spring + "\n",
        3);
    CHECK(names == std::vector<std::string>{"left, right and support", "left and right", "support along x"});
  }
}

TEST_CASE("blades and tower have the names of designers, and whirls the frequencies of the collective mode -+ the rate",
          "[linearised]") {
  constexpr double rate = 2;
  const ModesOf model(turbine(0));
  const std::map<std::string, double> found = hertz_of(model, behind_shaft(model, rate, 11));
  for (const char* name :
       {"1st tower fore-aft", "1st tower side-side", "1st blade flap, backward", "1st blade flap, collective",
        "1st blade flap, forward", "1st blade edge, backward", "1st blade edge, forward"}) {
    CAPTURE(name);
    CHECK(found.count(name) == 1);
  }
  // The tower is softer about y of its section, which is along the shaft: it moves sideways more easily.
  CHECK(found.at("1st tower side-side") < found.at("1st tower fore-aft"));
  CHECK(found.at("1st blade flap, collective") < found.at("1st blade edge, forward"));
  // Blades on a hub at rest have equal frequencies p in turning axes, and p - rate, p + rate in standing axes.
  const double apart = found.at("1st blade edge, forward") - found.at("1st blade edge, backward");
  CHECK(apart == Approx(2 * rate / two_pi).epsilon(0.1));
}

TEST_CASE("names of a turbine are the same however it is drawn", "[linearised]") {
  const ModesOf model(turbine(0)), across(turbine(M_PI / 2)), skew(turbine(0.7)), without(turbine(0.7, ""));
  const std::vector<std::string> names = names_of(model, behind_shaft(model, 2, 10));
  CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
  CHECK(names_of(across, behind_shaft(across, 2, 10)) == names);
  CHECK(names_of(skew, behind_shaft(skew, 2, 10)) == names);
  // Without gravity the axis of the tower defines the vertical.
  CHECK(names_of(without, behind_shaft(without, 2, 10)) == names);
  CHECK(names_of(model, behind_shaft(model, -2, 10)) == names);
}

TEST_CASE("pieces of a blade have its name", "[linearised]") {
  const std::string gravity = "gravity: [0, 0, -9.81]\n";
  const ModesOf whole(turbine(0, gravity)), pieces(turbine(0, gravity, 2));
  CHECK(names_of(pieces, behind_shaft(pieces, 2, 10)) == names_of(whole, behind_shaft(whole, 2, 10)));
}

TEST_CASE("the order of a blade's mode counts slower ones of mixed patterns", "[linearised]") {
  // At this rate the collective flap veers with the forward one: two modes have both.
  const ModesOf model(turbine(0));
  const std::map<std::string, double> found = hertz_of(model, behind_shaft(model, 1, 12));
  CHECK(found.count("1st blade flap") == 1);
  CHECK(found.count("1st blade flap, collective") == 0);
  REQUIRE(found.count("2nd blade flap, collective") == 1);
  CHECK(found.at("2nd blade flap, collective") > 4 * found.at("1st blade flap, backward"));
}

TEST_CASE("at rest asymmetric modes of three blades are told by the hub's tilt and yaw", "[linearised]") {
  const ModesOf model(turbine(0));
  const std::map<std::string, double> found = hertz_of(model, behind_shaft(model, 0, 10));
  for (const char* name : {"1st blade flap, collective", "1st blade flap, tilt", "1st blade flap, yaw"}) {
    CAPTURE(name);
    CHECK(found.count(name) == 1);
  }
}

TEST_CASE("lines of a Campbell diagram have the names of the modes at its last value, next to a veering too",
          "[linearised]") {
  const ModesOf model(turbine(0));
  CampbellOptions options;
  options.rotation = true;
  options.joint = "shaft";
  options.mean = true;
  options.modes = 7;
  for (const double last : {1.0, 0.9}) {  // the collective and the forward flap veer at 1 rad/s
    options.values = {0.5, last};
    const Campbell diagram = compute_campbell(model.session, options);
    const std::map<std::string, double> found = hertz_of(model, behind_shaft(model, last, 12));
    for (std::size_t k = 0; k < diagram.names.size(); ++k) {
      CAPTURE(last, diagram.names[k]);
      REQUIRE(found.count(diagram.names[k]) == 1);
      CHECK(found.at(diagram.names[k]) ==
            Approx(diagram.swept.points.back().tracks[k].s.imag() / two_pi).epsilon(1e-6));
    }
  }
}

TEST_CASE("a mode of a turbine has the name of its line in the Campbell diagram at each speed", "[linearised]") {
  const ModesOf model(turbine(0));
  CampbellOptions options;
  options.rotation = true;
  options.joint = "shaft";
  options.mean = true;
  options.values = {0, 1.8, 2.4};
  options.modes = 7;
  const Campbell diagram = compute_campbell(model.session, options);
  CHECK(std::set<std::string>(diagram.names.begin(), diagram.names.end()).size() == diagram.names.size());
  for (const SweepPoint& point : diagram.swept.points) {
    if (!point.given || point.speed == 0) continue;
    CAPTURE(point.speed);
    const std::map<std::string, double> found = hertz_of(model, behind_shaft(model, point.speed, 12));
    for (std::size_t k = 0; k < diagram.names.size(); ++k) {
      CAPTURE(diagram.names[k]);
      REQUIRE(found.count(diagram.names[k]) == 1);
      CHECK(found.at(diagram.names[k]) == Approx(point.tracks[k].s.imag() / two_pi).epsilon(1e-6));
    }
  }
}

TEST_CASE("whirls of a disc and of a shaft that turn have names by the sense of their closed forms", "[linearised]") {
  // Jt w^2 -+ Jp Om w - k = 0 (G. Genta, Dynamics of Rotating Systems (2005), ch. 4).
  constexpr double Jt = 0.02, Jp = 0.01, k = 800, speed = 100;
  for (const double sense : {1.0, -1.0}) {
    const ModesOf disc(fmt::format(
        "nodes: {{hub: {{}}, disc: {{angular_velocity: [{}, 0, 0]}}}}\n"
        "elements: {{disc: {{type: rigid_body, node: disc, mass: 5, inertia: [{}, {}, {}]}}}}\n"
        "joints:\n  mount: {{type: bushing, nodes: [ground, hub], stiffness: [2e6, 1e6, 1e6, 500, {}, {}]}}\n"
        "  axle: {{type: hinge, nodes: [hub, disc], position: [0, 0, 0], axis: [1, 0, 0]}}\n",
        sense * speed, Jp, Jt, Jt, k, k));
    const std::map<std::string, double> found = hertz_of(disc, disc({.count = 5}));
    const double gyro = Jp * speed, root = std::sqrt(gyro * gyro + 4 * k * Jt);
    CHECK(found.at("disc tilting, forward") == Approx((root + gyro) / (2 * Jt) / two_pi).epsilon(1e-6));
    CHECK(found.at("disc tilting, backward") == Approx((root - gyro) / (2 * Jt) / two_pi).epsilon(1e-6));
    CHECK(found.at("disc along the axis") == Approx(std::sqrt(2e6 / 5) / two_pi).epsilon(1e-6));
    CHECK(found.count("disc about the axis, rigid") == 1);
  }
  // A uniform round shaft in bearings: gyroscopic moments raise the forward whirl and lower the backward one.
  const ModesOf shaft(
      "nodes: {a: {angular_velocity: [0, 300, 0]}, b: {position: [0, 1, 0], angular_velocity: [0, 300, 0]}}\n"
      "elements: {shaft: {type: beam, nodes: [a, b], elements: 8, section: {circle: 0.05, young: 2e11, poisson: 0.3, "
      "density: 7800}}}\n"
      "joints:\n  left: {type: bearing, nodes: [ground, a], axis: [0, 1, 0], radial: 1e9, axial: 1e9}\n"
      "  right: {type: bearing, nodes: [ground, b], axis: [0, 1, 0], radial: 1e9}\n");
  const std::map<std::string, double> found = hertz_of(shaft, shaft({.count = 8}));
  REQUIRE(found.count("1st shaft bending, forward") == 1);
  REQUIRE(found.count("1st shaft bending, backward") == 1);
  CHECK(found.at("1st shaft bending, forward") > found.at("1st shaft bending, backward"));
  CHECK(found.count("2nd shaft bending, forward") == 1);
}

TEST_CASE("a motion along the axis does not change the sense of a whirl, unless the whirl is a small part",
          "[linearised]") {
  const ModesOf model(
      "nodes: {hub: {}, disc: {angular_velocity: [100, 0, 0]}}\n"
      "elements: {disc: {type: rigid_body, node: disc, mass: 5, inertia: [0.01, 0.02, 0.02]}}\n"
      "joints:\n  mount: {type: bushing, nodes: [ground, hub], stiffness: [2e6, 1e6, 1e6, 500, 800, 800]}\n"
      "  axle: {type: hinge, nodes: [hub, disc], position: [0, 0, 0], axis: [1, 0, 0]}\n");
  const ModesReport report = model({.count = 5});
  const std::vector<std::string> names = names_of(model, report);
  const auto mode = [&](const char* name) {
    const auto found = std::find(names.begin(), names.end(), name);
    REQUIRE(found != names.end());
    return report.found.modes[static_cast<std::size_t>(found - names.begin())];
  };
  const auto whirl = [&](const Mode& of) {
    return whirl_of(model.session.system(), report.about.state, report.equations->M, of, Vector3::UnitX());
  };
  const auto norm = [&](const Mode& of) { return std::sqrt(of.u.dot(report.equations->M * of.u).real()); };
  const Mode axial = mode("disc along the axis");
  CHECK_FALSE(whirl(axial));
  for (const auto& [name, sense] : {std::pair("disc tilting, forward", 1.0), std::pair("disc tilting, backward", -1.0)})
    for (const double share : {0.0, 0.5, 1.0, 10.0}) {  // size of the motion along the axis over that of the whirl
      CAPTURE(name, share);
      Mode both = mode(name);
      both.u += share * norm(both) / norm(axial) * axial.u;
      const std::optional<double> found = whirl(both);
      REQUIRE(found.has_value() == (share < 2));
      if (found) CHECK(*found == Approx(sense).epsilon(1e-6));
    }
}

TEST_CASE("a part at rest next to a rotor is named by its own axes, which are named if they are not inertial",
          "[linearised]") {
  const auto names = [](const std::string& turn, const std::string& axis) {
    return names_of(
        "nodes: {disc: {angular_velocity: [100, 0, 0]}, stand: {position: [0, 3, 0], rotation_vector: [0, 0, " + turn +
            "], fixed: [rx, ry, rz]}}\n"
            "elements:\n  disc: {type: rigid_body, node: disc, mass: 5, inertia: [0.01, 0.02, 0.02]}\n"
            "  stand: {type: point_mass, node: stand, mass: 1}\n"
            "joints:\n  shaft: {type: bearing, nodes: [ground, disc], axis: [1, 0, 0], radial: 1e6, axial: 1e6, "
            "tilting: 1e4}\n"
            "  base: {type: bushing, nodes: [ground, stand], axis: [0, 0, 1], second_axis: " +
            axis + ", stiffness: [100, 200, 300, 0, 0, 0]}\n",
        3);
  };
  const auto has = [](const std::vector<std::string>& all, const char* name) {
    return std::count(all.begin(), all.end(), name);
  };
  const std::vector<std::string> straight = names("0", "[1, 0, 0]"),
                                 turned = names("0.5", "[0.8775825618903728, 0.479425538604203, 0]");
  for (const char* direction : {"x", "y", "z"}) {
    CAPTURE(direction, straight, turned);
    CHECK(has(straight, fmt::format("stand along {}", direction).c_str()) == 1);
    CHECK(has(turned, fmt::format("stand along its {}", direction).c_str()) == 1);
  }
}

TEST_CASE("a shaft that is nearly vertical does not tell the sides of a tower", "[linearised]") {
  // The shaft rises at 53 and at 37 degrees: 0.6 and 0.8 of it are horizontal.
  for (const bool steep : {true, false}) {
    const ModesOf model(turbine(0, steep ? "gravity: [-7.848, 0, -5.886]\n" : "gravity: [-5.886, 0, -7.848]\n"));
    const std::vector<std::string> names = names_of(model, behind_shaft(model, 2, 10));
    CAPTURE(steep, names);
    CHECK((std::count(names.begin(), names.end(), "1st tower side-side") == 0) == steep);
  }
}

TEST_CASE("a pendulum swings about its joint, and a chain of them has modes in order", "[linearised]") {
  const auto chain = [](int count, const std::string& axis) {
    std::string nodes = "gravity: [0, 0, -9.81]\nnodes:\n", elements = "elements:\n", joints = "joints:\n";
    for (int k = 1; k <= count; ++k) {
      nodes += fmt::format("  bob_{}: {{position: [0, 0, {}]}}\n", k, -k);
      elements +=
          fmt::format("  bob_{0}: {{type: rigid_body, node: bob_{0}, mass: 1, inertia: [1e-6, 1e-6, 1e-6]}}\n", k);
      joints += fmt::format("  pivot_{}: {{type: hinge, nodes: [{}, bob_{}], position: [0, 0, {}], axis: {}}}\n", k,
                            k == 1 ? "ground" : fmt::format("bob_{}", k - 1), k, 1 - k, axis);
    }
    return names_of(nodes + elements + joints, count);
  };
  for (const auto& [axis, sideways] : {std::pair("[1, 0, 0]", "y"), std::pair("[0, 1, 0]", "x")}) {
    CHECK(chain(1, axis) == std::vector<std::string>{"bob_1 about pivot_1"});
    const std::string along = fmt::format("bob along {}", sideways);
    CHECK(chain(3, axis) == std::vector<std::string>{along, "2nd " + along, "3rd " + along});
  }
}

TEST_CASE("of several pendulums the one that swings gives its joint to the name", "[linearised]") {
  const std::vector<std::string> names = names_of(
      "gravity: [0, 0, -9.81]\nnodes: {a1: {position: [0, 0, -1]}, a2: {position: [1, 0, -2]}}\n"
      "elements:\n  bob1: {type: rigid_body, node: a1, mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
      "  bob2: {type: rigid_body, node: a2, mass: 1, inertia: [0.1, 0.1, 0.1]}\n"
      "joints:\n  p: {type: hinge, nodes: [ground, a1], position: [0, 0, 0], axis: [0, 1, 0]}\n"
      "  q: {type: hinge, nodes: [ground, a2], position: [1, 0, 0], axis: [0, 1, 0]}\n",
      2);
  CHECK(names == std::vector<std::string>{"bob about q", "bob about p"});  // sqrt(g l/(l^2 + 0.1)), l = 2 and 1
}

TEST_CASE("parts that share a mode are named together, and mixed directions have no word", "[linearised]") {
  // Two equal masses are on a line between three equal springs: sqrt(k/m) and sqrt(3 k/m), with half of the energy in
  // each mass.
  const std::vector<std::string> names = names_of(
      "nodes: {left: {position: [1, 0, 0], fixed: [y, z]}, right: {position: [2, 0, 0], fixed: [y, z]}}\n"
      "elements:\n  left: {type: point_mass, node: left, mass: 1}\n  right: {type: point_mass, node: right, mass: 1}\n"
      "  a: {type: spring_damper, nodes: [ground, left], stiffness: 1}\n"
      "  b: {type: spring_damper, nodes: [left, right], stiffness: 1}\n"
      "  c: {type: spring_damper, nodes: [right, ground], stiffness: 1}\n",
      2);
  CHECK(names == std::vector<std::string>{"left and right", "2nd left and right"});
  const std::vector<std::string> diagonal = names_of(
      "nodes: {mass: {position: [1, 1, 0], fixed: [z]}, anchor: {position: [2, 0, 0], fixed: true}}\n"
      "elements:\n  mass: {type: point_mass, node: mass, mass: 1}\n"
      "  a: {type: spring_damper, nodes: [ground, mass], stiffness: 1}\n"
      "  b: {type: spring_damper, nodes: [anchor, mass], stiffness: 2}\n",
      2);
  CHECK(diagonal == std::vector<std::string>{"mass", "2nd mass"});
}

TEST_CASE("rigid motions of a free body have no names of their own", "[linearised]") {
  const std::vector<std::string> names = names_of(
      "nodes: {a: {position: [0, 0, 0]}, b: {position: [0, 1, 0]}}\nelements: {boom: {type: beam, nodes: [a, b], "
      "elements: 6, section: {rectangle: [0.02, 0.03], young: 2e11, poisson: 0.3, density: 7800}}}\n",
      2);
  REQUIRE(names.size() == 8);
  CHECK(names[0] == "rigid motion, 1 of 6");
  CHECK(names[5] == "rigid motion, 6 of 6");
  CHECK(names[6] == "1st boom bending about z");  // 20 mm along y, so that bending about z is softer
  CHECK(names[7] == "1st boom bending about y");
}

TEST_CASE("modes of one name are numbered by their rates; around a frequency numbers are not known", "[linearised]") {
  const auto mode = [](const char* part, double rate, bool numbered) {
    ModeName name;
    name.part = part;
    name.s = {0, rate};
    name.rate = rate;
    name.numbered = numbered;
    return name;
  };
  CHECK(full_names({mode("blade", 5, true), mode("tower", 1, false), mode("blade", 2, true), mode("", 3, true),
                    mode("tower", 4, false)}) ==
        std::vector<std::string>{"2nd blade", "tower", "1st blade", "", "2nd tower"});
  std::vector<ModeName> many;
  for (int k = 1; k <= 22; ++k) many.push_back(mode("rod", k, true));
  const std::vector<std::string> numbered = full_names(many);
  CHECK(numbered[2] == "3rd rod");
  CHECK(numbered[10] == "11th rod");
  CHECK(numbered[11] == "12th rod");
  CHECK(numbered[21] == "22nd rod");
  CHECK(full_names({mode("rod", two_pi * 40, true), mode("rod", two_pi * 50, true), mode("arm", 9, true)}, false) ==
        std::vector<std::string>{"rod, at 40 Hz", "rod, at 50 Hz", "arm"});
  // Equal modes count as one.
  CHECK(full_names({mode("rod", 1, true), mode("rod", 1, true), mode("rod", 2, true)}) ==
        std::vector<std::string>{"1st rod, 1 of 2", "1st rod, 2 of 2", "2nd rod"});
  ModeName decaying = mode("oil", 3, true);
  decaying.s = -3;
  decaying.numbered = false;
  decaying.kind = ModeKind::decaying;
  CHECK(full_names({decaying}) == std::vector<std::string>{"oil, decaying"});
  // The shapes of rigid modes are arbitrary: parts that have most of them do not name them.
  ModeName left = mode("left", 0, false), right = mode("right", 0, false);
  left.kind = right.kind = ModeKind::rigid;
  CHECK(full_names({left, right}) == std::vector<std::string>{"rigid motion, 1 of 2", "rigid motion, 2 of 2"});
}

TEST_CASE("strain energies of a beam at rest add up to its potential energy, also if its section couples them",
          "[linearised]") {
  for (const char* more : {"", ", offset: [0.01, 0.02]"}) {
    const ModesOf model(fmt::format(
        "nodes: {{a: {{fixed: true}}, c: {{position: [1, 1.5, 1]}}}}\nelements:\n"
        "  boom: {{type: beam, nodes: [a, c], elements: 6, section: {{rectangle: [0.02, 0.05], young: 2e11, poisson: "
        "0.3, density: 7800{}}}}}\n",
        more));
    const ModesReport report = model({.count = 8});
    const MemberEnergies& energies = report.energies;
    for (Eigen::Index k = 0; k < 8; ++k) {
      const double strain = energies.extension.col(k).sum() + energies.torsion.col(k).sum() +
                            energies.bending_y.col(k).sum() + energies.bending_z.col(k).sum();
      CHECK(strain == Approx(energies.potential.col(k).sum()).epsilon(1e-8));
      CHECK(energies.turning.col(k).sum() > 0);
      CHECK(energies.turning.col(k).sum() < energies.kinetic.col(k).sum());
    }
  }
}

TEST_CASE("a mast that carries a heavier load is the part of its modes", "[linearised]") {
  const std::vector<std::string> names = names_of(
      "nodes: {foot: {fixed: true}, top: {position: [0, 0, 5]}}\nelements:\n"
      "  mast: {type: beam, nodes: [foot, top], elements: 4, orientation: [1, 0, 0], section: {box: {width: 0.1, "
      "height: "
      "0.2, thickness: 0.005}, young: 2e11, poisson: 0.3, density: 7800}}\n"
      "  load: {type: rigid_body, node: top, mass: 2000, inertia: [1, 1, 1]}\n",
      2);
  CHECK(names == std::vector<std::string>{"1st mast bending about z", "1st mast bending about y"});
}

TEST_CASE("patterns of blades are those of their phases", "[linearised]") {
  using Complex = std::complex<double>;
  const Vector3 axis = Vector3::UnitX();
  Matrix3 standing;  // along the axis, to the side, up
  standing << 1, 0, 0, 0, 1, 0, 0, 0, 1;
  const auto pattern = [&](int count, auto amplitude, bool out_of_plane, bool sense, bool rests) {
    std::vector<BladeAmplitude> blades;
    for (int b = 0; b < count; ++b) {
      const double psi = 2 * M_PI * b / count;  // from the upper blade on
      blades.push_back({Vector3(0, -std::sin(psi), std::cos(psi)), amplitude(psi)});
    }
    return blade_pattern(blades, axis, out_of_plane, sense, rests ? std::optional(standing) : std::nullopt);
  };
  for (const int count : {3, 4, 5}) {
    CAPTURE(count);
    CHECK(pattern(
              count, [](double) { return Complex(0, 2); }, true, true, false) == "collective");
    CHECK(pattern(
              count, [](double psi) { return std::polar(2.0, 1 - psi); }, true, true, false) == "forward");
    CHECK(pattern(
              count, [](double psi) { return std::polar(2.0, 1 + psi); }, false, true, false) == "backward");
    CHECK(pattern(
              count, [](double psi) { return std::polar(2.0, psi); }, true, false, false) == "asymmetric");
    // The upper and the lower blade move against each other: the hub tilts, or is pushed sideways.
    CHECK(pattern(
              count, [](double psi) { return Complex(std::cos(psi)); }, true, true, true) == "tilt");
    CHECK(pattern(
              count, [](double psi) { return Complex(std::sin(psi)); }, true, true, true) == "yaw");
    CHECK(pattern(
              count, [](double psi) { return Complex(std::cos(psi)); }, false, true, true) == "horizontal");
    CHECK(pattern(
              count, [](double psi) { return Complex(std::sin(psi)); }, false, true, true) == "vertical");
    CHECK(pattern(
              count, [](double psi) { return Complex(std::cos(psi + M_PI / 4)); }, true, true, true) == "asymmetric");
    CHECK(pattern(
              count, [](double psi) { return Complex(1 + std::cos(psi)); }, true, true, false) == "collective");
    CHECK(pattern(
              count, [](double) { return Complex(0); }, true, true, false)
              .empty());
  }
  CHECK(pattern(
            4, [](double psi) { return Complex(std::cos(2 * psi)); }, true, true, false) == "reactionless");
  CHECK(pattern(
            5, [](double psi) { return Complex(std::cos(2 * psi)); }, true, true, false) == "reactionless");
  CHECK(pattern(
            2, [](double psi) { return Complex(std::cos(psi)); }, true, true, false) == "differential");
  CHECK(pattern(
            2, [](double psi) { return Complex(psi < 1 ? 1 : 0); }, true, true, false)
            .empty());
}

TEST_CASE("names of several entries are short", "[linearised]") {
  CHECK(short_name(with_stars("blade_12.blade")) == "blade");
  CHECK(short_name(with_stars("blade_1.tip_mass")) == "blade.tip_mass");
  CHECK(short_name(with_stars("m7")) == "m");
  CHECK(short_name(with_stars("12")) == "*");
}

}  // namespace test_mode_names
