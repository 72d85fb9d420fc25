// Bushings whose stiffness and damping are tables over a measured speed.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/session/motion.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/eigenvalues.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/random.hpp"
#include "tests/support/session_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::message_of;
using bielle::test::model_from_text;
using bielle::test::Random;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_bushing_film {
namespace {

std::string by_rows(const MatrixX& A) {
  std::string text;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    text += i == 0 ? "[[" : "], [";
    for (Eigen::Index j = 0; j < A.cols(); ++j) text += fmt::format("{}{:.17g}", j == 0 ? "" : ", ", A(i, j));
  }
  return text + "]]";
}

/// Returns a matrix with a positive definite symmetric part in its first n rows and columns.
Matrix6 definite(Random& random, Eigen::Index n) {
  Matrix6 A = Matrix6::Zero();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) A(i, j) = random.uniform(-1, 1) + (i == j ? 7 : 0);
  return A;
}

/// Returns a row of a table of n measures.
std::string row(double speed, const Matrix6& K, const Matrix6& D, Eigen::Index n) {
  std::string text = fmt::format("{:.17g}", speed);
  for (const Matrix6* A : {&K, &D})
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) text += fmt::format(",{:.17g}", (*A)(i, j));
  return text + "\n";
}

std::string pair_joined_by(const std::string& keys) {
  return "nodes:\n  a: {}\n  b: {}\njoints:\n  it: {type: bushing, nodes: [a, b], " + keys + "}\n";
}

/// Returns a shaft that is driven faster and faster, and a body in a seal whose cross-coupled stiffness grows with its
/// speed.
std::string driven_seal(const std::string& file) {
  return fmt::format(R"yaml(
nodes:
  shaft: {{position: [0, 0, 0]}}
  body: {{position: [0, 0, 0], fixed: [z, rx, ry, rz], velocity: [0.1, 0, 0]}}
elements:
  shaft: {{type: rigid_body, node: shaft, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
  body: {{type: point_mass, node: body, mass: 2}}
joints:
  main: {{type: hinge, nodes: [ground, shaft], axis: [0, 0, 1]}}
  seal: {{type: bushing, nodes: [ground, body], axis: [0, 0, 1], film: {{table: {}, speed: main.angle.rate}}}}
drives:
  motor: {{joint: main, torque: "0.1*cos(5*t)"}}
measures: {{force: seal.force.x, reaction: seal.reaction.x, moved: body.position.x, speed: body.velocity.x, across: body.position.y, sideways: body.velocity.y, turning: main.angle.rate}}
)yaml",
                     file);
}

}  // namespace
}  // namespace test_bushing_film
using namespace test_bushing_film;

TEST_CASE("the forces of a bushing's film are those of constant matrices between the speeds, and of its ends beyond") {
  const bielle::test::TemporaryFolder folder;
  Random random(11);
  for (const Eigen::Index n : {2, 6}) {
    const Matrix6 K[] = {definite(random, n), definite(random, n)}, D[] = {definite(random, n), definite(random, n)};
    const std::string file = folder.path() + "/film.csv";
    std::ofstream(file) << row(100, K[0], D[0], n) << row(300, K[1], D[1], n);
    for (const double speed : {-50.0, 100.0, 150.0, 300.0, 1000.0}) {
      CAPTURE(n, speed);
      const double s = std::clamp((speed - 100) / 200, 0.0, 1.0);
      const Matrix6 K_s = (1 - s) * K[0] + s * K[1], D_s = (1 - s) * D[0] + s * D[1];
      const auto film = model_from_text(pair_joined_by(
                     fmt::format("film: {{{}: {}, speed: {}}}", n == 2 ? "table" : "matrices", file, speed))),
                 constant = model_from_text(
                     pair_joined_by("unsymmetric: true, stiffness: " + by_rows(K_s) + ", damping: " + by_rows(D_s)));
      const DenseModel of_film(*film), of_constant(*constant);
      State state = of_film.start();
      of_film.move(state, 0.3 * random.vector(of_film.size()));
      of_film.move_rates(state, random.vector(of_film.size()));
      const VectorX difference = of_film.residual(state) - of_constant.residual(state);
      CHECK(of_film.residual(state).norm() > 1);
      CHECK(difference.norm() < 1e-12);
    }
  }
}

// With K = [[k, a w], [-a w, k]] and damping c, the forward whirl of the frequency sqrt(k/m) grows from a w = c
// sqrt(k/m) on.
TEST_CASE("a body in a seal whirls from the speed at which its cross-coupled stiffness overcomes the damping") {
  const double k = 5e4, m = 2, c = 30, a = 4, limit = c * std::sqrt(k / m) / a;
  const bielle::test::TemporaryFolder folder;
  const std::string file = folder.path() + "/seal.csv";
  std::ofstream(file) << fmt::format("0,{0},0,0,{0},{1},0,0,{1}\n2000,{0},{2},{3},{0},{1},0,0,{1}\n", k, c, 2000 * a,
                                     -2000 * a);
  const auto growth = [&](double speed) {
    const auto model = model_from_text(
        fmt::format("nodes: {{disc: {{position: [0, 0, 0]}}}}\nelements: {{disc: {{type: point_mass, node: disc, mass: "
                    "{}}}}}\njoints: {{seal: {{type: bushing, nodes: [ground, disc], axis: [0, 0, 1], film: {{table: "
                    "{}, speed: {:.17g}}}}}}}",
                    m, file, speed));
    const DenseModel dense(*model);
    const State state = dense.start();
    MatrixX A = MatrixX::Zero(4, 4);
    A.topRightCorner(2, 2).setIdentity();
    A.bottomLeftCorner(2, 2) = -dense.tangent(state, DenseModel::Part::K).block(6, 6, 2, 2) / m;
    A.bottomRightCorner(2, 2) = -dense.tangent(state, DenseModel::Part::C).block(6, 6, 2, 2) / m;
    return bielle::test::eigenvalues(A).real().maxCoeff();
  };
  REQUIRE(limit < 2000);
  CHECK(growth(limit) == Approx(0).margin(1e-6));
  CHECK(growth(0.999 * limit) < -1e-3);
  CHECK(growth(1.001 * limit) > 1e-3);
}

TEST_CASE("the account of energy closes with second order while the speed of a film changes, and forces include it") {
  const bielle::test::TemporaryFolder folder;
  const std::string file = folder.path() + "/seal.csv";
  std::ofstream(file) << "-100,2e3,-500,500,2e3,5,0,0,5\n100,3e3,500,-500,4e3,9,1,-1,9\n";
  double balance[2], largest = 0;
  for (const int k : {0, 1}) {
    Session session = session_of(driven_seal(file));
    Motion motion = session.dynamics(steps_of(1, k == 0 ? 2e-3 : 1e-3));
    while (motion.step()) {
      const double s = (session.measure("turning") + 100) / 200, x = session.measure("moved"),
                   v = session.measure("speed"), y = session.measure("across"), w = session.measure("sideways");
      CHECK((s > 0 && s < 1));
      const double force = (2e3 + 1e3 * s) * x + (-500 + 1e3 * s) * y + (5 + 4 * s) * v + s * w;
      CHECK(session.measure("force") == Approx(-force).epsilon(1e-9).margin(1e-12));
      CHECK(session.measure("reaction") == Approx(-force).epsilon(1e-9).margin(1e-12));
      largest = std::max(largest, std::abs(session.measure("turning")));
    }
    balance[k] = motion.balance();
  }
  CHECK(largest > 15);
  CHECK(std::abs(balance[0]) < 1e-4);
  CHECK(balance[0] / balance[1] == Approx(4).epsilon(0.1));
}

// A hinge's reaction is computed from its own forces, those of the bushing meanwhile.
TEST_CASE("the speed of a film may follow from the reactions of other joints, also of other bushings") {
  const bielle::test::TemporaryFolder folder;
  const std::string file = folder.path() + "/seal.csv";
  std::ofstream(file) << "-100,2e3,-500,500,2e3,50,0,0,50\n100,3e3,500,-500,4e3,90,1,-1,90\n";
  const auto model = [&](const std::string& speed) {
    return fmt::format(R"yaml(
nodes:
  shaft: {{position: [0, 0, 0]}}
  body: {{position: [0, 0, 0], fixed: [z, rx, ry, rz]}}
  other: {{position: [0, 0, 0], fixed: [z, rx, ry, rz]}}
elements:
  shaft: {{type: rigid_body, node: shaft, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
  body: {{type: point_mass, node: body, mass: 2}}
  other: {{type: point_mass, node: other, mass: 2}}
joints:
  main: {{type: hinge, nodes: [ground, shaft], axis: [0, 0, 1]}}
  seal: {{type: bushing, nodes: [ground, body], axis: [0, 0, 1], film: {{table: {0}, speed: "{1}"}}}}
  next: {{type: bushing, nodes: [ground, other], axis: [0, 0, 1], film: {{table: {0}, speed: "seal.reaction.y + seal.force.x"}}}}
loads:
  on_shaft: {{node: shaft, force: [50, 0, 0]}}
  on_body: {{node: body, force: [10, 0, 0]}}
  on_other: {{node: other, force: [10, 0, 0]}}
measures: {{x: body.position.x, y: body.position.y, reaction: next.reaction.x, x_2: other.position.x, y_2: other.position.y}}
)yaml",
                       file, speed);
  };
  Session session = session_of(model("-main.reaction.x"));
  session.dynamics(steps_of(5, 0.01)).finish();
  // At rest the hinge carries the 50 N and the seal its 10 N, and the coefficients are those at 50 and at -10.
  const auto displaced = [](double speed) {
    const double s = (speed + 100) / 200;
    Eigen::Matrix2d K;
    K << 2e3 + 1e3 * s, -500 + 1e3 * s, 500 - 1e3 * s, 2e3 + 2e3 * s;
    return Eigen::Vector2d(K.inverse() * Eigen::Vector2d(10, 0));
  };
  CHECK(session.measure("x") == Approx(displaced(50).x()).epsilon(1e-6));
  CHECK(session.measure("y") == Approx(displaced(50).y()).epsilon(1e-6));
  CHECK(session.measure("x_2") == Approx(displaced(-10).x()).epsilon(1e-6));
  CHECK(session.measure("y_2") == Approx(displaced(-10).y()).epsilon(1e-6));
  CHECK(session.measure("reaction") == Approx(-10).epsilon(1e-6));
}

TEST_CASE("wrong films of a bushing are refused with a sentence") {
  const bielle::test::TemporaryFolder folder;
  const auto path = [&](const char* name) { return folder.path() + "/" + name; };
  std::ofstream(path("good.csv")) << "0 1 0 0 1 1 0 0 1\n1 1 0 0 1 1 0 0 1\n";
  std::ofstream(path("single.csv")) << "0 1 0 0 1 1 0 0 1\n";
  std::ofstream(path("nan.csv")) << "0 1 0 0 1 1 0 0 1\n1 1 0 nan 1 1 0 0 1\n";
  const auto message = [&](const std::string& film, const std::string& more = "") {
    return message_of<bielle::InputError>([&] { session_of(pair_joined_by("film: {" + film + "}") + more); });
  };
  const std::string good = "table: " + path("good.csv");
  CHECK_THAT(message(good), Contains("joints.it.film") && Contains("speed"));
  CHECK_THAT(message("speed: 1"), Contains("either `table` or `matrices`"));
  CHECK_THAT(message(good + ", speed: 1, matrices: " + path("good.csv")), Contains("either `table` or `matrices`"));
  CHECK_THAT(message("speed: 1, matrices: " + path("good.csv")), Contains("film.matrices") && Contains("73 numbers"));
  CHECK_THAT(message("speed: 1, table: " + path("single.csv")), Contains("film.table") && Contains("two points"));
  CHECK_THAT(message("speed: 1, table: " + path("nan.csv")), Contains("film.table") && Contains("nan"));
  CHECK_THAT(message(good + ", speed: a.velocity"), Contains("film.speed"));
  CHECK_THAT(message(good + ", speed: it.rz.rate"), Contains("film.speed") && Contains("depends on the bushing 'it'"));
  CHECK_THAT(message(good + ", speed: twice", "measures: {twice: 2*once, once: it.force.x}\n"),
             Contains("depends on the bushing 'it' itself"));
  CHECK_THAT(message(good + ", speed: 1, sped: 2"), Contains("did you mean 'speed'"));
}
