// The flying spaghetti up to moderate times; later ones are in test_flying_spaghetti_late.cpp.
#include <optional>

#include "tests/benchmarks/beams/flying_spaghetti.hpp"
#include "tests/support/dense_model.hpp"

using namespace bielle::mechanism;
using namespace bielle::test::spaghetti;
using bielle::test::DenseModel;
using bielle::test::ReadyModel;

TEST_CASE("flying spaghetti in the plane, EI = 100, converges to the reference") {
  check(100, true, 0.02,
        {{5, {5.7315150, 6.7442325, 0}, {10.4829096, 5.7530415, 0}},
         {10, {15.665687, 1.603014, 0}, {16.105731, 7.323837, 0}}},
        2e-3);
}

TEST_CASE("flying spaghetti in the plane, EI = 500, converges to the reference") {
  check(500, true, 0.02, {{10, {21.0650426, 7.9514927, 0}, {14.9572865, 0.0312997, 0}}}, 2e-3);
}

TEST_CASE("flying spaghetti in space converges to the reference") {
  check(500, false, 0.01,
        {{5, {19.562761, 1.521334, -1.507694}, {11.878831, 6.881357, 1.830018}},
         {8, {30.872201, -0.978405, 0.365400}, {29.863127, 8.948532, -0.226849}}},
        5e-3);
}

TEST_CASE("flying spaghetti: loads leave the momenta that their impulses say, and the energy of the reference") {
  // P = int T/10 dt along x; H about the origin, and the energy, from the reference.
  struct Case {
    double EI;
    bool plane;
    Vector3 P;
    std::optional<Vector3> H;
    double energy;
  };
  for (const Case& c :
       {Case{100, true, {20, 0, 0}, Vector3(0, 0, -226.1630683), 204.38447}, Case{500, true, {20, 0, 0}, {}, 52.699214},
        Case{500, false, {50, 0, 0}, Vector3(0, -295.7030776, -553), 884.12686}})
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
      if (c.H) CHECK((H - *c.H).norm() < 2e-3 * c.H->norm());
      CHECK_THAT(energy.kinetic + energy.elastic, Catch::WithinRel(c.energy, 1e-2));
    });
}
