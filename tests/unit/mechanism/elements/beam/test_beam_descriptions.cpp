// One beam described in several ways is one beam: from its other end, in two pieces, with its nodes off the
// centroid.
#include <cmath>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/beam/beam_geometry.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "tests/support/list_of_numbers.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::list;
using bielle::test::StaticModel;

namespace {

/// A rectangle with all quantities that may vary along a beam.
struct Section {
  Eigen::Vector2d size, offset, factors, point;
  double young, density;
  std::string text() const {
    return fmt::format(
        "{{rectangle: [{:.17g}, {:.17g}], young: {:.17g}, poisson: 0.25, density: {:.17g}, offset: [{:.17g}, {:.17g}], "
        "shear_factors: [{:.17g}, {:.17g}], stress_points: [[{:.17g}, {:.17g}]]}}",
        size.x(), size.y(), young, density, offset.x(), offset.y(), factors.x(), factors.y(), point.x(), point.y());
  }
  /// Returns the section as seen from the other end: x and z change their signs.
  Section reversed() const {
    Section s = *this;
    s.offset.y() *= -1;
    s.point.y() *= -1;
    return s;
  }
};

const Section first{{0.3, 0.2}, {0.05, -0.1}, {0.8, 0.7}, {0.1, 0.05}, 100, 3},
    last{{0.2, 0.25}, {0.15, 0.02}, {0.9, 0.85}, {-0.07, 0.11}, 140, 2};

Section between(double s) {
  const auto mix = [s](const auto& a, const auto& b) { return ((1 - s) * a + s * b); };
  return {mix(first.size, last.size),   mix(first.offset, last.offset), mix(first.factors, last.factors),
          mix(first.point, last.point), mix(first.young, last.young),   mix(first.density, last.density)};
}

constexpr double twist = 1.1;
const Vector3 start(0.2, -0.1, 0.3), end(1.7, 0.8, 0.9), orientation(0.2, 0.1, 1);
const BeamLine line = [] {
  const auto arc = bielle::YamlValue::parse("arc_through: [0.8, 0.9, 0.1]", "arc.yaml");
  return read_beam_line(arc, start, end);
}();
const Matrix3 start_axes = read_start_axes(
    bielle::YamlValue::parse(
        fmt::format("orientation: [{}, {}, {}]", orientation.x(), orientation.y(), orientation.z()), "arc.yaml"),
    line.start_tangent());

std::string nodes(const std::string& more = "") {
  return fmt::format(
      "gravity: [0.02, 0, -0.05]\nnodes:\n  root: {{position: {}, rotation_vector: [0, pi, 0], fixed: true}}\n"
      "  tip: {{position: {}, euler: [1, 2, 3]}}\n{}loads: {{p: {{node: tip, force: [0.02, 0.03, -0.02], moment: "
      "[0.01, "
      "0, 0.02]}}}}\n"
      "elements:\n",
      list(start), list(end), more);
}

/// Returns the part of the beam from s_a to s_b, in `elements` elements.
std::string part(const std::string& name, const std::string& a, const std::string& b, double s_a, double s_b,
                 int elements) {
  const auto s = [&](const std::string& term) { return fmt::format("({} + {}*s){}", s_a, s_b - s_a, term); };
  return fmt::format(
      "  {}: {{type: beam, nodes: [{}, {}], elements: {}, arc_through: {}, twist: {:.17g}, orientation: {}, section: "
      "[{}, {}], distributed: {{force: ['0.03*{}', 0.02, '-0.01*{}'], at: [0.1, 0.05], follower: true}}}}\n",
      name, a, b, elements, list(line.point(0.5 * (s_a + s_b))), twist * (s_b - s_a),
      list(line.frame(s_a, start_axes, twist).R.col(1)), between(s_a).text(), between(s_b).text(), s(""), s("^2"));
}

/// Returns the whole beam from end to start; loads per length in section axes of the other sense.
std::string reversed_beam(int elements) {
  return fmt::format(
      "  b: {{type: beam, nodes: [tip, root], elements: {}, arc_through: {}, twist: {:.17g}, orientation: {}, section: "
      "[{}, {}], distributed: {{force: ['-0.03*(1 - s)', 0.02, '0.01*(1 - s)^2'], at: [0.1, -0.05], "
      "follower: true}}}}\n",
      elements, list(line.point(0.5)), twist, list(line.frame(1, start_axes, twist).R.col(1)), last.reversed().text(),
      first.reversed().text());
}

/// Quantities that do not depend on the description: six eigenvalues of the beam as drawn and loaded, the tip under
/// load, the energy, and the stretch and the stress at the point of the elements `stressed` (from 0).
VectorX signature(const std::string& elements, const std::vector<std::size_t>& stressed,
                  const std::string& more_nodes = "") {
  StaticModel beam(nodes(more_nodes) + elements);
  const auto eigenvalues = [&] {
    const MatrixX K = beam.stiffness(), M = beam.dense.tangent(beam.state, DenseModel::Part::M)(beam.free, beam.free);
    const bielle::SymmetricEigenpairs eigen = bielle::symmetric_eigenpairs(0.5 * (K + K.transpose()), M).value();
    return Vector6(eigen.values.head<6>());
  };
  VectorX all(17 + 3 * static_cast<Eigen::Index>(stressed.size()));
  beam.dense.environment.load_factor = 0;
  all.head<6>() = eigenvalues();
  REQUIRE(beam.load(4, 1e-12) >= 0);
  const NodeState tip = beam.node("tip");
  const Energy energy = beam.dense.energy(beam.state);
  CHECK((tip.x - end).norm() > 0.2);
  all.segment<11>(6) << eigenvalues(), tip.x, energy.elastic, energy.gravity;
  Eigen::Index row = 17;
  for (const std::size_t k : stressed) {
    std::vector<const Component*> members;
    for (const Member& member : beam.model->members())
      if (member.recorded == Recorded::stacked) members.push_back(member.component.get());
    Declaration declaration;
    members[k]->declare(declaration);
    Slots slots;
    slots.nodes = declaration.nodes;
    slots.memory_begin = static_cast<int>(3 * k);
    slots.memories = 3;
    Eigen::Matrix<double, 16, 1> out;  // strain, resultants, stress, von_mises
    members[k]->write_output({beam.state, slots, beam.dense.environment}, out.data());
    all[row++] = out[0];
    all[row++] = out[12];
    all[row++] = out[15];
  }
  return all;
}

/// All numbers are of order one; an elasticity of 100 against loads of 0.1 causes rounding errors of about 1e-12.
double difference(const VectorX& a, const VectorX& b) {
  return ((a - b).array() / (1 + a.array().abs())).abs().maxCoeff();
}

}  // namespace

TEST_CASE("a curved, twisted and tapered beam is the same from either end, and as one or as two") {
  const VectorX one = signature(part("b", "root", "tip", 0, 1, 4), {0, 3});
  const VectorX from_tip = signature(reversed_beam(4), {3, 0});
  CAPTURE(one.transpose(), from_tip.transpose());
  CHECK(difference(one, from_tip) < 1e-11);
  const std::string middle = fmt::format("  middle: {{position: {}, bryant: [3, 2, 1]}}\n", list(line.point(0.5)));
  const VectorX two =
      signature(part("b", "root", "middle", 0, 0.5, 2) + part("c", "middle", "tip", 0.5, 1, 2), {0, 3}, middle);
  CAPTURE(two.transpose());
  CHECK(difference(one, two) < 1e-11);
}

TEST_CASE("a straight clamped beam has the same frequencies wherever its nodes stand relative to the centroid") {
  // Stretch, bending, torsion and shear of a bar whose nodes are up to three times its height away.
  const auto eigenvalues = [](const std::string& offset) {
    const StaticModel bar(
        "nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: [1, 0, 0]}}\n"
        "elements: {b: {type: beam, nodes: [root, tip], orientation: [0, 1, 0], elements: 3, section: {rectangle: "
        "[0.2, "
        "0.3], young: 2.6, poisson: 0.3, density: 1, offset: " +
        offset + "}}}\n");
    const MatrixX M = bar.dense.tangent(bar.state, DenseModel::Part::M)(bar.free, bar.free);
    return bielle::symmetric_eigenpairs(bar.stiffness(), M)->values;
  };
  const VectorX centred = eigenvalues("[0, 0]"), beside = eigenvalues("[0.4, -0.9]");
  CAPTURE(centred.transpose(), beside.transpose());
  CHECK((beside - centred).cwiseQuotient(centred).cwiseAbs().maxCoeff() < 1e-10);
}
