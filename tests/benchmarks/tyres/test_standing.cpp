// A tyre that stands: it sticks below the friction, its tread swings with its damping, and slides at the friction.
#include <string>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/second_order.hpp"

namespace test_standing {

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Eigen::Vector2d;

constexpr double m = 20, most = 0.8 * 200;  // friction of the load of 200 N
const Vector2d K(4e3 / 0.2, 3e3 / 0.3);     // stiffness of the tread

/// Returns a wheel that does not turn and is pressed in by 10 mm, under loads along the road.
std::string standing(const std::string& load, const std::string& slip) {
  return fmt::format(R"yaml(
nodes: {{hub: {{position: [0, 0, 0.49], fixed: [z, rx, ry, rz]}}}}
elements: {{wheel: {{type: rigid_body, node: hub, mass: 20, inertia: [1, 1, 1]}}}}
joints:
  tyre: {{type: tyre, nodes: [ground, hub], normal: [0, 0, 1], position: [0, 0, 0], axis: [0, 1, 0], radius: 0.5, stiffness: 2e4,
          slip: {{longitudinal: 4e3, lateral: 3e3, friction: 0.8, relaxation: [0.2, 0.3]{}}}}}
loads: {{pull: {{node: hub, force: [{}, 0]}}}}
)yaml",
                     slip, load);
}

Vector2d force_of(const Session& session) {
  const std::vector<double> force = session.read("joints/tyre/tyre_force");
  return {force[0], force[1]};
}

/// Returns a steady load, a part of the friction, which begins suddenly, and shakes.
std::string shaken(double steady) { return fmt::format("160*({} + 0.1*sin(2*pi*t)), 160*0.05", steady); }

TEST_CASE("a standing tyre that is shaken below its friction does not creep") {
  // Without damping the tread is deflected as far as the wheel has moved, at all times, up to errors of the steps.
  struct Case {
    std::string law;
    double steady;
  };
  // A tyre that falls beyond its peak holds mu N sin(1.6 pi/2) = 0.59 mu N.
  for (const Case& each :
       {Case{"", 0.4}, {", shape: 1.6", 0.2}, {", shape: 1.2, curvature: 1", 0.4}, {", stiffest_load: 150", 0.4}}) {
    CAPTURE(each.law);
    const auto crept = [&](double h) {
      Eigen::VectorXd farthest = Eigen::VectorXd::Zero(1);
      move(standing(shaken(each.steady), ", damping: 0" + each.law), h, 4, [&](const Session& session) {
        const Vector2d x = session.node("hub").x.head<2>(), u = -force_of(session).cwiseQuotient(K);
        farthest[0] = std::max(farthest[0], (x - u).norm());
      });
      return farthest;
    };
    bielle::test::check_second_order(crept, 4e-3, 2, 0.2);
    CHECK(crept(4e-3)[0] < 1e-4 * most / K.x());
  }
  // With its damping the tyre comes to the periodic motion about the equilibrium, which it keeps.
  Vector2d before, sum(0, 0);
  int count = 0;
  move(standing(shaken(0.4), ""), 2e-3, 30, [&](const Session& session) {
    const Vector2d x = session.node("hub").x.head<2>();
    if (std::abs(session.time() - 10) < 1e-6) before = x;
    if (session.time() > 29 + 1e-6) {
      sum += x;
      ++count;
    }
    if (session.time() > 30 - 1e-6) CHECK((x - before).norm() < 1e-7 * most / K.x());
  });
  REQUIRE(count == 500);
  CHECK((sum / count - Vector2d(0.4, 0.05).cwiseQuotient(K) * most).norm() < 1e-4 * most / K.x());
}

TEST_CASE("a standing tyre swings as its stiffness and damping say, with order two") {
  // m x'' + D x' + K x = W; the default is 5 ms of the stiffness, across in the ratio of the slip stiffnesses.
  const Vector2d W(0.3 * most, 0.2 * most);
  struct Case {
    std::string slip;
    double damping;
  };
  for (const Case& each : {Case{"", 0.005 * K.x()}, {", damping: 40", 40}, {", damping: 0", 0}}) {
    CAPTURE(each.slip);
    const Vector2d D(each.damping, each.damping * 0.75);
    const auto error = [&](double h) {
      Eigen::VectorXd left(2);
      move_to(standing(fmt::format("{:.17g}, {:.17g}", W.x(), W.y()), each.slip), h, 0.4, [&](const Session& session) {
        for (int k = 0; k < 2; ++k) {
          const double decay = D[k] / (2 * m), w = std::sqrt(K[k] / m - decay * decay), t = 0.4;
          const double swing = std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
          left[k] = session.node("hub").x[k] - W[k] / K[k] * (1 - swing);
        }
      });
      return left;
    };
    bielle::test::check_second_order(error, 4e-3, 2, 0.2);
  }
}

TEST_CASE("a standing tyre never has more than its friction, slides by Coulomb's law and stops") {
  for (const std::string damping : {"", ", damping: 0", ", damping: 3e3"}) {
    CAPTURE(damping);
    double speed = 0, dissipated = 0, rest = 0;
    const auto file =
        bielle::mechanism::read_mechanism_text(standing("'if(t < 0.5, 240, 0)', 0", damping), "model.yaml");
    Session session(file.model);
    bielle::mechanism::DynamicsOptions options;
    options.duration = 4;
    options.stepping.size = 1e-3;
    bielle::mechanism::Motion motion = session.dynamics(options);
    const auto slid = [&] { return session.node("hub").x.x() + force_of(session).x() / K.x(); };
    while (motion.step()) {
      const double F = force_of(session).norm(), t = session.time(), v = session.node("hub").v.x();
      CHECK(F <= most * (1 + 1e-7));  // a step ends beyond the beginning of the slip
      CHECK(motion.energy().dissipation >= dissipated - 1e-9);
      dissipated = motion.energy().dissipation;
      if (std::abs(t - 0.3) < 1e-6) speed = v;
      if (std::abs(t - 0.5) < 1e-6) CHECK((v - speed) / 0.2 == Approx((240 - most) / m).epsilon(1e-6));
      if (std::abs(t - 1.5) < 1e-6) rest = slid();
    }
    CHECK(std::abs(session.balance()) < 2e-3 * dissipated);
    CHECK(rest > 0.5);
    if (damping == ", damping: 0") {
      // The wheel oscillates on its tread by up to 8 mm, and does not move on.
      CHECK(std::abs(slid() - rest) < 2e-6);
    } else {
      CHECK(session.node("hub").v.norm() < 1e-2 * most / std::sqrt(K.x() * m));
    }
  }
}

TEST_CASE(
    "a tyre that rolls to and fro under a side force creeps by the slip of this force on the path that it rolls") {
  // F = mu N g(rho) at each rolling speed in either direction: dy/|dx| = mu N rho/C_y, rho = 3 (1 - (1 - F/(mu
  // N))^(1/3)).
  constexpr double amplitude = 0.3, F = 16, C_y = 3e3, period = 1;
  std::string text = standing(fmt::format("0, {}", F), "");
  text.replace(text.find("fixed: [z, rx, ry, rz]"), 22, "motion: {x: '0.3*sin(2*pi*t)'}, fixed: [z, rx, rz]");
  // The wheel rolls freely, and its inertia across is small: 0.2 kg need 0.01 N.
  text.replace(text.find("mass: 20, inertia: [1, 1, 1]"), 28, "mass: 0.2, inertia: [1, 1e-3, 1]");
  std::vector<double> y;
  move(text, 1e-3, 4 * period, [&](const Session& session) {
    if (session.time() > (2 + static_cast<double>(y.size())) * period - 1e-6) y.push_back(session.node("hub").x.y());
  });
  REQUIRE(y.size() == 3);
  const double rho = 3 * (1 - std::cbrt(1 - F / most)), crept = 4 * amplitude * most * rho / C_y;
  for (std::size_t k : {1u, 2u}) CHECK(y[k] - y[k - 1] == Approx(crept).epsilon(1e-3));
}

TEST_CASE("a tyre that is dragged in a circle keeps within its friction in all directions") {
  for (const std::string damping : {"", ", damping: 0", ", damping: 3e3"})
    for (const std::string relaxation : {"0.25", "[0.2, 0.3]"}) {
      CAPTURE(damping, relaxation);
      std::string text = standing("0, 0", damping);
      text.replace(text.find("fixed: [z, rx, ry, rz]"), 22,
                   "motion: {x: '0.05*sin(2*pi*t)', y: '0.05*cos(2*pi*t) - 0.05'}, fixed: [z, rx, ry, rz]");
      text.replace(text.find("[0.2, 0.3]"), 10, relaxation);
      double largest = 0;
      move(text, 5e-4, 2, [&](const Session& session) {
        largest = std::max(largest, force_of(session).norm());
        const Vector2d v = session.node("hub").v.head<2>();
        if (session.time() > 0.5) CHECK(force_of(session).dot(v) < 0);
      });
      CHECK(largest > 0.999 * most);
      // Radial return is exact for equal relaxation lengths; with others the deflections decay at different rates while
      // the direction changes.
      CHECK(largest <= most * (relaxation == "0.25" ? 1 + 1e-7 : 1.003));
    }
}

}  // namespace test_standing
