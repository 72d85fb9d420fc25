// Mechanisms that are drawn in one point, or next to it, on springs that decide their size.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

using namespace bielle::mechanism;

namespace {

/// Returns the position of a mass of 2 kg that hangs from a point on a spring of length zero: k z = -m g, with any of
/// its keys.
Vector3 hanging(double drawn, double stiffness, const StaticsOptions& options = {}) {
  const MechanismFile file = read_mechanism_text(
      fmt::format("gravity: [0, 0, -9.81]\nnodes: {{m: {{position: [0, 0, {:.17g}]}}}}\nelements:\n"
                  "  m: {{type: point_mass, node: m, mass: 2}}\n"
                  "  s: {{type: spring_damper, nodes: [ground, m], stiffness: {:.17g}, length: 0}}\n",
                  drawn, stiffness),
      "drop.yaml");
  Session session(file.model);
  compute_statics(session, options);
  return session.node("m").x;
}

}  // namespace

TEST_CASE("a mass on a spring hangs at m g/k, however near its point it is drawn, and however far it goes") {
  StaticsOptions path;
  path.steps = 0;
  path.path.emplace();
  path.path->end.load_factor = 1;
  for (const double stiffness : {5e-6, 500.0, 5e12})
    for (const double drawn : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, -1e-6, 1e-3, 1.0, 1e3}) {
      CAPTURE(stiffness, drawn);
      const double exact = -2 * 9.81 / stiffness;
      CHECK(hanging(drawn, stiffness)[2] == Approx(exact).epsilon(1e-9).margin(1e-12 * std::abs(drawn)));
      CHECK(hanging(drawn, stiffness).head<2>().norm() <= 1e-9 * std::abs(exact));
      if (drawn == 0 || std::abs(drawn) == 1e-6)
        CHECK(hanging(drawn, stiffness, path)[2] == Approx(exact).epsilon(1e-9).margin(1e-12 * std::abs(drawn)));
    }
}

TEST_CASE("the size of a mechanism is not made of rounding") {
  State state;
  state.nodes.resize(3);
  const double other = 0.1 + 0.2;  // not 0.3
  state.nodes[1].x = Vector3(0.3, 0, 0);
  state.nodes[2].x = Vector3(other, 0, 0);
  REQUIRE(state.nodes[1].x != state.nodes[2].x);
  CHECK(spread(state) == 0);
  CHECK(model_extent(state) == other);
  state.nodes[1].x = Vector3(0.3, 1e-9, 0);  // a nanometre is a size
  CHECK(spread(state) == Approx(1e-9).epsilon(1e-6));
  state.nodes[1].x = state.nodes[2].x = Vector3::Zero();
  CHECK(spread(state) == 0);
  CHECK(model_extent(state) == 1);
  // An equilibrium at the origin is found to rounding.
  state.nodes[2].x = Vector3(1.6e-16, 0, 0);
  CHECK(model_length(state) == 1);
  state.nodes[2].x = Vector3(0, 1e-9, 0);
  CHECK(model_length(state) == 1e-9);
}
