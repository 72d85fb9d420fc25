// Superelements and beams that are strained: stretch, shear, bending and torsion of a block between two ends, whose
// strain is known, against the warning of the run.
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/session/step_recorders.hpp"
#include "reduce/common/error.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace {

/// Poisson's ratio is zero: rigid ends do not suppress contraction, and the strains of the closed forms are exact.
void write_block(const std::string& path, const Eigen::Vector3d& size, const std::array<int, 3>& bricks) {
  reduce::ReductionOptions options;
  options.name = "block";
  options.materials = {{"m", reduce::Material::isotropic(1e7, 0, 1000)}};
  options.regions = {{"all", "m"}};
  options.modes.count = 4;
  for (const char* group : {"x0", "x1"}) {
    reduce::InterfaceRequest request;
    request.name = request.group = group;
    options.interfaces.push_back(request);
  }
  Progress quiet(true);
  const Eigen::Vector3d middle(0, size.y() / 2, size.z() / 2);
  const reduce::Mesh mesh =
      box_mesh({size, bricks}, [&](const Eigen::Vector3d& X) { return Eigen::Vector3d(X - middle); });
  write_superelement(reduce::reduce_body(mesh, options, quiet, 2), path);
}

/// A model whose nodes are moved to given places, and the warnings of its run.
struct Placed {
  ReadyModel model;
  State state;
  explicit Placed(const std::string& text) : model(text), state(model.system.start(0)) {}

  void put(const std::string& node, const Vector3& x, const Vector3& turn) {
    NodeState& place = state.nodes[static_cast<std::size_t>(*model.file.model.find_node(node))];
    place.x = x;
    place.R = exp_so3(turn);
  }
  std::string says() {
    StepRecorders gatherers(model.file.model);
    gatherers.begin();
    gatherers.add(state, model.system.slots(), model.environment());
    for (const ResultArray& array : gatherers.results()) values[array.dataset] = array.values.front();
    return gatherers.summary();
  }
  double error() const { return values.at("validity/m/error"); }
  double strain() const { return values.at("validity/m/strain"); }
  std::map<std::string, double> values;
};

/// The block of length 1 with its end b displaced and turned; the zero components are not given.
struct Block : Placed {
  Block(const TemporaryFolder& folder, const Vector3& moved, const Vector3& turn, const std::string& more = "")
      : Placed(fmt::format("nodes: {{a: {{}}, b: {{position: [1, 0, 0]}}}}\n"
                           "elements: {{m: {{type: superelement, file: {}/block.h5, nodes: {{x0: a, x1: b}}{}}}}}\n",
                           folder.path(), more)) {
    put("b", Vector3(1, 0, 0) + moved, turn);
  }
};

/// Returns a beam of length 1 and 8 elements along a line: place and turn of its nodes by s in 0..1.
/// @param section  a shape with its dimensions, or constants
std::string beam_says(const std::string& section, const std::function<Vector3(double)>& x,
                      const std::function<Vector3(double)>& turn) {
  Placed beam(
      "nodes: {a: {}, b: {position: [1, 0, 0]}}\nelements: {m: {type: beam, nodes: [a, b], elements: 8, section: {" +
      section + (section.starts_with("EA") ? "" : ", young: 2e11, poisson: 0.3, density: 7800") + "}}}\n");
  for (int k = 0; k <= 8; ++k)
    beam.put(k == 0 ? "a" : k == 8 ? "b" : fmt::format("m.{}", k), x(k / 8.0), turn(k / 8.0));
  return beam.says();
}

}  // namespace

TEST_CASE("a superelement that is stretched warns by its strain") {
  const TemporaryFolder folder;
  write_block(folder / "block.h5", {1, 0.1, 0.1}, {10, 1, 1});
  const Vector3 straight = Vector3::Zero();
  for (const double e : {0.1, -0.1, 0.03}) {
    Block found(folder, {e, 0, 0}, straight);
    const std::string text = found.says();
    CAPTURE(e, text);
    // Linear coordinates differ from the interfaces' displacements to second order.
    CHECK(std::abs(found.error() - std::abs(e)) < e * e);
    CHECK(std::abs(found.strain() - std::abs(e)) < e * e);
    CHECK_THAT(text, Contains("warning: superelement 'm' is strained by") && Contains("% in the mean"));
  }
  CHECK(Block(folder, {5e-4, 0, 0}, straight).says().empty());
  CHECK_THAT(message_of<ComputationError>([&] {
               Block(folder, {0.1, 0, 0}, straight, ", largest_error: 0.05").says();
             }),
             Contains("% in the mean") && Contains("largest_error"));
  // A rigid motion causes no strain.
  Block turned(folder, {-1, 1, 0}, {0, 0, M_PI / 2});
  turned.put("a", Vector3::Zero(), {0, 0, M_PI / 2});
  CHECK(turned.says().empty());
  CHECK(turned.strain() < 1e-9);
}

TEST_CASE(
    "bending does not look like stretch: the mean strain of a bent bar is none, and the largest is at its surface") {
  const TemporaryFolder folder;
  write_block(folder / "block.h5", {1, 0.1, 0.1}, {20, 2, 2});
  // An arc of the length 1 that turns by 0.3 rad.
  const double angle = 0.3;
  Block bent(folder, {std::sin(angle) / angle - 1, (1 - std::cos(angle)) / angle, 0}, {0, 0, angle});
  const std::string text = bent.says();
  CAPTURE(text);
  CHECK(bent.strain() < 1.05 * angle * 0.05);
  CHECK(bent.strain() > 0.7 * angle * 0.05);  // two elements across
  CHECK(bent.error() == Approx(0.006 * angle * angle).epsilon(0.01));
}

TEST_CASE("a superelement of an earlier version, whose file holds no strains, gives no warning") {
  const TemporaryFolder folder;
  write_block(folder / "block.h5", {1, 0.1, 0.1}, {10, 1, 1});
  Superelement body = read_superelement(folder / "block.h5");
  body.strains.resize(0, 0);
  write_superelement(body, folder / "block.h5");
  Block found(folder, {0.1, 0, 0}, Vector3::Zero());
  CHECK_THAT(found.says(), !Contains("strained"));
  CHECK(found.strain() == 0);
}

TEST_CASE("shear and torsion of a stout superelement are seen, which turns and chords do not show") {
  const TemporaryFolder folder;
  // A plate between two faces, 1 thick and 4 x 4, whose sides are free of stress.
  write_block(folder / "block.h5", {1, 4, 4}, {2, 6, 6});
  const double gamma = 0.09;
  Block sheared(folder, {0, gamma, 0}, Vector3::Zero());
  CHECK_THAT(sheared.says(), Contains("warning: superelement 'm' is strained by"));
  CHECK(sheared.error() == Approx(2.0 / 3 * gamma).epsilon(0.2));
  // A cube whose faces are turned by theta: sides of a long square bar have gamma = 0.675 theta, edges theta/sqrt(2)
  // where they are held. The mean is zero.
  write_block(folder / "block.h5", {1, 1, 1}, {4, 4, 4});
  const double theta = 0.1;
  Block twisted(folder, Vector3::Zero(), {theta, 0, 0});
  CHECK_THAT(twisted.says(), Contains("warning: superelement 'm' is strained by"));
  CHECK(twisted.strain() > 2.0 / 3 * 0.675 * theta * 0.7);
  CHECK(twisted.strain() < 2.0 / 3 * theta);
  CHECK(twisted.error() < 1e-3);
}

TEST_CASE("beams say how far they are strained: stretch, bending, torsion") {
  const std::string circle = "circle: 0.02", upright = "rectangle: [0.02, 0.04]";
  const auto none = [](double) -> Vector3 { return Vector3::Zero(); };
  const auto stretch = [&](double e) {
    return beam_says(
        "circle: 0.2",  // thick enough for its tension
        [e](double s) -> Vector3 {
          return {s * (1 + e), 0, 0};
        },
        none);
  };
  CHECK_THAT(stretch(0.5), Contains("warning: beam 'm' is strained by 50 %"));
  CHECK_THAT(stretch(-0.03), Contains("warning: beam 'm' is strained by 3 %"));
  CHECK(stretch(0.019).empty());
  // Bent to an arc of 1.5 rad, its length kept: the outermost fibre has 1.5 times its distance from the axis.
  constexpr double angle = 1.5;
  const auto arc = [&](const std::string& section, bool in_y) {
    return beam_says(
        section,
        [&](double s) -> Vector3 {
          const double across = (1 - std::cos(angle * s)) / angle;
          return {std::sin(angle * s) / angle, in_y ? across : 0, in_y ? 0 : across};
        },
        [&](double s) -> Vector3 {
          return {0, in_y ? 0 : -angle * s, in_y ? angle * s : 0};
        });
  };
  CHECK_THAT(arc(circle, true), Contains("beam 'm' is strained by 3 %"));
  CHECK_THAT(arc(circle, false), Contains("beam 'm' is strained by 3 %"));
  CHECK_THAT(arc(upright, false), Contains("beam 'm' is strained by 3 %"));
  CHECK(arc(upright, true).empty());
  // By constants it is as thick as a rectangle of its radii of gyration: those of 0.02 x 0.04 m, of no mass.
  CHECK_THAT(arc("EA: 1.6e8, GAy: 5e7, GAz: 5e7, GJ: 1e4, EIy: 21333.3333333, EIz: 5333.33333333", false),
             Contains("beam 'm' is strained by 3 %") && Contains("if it is as thick as EI and EA say"));
  // Twisted by 2.4 rad: gamma = 2.4 * 0.02 at the surface, of which two thirds count.
  const auto twist = [&](double whole) {
    return beam_says(
        circle,
        [](double s) -> Vector3 {
          return {s, 0, 0};
        },
        [whole](double s) -> Vector3 {
          return {whole * s, 0, 0};
        });
  };
  CHECK_THAT(twist(2.4), Contains("beam 'm' is strained by 3.2 %"));
  CHECK(twist(1.4).empty());
}
