// The flying spaghetti up to moderate times; later ones are in test_flying_spaghetti_late.cpp.
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

namespace {

/// After the loads: momenta about the origin that their impulses say, and the energy.
void check_invariants(double EI, bool plane, const Vector3& P_exact, const Vector3& H_exact, double energy_exact,
                      double momentum, double moment_of_momentum, double relative_energy) {
  fly(16, EI, plane, 0.02, {5, 8}, [&](const ReadyModel& model, const State& state, std::size_t) {
    const DenseModel dense(model.file.model);
    const VectorX p = dense.tangent(state, DenseModel::Part::M) * dense.rates(state);
    Vector3 P = Vector3::Zero(), H = Vector3::Zero();
    for (int k = 0; k < dense.nodes(); ++k) {
      const NodeState& node = state.nodes[static_cast<std::size_t>(k)];
      P += p.segment<3>(6 * k);
      H += node.x.cross(p.segment<3>(6 * k)) + node.R * p.segment<3>(6 * k + 3);
    }
    const Energy energy = dense.energy(state);
    CAPTURE(state.time, P.transpose(), H.transpose(), energy.kinetic + energy.elastic);
    CHECK((P - P_exact).norm() < momentum);
    CHECK((H - H_exact).norm() < moment_of_momentum);
    CHECK_THAT(energy.kinetic + energy.elastic, Catch::WithinRel(energy_exact, relative_energy));
  });
}

}  // namespace

TEST_CASE("flying spaghetti: loads leave the momenta that their impulses say, and the energy of the reference") {
  // P = int T/10 dt along x.
  check_invariants(500, false, {50, 0, 0}, {0, -295.7030776, -553}, 884.12686, 0.05, 1, 1e-2);
  check_invariants(100, true, {20, 0, 0}, {0, 0, -226.1630683}, 204.38447, 0.02, 0.4, 1e-2);
}

TEST_CASE("flying spaghetti: the loaded end at times when errors of elements and steps nearly cancel") {
  const auto extrapolated = [](bool plane, double time, const Vector3& exact) {
    std::vector<Vector3> errors;
    for (const int level : {1, 2})
      fly(16 << level, 500, plane, 0.01 / level, {time}, [&](const ReadyModel& model, const State& state, std::size_t) {
        errors.push_back(model.node(state, "a").x - exact);
      });
    CAPTURE(errors[0].transpose(), errors[1].transpose());
    CHECK(errors[1].norm() < 2e-3);
    return ((4 * errors[1] - errors[0]) / 3).norm();
  };
  CHECK(extrapolated(true, 5, {4.29940117, 0.64024815, 0}) < 5e-5);
  CHECK(extrapolated(false, 3.5, {4.7692447, 3.0617638, -2.8014768}) < 5e-4);
}

TEST_CASE("flying spaghetti in the plane, EI = 500: its energy behind the loads") {
  fly(16, 500, true, 0.02, {5, 8}, [](const ReadyModel& model, const State& state, std::size_t) {
    const Energy energy = DenseModel(model.file.model).energy(state);
    CHECK_THAT(energy.kinetic + energy.elastic, Catch::WithinRel(52.699214, 1e-2));
  });
}
