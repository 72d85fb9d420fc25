// The laws of tangents and constraints for directions of nodes that are held by constraints: these belong to a key of
// nodes, and to no type of the component table.
#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;
using bielle::test::derivative;
using bielle::test::jacobian;

TEST_CASE("directions held by constraints have the tangents of their forces, and rows with these gradients and rates") {
  struct Held {
    std::string keys;
    int rows;
  };
  for (const Held& held : {Held{"[rx]", 1}, Held{"[ry]", 1}, Held{"[rz]", 1}, Held{"[z, rx, rz], fixed_axes: own", 3},
                           Held{"[x, y, ry, rz], fixed_axes: own", 4}, Held{"[x, y, z, rx, ry], fixed_axes: own", 2},
                           Held{"[x, ry], fixed_axes: own", 2}, Held{"[y, rx], fixed_axes: own", 2},
                           Held{"[z, rz], fixed_axes: own", 2}}) {
    CAPTURE(held.keys);
    Sample sample{bielle::mechanism::Section::nodes,
                  "node",
                  held.keys,
                  "nodes: {it: {position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8], fixed: " + held.keys +
                      "}}\nelements: {body: {type: rigid_body, node: it, mass: 1, inertia: [1, 1, 1]}}\n",
                  {}};
    int checked = 0;
    for (const Subject& subject : subjects(sample)) {
      const DenseModel& dense = *subject.dense;
      if (dense.own_multipliers() == 0) continue;  // the support, which records
      REQUIRE(dense.own_multipliers() == held.rows);
      const int begin = dense.multiplier_begin(), dofs = dense.first_order_begin();
      for (const NamedState& named : law_states(subject)) {
        CAPTURE(named.name);
        const State& state = named.state;
        const MatrixX K = dense.tangent(state, DenseModel::Part::K);
        const MatrixX D = jacobian(
            [&](const VectorX& step) -> VectorX {
              State moved = state;
              dense.move(moved, step);
              return dense.residual(moved);
            },
            dense.size(), 0.005);
        CHECK((K - D).cwiseAbs().maxCoeff() < 1e-9 * (1 + K.cwiseAbs().maxCoeff()));
        const MatrixX B = K.block(begin, 0, held.rows, dofs);
        CHECK((K.block(0, begin, dofs, held.rows) - B.transpose()).cwiseAbs().maxCoeff() == 0);
        VectorX velocity, acceleration, ignored;
        dense.constraint_rates(state, velocity, acceleration);
        const VectorX rates = derivative([&](double s) -> VectorX {
          return dense.residual(dense.along_motion(state, s)).segment(begin, held.rows);
        });
        const VectorX second = derivative([&](double s) -> VectorX {
          VectorX at;
          dense.constraint_rates(dense.along_motion(state, s), at, ignored);
          return at;
        });
        CHECK((velocity - rates).norm() < 1e-10);
        CHECK((acceleration - second).norm() < 1e-10);
        if (named.name == "reference") {  // as drawn all rows are satisfied, and their gradients orthonormal
          CHECK(dense.residual(state).segment(begin, held.rows).norm() < 1e-14);
          CHECK((B * B.transpose() - MatrixX::Identity(held.rows, held.rows)).norm() < 1e-14);
        }
        ++checked;
      }
    }
    CHECK(checked >= 5);
  }
}
