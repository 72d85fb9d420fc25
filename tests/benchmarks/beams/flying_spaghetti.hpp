// The flying spaghetti: J. Simo, L. Vu-Quoc, J. Appl. Mech. 53 (1986) 855 (plane) and Comput. Methods Appl. Mech. Eng.
// 66 (1988) 125 (space); the loads as stated here.
//
// A free beam of length 10, EA = GA = 1e4, mass 1 and mass moments 10 per length, at rest from A = (6, 0, 0) to B = (0,
// 8, 0). A dead force along x and a dead moment act at A: T rises linearly to its peak at 2.5 s and is zero after 5 s.
//   plane: force T/10, moment -T about z, peak 80
//   space: force T/10, moment (0, -T/2, -T), peak 200, EI = GJ = 500
// References: a spectral element in space, Runge-Kutta in time (tests/references/flying_spaghetti.py).
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"

namespace bielle::test::spaghetti {

using namespace bielle::mechanism;

inline std::string model_of(int elements, double EI, bool plane) {
  const std::string T =
      plane ? "if(t < 2.5, 32*t, if(t < 5, 32*(5 - t), 0))" : "if(t < 2.5, 80*t, if(t < 5, 80*(5 - t), 0))";
  return fmt::format(
      "nodes: {{a: {{position: [6, 0, 0]}}, b: {{position: [0, 8, 0]}}}}\n"
      "elements: {{s: {{type: beam, nodes: [a, b], elements: {}, section: {{EA: 1e4, GAy: 1e4, GAz: 1e4, GJ: {}, EIy: "
      "{}, EIz: {}, "
      "mass_per_length: 1, Jx: 10, Jy: 10, Jz: 10}}}}}}\n"
      "loads: {{l: {{node: a, force: ['({})/10', 0, 0], moment: [0, '{}*({})', '-({})']}}}}\n",
      elements, EI, EI, EI, T, plane ? "0" : "-0.5", T, T);
}

/// Returns the name in the table of references.
inline std::string name_of(double EI, bool plane) { return plane ? fmt::format("plane_{}", EI) : "space"; }

/// Integrates, with calls at t = `times`.
inline void fly(int elements, double EI, bool plane, double h, const std::vector<double>& times,
                const std::function<void(const ReadyModel&, const State&, std::size_t)>& at) {
  const ReadyModel model(model_of(elements, EI, plane));
  integrate(model, Scheme::generalized_alpha(0.9), h, times.back(), [&](const State& state) {
    for (std::size_t k = 0; k < times.size(); ++k)
      if (std::abs(state.time - times[k]) < 0.01 * h) at(model, state, k);
  });
}

/// Three levels, each with half the element length and step: second order, and Richardson's value at the reference.
inline void check(double EI, bool plane, double step, const std::vector<double>& times, double tolerance) {
  const ReferenceTable table("flying_spaghetti");
  std::vector<std::vector<Vector6>> errors(3);
  for (int level = 0; level < 3; ++level)
    fly(16 << level, EI, plane, step / (1 << level), times,
        [&](const ReadyModel& model, const State& state, std::size_t k) {
          const std::string row = fmt::format("{}.{}.", name_of(EI, plane), times[k]);
          Vector6 e;
          e << model.node(state, "a").x - table.vector(row + "a"), model.node(state, "b").x - table.vector(row + "b");
          errors[static_cast<std::size_t>(level)].push_back(e);
        });
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Vector6 &coarse = errors[1][k], &fine = errors[2][k];
    CAPTURE(EI, plane, times[k], errors[0][k].transpose(), coarse.transpose(), fine.transpose());
    // The steps are of second order. Terms of higher order from the elements may still appear at late times.
    CHECK(std::log2(coarse.norm() / fine.norm()) > 1.8);
    CHECK(((4 * fine - coarse) / 3).norm() < tolerance);
  }
}

}  // namespace bielle::test::spaghetti
