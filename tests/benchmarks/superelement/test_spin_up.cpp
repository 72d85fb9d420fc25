// Spin-up of a flexible arm on a rotating hub, as one superelement.
//
// J. C. Simo, L. Vu-Quoc, On the dynamics of flexible beams under large overall motions - the plane case: Part II,
// J. Appl. Mech. 53 (1986) 855: EA = 2.8e7, EI = 1.4e4, mass per length 1.2, length 10; the root turns by
// psi = Om/Ts [t^2/2 + (Ts/2pi)^2 (cos(2 pi t/Ts) - 1)] up to Ts = 15 s, Om = 6 rad/s, then at Om.
// References: the tip's deflection u2 behind the line of the root, by the geometrically exact rod
// (tests/references/spin_up.py); its least value by the linear beam with the centrifugal tension of the rotating root.
// Likewise for the arm of S. Wu, E. Haug, IJNME 26 (1988) 2211: length 8, EA = 5.03132e6, EI = 566.7, mass
// per length 0.201878, Om = 4 rad/s, more than its first frequency at rest.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/beam_superelement.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

struct Arm {
  double length, mass_per_length, EA, EI, speed;
};

constexpr Arm simo_vu_quoc{10, 1.2, 2.8e7, 1.4e4, 6}, wu_haug{8, 0.201878, 5.03132e6, 566.7, 4};

/// Records of the tip's deflection seen from the root.
struct SpinUp {
  double least = 0, time_of_least = 0, at_5 = 0, at_10 = 0;

  SpinUp(const Arm& arm, bool prestress, double end) {
    BeamChain chain =
        straight_beam({arm.mass_per_length, arm.EA, arm.EI, arm.EI, arm.EI, 5e-4 * arm.mass_per_length}, 6);
    for (Eigen::Vector3d& node : chain.nodes) node *= arm.length;
    chain.prestress = prestress;
    TemporaryFolder folder;
    write_superelement(chain.reduced().body, folder / "arm.h5");
    const ReadyModel model(
        "parameters: {Om: " + std::to_string(arm.speed) +
        "}\nnodes:\n  root: {position: [0, 0, 0], fixed: [x, y, z, rx, ry], motion: {rz: "
        "\"Om/15*(t^2/2 + (15/(2*pi))^2*(cos(2*pi*t/15) - 1))\"}}\nelements:\n  arm: {type: superelement, file: " +
        folder.path() + "/arm.h5, nodes: {a: root}}\n");
    integrate(model, Scheme::generalized_alpha(0.8), 0.01, end, [&](const State& state) {
      const NodeState& root = model.node(state, "root");
      const double deflection = (root.R.transpose() * model.node(state, "arm.b").x).y();
      if (deflection < least) {
        least = deflection;
        time_of_least = state.time;
      }
      if (std::abs(state.time - 5) < 1e-6) at_5 = deflection;
      if (std::abs(state.time - 10) < 1e-6) at_10 = deflection;
    });
  }
};

}  // namespace

TEST_CASE("an arm that is spun up deflects as the rod with centrifugal tension") {
  const SpinUp run(simo_vu_quoc, true, 10.5);
  // One linear body with the tension of its spin and of its root's reaction is the linear beam with tension: from it
  // differ the six modes and the step; the geometrically exact rod is 1e-3 away.
  const ReferenceTable exact("spin_up");
  CHECK_THAT(run.least, Catch::WithinRel(exact("simo_vu_quoc.linear_least"), 2e-3));
  CHECK_THAT(run.time_of_least, Catch::WithinAbs(exact("simo_vu_quoc.time"), 0.011));
  CHECK_THAT(run.at_5, Catch::WithinRel(exact("simo_vu_quoc.at_5"), 3e-3));
  CHECK_THAT(run.at_10, Catch::WithinRel(exact("simo_vu_quoc.at_10"), 3e-3));
}

TEST_CASE("an arm that is spun up beyond its first frequency at rest is held by the tension of its spin") {
  const SpinUp run(wu_haug, true, 10.5);
  const ReferenceTable exact("spin_up");
  CHECK_THAT(run.least, Catch::WithinRel(exact("wu_haug.linear_least"), 3e-3));
  CHECK_THAT(run.time_of_least, Catch::WithinAbs(exact("wu_haug.time"), 0.011));
}

TEST_CASE("without the tension of spin the arm bends too far") {
  const SpinUp run(simo_vu_quoc, false, 10.5);
  CHECK(run.least < -0.63);
}
