// Bushings, bearings and stiffness fields against their matrices and closed forms.
#include <cmath>
#include <complex>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/session/session.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/random.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using bielle::test::move;
using bielle::test::move_to;
using bielle::test::Random;

namespace {

const std::string matrix =
    "[[3, .1, .2, .3, -.2, .1], [.1, 2, .1, -.2, .3, .2], [.2, .1, 2, .1, .1, .4], [.3, -.2, .1, 1, .1, .2], "
    "[-.2, .3, .1, .1, 1.5, -.1], [.1, .2, .4, .2, -.1, 2]]";

Matrix6 matrix_entries() {
  Matrix6 K;
  K << 3, .1, .2, .3, -.2, .1, .1, 2, .1, -.2, .3, .2, .2, .1, 2, .1, .1, .4, .3, -.2, .1, 1, .1, .2, -.2, .3, .1, .1,
      1.5, -.1, .1, .2, .4, .2, -.1, 2;
  return K;
}

/// Two nodes at the origin, the bushing's frames are those of the nodes.
const std::string pair_of_nodes =
    "nodes:\n  a: {}\n  b: {}\njoints:\n  it: {type: bushing, nodes: [a, b], stiffness: " + matrix + "}\n";

void place(State& state, const Matrix3& R, const Vector3& x, const Vector6& e) {
  state.nodes[1].x = x;
  state.nodes[1].R = R;
  state.nodes[2].x = x + R * exp_so3(0.5 * e.tail<3>()) * e.head<3>();
  state.nodes[2].R = R * exp_so3(e.tail<3>());
}

/// Returns the force and moment on node b, in the axes of the middle frame.
Vector6 on_second(const DenseModel& dense, const State& state, const Vector6& e) {
  const VectorX r = dense.residual(state);
  const Matrix3 M = state.nodes[1].R * exp_so3(0.5 * e.tail<3>());
  Vector6 wrench;
  wrench << -(M.transpose() * r.segment<3>(12)), -(M.transpose() * (state.nodes[2].R * r.segment<3>(15)));
  return wrench;
}

}  // namespace

TEST_CASE("a bushing's force is that of its matrix, whatever the rotation of its carrier") {
  const auto model = model_from_text(pair_of_nodes);
  DenseModel dense(*model);
  Random random(3);
  const Matrix6 K = matrix_entries();
  for (int k = 0; k < 20; ++k) {
    const Vector6 e = 1e-6 * random.vector(6);
    State state = dense.start();
    place(state, exp_so3(random.vector_of_length(random.uniform(0, 3))), random.vector3(5), e);
    // For small rotations the moment differs from -K e by second order.
    CHECK((on_second(dense, state, e) + K * e).norm() <= 1e-5 * (K * e).norm());
    // For large rotations, forces and energies are those of a pair whose carrier is not turned.
    const Vector6 large = random.vector(6);
    place(state, exp_so3(random.vector_of_length(2)), random.vector3(5), large);
    State unturned = dense.start();
    place(unturned, Matrix3::Identity(), Vector3::Zero(), large);
    CHECK((on_second(dense, state, large) - on_second(dense, unturned, large)).norm() < 1e-13);
    // Forces along the middle frame are exact at any relative rotation, and so is the moment along psi.
    const Vector6 wrench = on_second(dense, state, large), N = K * large;
    CHECK((wrench.head<3>() + N.head<3>()).norm() < 1e-13);
    CHECK(dense.energy(state).elastic == Approx(0.5 * large.dot(N)).epsilon(1e-13));
  }
}

TEST_CASE("the second node is preferred to the first in nothing") {
  const auto model = model_from_text(pair_of_nodes);
  DenseModel dense(*model);
  Random random(5);
  for (int k = 0; k < 5; ++k) {
    State state = dense.start(), exchanged = dense.start();
    place(state, exp_so3(random.vector_of_length(2)), random.vector3(5), random.vector(6));
    exchanged.nodes[1] = state.nodes[2];
    exchanged.nodes[2] = state.nodes[1];
    const VectorX r = dense.residual(state), back = dense.residual(exchanged);
    CHECK((r.segment<6>(6) - back.segment<6>(12)).norm() < 1e-13);
    CHECK((r.segment<6>(12) - back.segment<6>(6)).norm() < 1e-13);
  }
}

TEST_CASE(
    "no work is done around a closed path of large rotations, and the stiffness is symmetric where the moment "
    "vanishes") {
  const auto model = model_from_text(pair_of_nodes);
  DenseModel dense(*model);
  // Relative rotations reach 2.5 rad. The trapezoidal rule converges exponentially on periodic functions.
  const auto rotation = [](double s) {
    return Vector3(1.5 * std::cos(s), 1.8 * std::sin(s), 0.7 * std::sin(2 * s) + 0.5);
  };
  const auto rotation_slope = [](double s) {
    return Vector3(-1.5 * std::sin(s), 1.8 * std::cos(s), 1.4 * std::cos(2 * s));
  };
  double work = 0, size = 0;
  const int points = 200;
  for (int k = 0; k < points; ++k) {
    const double s = 2 * M_PI * k / points;
    State state = dense.start();
    state.nodes[2].R = exp_so3(rotation(s));
    state.nodes[2].x = Vector3(0.4 * std::sin(s), 0.3 * std::cos(3 * s), 0.5 * std::cos(s));
    const Vector3 dx(0.4 * std::cos(s), -0.9 * std::sin(3 * s), -0.5 * std::sin(s));
    const Vector3 turn = tangent(rotation(s)) * rotation_slope(s);
    const VectorX r = dense.residual(state);
    const double power = r.segment<3>(12).dot(dx) + r.segment<3>(15).dot(turn);
    work += power * 2 * M_PI / points;
    size += std::abs(power) * 2 * M_PI / points;
  }
  CHECK(size > 1);
  CHECK(std::abs(work) < 1e-12 * size);
  // The body is at rest in the position without strain.
  State state = dense.start();
  place(state, exp_so3({0.3, -1, 0.7}), {1, 2, 3}, Vector6::Zero());
  const MatrixX K = dense.tangent(state, DenseModel::Part::K);
  CHECK((K - K.transpose()).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("masses on bushings oscillate with the frequency of their stiffness, rotations at any amplitude") {
  const std::string text = R"yaml(
nodes:
  body: {velocity: [0.2, 0, 0], angular_velocity: [0, 0, 9.5]}
elements:
  body: {type: rigid_body, node: body, mass: 2, inertia: [1, 1, 1]}
joints:
  it: {type: bushing, nodes: [ground, body], stiffness: [800, 800, 800, 20, 20, 16]}
)yaml";
  // The stiffness is equal in all directions: the force acts along the line between the points, however the body turns.
  // x = v/w sin(w t), w = 20 rad/s; rz = (9.5/4) sin(4 t), up to 136 degrees. The scheme's error is of second order.
  double x_error[2], rz_error[2];
  for (const int k : {0, 1})
    move_to(text, k == 0 ? 1e-3 : 5e-4, 2, [&](const Session& session) {
      const std::vector<double> q = session.read("joints/it/coordinate");
      x_error[k] = std::abs(session.node("body").x[0] - 0.01 * std::sin(40));
      rz_error[k] = std::abs(q[5] - 9.5 / 4 * std::sin(8));
    });
  CHECK(x_error[1] < 1e-5);
  CHECK(x_error[0] / x_error[1] == Approx(4).epsilon(0.05));
  CHECK(rz_error[1] < 1e-4);
  CHECK(rz_error[0] / rz_error[1] == Approx(4).epsilon(0.05));
}

namespace {

/// Returns a bushing with one branch between ground and a node that moves along x as prescribed.
std::string driven(const std::string& x) {
  return R"yaml(
nodes:
  end: {fixed: [y, z, rx, ry, rz], motion: {x: ")yaml" +
         x + R"yaml("}}
joints:
  it: {type: bushing, nodes: [ground, end], stiffness: [1000, 0, 0, 0, 0, 0], maxwell: [{stiffness: [500, 0, 0, 0, 0, 0], time: 0.05}]}
)yaml";
}

}  // namespace

TEST_CASE("a Maxwell branch relaxes with its time") {
  // Pulled at r = 1 m/s for T = 0.01 s: the branch carries K r tau (1 - exp(-T/tau)), and loses it exponentially.
  const double tau = 0.05, T = 0.01, at_T = 500 * tau * (1 - std::exp(-T / tau));
  double error[2] = {0, 0};
  for (const int k : {0, 1})
    move(driven("ramp(t, 0, 0.01)*0.01"), k == 0 ? 1e-3 : 5e-4, 0.2, [&](const Session& session) {
      const double t = session.time();
      if (t < T + 1e-9) return;
      const double force = -session.read("joints/it/force")[0];
      error[k] = std::max(error[k], std::abs(force - (10 + at_T * std::exp(-(t - T) / tau))));
    });
  CHECK(error[1] < 1e-4 * at_T);
  CHECK(error[0] / error[1] > 3.5);
}

TEST_CASE("a Maxwell branch has the complex stiffness of spring and damper in series") {
  const double tau = 0.05;
  for (const double w : {2.0, 20.0, 200.0}) {
    const int steps = 400;  // per period
    const double period = 2 * M_PI / w, begin = std::ceil(25 * tau / period) * period;
    std::complex<double> force = 0;
    int count = 0;
    move(driven(fmt::format("0.01*sin({}*t)", w)), period / steps, begin + period, [&](const Session& session) {
      const double t = session.time();
      if (t < begin + 0.5 * period / steps) return;
      force += -session.read("joints/it/force")[0] * std::exp(std::complex<double>(0, -w * t));
      ++count;
    });
    CHECK(count == steps);
    // x = 0.01 Im(exp(iwt)): its coefficient at exp(iwt) is 0.005/i.
    const std::complex<double> stiffness = force / static_cast<double>(steps) / std::complex<double>(0, -0.005);
    const std::complex<double> s(0, w * tau), expected = 1000. + 500. * s / (1. + s);
    CAPTURE(w);
    CHECK(std::arg(stiffness) == Approx(std::arg(expected)).epsilon(1e-3));  // the loss angle
    CHECK(std::abs(stiffness) == Approx(std::abs(expected)).epsilon(1e-4));
  }
}

TEST_CASE("a body hangs where curves, preload and branches let it") {
  const bielle::test::TemporaryFolder folder;
  std::ofstream(folder.path() + "/z.csv") << "-0.02,-20\n0,0\n0.01,2\n";  // stiff below, soft above
  const auto rest = [&](const std::string& keys, double gravity) {
    const MechanismFile file = read_mechanism_file(folder.file("model.yaml", fmt::format(R"yaml(
gravity: [0, 0, {}]
nodes:
  body: {{fixed: [x, y, rx, ry, rz]}}
elements:
  body: {{type: point_mass, node: body, mass: 2}}
joints:
  it: {{type: bushing, nodes: [ground, body], {}}}
)yaml",
                                                                                         gravity, keys)));
    Session session(file.model);
    compute_statics(session);
    return session.read("joints/it/coordinate")[2];
  };
  const std::string curve = "curves: {z: z.csv}";
  CHECK(rest(curve, -5) == Approx(-10. / 1000).epsilon(1e-9));
  CHECK(rest(curve, 0.5) == Approx(1. / 200).epsilon(1e-9));
  // Beyond its ends the curve continues as a straight line.
  CHECK(rest(curve, -20) == Approx(-40. / 1000).epsilon(1e-9));
  CHECK(rest(curve, 2) == Approx(4. / 200).epsilon(1e-9));
  CHECK(rest("stiffness: [0, 0, 1000, 0, 0, 0], preload: [0, 0, -5, 0, 0, 0]", -5) == Approx(-5. / 1000).epsilon(1e-9));
  // The force is a formula: 100 q + 1e6 q^3 = -10 at q = -0.02.
  CHECK(rest("curves: {z: \"100*q + 1e6*q^3\"}", -5) == Approx(-0.02).epsilon(1e-6));
  // The branches have relaxed.
  CHECK(rest("stiffness: [0, 0, 1000, 0, 0, 0], maxwell: [{factor: 3, time: 2}]", -5) == Approx(-0.01).epsilon(1e-9));
}

TEST_CASE("a bearing carries a turning shaft like a spring, and counts its turns") {
  move_to(R"yaml(
gravity: [0, 0, -10]
nodes:
  shaft: {angular_velocity: [0, 20, 0]}
elements:
  shaft: {type: rigid_body, node: shaft, mass: 3, inertia: [0.1, 0.2, 0.1]}
joints:
  it: {type: bearing, nodes: [ground, shaft], axis: [0, 1, 0], second_axis: [1, 0, 0],
       radial: {stiffness: [2000, 3000], damping: 400}, axial: 1e3, tilting: 500}
drives:
  motor: {joint: it, coordinate: angle, torque: 0.4}
)yaml",
          2e-3, 3, [](const Session& session) {
            const std::vector<double> q = session.read("joints/it/coordinate");
            // z of the frame along y, x along x: y along -z. 3*10/3000 down.
            CHECK(q[0] == Approx(0).margin(1e-12));
            CHECK(q[1] == Approx(0.01).epsilon(1e-9));
            CHECK(q[5] == Approx(20 * 3 + 0.5 * 2 * 9).epsilon(1e-9));  // eleven turns
            CHECK(session.read("joints/it/reaction_inertial")[2] == Approx(30).epsilon(1e-9));
          });
}

TEST_CASE("a bearing's tilt resists like a torsion spring at large tilts") {
  // The shaft is held tilted by 2 rad and turned: the moment is across its tilt, 500 * 2 N m.
  const auto model = model_from_text(
      "nodes:\n  a: {}\n  b: {}\njoints:\n  it: {type: bearing, nodes: [a, b], axis: [0, 0, 1], second_axis: [1, 0, "
      "0], radial: 1, "
      "tilting: 500}\n");
  DenseModel dense(*model);
  for (const double tilt : {1e-9, 0.2, 0.3222, 2.0, 3.0})
    for (const double turn : {0.0, 1.0, 4.0}) {
      State state = dense.start();
      state.nodes[2].R = exp_so3({0, tilt, 0}) * exp_so3({0, 0, turn});
      CHECK(dense.energy(state).elastic == Approx(250 * tilt * tilt).epsilon(1e-12));
      const Vector3 moment = state.nodes[2].R * dense.residual(state).segment<3>(15);
      CHECK((moment - Vector3(0, 500 * tilt, 0)).norm() < 1e-11 * 500 * (tilt + 1e-3));
    }
}

namespace {

/// Returns K of two nodes of Timoshenko's beam along x with the constants below.
Eigen::Matrix<double, 12, 12> beam_stiffness(double L) {
  const double EA = 4e4, GAy = 1e4, GAz = 2e4, GJ = 30, EIy = 50, EIz = 80;
  Eigen::Matrix<double, 12, 12> K = Eigen::Matrix<double, 12, 12>::Zero();
  const auto bar = [&](int i, double k) {
    K(i, i) = K(i + 6, i + 6) = k;
    K(i, i + 6) = K(i + 6, i) = -k;
  };
  bar(0, EA / L);
  bar(3, GJ / L);
  // Bending in a plane: w and theta = dw/dx of sign s.
  const auto bend = [&](int w, int theta, double EI, double GA, double s) {
    const double phi = 12 * EI / (GA * L * L), c = EI / (L * L * L * (1 + phi));
    const int at[] = {w, theta, w + 6, theta + 6};
    Eigen::Matrix4d k;
    k << 12, 6 * L, -12, 6 * L, 6 * L, (4 + phi) * L * L, -6 * L, (2 - phi) * L * L, -12, -6 * L, 12, -6 * L, 6 * L,
        (2 - phi) * L * L, -6 * L, (4 + phi) * L * L;
    const Eigen::Vector4d sign(1, s, 1, s);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) K(at[i], at[j]) += c * sign[i] * k(i, j) * sign[j];
  };
  bend(1, 5, EIz, GAy, 1);
  bend(2, 4, EIy, GAz, -1);
  return K;
}

}  // namespace

TEST_CASE("a stiffness field of a beam's matrix deflects as the beam element") {
  const bielle::test::TemporaryFolder folder;
  std::ofstream file(folder.path() + "/k.csv");
  const Eigen::Matrix<double, 12, 12> K = beam_stiffness(1.5);
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) file << fmt::format("{:.17g}{}", K(i, j), j < 11 ? "," : "\n");
  file.close();
  const auto tip = [&](const std::string& element) {
    // The beam has a general orientation: it lies along x of axes turned by (0.3, -0.5, 0.8).
    const Matrix3 R = exp_so3({0.3, -0.5, 0.8});
    const Vector3 at = 1.5 * R.col(0), y = R.col(1);
    const MechanismFile model = read_mechanism_file(folder.file(
        "model.yaml", fmt::format(R"yaml(
nodes:
  root: {{fixed: true}}
  tip: {{position: [{:.17g}, {:.17g}, {:.17g}]}}
elements:
  it: {}
loads:
  push: {{node: tip, force: [1e-4, 2e-4, -3e-4], moment: [1e-4, -2e-4, 1e-4]}}
)yaml",
                                  at[0], at[1], at[2], fmt::format(fmt::runtime(element), y[0], y[1], y[2]))));
    Session session(model.model);
    compute_statics(session);
    Vector6 moved;
    moved << session.node("tip").x - at, log_so3(session.node("tip").R);
    return moved;
  };
  const Vector6 of_beam =
      tip("{{type: beam, nodes: [root, tip], elements: 1, orientation: [{:.17g}, {:.17g}, {:.17g}], section: {{EA: "
          "4e4, GAy: 1e4, GAz: 2e4, "
          "GJ: 30, EIy: 50, EIz: 80}}}}");
  const Vector6 of_field = tip(
      "{{type: stiffness_field, nodes: [root, tip], stiffness: {{file: k.csv}}, rotation_vector: [0.3, -0.5, 0.8]}}");
  CHECK(of_beam.norm() > 1e-6);
  CHECK((of_field - of_beam).norm() < 1e-5 * of_beam.norm());  // loads so small that second order is 1e-6
}

TEST_CASE("a stiffness field says how far its matrix resists rigid motions") {
  std::string rows;
  const Eigen::Matrix<double, 12, 12> K = beam_stiffness(1.5);
  for (int i = 0; i < 12; ++i) {
    rows += i == 0 ? "[" : ", [";
    for (int j = 0; j < 12; ++j)
      rows += fmt::format("{}{:.17g}", j == 0 ? "" : ", ", K(i, j) + (i == 0 && j == 0 ? 1e-4 * K(0, 0) : 0));
    rows += "]";
  }
  const MechanismFile file = read_mechanism_text(
      "nodes:\n  a: {}\n  b: {position: [1.5, 0, 0]}\nelements:\n  it: {type: stiffness_field, nodes: [a, b], "
      "stiffness: [" +
          rows + "]}\n",
      "model.yaml");
  REQUIRE(file.warnings.size() == 1);
  CHECK_THAT(file.warnings[0], Catch::Contains("resists rigid motions of the pair by 5e-05 of its entries"));
}

TEST_CASE("a bushing that turns through half a turn ends the run and says what turns freely") {
  const auto spin = [](double h) {
    move_to(R"yaml(
nodes:
  body: {angular_velocity: [0, 0, 20]}
elements:
  body: {type: rigid_body, node: body, mass: 2, inertia: [1, 1, 1]}
joints:
  it: {type: bushing, nodes: [ground, body], stiffness: [800, 800, 800, 1, 1, 1]}
)yaml",
            h, 1, [](const Session&) {});
  };
  CHECK_THROWS_WITH(spin(1e-3),
                    Catch::Contains("bushing 'it'") && Catch::Contains("171") && Catch::Contains("`bearing`"));
  CHECK_THROWS_WITH(spin(0.03), Catch::Contains("past 180 degrees"));
}

TEST_CASE("a bearing whose shaft tilts through half a turn ends the run and says so") {
  const auto tumble = [](double h, const std::string& rate) {
    move_to("nodes:\n  body: {angular_velocity: [" + rate + R"yaml(]}
elements:
  body: {type: rigid_body, node: body, mass: 2, inertia: [1, 1, 1]}
joints:
  it: {type: bearing, nodes: [ground, body], axis: [0, 0, 1], radial: 800, axial: 800, tilting: 1}
)yaml",
            h, 1, [](const Session&) {});
  };
  CHECK_THROWS_WITH(tumble(1e-3, "20, 0, 0"),
                    Catch::Contains("bearing 'it'") && Catch::Contains("171") && Catch::Contains("`spherical`"));
  CHECK_THROWS_WITH(tumble(0.03, "0, 20, 0"), Catch::Contains("past 180 degrees"));
  CHECK_NOTHROW(tumble(1e-3, "0, 0, 20"));
}
