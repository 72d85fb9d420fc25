// Bristles (LuGre) in contacts: a sticking body does not creep, a sliding one follows the law's differential equation,
// on its own and on parts that turn; derivatives are exact, and no deflection generates power.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/random.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

const std::string bristles = "friction: {model: lugre, coefficient: 0.5, bristle_stiffness: 1e4, bristle_damping: 30}";

}  // namespace

TEST_CASE("a block on an incline yields by the bristles and then stays for 1000 s") {
  // tan(slope) is 0.3 and the coefficient 0.5; with regularised Coulomb friction the body would have crept by 0.7 m.
  const double slope = std::atan(0.3);
  const std::string text = contact_model(
      {{"block",
        fmt::format("position: [0, 0, {:.17g}]", 0.05 - std::pow(g * std::cos(slope) / 4 / 1e6, 1 / 1.5)),
        1,
        {0.002, 0.002, 0.002}}},
      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: block, box: [0.1, 0.1, 0.1]}], "
      "stiffness: 1e6, damping: 5, friction: {model: lugre, coefficient: 0.5, bristle_stiffness: 1e4, bristle_damping: "
      "64}}\n",
      fmt::format("[{:.17g}, 0, {:.17g}]", g * std::sin(slope), -g * std::cos(slope)));
  const auto foot = [](const Session& session) {
    return Vector3(session.node("block").x + session.node("block").R * Vector3(0, 0, -0.05));
  };
  Vector3 bent = Vector3::Zero(), settled = Vector3::Zero(), end = Vector3::Zero();
  run_contact(text, {2e-4, 2}, [&](const Session& session, const Motion&) { bent = foot(session); });
  // Bristles bend from 0 to 3e-5 m over a distance of at least -(mu/sigma_0) ln(1 - 0.3/0.5), because zdot = v (1 - z
  // sigma_0/mu) as long as the motion does not reverse. The block rocks as friction begins, and moves several times
  // this distance before it is at rest.
  const double least = -5e-5 * std::log(0.4);
  CHECK(bent.x() > 0.99 * least);
  CHECK(bent.x() < 4 * least);
  run_contact(text, {0.02, 1000}, [&](const Session& session, const Motion&) {
    end = foot(session);
    if (session.time() < 100) settled = end;
  });
  // Positions are accurate to about 1e-14 m in each of 45 000 steps; bristles drift if the body that they hold
  // vibrates.
  CHECK((end - settled).norm() < 1e-9);
}

TEST_CASE("what slides, stops and sticks follows the law's differential equation") {
  // A ball that does not turn is pressed against an inclined plane and thrown up along it.
  const double k = 1e6, v_0 = 0.3, along = -0.2 * g, down = g;
  const std::string law =
      "friction: {model: lugre, coefficient: 0.3, static: 0.45, stribeck_velocity: 0.05, viscous: "
      "0.02, bristle_stiffness: 2e3, bristle_damping: 20}";
  // C. Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995) 419: zdot = v - sigma_0 |v| z/mu(|v|), R =
  // sigma_0 z + sigma_1 zdot + sigma_2 v per unit of the normal force, mu = mu_k + (mu_s - mu_k) exp(-(v/v_s)^2). The
  // manual lets sigma_1 fall as sigma_1/sqrt(1 + (sigma_1 v/(4 mu_k))^2).
  const auto rate = [&](const Eigen::Vector3d& y) -> Eigen::Vector3d {  // x, v, z
    constexpr double sigma_0 = 2e3, sigma_1 = 20, sigma_2 = 0.02, mu_k = 0.3, mu_s = 0.45, v_s = 0.05;
    const double v = y[1], mu = mu_k + (mu_s - mu_k) * std::exp(-v * v / (v_s * v_s));
    const double zdot = v - sigma_0 * std::abs(v) * y[2] / mu;
    const double damping = sigma_1 / std::hypot(1, sigma_1 * v / (4 * mu_k));
    return {v, along - down * (sigma_0 * y[2] + damping * zdot + sigma_2 * v), zdot};
  };
  double errors[2] = {0, 0};
  for (const int fine : {0, 1}) {
    const std::string text = contact_model(
        {{"ball", fmt::format("position: [0, 0, {:.17g}], velocity: [{}, 0, 0], fixed: [z, rx, ry, rz]",
                              0.1 - std::pow(down / k, 1 / 1.5), v_0)}},
        fmt::format("  it: {{type: contact, shapes: [{{node: ball, sphere: 0.1}}, {{node: ground, plane: [0, 0, 1]}}], "
                    "stiffness: {}, {}}}\n",
                    k, law),
        fmt::format("[{:.17g}, 0, {:.17g}]", along, -down));
    Eigen::Vector3d y(0, v_0, 0);
    double time = 0;
    run_contact(text, {fine ? 5e-5 : 1e-4, 0.3, 0, 0.9}, [&](const Session& session, const Motion& motion) {
      if (session.time() > time) advance_by_runge_kutta(y, session.time() - time, 10, rate);
      time = session.time();
      errors[fine] = std::max(errors[fine], std::abs(session.node("ball").v.x() - y[1]));
      CHECK(std::abs(motion.balance()) < 1e-3);
    });
    CHECK(std::abs(y[1]) < 1e-3);  // it is at rest: a force of 0.2 g is held
  }
  CAPTURE(errors[0], errors[1]);
  CHECK(errors[1] < 2e-3 * v_0);
  CHECK(errors[0] / errors[1] > 1.8);  // the implicit Euler method is of first order
}

TEST_CASE("what sticks to a part that turns stays where it is on that part") {
  // A drum of 0.5 m turns at 20 rad/s without gravity. A ball lies on its inner wall, 0.1 m away from the foot of the
  // perpendicular, so that a fifth of the centrifugal force acts along the wall.
  for (const bool wall_first : {true, false}) {
    CAPTURE(wall_first);
    const double w = 20, R = 0.5, r = 0.05, k = 1e7;
    const double depth = std::pow(w * w * (R - r) / k, 1 / 1.5);
    const std::string wall = "{node: drum, plane: [-1, 0, 0], at: [0.5, 0, 0]}",
                      ball = "{node: ball, box: [0.1, 0.1, 0.1]}";
    const std::string text =
        contact_model({{"drum", "motion: {rx: 0, ry: 0, rz: '20*t'}"},
                       {"ball",
                        fmt::format("position: [{0:.17g}, 0.09, 0], velocity: [{1:.17g}, {2:.17g}, 0], "
                                    "angular_velocity: [0, 0, 20]",
                                    R - r + depth / 2.5, -0.09 * w, (R - r + depth / 2.5) * w),
                        1,
                        {0.002, 0.002, 0.002}}},
                      fmt::format("  it: {{type: contact, shapes: [{}, {}], stiffness: {}, damping: 1, {}}}\n",
                                  wall_first ? wall : ball, wall_first ? ball : wall, k, bristles));
    Vector3 settled = Vector3::Zero(), end = Vector3::Zero();
    run_contact(text, {5e-4, 20, 0, 0.8}, [&](const Session& session, const Motion&) {
      const NodeState& drum = session.node("drum");
      end = drum.R.transpose() * (session.node("ball").x - drum.x);
      if (session.time() < 2) settled = end;
    });
    // The drum makes 57 turns; the ball yields by about 0.2/1e4 m.
    CHECK(std::abs(end.y() - 0.09) < 1e-4);
    CHECK((end - settled).norm() < 1e-8);
  }
}

TEST_CASE("derivatives within a step are exact, and what is lost is never gained, at any deflection") {
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes:
  a: {position: [0.1, 0.05, -0.1], rotation_vector: [0.1, -0.2, 0.3]}
  b: {position: [0.2, 0.1, 1.3], rotation_vector: [-0.2, 0.1, 0.2]}
joints:
  it: {type: contact, shapes: [{node: a, box: [2, 2.2, 1.6], rounding: 0.7}, {node: b, box: [3, 2.6, 1.7], rounding: 0.7}], stiffness: 3, damping: 0.1, friction: {model: lugre, coefficient: 0.4, static: 0.6, stribeck_velocity: 2, viscous: 0.1, bristle_stiffness: 1.5, bristle_damping: 0.8}}
)yaml",
                                                 "model.yaml");
  const DenseModel dense(file.model);
  Random random(5);
  for (int round = 0; round < 6; ++round) {
    CAPTURE(round);
    State state = dense.start();
    dense.move(state, 0.05 * random.vector(dense.size()));
    dense.move_rates(state, random.vector(dense.size()));
    state.time = 0.3;
    // All corners of both bodies have bristles, with deflections up to five times the largest that sliding causes.
    state.memory[0] = 0.1;
    Eigen::Index begin = 7;
    for (const NodeState& node : dense.start().nodes) {
      state.memory.segment<3>(begin) = node.x;
      Eigen::Map<Matrix3>(state.memory.data() + begin + 3) = node.R;
      begin += 12;
    }
    state.memory[begin] = 16;
    for (int k = 0; k < 16; ++k) {
      const int corner = k / 8 * 32 + k % 8;
      state.memory.segment<2>(begin + 1 + 8 * k) << 0, corner;
      state.memory.segment<3>(begin + 1 + 8 * k + 2) = random.vector3(2);
    }
    const VectorX r = dense.residual(state), v = dense.rates(state);
    REQUIRE(r.norm() > 0);
    const Energy energy = dense.energy(state);
    const double stored =
        derivative([&](double s) { return dense.energy(dense.along_motion(state, s)).elastic; }, 1e-4);
    CHECK(energy.dissipation >= 0);
    CHECK_THAT(r.dot(v), Catch::WithinAbs(stored + energy.dissipation - energy.input, 1e-9 * r.norm() * v.norm()));
    for (const auto part : {DenseModel::Part::K, DenseModel::Part::C}) {
      const MatrixX tangent = dense.tangent(state, part);
      for (int j = 0; j < dense.size(); ++j) {
        const VectorX column = derivative(
            [&](double s) -> VectorX {
              State moved = state;
              const VectorX step = s * VectorX::Unit(dense.size(), j);
              part == DenseModel::Part::K ? dense.move(moved, step) : dense.move_rates(moved, step);
              return dense.residual(moved);
            },
            1e-3);
        CHECK((tangent.col(j) - column).norm() <= 1e-8 * (1 + tangent.norm()));
      }
    }
  }
}

TEST_CASE("bristles are zero again where shapes have parted") {
  // A ball that is pressed in slides, is thrown off and comes down: its friction begins with undeflected bristles.
  const std::string text = contact_model(
      {{"ball", "position: [0, 0, 0.096], velocity: [1, 0, 0], fixed: [rx, ry, rz]"}},
      "  it: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], stiffness: 1e6, " +
          std::string("friction: {model: lugre, coefficient: 0.5, bristle_stiffness: 1e2}") + "}\n",
      "[0, 0, -9.81]");
  bool apart = false, again = false;
  double ratio = 1;
  run_contact(text, {1e-4, 0.4}, [&](const Session& session, const Motion&) {
    const std::vector<double> force = session.read("contacts/it/force");
    if (session.read("contacts/it/state")[0] == 0) {
      apart = true;
    } else if (apart && !again) {
      again = true;
      ratio = std::abs(force[0] / force[2]);
    }
  });
  CHECK(again);
  // In a step of 1e-4 s at about 1 m/s, z changes by 1e-4 m; the largest deflection in sliding is 5e-3 m.
  CHECK(ratio <= 1.01e-2);
}
