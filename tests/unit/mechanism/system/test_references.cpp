// Components that use unknowns of others: the assembled tangent and its parts, one weight at a time.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/system/linearise.hpp"
#include "tests/support/coordinate_gear.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/maxwell_strut.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scalar_amplitude.hpp"
#include "tests/support/state_mixer.hpp"

using namespace bielle::mechanism;
using bielle::test::CoordinateGear;
using bielle::test::MaxwellStrut;
using bielle::test::ScalarAmplitude;
using bielle::test::StateMixer;

namespace {

/// Nodes that are free, fixed, held in some directions, turning about one axis, carried, driven.
const char* const every_node = R"yaml(
gravity: [1, -2, -9.81]
nodes:
  a: {position: [0.1, 0.2, -0.3], rotation_vector: [0.3, -0.5, 0.2]}
  b: {position: [1.0, 0.4, 0.1], rotation_vector: [-0.2, 0.1, 0.9]}
  c: {position: [1.5, -0.2, 0.3], fixed: [y, rx, ry]}
  d: {position: [0.2, 0.9, 0.5], rotation_vector: [1, 0.2, 0], fixed: true}
  e: {position: [0.4, 0.7, 0.1], rotation_vector: [0.2, 0.2, 0.3]}
  f: {position: [0.7, 0.1, 0.4], motion: {x: "0.1*sin(3*t)", rx: "0.2*t", ry: "t^2", rz: "0.3*sin(t)"}}
elements:
  a: {type: rigid_body, node: a, mass: 2, centre: [0.1, 0.2, 0.05], inertia: [0.3, 0.4, 0.5], also: [e]}
  b: {type: rigid_body, node: b, mass: 1, centre: [0.1, -0.1, 0.2], inertia: [0.1, 0.12, 0.15]}
  c: {type: rigid_body, node: c, mass: 3, centre: [0.1, -0.1, 0.2], inertia: [0.1, 0.12, 0.15]}
joints:
  pivot: {type: hinge, nodes: [e, b], axis: [0.2, 0.3, 1], position: [0.5, 0.5, 0.5]}
  slide: {type: prismatic, nodes: [b, c], axis: [1, 0.3, 0.4]}
  hook: {type: spherical, nodes: [d, f], position: [0.5, 0.4, 0.4]}
drives:
  motor: {joint: pivot, rate: "0.4*sin(2*t)"}
)yaml";

/// A model with free and fixed nodes alone.
const char* const free_nodes = R"yaml(
gravity: [1, -2, -9.81]
nodes:
  a: {position: [0.1, 0.2, -0.3], rotation_vector: [0.3, -0.5, 0.2]}
  b: {position: [1.0, 0.4, 0.1], rotation_vector: [-0.2, 0.1, 0.9]}
  c: {position: [0.5, -0.2, 0.3]}
  d: {position: [0.2, 0.9, 0.5], rotation_vector: [1, 0.2, 0], fixed: true}
  e: {position: [0.4, 0.7, 0.1], rotation_vector: [0.2, 0.2, 0.3]}
elements:
  a: {type: rigid_body, node: a, mass: 2, centre: [0.1, 0.2, 0.05], inertia: [0.3, 0.4, 0.5]}
joints:
  pivot: {type: hinge, nodes: [e, b], axis: [0.2, 0.3, 1], position: [0.5, 0.5, 0.5]}
  slide: {type: prismatic, nodes: [b, c], axis: [1, 0.3, 0.4]}
  hook: {type: spherical, nodes: [d, c], position: [0.5, 0.4, 0.4]}
drives:
  motor: {joint: pivot, rate: "0.4*sin(2*t)"}
)yaml";

/// A model with a component that refers to all others, one that refers to the first, and a gear. (A drive refers to its
/// joint as well.)
struct Mixed {
  MechanismFile file;
  std::unique_ptr<System> system;
  const Component *mixer = nullptr, *strut = nullptr, *scalar = nullptr, *gear = nullptr;

  explicit Mixed(const char* text, bool carried_axes = true) : file(read_mechanism_text(text, "mixed.yaml")) {
    Model& model = file.model;
    const auto node = [&](const char* name) { return *model.find_node(name); };
    const auto joint = [&](const char* name) -> Component& { return *model.components_of({Section::joints, name})[0]; };
    auto first = std::make_unique<StateMixer>("first", std::vector{node("a")}, std::vector<const Component*>{});
    StateMixer& mixed = *first;  // in the order before the components to which it refers
    model.add(std::move(first), Entry{Section::elements, "first"}, Recorded::no);
    scalar = &model.add(std::make_unique<ScalarAmplitude>("scalar", Declaration::Scalar{"q", "m"},
                                                          ScalarAmplitude::Law{2, 0.3, 5, 0.7, 1}),
                        Entry{Section::elements, "scalar"}, Recorded::no);
    strut = &model.add(std::make_unique<MaxwellStrut>("strut", node("e"), node("c"), 30, 0.7, 2),
                       Entry{Section::elements, "strut"}, Recorded::no);
    for (const Component* component : std::initializer_list<const Component*>{&joint("slide"), strut, scalar})
      mixed.refer_to(*component);
    mixed.refer_to(*model.components_named("pivot").back());
    mixer = &mixed;
    model.add(std::make_unique<StateMixer>("second", std::vector<int>{},
                                           std::vector<const Component*>{mixer, &joint("hook")}),
              Entry{Section::elements, "second"}, Recorded::no);
    auto wheels = std::make_unique<CoordinateGear>("gear", -1.7);
    wheels->join(dynamic_cast<const Joint&>(joint("pivot")), dynamic_cast<const Joint&>(joint("slide")));
    gear = &model.add(std::move(wheels), Entry{Section::elements, "gear"}, Recorded::no);
    system = std::make_unique<System>(model);
    if (!carried_axes) system->set_aside({});
  }
};

/// A point of the unknowns: increments from a base, rates, accelerations.
struct Point {
  VectorX dq, v, a, y, y_rate, lambda;
};

Point random_point(const System& system) {
  bielle::test::Random random(11);
  return {random.vector(system.dofs(), 0.5),    random.vector(system.dofs()),
          random.vector(system.dofs()),         random.vector(system.first_orders()),
          random.vector(system.first_orders()), random.vector(system.multipliers())};
}

State state_at(const System& system, const Point& point) {
  State state = system.start(0.7);
  const State base = state;
  system.displace(state, base, point.dq);
  system.set_rates(state, point.v, point.a);
  state.first_order = point.y;
  state.first_order_rate = point.y_rate;
  state.multiplier = point.lambda;
  return state;
}

VectorX residual_at(const System& system, const Environment& environment, const Point& point) {
  VectorX r(system.size());
  system.residual(state_at(system, point), environment, r);
  return r;
}

MatrixX dense(const System& system, const std::vector<double>& values) {
  MatrixX J = MatrixX::Zero(system.size(), system.size());
  for (int column = 0; column < system.size(); ++column)
    for (int k = system.pattern().column_start()[static_cast<std::size_t>(column)];
         k < system.pattern().column_start()[static_cast<std::size_t>(column) + 1]; ++k)
      J(system.pattern().row()[static_cast<std::size_t>(k)], column) = values[static_cast<std::size_t>(k)];
  return J;
}

MatrixX tangent_of(const System& system, const Environment& environment, const Point& point,
                   const TangentWeights& weights) {
  std::vector<double> values;
  system.tangent(state_at(system, point), environment, weights, &point.dq, values);
  return dense(system, values);
}

/// Derivatives by increments, first-order unknowns and multipliers at fixed rates; by rates; by accelerations.
struct Differences {
  MatrixX K, C, M;
};

// The residual varies on a scale of 0.3 along increments: truncation of (0.01/0.3)^6 and rounding of 3 epsilon / 0.0025
// are 1e-9 and 3e-13 of the largest terms at worst, and 1e-10 at most in fact.
constexpr double accurate = 1e-9;

Differences differences(const System& system, const Environment& environment, const Point& point) {
  const int n = system.dofs(), y = system.first_orders(), m = system.multipliers(), size = system.size();
  const auto by = [&](int columns, const auto& act) {
    return bielle::test::jacobian(
        [&](const VectorX& step) -> VectorX {
          Point moved = point;
          act(moved, step);
          return residual_at(system, environment, moved);
        },
        columns, 0.01);
  };
  Differences d{MatrixX::Zero(size, size), MatrixX::Zero(size, size), MatrixX::Zero(size, size)};
  d.K.leftCols(n) = by(n, [](Point& p, const VectorX& step) { p.dq += step; });
  d.K.middleCols(n, y) = by(y, [](Point& p, const VectorX& step) { p.y += step; });
  d.K.rightCols(m) = by(m, [](Point& p, const VectorX& step) { p.lambda += step; });
  d.C.leftCols(n) = by(n, [](Point& p, const VectorX& step) { p.v += step; });
  d.C.middleCols(n, y) = by(y, [](Point& p, const VectorX& step) { p.y_rate += step; });
  d.M.leftCols(n) = by(n, [](Point& p, const VectorX& step) { p.a += step; });
  return d;
}

double distance(const MatrixX& A, const MatrixX& B) {
  return (A - B).cwiseAbs().maxCoeff() / std::max(1.0, B.cwiseAbs().maxCoeff());
}

}  // namespace

TEST_CASE("with references of all kinds on nodes of all kinds the tangent is the derivative of the residual") {
  for (const char* const text : {every_node, free_nodes})
    for (const bool carried_axes : {true, false}) {
      const Mixed mixed(text, carried_axes);
      const System& system = *mixed.system;
      const Environment& environment = mixed.file.model.environment;
      const Point point = random_point(system);
      const Differences d = differences(system, environment, point);
      const MatrixX expected_C = d.C;
      CHECK(distance(tangent_of(system, environment, point, {1, 0, 0, 0, 1}), d.K) < accurate);
      CHECK(distance(tangent_of(system, environment, point, {0, 1, 0, 1, 0}), d.C) < accurate);
      CHECK(distance(tangent_of(system, environment, point, {0, 0, 1, 0, 0}), d.M) < accurate);
      const MatrixX all = d.K + 3 * d.C + 7 * d.M;
      CHECK(distance(tangent_of(system, environment, point, {1, 3, 7, 3, 1}), all) < accurate);
      // The mixed terms are not zero: each part of the tangent, for each kind of unknown of other components.
      const int row = 0, n = system.dofs(), strut = n + system.slots_of(*mixed.strut).first_order_begin,
                scalar = system.kinematics().unknowns() + system.slots_of(*mixed.scalar).amplitude_begin;
      for (const int column : {strut, scalar}) {
        CHECK(std::abs(d.K(row, column)) > 0.01);
        CHECK(std::abs(d.C(row, column)) > 0.01);
      }
      for (int k = 0; k < system.multipliers(); ++k)
        if (k != system.slots_of(*mixed.gear).multiplier_begin)
          CHECK(std::abs(d.K(row, system.size() - system.multipliers() + k)) > 0.01);
      for (const int other : {strut, scalar}) CHECK(std::abs(d.K(other, row)) > 0.01);
    }
}

TEST_CASE("constraints of others and derivatives of forces by multipliers come each by their own weight") {
  for (const char* const text : {every_node, free_nodes}) {
    const Mixed mixed(text);
    const System& system = *mixed.system;
    const Environment& environment = mixed.file.model.environment;
    const Point point = random_point(system);
    const Differences d = differences(system, environment, point);
    const int m = system.multipliers(), n = system.size() - m;
    // B^T is the effect of multipliers on their owners: rows of B that multiply rates or increments. (The increments'
    // T(Dq) is no part of B.)
    MatrixX B = tangent_of(system, environment, point, {0, 0, 0, 0, 1, true}).bottomLeftCorner(m, n);
    const MatrixX by_multipliers = d.K.topRightCorner(n, m);
    // df/dlambda alone.
    const MatrixX forces = tangent_of(system, environment, point, {1, 0, 0, 0, 0});
    CHECK(forces.bottomRows(m).isZero(0));
    CHECK(forces.topRightCorner(n, m).cwiseAbs().maxCoeff() > 0.01);
    const MatrixX constraints = tangent_of(system, environment, point, {0, 0, 0, 0, 1});
    CHECK(constraints.topLeftCorner(n, n).isZero(0));
    CHECK(distance(forces.topRightCorner(n, m) + constraints.topRightCorner(n, m), by_multipliers) < accurate);
    // B and B^T alone: with no increment since the base they are each other's mirror image.
    Point base = point;
    std::vector<double> values;
    system.tangent(state_at(system, base), environment, {0, 0, 0, 0, 1, true}, nullptr, values);
    const MatrixX alone = dense(system, values);
    CHECK(alone.topLeftCorner(n, n).isZero(0));
    CHECK(distance(alone.topRightCorner(n, m), alone.bottomLeftCorner(m, n).transpose()) < 1e-14);
    // The only other terms are the derivatives by multipliers less those of the forces.
    CHECK(distance(alone.topRightCorner(n, m), by_multipliers - forces.topRightCorner(n, m)) < accurate);
    // With `reactions` they count in full with any stiffness.
    TangentWeights weights{0, 0, 1, 1, 1, true};
    weights.reactions = true;
    CHECK(distance(tangent_of(system, environment, point, weights).topRightCorner(n, m), by_multipliers) < accurate);
    weights.stiffness = 0.25;
    CHECK(distance(tangent_of(system, environment, point, weights).topRightCorner(n, m), by_multipliers) < accurate);
    weights.reactions = false;
    CHECK(distance(tangent_of(system, environment, point, weights).topRightCorner(n, m),
                   by_multipliers - 0.75 * forces.topRightCorner(n, m)) < accurate);
  }
}

TEST_CASE("the matrices of the linearised equations are the derivatives of the residual") {
  for (const char* const text : {every_node, free_nodes}) {
    const Mixed mixed(text);
    const System& system = *mixed.system;
    const Environment& environment = mixed.file.model.environment;
    Point point = random_point(system);
    const State state = state_at(system, point);
    // Increments from the state itself.
    const int n = system.size() - system.multipliers(), m = system.multipliers();
    const auto residual = [&](const VectorX& dx, const VectorX& dv, const VectorX& da) -> VectorX {
      State moved = state;
      system.displace(moved, state, dx.head(system.dofs()));
      system.set_rates(moved, point.v + dv.head(system.dofs()), point.a + da.head(system.dofs()));
      moved.first_order += dx.segment(system.dofs(), system.first_orders());
      moved.first_order_rate += dv.segment(system.dofs(), system.first_orders());
      moved.multiplier += dx.tail(m);
      VectorX r(system.size());
      system.residual(moved, environment, r);
      return r;
    };
    const VectorX none = VectorX::Zero(system.size());
    const auto by = [&](const auto& act) { return bielle::test::jacobian(act, system.size(), 0.01); };
    const MatrixX by_x = by([&](const VectorX&s) { return residual(s, none, none); }),
                  by_v = by([&](const VectorX&s) { return residual(none, s, none); }),
                  by_a = by([&](const VectorX&s) { return residual(none, none, s); });
    const SystemMatrices matrices = linearise(system, environment, state);
    CHECK(distance(matrices.K, by_x.topLeftCorner(n, n)) < accurate);
    CHECK(distance(matrices.C, by_v.topLeftCorner(n, n)) < accurate);
    CHECK(distance(matrices.M, by_a.topLeftCorner(n, n)) < accurate);
    CHECK(distance(MatrixX(matrices.B.transpose()) + MatrixX(matrices.F), by_x.topRightCorner(n, m)) < accurate);
    const int rate_row = system.slots_of(*mixed.file.model.components_named("pivot").back()).multiplier_begin;
    for (int row = 0; row < m; ++row) {
      const bool rate = system.constraint_kind(row) == ConstraintKind::nonholonomic;
      CHECK(rate == (row == rate_row));
      CHECK(distance(MatrixX(matrices.B).row(row), (rate ? by_v : by_x).row(n + row).head(n)) < accurate);
      CHECK(distance(MatrixX(matrices.S).row(row), rate ? MatrixX(by_x.row(n + row).head(n)) : MatrixX::Zero(1, n)) <
            accurate);
    }
    CHECK(matrices.F.nonZeros() > 0);
    CHECK(MatrixX(matrices.S).cwiseAbs().maxCoeff() > 0.01);
  }
}

namespace {

/// dPhi/dt's derivatives: rows of holonomic constraints hold d(B v)/dq by `stiffness` and B by `damping`.
void check_velocity_level(const char* text) {
  const Mixed mixed(text);
  const System& system = *mixed.system;
  const Environment& environment = mixed.file.model.environment;
  const Point point = random_point(system);
  TangentWeights weights{1, 3, 0, 0, 1};
  weights.velocity_level = true;
  const MatrixX J = tangent_of(system, environment, point, weights);
  const int m = system.multipliers(), n = system.dofs();
  const MatrixX expected = bielle::test::jacobian(
      [&](const VectorX& step) -> VectorX {
        Point moved = point;
        moved.dq += step;
        moved.v += 3 * step;
        VectorX velocity(m), acceleration(m);
        system.constraint_rates(state_at(system, moved), environment, velocity, acceleration);
        return velocity;
      },
      n, 0.01);
  for (int k = 0; k < m; ++k)
    if (system.constraint_kind(k) == ConstraintKind::holonomic) {
      INFO(system.equation_name(system.size() - m + k));
      CHECK(distance(J.row(system.size() - m + k).head(n), expected.row(k)) < accurate);
    }
}

}  // namespace

TEST_CASE("rows of the velocities of constraints are the derivatives of dPhi/dt, those of a gear too") {
  check_velocity_level(every_node);
  check_velocity_level(free_nodes);
}

TEST_CASE("a component adds flow to the first-order equation of another, and nothing to its constraints") {
  const Mixed mixed(every_node);
  const System& system = *mixed.system;
  const Environment& environment = mixed.file.model.environment;
  Point point = random_point(system);
  const int row = system.dofs() + system.slots_of(*mixed.strut).first_order_begin;
  // Alone, the strut's equation does not see the amplitude's rate; the mixers' flow on it does.
  const VectorX before = residual_at(system, environment, point);
  const int scalar = system.kinematics().unknowns() + system.slots_of(*mixed.scalar).amplitude_begin;
  point.v[scalar] += 0.5;
  const VectorX after = residual_at(system, environment, point);
  CHECK(std::abs(after[row] - before[row]) > 0.01);
  CHECK((after - before).tail(system.multipliers()).isZero(0));
}

TEST_CASE("references in a circle are refused by name, and so is a reference to oneself") {
  using bielle::test::message_of;
  const auto numbered = [](const std::function<void(StateMixer&, StateMixer&, StateMixer&)>& refer) {
    return [refer] {
      Model model;
      std::vector<StateMixer*> mixers;
      for (const char* name : {"one", "two", "three"}) {
        auto mixer = std::make_unique<StateMixer>(name, std::vector{0}, std::vector<const Component*>{});
        mixers.push_back(mixer.get());
        model.add(std::move(mixer), Entry{Section::elements, name}, Recorded::no);
      }
      refer(*mixers[0], *mixers[1], *mixers[2]);
      const System system(model);
    };
  };
  using bielle::InputError;
  CHECK_THAT(message_of<InputError>(numbered([](auto& one, auto& two, auto& three) {
               one.refer_to(two);
               two.refer_to(three);
               three.refer_to(one);
             })),
             Catch::Contains("element 'three' refers to element 'one', which refers back to it"));
  CHECK_THAT(message_of<InputError>(numbered([](auto& one, auto&, auto&) { one.refer_to(one); })),
             Catch::Contains("element 'one' refers to itself"));
  // Two references to the same component are no cycle.
  CHECK_NOTHROW(numbered([](auto& one, auto& two, auto& three) {
    one.refer_to(two);
    one.refer_to(three);
    two.refer_to(three);
  })());
}
