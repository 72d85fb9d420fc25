// A superelement's forces: exact tangents, invariance under rigid motions, power, and the effect of loads and
// prestress.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/superelement_alone.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

SuperelementAlone alone_with_loads(const BeamChain& chain, Random& random) {
  return SuperelementAlone(
      chain.reduced().body, {exp_so3(random.vector3(2)), exp_so3(random.vector3(2)), exp_so3(random.vector3(2))},
      {{"push", bielle::Expression("2 + t", {"t"}), true}, {"spread", bielle::Expression("3*cos(t)", {"t"}), false}});
}

State carried(const State& state, const Frame& motion, const Vector3& v = Vector3::Zero()) {
  State result = state;
  for (NodeState& node : result.nodes) {
    node.x = motion.x + motion.R * node.x;
    node.R = motion.R * node.R;
    node.v = v + motion.R * node.v;
    node.a = motion.R * node.a;
  }
  return result;
}

/// Returns the residual in the node axes, in which rigid motions have no effect.
VectorX turned_back(const VectorX& r, const Matrix3& R, int nodes) {
  VectorX result = r;
  for (int k = 0; k < nodes; ++k) result.segment<3>(6 * k) = R.transpose() * r.segment<3>(6 * k);
  return result;
}

}  // namespace

TEST_CASE("the tangents of a superelement are the derivatives of its residual, with nothing neglected") {
  Random random(1);
  for (const BeamChain& chain : bent_chains())
    for (double deformation : {0.0, 1e-8, 0.01, 0.1})
      for (double rate : {0.0, 1.0, 10.0}) {
        CAPTURE(deformation, rate);
        SuperelementAlone alone = alone_with_loads(chain, random);
        alone.environment.gravity = {1, -9, 3};
        State state = alone.random_state(random, deformation, rate);
        state.time = 0.7;
        const VectorX v = alone.velocity(state), a = alone.acceleration(state), r = alone.residual(state);
        const SuperelementAlone::Tangent tangent = alone.tangent(state);
        const auto n = alone.size();
        const auto check = [&](const MatrixX& exact, const MatrixX& differences, double step) {
          // Rounding of the residual over the smallest step, and 1e-11 of the derivative for truncation.
          const double tolerance =
              1e-11 * differences.cwiseAbs().maxCoeff() + 3e-15 * r.cwiseAbs().maxCoeff() / (step / 4);
          CHECK(error(exact, differences) < tolerance);
        };
        // The frame of a bent body varies on a scale of some 0.3; the residual is quadratic in the velocities and
        // linear in the accelerations, so that any step is exact.
        check(tangent.K, jacobian([&](const VectorX& z) { return alone.residual(alone.moved(state, z)); }, n, 0.0025),
              0.0025);
        check(tangent.C,
              jacobian([&](const VectorX& dv) { return alone.residual(alone.with_rates(state, v + dv, a)); }, n, 1), 1);
        check(tangent.M,
              jacobian([&](const VectorX& da) { return alone.residual(alone.with_rates(state, v, a + da)); }, n, 1), 1);
        CHECK(error(tangent.M, tangent.M.transpose()) < 1e-14 * tangent.M.cwiseAbs().maxCoeff());
      }
}

TEST_CASE("each tangent can be had alone") {
  Random random(2);
  const SuperelementAlone alone = alone_with_loads(bent_chain(), random);
  const State state = alone.random_state(random, 0.1, 3);
  const SuperelementAlone::Tangent all = alone.tangent(state);
  for (int wanted = 0; wanted < 3; ++wanted) {
    MatrixX K = MatrixX::Zero(alone.size(), alone.size()), C = K, M = K;
    LocalTangent parts{LocalMatrix(K), LocalMatrix(C), LocalMatrix(M), wanted == 0, wanted == 1, wanted == 2};
    alone.body().add_tangent(alone.local(state), parts);
    CHECK(error(K, wanted == 0 ? all.K : MatrixX(0 * K)) == 0);
    CHECK(error(C, wanted == 1 ? all.C : MatrixX(0 * C)) == 0);
    CHECK(error(M, wanted == 2 ? all.M : MatrixX(0 * M)) == 0);
  }
}

TEST_CASE("a rigid motion of everything turns the forces and leaves energies and local coordinates") {
  Random random(3);
  for (const BeamChain& chain : bent_chains())
    for (double deformation : {0.0, 0.01, 0.15}) {
      const SuperelementAlone alone = alone_with_loads(chain, random);
      State state = alone.random_state(random, deformation, 2);
      const Frame motion{random.vector3(3), exp_so3(random.vector3(3))};
      const auto r = alone.residual(state);
      // The load fixed in space does not turn with the body: its cosine is zero at this time.
      state.time = M_PI / 2;
      const VectorX still = alone.residual(state), there = alone.residual(carried(state, motion));
      CHECK(error(turned_back(there, motion.R, alone.nodes()), still) < 1e-12 * r.cwiseAbs().maxCoeff());
      const Energy here = alone.energy(state), elsewhere = alone.energy(carried(state, motion));
      CHECK_THAT(elsewhere.kinetic, Catch::WithinRel(here.kinetic, 1e-12));
      CHECK_THAT(elsewhere.elastic, Catch::WithinAbs(here.elastic, 1e-12 * here.kinetic));
      CHECK_THAT(elsewhere.dissipation, Catch::WithinRel(here.dissipation, 1e-11) || Catch::WithinAbs(0, 1e-12));
    }
}

TEST_CASE("every observer in uniform motion sees the same forces") {
  Random random(4);
  for (const BeamChain& chain : bent_chains()) {
    SuperelementAlone alone = alone_with_loads(chain, random);
    State state = alone.random_state(random, 0.05, 3);
    // Rates of some 1000 times the size of the change would show.
    const VectorX r = alone.residual(state), boosted = alone.residual(carried(state, {}, {10, -5, 7}));
    CHECK(error(r, boosted) < 1e-12 * r.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("gravity is an acceleration of the observer") {
  Random random(5);
  SuperelementAlone alone = alone_with_loads(bent_chains()[3], random);
  State state = alone.random_state(random, 0.05, 1);
  const VectorX weightless = alone.residual(state);
  alone.environment.gravity = {1, 2, -9.81};
  for (NodeState& node : state.nodes) node.a += alone.environment.gravity;
  CHECK(error(alone.residual(state), weightless) < 1e-12 * weightless.cwiseAbs().maxCoeff());

  // Its potential is that of the centre of mass: minus the work of moving the body there.
  const BeamSuperelement reduced = bent_chains()[3].reduced();
  const CorotatedGeometry geometry = alone.geometry(state);
  VectorX q(reduced.body.size());
  alone.body().matrices().to_file(alone.coordinates(state), q);
  double potential = 0;
  for (Eigen::Index g = 0; g < reduced.masses.size(); ++g) {
    const Vector3 u = reduced.field.middleRows<3>(3 * g) * q;
    const Vector3 position = geometry.frame.x + geometry.frame.R * (reduced.points.col(g) + u);
    potential -= reduced.masses[g] * alone.environment.gravity.dot(position);
  }
  // Terms of 1.5 kg, 10 m/s^2 and some 5 m cancel.
  CHECK_THAT(alone.energy(state).gravity, Catch::WithinAbs(potential, 2e-13));
}

TEST_CASE("forces of a superelement in motion balance the rates of its momenta") {
  Random random(6);
  for (const BeamChain& chain : bent_chains()) {
    const SuperelementAlone alone(chain.reduced().body);
    // Along a motion with constant residual zero the sum of forces is the rate of momentum: here the sums of elastic
    // forces alone, which must vanish, with moments about the origin.
    const State state = alone.random_state(random, 0.1, 0);
    const VectorX r = alone.residual(state);
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    for (int k = 0; k < alone.nodes(); ++k) {
      const NodeState& node = state.nodes[static_cast<std::size_t>(k)];
      force += r.segment<3>(6 * k);
      moment += node.x.cross(r.segment<3>(6 * k)) + node.R * r.segment<3>(6 * k + 3);
    }
    CHECK(force.norm() < 1e-13 * r.norm());
    CHECK(moment.norm() < 1e-13 * r.norm());
  }
}

TEST_CASE("the power of all forces is the rate of energy and dissipation") {
  Random random(7);
  for (const BeamChain& chain : bent_chains()) {
    SuperelementAlone alone = alone_with_loads(chain, random);
    alone.environment.gravity = {1, 2, -9.81};
    const State state = alone.random_state(random, 0.05, 2);
    const VectorX v = alone.velocity(state), a = alone.acceleration(state);
    // The motion z(s) = v s + a s^2 / 2 from the state, body velocities v + a s (to the order that counts: rates of
    // rotation vectors and angular velocities differ by a term of s^2 here, whose derivative at zero vanishes).
    const auto total = [&](double s) {
      const State at = alone.with_rates(alone.moved(state, v * s + a * (s * s / 2)), v + a * s, a);
      const Energy energy = alone.energy(at);
      return energy.kinetic + energy.elastic + energy.gravity;
    };
    const Energy energy = alone.energy(state);
    const double rate = derivative(total, 0.002);
    const double power = alone.residual(state).dot(v);
    CHECK_THAT(power, Catch::WithinAbs(rate + energy.dissipation - energy.input, 1e-10 * std::abs(power)));
    CHECK(energy.dissipation > 0);
    CHECK(std::abs(energy.input) > 0.1);
  }
}

TEST_CASE("load patterns do the work of the forces that they stand for") {
  Random random(8);
  const BeamChain chain = bent_chain();
  const BeamSuperelement reduced = chain.reduced();
  for (bool follows : {true, false}) {
    const SuperelementAlone loaded(reduced.body, {}, {{"spread", bielle::Expression(2.0), follows}});
    const SuperelementAlone free(reduced.body);
    const State state = loaded.random_state(random, 0.1, 0);
    const VectorX force = free.residual(state) - loaded.residual(state);
    // Positions of the loaded points in space, from the frame and the reduction basis.
    const VectorX direction = random.vector(loaded.size());
    const CorotatedGeometry start = free.geometry(state);
    const auto work = [&](double s) {
      const State at = free.moved(state, s * direction);
      const CorotatedGeometry geometry = free.geometry(at);
      VectorX q(reduced.body.size());
      free.body().matrices().to_file(free.coordinates(at), q);
      double sum = 0;
      for (const BeamLoad& load : chain.loads) {
        if (load.pattern != "spread") continue;
        const Vector3 u = reduced.basis.middleRows<3>(6 * load.node) * q;
        const Vector3 X = chain.nodes[static_cast<std::size_t>(load.node)];
        const Vector3 position = geometry.frame.x + geometry.frame.R * (X + u);
        sum += 2 * (follows ? Vector3(start.frame.R * load.force) : load.force).dot(position);
      }
      return sum;
    };
    CHECK_THAT(force.dot(direction), Catch::WithinAbs(derivative(work, 0.005), 1e-10));
  }
}

TEST_CASE("the load factor of a static analysis scales load patterns") {
  Random random(9);
  SuperelementAlone alone = alone_with_loads(bent_chain(), random);
  const State state = alone.rigid_state({});
  const VectorX full = alone.residual(state);
  CHECK(full.norm() > 1);
  alone.environment.load_factor = 0.25;
  CHECK(error(alone.residual(state), 0.25 * full) < 1e-14 * full.norm());
}

TEST_CASE("rotations that an interface does not keep carry no moment") {
  Random random(10);
  const auto chains = bent_chains();
  const SuperelementAlone forces_alone(chains[1].reduced().body);
  const State state = forces_alone.random_state(random, 0.05, 3);
  CHECK(forces_alone.residual(state).segment<3>(9).norm() == 0);
  State turned = state;
  turned.nodes[1].R = turned.nodes[1].R * exp_so3({1, 2, 3});
  turned.nodes[1].Omega *= 7;
  turned.nodes[1].Omegadot.setConstant(11);
  CHECK(error(forces_alone.residual(turned), forces_alone.residual(state)) == 0);

  // The interface is free about z of the body. There is no moment about the image of this axis at the node, for any
  // spin about it.
  const SuperelementAlone free_about_z(chains[2].reduced().body);
  const State tilted = free_about_z.random_state(random, 0.05, 3);
  const VectorX r = free_about_z.residual(tilted);
  const Vector3 moment = r.segment<3>(9);
  CHECK(moment.norm() > 1e-3);
  CHECK(std::abs(moment.z()) < 1e-14 * r.norm());
  State spun = tilted;
  spun.nodes[1].Omega.z() += 50;
  // The node's z axis keeps its acceleration R (Omegadot x e + Omega x (Omega x e)).
  spun.nodes[1].Omegadot += 50 * tilted.nodes[1].Omega.cross(Vector3::UnitZ());
  CHECK(error(free_about_z.residual(spun), r) < 1e-12 * r.norm());
}

TEST_CASE("an axial force changes the bending stiffness at once") {
  const BeamProperties properties;
  const BeamSuperelement reduced = straight_beam(properties, 16).reduced();
  const SuperelementAlone alone(reduced.body);
  // A pinned beam under the axial force N: omega^2 = (EI k^4 + N k^2) / mass per length with k = pi / L, both planes;
  // zero at Euler's load.
  for (double N : {0.0, 3.0, -M_PI * M_PI}) {
    State state = alone.rigid_state({});
    state.nodes[1].x.x() += N / properties.EA;
    const VectorX r = alone.residual(state);
    CHECK(std::abs(r[6] - N) < 1e-9);

    const SuperelementAlone::Tangent tangent = alone.tangent(state);
    std::vector<int> free_unknowns = {4, 5, 10, 11};  // rotations y and z of both ends
    for (int k = 12; k < alone.size(); ++k) free_unknowns.push_back(k);
    const bielle::SymmetricEigenpairs eigen =
        bielle::symmetric_eigenpairs(MatrixX(tangent.K(free_unknowns, free_unknowns)),
                                     MatrixX(tangent.M(free_unknowns, free_unknowns)))
            .value();
    const double k = M_PI;
    // Modes beyond the retained ones: some 1e-5 of the bending term. A bar that is longer by N/EA has a lower bending
    // stiffness, by four times that; a third-order energy does not determine how much.
    const double tolerance = 5e-3 + 4 * std::abs(N) / properties.EA * properties.EIy * std::pow(k, 4);
    CHECK_THAT(eigen.values[0], Catch::WithinAbs(properties.EIz * std::pow(k, 4) + N * k * k, tolerance));
    CHECK_THAT(eigen.values[1], Catch::WithinAbs(properties.EIy * std::pow(k, 4) + N * k * k, tolerance));
  }
}
