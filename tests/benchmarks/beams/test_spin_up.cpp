// Spin-up of a flexible arm, as beams.
//
// J. Simo, L. Vu-Quoc, J. Appl. Mech. 53 (1986) 855; S.-C. Wu, E. Haug, IJNME 26 (1988) 2211. The root turns by psi =
// Om/Ts [t^2/2 + (Ts/2pi)^2 (cos(2 pi t/Ts) - 1)] up to Ts = 15 s, then at Om. References: geometrically exact rod by
// a spectral element (tests/references/spin_up.py); steady extension tan(kL)/k - L, k^2 = m Om^2/EA.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

struct Arm {
  double L, EA, GA, EI, m, J, Om;
};

struct Record {
  double least = 0, time_of_least = 0, at_5 = 0, at_10 = 0, last_largest = 0, extension = 0;
};

Record spin_up(const Arm& arm, double h, double end) {
  const ReadyModel model(
      fmt::format("parameters: {{Om: {}, Ts: 15}}\nnodes:\n"
                  "  root: {{position: [0, 0, 0], fixed: [x, y, z, rx, ry], motion: {{rz: \"if(t < Ts, Om/Ts*(t^2/2 + "
                  "(Ts/(2*pi))^2*(cos(2*pi*t/Ts) - 1)), Om*(t - Ts/2))\"}}}}\n"
                  "  tip: {{position: [{}, 0, 0]}}\nelements:\n"
                  "  arm: {{type: beam, nodes: [root, tip], elements: 16, orientation: [0, 1, 0], section: {{EA: {}, "
                  "GAy: {}, GAz: {}, GJ: {}, EIy: {}, EIz: {}, mass_per_length: {}, Jx: {}, Jy: {}, Jz: {}}}}}\n",
                  arm.Om, arm.L, arm.EA, arm.GA, arm.GA, arm.EI, arm.EI, arm.EI, arm.m, 2 * arm.J, arm.J, arm.J));
  Record record;
  double sum = 0;
  int count = 0;
  integrate(model, Scheme::generalized_alpha(0.9), h, end, [&](const State& state) {
    const Vector3 tip = model.node(state, "root").R.transpose() * model.node(state, "tip").x;
    if (tip.y() < record.least) {
      record.least = tip.y();
      record.time_of_least = state.time;
    }
    if (std::abs(state.time - 5) < h / 4) record.at_5 = tip.y();
    if (std::abs(state.time - 10) < h / 4) record.at_10 = tip.y();
    if (state.time > 15) {
      record.last_largest = std::max(record.last_largest, std::abs(tip.y()));
      sum += tip.x() - arm.L + tip.y() * tip.y() / (2 * arm.L);  // less the shortening by bending, about
      ++count;
    }
  });
  if (count > 0) record.extension = sum / count;
  return record;
}

}  // namespace

TEST_CASE("an arm that is spun up deflects as the geometrically exact rod (Simo and Vu-Quoc)") {
  const Arm arm{10, 2.8e7, 1e7, 1.4e4, 1.2, 6e-4, 6};
  const Record coarse = spin_up(arm, 0.01, 10.1), fine = spin_up(arm, 0.005, 20);
  const ReferenceTable exact("spin_up");
  CHECK_THAT(fine.least, Catch::WithinRel(exact("simo_vu_quoc.least"), 3e-4));
  CHECK_THAT(fine.time_of_least, Catch::WithinAbs(exact("simo_vu_quoc.time"), 0.006));
  // The error is of second order in the step: its extrapolation leaves the error of the elements, 1e-5.
  CHECK_THAT((4 * fine.at_5 - coarse.at_5) / 3, Catch::WithinRel(exact("simo_vu_quoc.at_5"), 3e-5));
  CHECK_THAT((4 * fine.at_10 - coarse.at_10) / 3, Catch::WithinRel(exact("simo_vu_quoc.at_10"), 3e-5));
  CHECK_THAT(fine.last_largest, Catch::WithinRel(exact("simo_vu_quoc.swing"), 5e-2));
  CHECK_THAT(fine.extension, Catch::WithinRel(exact("simo_vu_quoc.extension"), 1e-2));
}

TEST_CASE("an arm that is spun up beyond its first frequency at rest (Wu and Haug)") {
  const Arm arm{8, 5.03132e6, 2e6, 566.7, 0.201878, 566.7 / 5.03132e6 * 0.201878, 4};
  const Record record = spin_up(arm, 0.005, 20);
  const ReferenceTable exact("spin_up");
  CHECK_THAT(record.least, Catch::WithinRel(exact("wu_haug.least"), 1e-3));
  CHECK_THAT(record.time_of_least, Catch::WithinAbs(exact("wu_haug.time"), 0.006));
  CHECK_THAT(record.last_largest, Catch::WithinRel(exact("wu_haug.swing"), 5e-2));
  CHECK_THAT(record.extension, Catch::WithinRel(exact("wu_haug.extension"), 1e-2));
}
