// Superelements with three interfaces, and with a corner, against geometrically exact beams and against their own
// division into parts.
//
// Section of 1 x 1, E = 1e7, without shear. Bodies are chains of linear beam elements of the stiffness of the exact
// beam, so that their difference, without the part linear in the load, is that of large deformation.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/math/so3.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/static_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_more_interfaces {
namespace {

constexpr double EI = 1e7 / 12, GJ = 7.03e5, EA = 1e7, leg = 10, floor_of_residual = 1e-6;
constexpr int elements_per_leg = 24;
const std::string section = fmt::format(
    "{{EA: {0}, GAy: 1e10, GAz: 1e10, GJ: {1}, EIy: {2}, EIz: {2}, mass_per_length: 1000, Jx: 200, Jy: 1e-3, "
    "Jz: 1e-3}}",
    EA, GJ, EI);

/// Returns two legs of ten metres from the origin, the first along x, with interfaces at both ends and, if wanted,
/// between the legs.
BeamChain two_legs(const Vector3& second, bool middle, int modes) {
  BeamChain chain;
  for (int k = 0; k <= 2 * elements_per_leg; ++k) {
    const double s = leg * k / elements_per_leg;
    chain.nodes.push_back(std::min(s, leg) * Vector3::UnitX() + std::max(0.0, s - leg) * second);
  }
  chain.y_direction = Vector3::UnitZ();
  chain.properties = {1000, EA, EI, EI, GJ, 200};
  chain.interfaces = {{0}, {2 * elements_per_leg}};
  if (middle) chain.interfaces.push_back({elements_per_leg});
  chain.modes = modes;
  return chain;
}

/// Returns the names of interfaces of these chains: a, b, c in the order above.
std::string nodes_of(const Vector3& second, const std::string& held) {
  const Vector3 middle(leg, 0, 0), tip = middle + leg * second;
  return fmt::format("nodes:\n  n0: {{{}}}\n  n1: {{position: [{}, {}, {}]}}\n  n2: {{position: [{}, {}, {}]}}\n", held,
                     middle.x(), middle.y(), middle.z(), tip.x(), tip.y(), tip.z());
}

std::string beams(int elements = elements_per_leg) {
  std::string text = "elements:\n";
  for (int k = 0; k < 2; ++k)
    text += fmt::format("  b{}: {{type: beam, nodes: [n{}, n{}], orientation: [0, 0, 1], elements: {}, section: {}}}\n",
                        k, k, k + 1, elements, section);
  return text;
}

std::string load(const std::string& name, const std::string& node, const Vector3& F, const Vector3& M) {
  return fmt::format("  {}: {{node: {}, force: [{:.17g}, {:.17g}, {:.17g}], moment: [{:.17g}, {:.17g}, {:.17g}]}}\n",
                     name, node, F.x(), F.y(), F.z(), M.x(), M.y(), M.z());
}

struct Load {
  std::string name;
  Vector3 middle, middle_moment, tip, tip_moment;
};

const Vector3 none = Vector3::Zero();
const std::vector<Load> loads = {{"middle alone", {0, 300, 900}, none, none, none},
                                 {"tip alone", none, none, {200, 150, 300}, none},
                                 {"against each other", {0, 0, -900}, none, {0, 0, 400}, none},
                                 {"moments", none, {3e3, 8e3, 0}, none, {0, -6e3, 8e3}},
                                 {"all", {500, -300, 300}, {3e3, -3e3, 2e3}, {-300, 150, 200}, {2e3, 4e3, -3e3}}};

/// Displacements, and rotations times a leg, of the middle and of the tip.
VectorX answer(const std::string& text, const std::string& middle) {
  StaticModel model(text);
  const NodeState middle_start = model.node(middle), tip_start = model.node("n2");
  REQUIRE(model.load(4, floor_of_residual) >= 0);
  VectorX result(12);
  result << model.node(middle).x - middle_start.x, leg * log_so3(middle_start.R.transpose() * model.node(middle).R),
      model.node("n2").x - tip_start.x, leg * log_so3(tip_start.R.transpose() * model.node("n2").R);
  return result;
}

/// The same loads on one superelement and on the beams.
void check_third_order(const std::string& element, const Vector3& second, double bound) {
  const std::string nodes = nodes_of(second, "fixed: true");
  for (const Load& l : loads) {
    const auto answers = [&](double f) {
      const std::string text = "loads:\n" + load("m", "n1", f * l.middle, f * l.middle_moment) +
                               load("t", "n2", f * l.tip, f * l.tip_moment);
      const VectorX exact = answer(nodes + beams() + text, "n1");
      return std::pair(VectorX(answer(nodes + "elements:\n" + element + text, "n1") - exact), exact);
    };
    constexpr double small = 1e-3;
    const VectorX linear = answers(small).first / small;
    const auto error = [&](double factor) {
      const auto [difference, exact] = answers(factor);
      return (difference - factor * linear).norm() / exact.norm();
    };
    const double full = error(1), half = error(0.5);
    CAPTURE(l.name, full, half);
    CHECK(full < bound);
    CHECK(half < 0.3 * full + 2.5e-5);  // the last for the elements of the free body's stress
  }
}

/// Returns the position of the tip as seen from the root, which turns about z by `angle` in 60 s and stays there for 20
/// s.
std::vector<Vector3> turned_tip(const std::string& elements, const Vector3& second, double angle) {
  const std::string held = fmt::format(
      "fixed: [x, y, z, rx, ry], motion: {{rz: \"if(t < 60, {:.17g}*(t/60 - sin(2*pi*t/60)/(2*pi)), {:.17g})\"}}",
      angle, angle);
  std::string nodes = nodes_of(second, held);
  if (elements.find("n1") == std::string::npos)
    nodes.erase(nodes.find("  n1:"), nodes.find("  n2:") - nodes.find("  n1:"));
  const ReadyModel model(nodes + elements);
  std::vector<Vector3> tip;
  integrate(model, Scheme::generalized_alpha(0.8), 0.1, 80, [&](const State& state) {
    tip.push_back(model.node(state, "n0").R.transpose() * model.node(state, "n2").x);
  });
  return tip;
}

double largest_difference(const std::vector<Vector3>& one, const std::vector<Vector3>& other) {
  REQUIRE(one.size() == other.size());
  double result = 0;
  for (std::size_t k = 0; k < one.size(); ++k) result = std::max(result, (one[k] - other[k]).norm());
  return result;
}

double largest_deflection(const std::vector<Vector3>& tip) {
  return largest_difference(tip, std::vector<Vector3>(tip.size(), tip.front()));
}

}  // namespace

TEST_CASE("loads on a superelement with three interfaces, in a line and at a corner: its error is of third order") {
  TemporaryFolder folder;
  for (const Vector3& second : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0.6, 0, 0.8)}) {
    CAPTURE(second.transpose());
    write_superelement(two_legs(second, true, 16).reduced().body, folder / "legs.h5");
    check_third_order(
        "  body: {type: superelement, file: " + folder.path() + "/legs.h5, nodes: {a: n0, c: n1, b: n2}}\n", second,
        1e-3);
  }
}

TEST_CASE("a frame that is turned quickly, as one superelement, as two joined and as beams") {
  TemporaryFolder folder;
  for (const Vector3& second : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0.6, 0, 0.8)}) {
    BeamChain first_leg = two_legs(second, false, 8), second_leg = first_leg;
    const auto bend = first_leg.nodes.begin() + elements_per_leg;
    first_leg.nodes = {first_leg.nodes.begin(), bend + 1};
    second_leg.nodes.erase(second_leg.nodes.begin(), second_leg.nodes.begin() + elements_per_leg);
    first_leg.interfaces[1].node = second_leg.interfaces[1].node = elements_per_leg;
    write_superelement(two_legs(second, false, 16).reduced().body, folder / "frame.h5");
    write_superelement(two_legs(second, true, 16).reduced().body, folder / "corner.h5");
    write_superelement(first_leg.reduced().body, folder / "first.h5");
    write_superelement(second_leg.reduced().body, folder / "second.h5");
    const auto element = [&](const std::string& name, const std::string& nodes) {
      return fmt::format("  {0}: {{type: superelement, file: {1}/{0}.h5, nodes: {{{2}}}}}\n", name, folder.path(),
                         nodes);
    };
    struct Errors {
      double frame, corner, joined, parts;
    };
    const auto errors = [&](double angle) -> Errors {
      const auto beam = turned_tip(beams(), second, angle);
      const auto frame = turned_tip("elements:\n" + element("frame", "a: n0, b: n2"), second, angle);
      const auto corner = turned_tip("elements:\n" + element("corner", "a: n0, c: n1, b: n2"), second, angle);
      const auto joined = turned_tip(
          "elements:\n" + element("first", "a: n0, b: n1") + element("second", "a: n1, b: n2"), second, angle);
      const double deflection = largest_deflection(beam);
      return {largest_difference(frame, beam) / deflection, largest_difference(corner, beam) / deflection,
              largest_difference(joined, beam) / deflection, largest_difference(corner, joined) / deflection};
    };
    // The deflection of the tip is 8, 4 and 6 % of the length of 20 m at 1.6 rad.
    const Errors far = errors(1.6), half = errors(0.8), near = errors(0.016);
    CAPTURE(second.transpose(), far.frame, far.corner, far.joined, half.frame, half.corner, near.parts);
    CHECK(far.joined < 3e-5);
    CHECK(far.corner < 1e-3);
    CHECK(far.frame < 1e-3);
    // One body and two joined bodies have the same linear theory.
    CHECK(near.parts < 1e-5);
    // In the straight bar errors are of third order in the load. In a rotating frame of two legs they are of second
    // order: small, and not caused by loads on its interfaces.
    const double order = second.x() == 1 ? 0.3 : 0.65;
    CHECK(half.frame < order * far.frame);
    CHECK(half.corner < order * far.corner);
  }
}

}  // namespace test_more_interfaces
