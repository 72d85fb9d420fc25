// The flying spaghetti up to moderate times; later ones are in test_flying_spaghetti_late.cpp.
#include "tests/benchmarks/beams/flying_spaghetti.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using namespace bielle::test::spaghetti;
using bielle::test::DenseModel;
using bielle::test::ReadyModel;

TEST_CASE("flying spaghetti in the plane, EI = 100, converges to the reference") {
  check(100, true, 0.02, {5, 10}, 2e-3);
}

TEST_CASE("flying spaghetti in the plane, EI = 500, converges to the reference") { check(500, true, 0.02, {10}, 2e-3); }

TEST_CASE("flying spaghetti in space converges to the reference") { check(500, false, 0.01, {5, 8}, 5e-3); }

TEST_CASE("flying spaghetti: loads leave the momenta that their impulses say, and the energy of the reference") {
  // The momentum is P = int T/10 dt along x; H about the origin and the energy are those of the reference.
  struct Case {
    double EI;
    bool plane;
    Vector3 P;
  };
  const bielle::test::ReferenceTable table("flying_spaghetti");
  for (const Case& c : {Case{100, true, {20, 0, 0}}, Case{500, true, {20, 0, 0}}, Case{500, false, {50, 0, 0}}})
    fly(16, c.EI, c.plane, 0.02, {5, 8}, [&](const ReadyModel& model, const State& state, std::size_t) {
      const DenseModel dense(model.file.model);
      const VectorX p = dense.tangent(state, DenseModel::Part::M) * dense.rates(state);
      Vector3 P = Vector3::Zero(), H = Vector3::Zero();
      for (int k = 0; k < dense.nodes(); ++k) {
        const NodeState& node = state.nodes[static_cast<std::size_t>(k)];
        P += p.segment<3>(6 * k);
        H += node.x.cross(p.segment<3>(6 * k)) + node.R * p.segment<3>(6 * k + 3);
      }
      const Energy energy = dense.energy(state);
      CAPTURE(c.EI, c.plane, state.time, P.transpose(), H.transpose());
      CHECK((P - c.P).norm() < 1e-3 * c.P.norm());
      const std::string name = name_of(c.EI, c.plane);
      const Vector3 exact = table.vector(name + ".momentum");
      CHECK((H - exact).norm() < 2e-3 * exact.norm());
      CHECK_THAT(energy.kinetic + energy.elastic, Catch::WithinRel(table(name + ".energy"), 1e-2));
    });
}
