// The pattern of bodies that may touch: it has the pairs that are near, follows them, and its number of entries grows
// with the number of bodies.
#include <cmath>
#include <memory>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/system/system.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::Random;

namespace {

/// Returns balls of 0.05 m in a group.
/// @param nodes    text of the nodes b0, b1, .. on which they stand
/// @param carried  number of a ball that the last one carries; -1: none
std::string group_of_balls(const std::vector<std::string>& nodes, int carried = -1) {
  std::string section = "nodes:\n", elements = "elements:\n", shapes;
  for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
    section += fmt::format("  b{}: {{{}}}\n", k, nodes[static_cast<std::size_t>(k)]);
    const bool carries = carried >= 0 && k + 1 == static_cast<int>(nodes.size());
    if (k != carried)
      elements += fmt::format("  b{0}: {{type: rigid_body, node: b{0}, solid: {{sphere: 0.05, density: 1000}}{1}}}\n",
                              k, carries ? fmt::format(", also: [b{}]", carried) : "");
    shapes += fmt::format("      - {{node: b{}, sphere: 0.05, at: [0.002, 0.001, -0.003]}}\n", k);
  }
  return section + elements + "joints:\n  it:\n    type: contact\n    shapes:\n" + shapes +
         "    stiffness: 1e6\n    damping: 0.5\n    friction: {coefficient: 0.3, velocity: 0.01}\n";
}

constexpr TangentWeights all{1, 0.7, 0.3, 0, 1};

MatrixX tangent_at(const System& system, const Environment& environment, const State& state, const VectorX* dq) {
  std::vector<double> values;
  system.tangent(state, environment, all, dq, values);
  MatrixX J = MatrixX::Zero(system.size(), system.size());
  system.pattern().for_each(
      [&](int place, int row, int column) { J(row, column) = values[static_cast<std::size_t>(place)]; });
  return J;
}

/// Returns the same by central differences of the residual, along increments dq of positions from the base, of rates
/// and of accelerations.
MatrixX differences_at(const System& system, const Environment& environment, const State& base, const VectorX& dq,
                       const VectorX& v, const VectorX& a) {
  constexpr double e = 1e-6;
  MatrixX J(system.size(), system.dofs());
  const auto residual = [&](const VectorX& step) {
    State state = base;
    system.displace(state, base, dq + all.stiffness * step);
    system.set_rates(state, v + all.damping * step, a + all.mass * step);
    VectorX r(system.size());
    system.residual(state, environment, r);
    return r;
  };
  for (int j = 0; j < system.dofs(); ++j) {
    const VectorX step = e * VectorX::Unit(system.dofs(), j);
    J.col(j) = (residual(step) - residual(-step)) / (2 * e);
  }
  return J;
}

/// A component that couples all directions of its nodes in the pattern, and adds nothing.
class Coupling final : public Component {
 public:
  explicit Coupling(std::vector<int> nodes) : Component("coupling", "all"), nodes_(std::move(nodes)) {}
  void declare(Declaration& declaration) const override {
    declaration.nodes = nodes_;
    declaration.stiffness = true;
  }
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}
  void add_tangent(const LocalState&, LocalTangent&) const override {}

 private:
  std::vector<int> nodes_;
};

/// Returns the positions of all nodes at the end of a motion.
VectorX positions_after(const std::string& text, bool all_coupled, double duration, ConstraintForm form,
                        double tolerance, long& entries) {
  MechanismFile file = read_mechanism_text(text, "balls.yaml");
  if (all_coupled) {
    std::vector<int> nodes;
    for (int k = 1; k < static_cast<int>(file.model.nodes().size()); ++k) nodes.push_back(k);
    file.model.add(std::make_unique<Coupling>(nodes), {Section::elements, "all"});
  }
  Session session(file.model);
  DynamicsOptions options;
  options.duration = duration;
  options.stepping.size = 2e-4;  // some ten steps in an impact
  options.stepping.tolerance = tolerance;
  options.form = form;
  Motion motion = session.dynamics(options);
  motion.finish();
  entries = session.system().pattern().entry_count();
  const std::vector<NodeState>& nodes = session.state().nodes;
  VectorX x(3 * static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k) x.segment<3>(3 * static_cast<Eigen::Index>(k)) = nodes[k].x;
  return x;
}

}  // namespace

TEST_CASE("a ball that comes near gets its entries, and they stay while it is near") {
  const MechanismFile file = read_mechanism_text(
      group_of_balls({"position: [0, 0, 0]", "position: [0.099, 0, 0]", "position: [0, 3, 0]"}), "balls.yaml");
  const System system(file.model);
  const State start = system.start(0);
  const auto couples = [&](int one, int other) { return system.pattern().find(6 * one, 6 * other) >= 0; };
  CHECK(!couples(0, 1));
  const auto tangent = [&](const State& state) { return tangent_at(system, file.model.environment, state, nullptr); };
  tangent(start);
  CHECK((couples(0, 1) && couples(1, 0)));
  CHECK((!couples(0, 2) && !couples(1, 2)));
  const auto before = system.shared_pattern();

  State moved = start;
  const auto third_at = [&](double y) {
    VectorX dq = VectorX::Zero(system.dofs());
    dq[13] = y - 3;
    system.displace(moved, start, dq);
  };
  third_at(0.11);  // near, but not in contact
  tangent(moved);
  CHECK(system.shared_pattern() == before);
  third_at(0.099);
  CHECK(tangent(moved).block<6, 6>(0, 12).norm() > 0);
  CHECK(system.shared_pattern() != before);
  CHECK((couples(0, 1) && couples(0, 2)));
  CHECK(before->whole.find(0, 12) == -1);  // owners of the old pattern still have it
  const auto after = system.shared_pattern();
  third_at(0.3);
  CHECK(tangent(moved).block<6, 6>(0, 12).norm() == 0);
  CHECK(system.shared_pattern() == after);
  system.forget_pairs();
  CHECK((!couples(0, 1) && !couples(0, 2)));
}

TEST_CASE("tangents of pairs are the derivatives of the forces, whatever holds or carries the nodes") {
  // The fourth ball carries the third one, or none.
  const std::vector<std::string> others = {"position: [0.097, 0, 0], rotation_vector: [0.1, 0.2, -0.3]",
                                           "position: [0.05, 0.01, 0.083]",
                                           "position: [0.3, 0.2, 0.2], rotation_vector: [0.3, 0, 0.1]"};
  for (const char* held : {"", ", fixed: true", ", fixed: [x, rx, ry]"})
    for (const int carried : {-1, 2}) {
      CAPTURE(held, carried);
      std::vector<std::string> nodes = {std::string("position: [0, 0, 0]") + held};
      nodes.insert(nodes.end(), others.begin(), others.end());
      const MechanismFile file = read_mechanism_text(group_of_balls(nodes, carried), "balls.yaml");
      const System system(file.model);
      Random random(3);
      const State base = system.start(0);
      const VectorX dq = random.vector(system.dofs(), 1e-4), v = random.vector(system.dofs(), 0.1),
                    a = random.vector(system.dofs());
      State state = base;
      system.displace(state, base, dq);
      system.set_rates(state, v, a);
      const MatrixX J = tangent_at(system, file.model.environment, state, &dq),
                    expected = differences_at(system, file.model.environment, base, dq, v, a);
      CHECK(system.pattern().intermittent().size() > 0);
      CHECK((J - expected).norm() < 1e-6 * expected.norm());
    }
}

TEST_CASE("the entries of a sheet of touching balls grow with their number") {
  for (const int along : {4, 8, 16}) {
    std::vector<std::string> nodes;
    for (int k = 0; k < along * along; ++k)
      nodes.push_back(fmt::format("position: [{}, {}, 0]", 0.099 * (k / along), 0.099 * (k % along)));
    const MechanismFile file = read_mechanism_text(group_of_balls(nodes), "balls.yaml");
    const System system(file.model);
    std::vector<double> values;
    system.tangent(system.start(0), file.model.environment, all, nullptr, values);
    const int touching = 2 * along * (along - 1);
    CHECK(system.pattern().entry_count() == 36 * (along * along + 2 * touching));
  }
}

TEST_CASE("balls whose neighbours change move as with all pairs in the pattern") {
  // A fast ball arrives from far away at a row of balls, of which the last one hangs on a joint.
  std::vector<std::string> nodes = {"position: [-0.5, 0.01, 0.005], velocity: [10, 0, 0]"};
  for (int k = 0; k < 6; ++k) nodes.push_back(fmt::format("position: [{}, {}, 0]", 0.11 * k, 0.004 * (k % 3)));
  const std::string text =
      group_of_balls(nodes) + "  hang: {type: spherical, nodes: [ground, b6], position: [0.55, 0.3, 0]}\n";
  for (const ConstraintForm form : {ConstraintForm::position, ConstraintForm::stabilised})
    for (const double tolerance : {0.0, 1e-4}) {
      CAPTURE(static_cast<int>(form), tolerance);
      long few = 0, many = 0;
      const VectorX near = positions_after(text, false, 0.15, form, tolerance, few),
                    whole = positions_after(text, true, 0.15, form, tolerance, many);
      CHECK(few < many);
      CHECK((near.segment<3>(3 * 7) - Vector3(0.55, 0.008, 0)).norm() > 0.05);  // the last ball has been struck
      CHECK((near - whole).cwiseAbs().maxCoeff() < 1e-9);  // the tolerance of Newton's method, in a model of about 1 m
    }
}
