// The inertia of a superelement against references that are independent of its formulas: the mass points of the reduced
// field, followed through space by differences, and Lagrange's equations of their energies.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "tests/support/finite_difference.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/superelement_alone.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

std::vector<BeamChain> bodies() {
  std::vector<BeamChain> chains = bent_chains();
  chains[0].prestress = false;
  for (BeamChain& chain : chains) chain.damping = 0;
  return chains;
}

/// A motion through a state: z(t) = v t + a t^2 / 2 in the chart x + dx, R exp(dTheta), amplitudes. In this chart rates
/// and accelerations at t = 0 are v and a.
struct Reference {
  const BeamSuperelement& reduced;
  const SuperelementAlone& alone;
  State start;
  VectorX v, a;

  struct Configuration {
    Frame frame;
    VectorX q;                // in the file's order
    Eigen::Matrix3Xd points;  // in space
  };
  Configuration at(const VectorX& z) const {
    const State state = alone.moved(start, z);
    const CorotatedGeometry geometry = alone.geometry(state);
    Configuration c;
    c.frame = geometry.frame;
    c.q.resize(reduced.body.size());
    alone.body().matrices().to_file(alone.coordinates(state), c.q);
    c.points = (reduced.field * c.q).reshaped(3, reduced.masses.size());
    c.points = (c.frame.R * (reduced.points + c.points)).colwise() + c.frame.x;
    return c;
  }

  struct Rates {
    Eigen::Matrix3Xd points;
    Vector3 Om;  // angular velocity of the frame, body axes
    VectorX q;
    Vector3 momentum, angular_momentum;
    double kinetic;
  };
  /// Rates at z along zdot, by differences of positions.
  Rates rates(const VectorX& z, const VectorX& zdot) const {
    const double step = 0.004;
    const Configuration here = at(z);
    const auto pick = [&](double s) {
      const Configuration c = at(z + s * zdot);
      VectorX all(c.points.size() + 9 + c.q.size());
      all << c.points.reshaped(), c.frame.R.reshaped(), c.q;
      return all;
    };
    const VectorX d = derivative(pick, step);
    Rates rates;
    rates.points = d.head(here.points.size()).reshaped(3, here.points.cols());
    const Matrix3 R_rate = d.segment<9>(here.points.size()).reshaped(3, 3);
    rates.Om = skew_vector(here.frame.R.transpose() * R_rate);
    rates.q = d.tail(here.q.size());
    // Rotary inertia rotates with s = U nu_0 + qdot; only the rotations of s matter.
    const SuperelementMatrices& matrices = alone.body().matrices();
    MatrixX U(here.q.size(), 6);
    for (int k = 0; k < 6; ++k) {
      VectorX column(here.q.size());
      matrices.to_file(VectorX(matrices.U.col(k)), column);
      U.col(k) = column;
    }
    VectorX turning = U.rightCols<3>() * rates.Om;
    turning += rates.q;
    rates.kinetic = 0.5 * turning.dot(reduced.rotary * turning);
    rates.angular_momentum = here.frame.R * (U.rightCols<3>().transpose() * (reduced.rotary * turning));
    rates.momentum.setZero();
    for (Eigen::Index g = 0; g < reduced.masses.size(); ++g) {
      const Vector3 velocity = rates.points.col(g), position = here.points.col(g);
      rates.kinetic += 0.5 * reduced.masses[g] * velocity.squaredNorm();
      rates.momentum += reduced.masses[g] * velocity;
      rates.angular_momentum += reduced.masses[g] * position.cross(velocity);
    }
    // Foreshortening: - Om_k Om_l q K_sigma,kl q / 2, Om that of the mean motion of the mass.
    if (reduced.body.spin_stiffness[0].size() > 0) {
      const MatrixX MU = reduced.body.mass * U;
      const Vector3 Om = rates.Om + (U.transpose() * MU).inverse().bottomRows<3>() * (MU.transpose() * rates.q);
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) {
          const MatrixX& K = reduced.body.spin_stiffness[static_cast<std::size_t>(pair_index(k, l))];
          rates.kinetic -= 0.5 * Om[k] * Om[l] * here.q.dot(K * here.q);
          rates.angular_momentum -= here.frame.R * Vector3(Vector3::Unit(k) * Om[l] * here.q.dot(K * here.q));
        }
    }
    return rates;
  }
  double potential(const VectorX& z) const {
    const VectorX q = at(z).q;
    return 0.5 * q.dot(reduced.body.stiffness * q);
  }
  VectorX position(double t) const { return v * t + a * (t * t / 2); }
  VectorX velocity(double t) const { return v + a * t; }
};

Reference reference_of(const BeamSuperelement& reduced, const SuperelementAlone& alone, Random& random,
                       double deformation) {
  Reference reference{reduced, alone, alone.random_state(random, deformation, 1), {}, {}};
  reference.v = alone.velocity(reference.start);
  reference.a = alone.acceleration(reference.start);
  return reference;
}

}  // namespace

TEST_CASE("the kinetic energy is that of the mass points of the reduced field") {
  Random random(1);
  for (const BeamChain& chain : bodies())
    for (double deformation : {0.0, 0.02, 0.1}) {
      const BeamSuperelement reduced = chain.reduced();
      const SuperelementAlone alone(reduced.body,
                                    {exp_so3(random.vector3(2)), exp_so3(random.vector3(2)), exp_so3({1, 0, 2})});
      const Reference reference = reference_of(reduced, alone, random, deformation);
      const double expected = reference.rates(VectorX::Zero(alone.size()), reference.v).kinetic;
      CHECK_THAT(alone.energy(reference.start).kinetic, Catch::WithinRel(expected, 1e-11));
    }
}

TEST_CASE("forces of a superelement are those of Lagrange's equations") {
  Random random(2);
  for (const BeamChain& chain : bodies())
    for (double deformation : {0.0, 0.02, 0.05}) {
      CAPTURE(deformation);
      const BeamSuperelement reduced = chain.reduced();
      const SuperelementAlone alone(reduced.body,
                                    {exp_so3(random.vector3(2)), exp_so3(random.vector3(2)), exp_so3({1, 0, 2})});
      const Reference reference = reference_of(reduced, alone, random, deformation);
      const VectorX force = alone.residual(reference.start);
      const double step = 0.005;
      for (Eigen::Index j = 0; j < alone.size(); ++j) {
        const VectorX e = VectorX::Unit(alone.size(), j);
        // T is quadratic in the rates: dT/dzdot_j by one central difference of any size is exact.
        const auto momentum = [&](double t) {
          const VectorX z = reference.position(t), zdot = reference.velocity(t);
          return (reference.rates(z, zdot + e).kinetic - reference.rates(z, zdot - e).kinetic) / 2;
        };
        const auto lagrangian = [&](double s) {
          return reference.rates(s * e, reference.v).kinetic - reference.potential(s * e);
        };
        const double expected = derivative(momentum, step) - derivative(lagrangian, step);
        // Differences of differences: 1e-13 over steps of 0.00125 of energies of some 10, and truncation, which grows
        // fast with the deformation where a body is held loosely.
        CHECK_THAT(force[j], Catch::WithinAbs(expected, 2e-9 * (1 + force.cwiseAbs().maxCoeff())));
      }
    }
}

TEST_CASE("forces of a superelement sum up to the rates of its momentum and angular momentum") {
  Random random(3);
  for (const BeamChain& chain : bodies()) {
    const BeamSuperelement reduced = chain.reduced();
    const SuperelementAlone alone(reduced.body,
                                  {exp_so3(random.vector3(2)), exp_so3(random.vector3(2)), exp_so3({1, 0, 2})});
    const Reference reference = reference_of(reduced, alone, random, 0.05);
    const VectorX r = alone.residual(reference.start);
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    for (int k = 0; k < alone.nodes(); ++k) {
      const NodeState& node = reference.start.nodes[static_cast<std::size_t>(k)];
      force += r.segment<3>(6 * k);
      moment += node.x.cross(r.segment<3>(6 * k)) + node.R * r.segment<3>(6 * k + 3);
    }
    const auto momenta = [&](double t) {
      const Reference::Rates rates = reference.rates(reference.position(t), reference.velocity(t));
      return Vector6((Vector6() << rates.momentum, rates.angular_momentum).finished());
    };
    const Vector6 expected = derivative(momenta, 0.005);
    // Velocities of some 5 m/s are known to 1e-12 by differences; over the smallest step of 0.00125.
    CHECK(error(force, expected.head<3>()) < 5e-9);
    CHECK(error(moment, expected.tail<3>()) < 5e-9);
  }
}

TEST_CASE("an undeformed superelement has the inertia of the rigid body") {
  Random random(4);
  for (const BeamChain& chain : bodies()) {
    const BeamSuperelement reduced = chain.reduced();
    const SuperelementAlone alone(reduced.body,
                                  {exp_so3(random.vector3(2)), exp_so3(random.vector3(2)), exp_so3({1, 0, 2})});
    const Frame frame{random.vector3(), exp_so3(random.vector3(2))};
    const Vector3 v = random.vector3(), Om = random.vector3(3), a = random.vector3(), Om_rate = random.vector3(2);
    State state = alone.rigid_state(frame, v, Om);
    const auto& points = alone.body().frame().points();
    for (std::size_t k = 0; k < points.size(); ++k) {
      state.nodes[k].a += a + frame.R * Om_rate.cross(points[k].X);
      state.nodes[k].Omegadot = points[k].R_ref.transpose() * Om_rate;
    }
    const VectorX r = alone.residual(state);
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();  // about the centre of mass, body axes
    const Vector3& centre = reduced.body.centre;
    const Matrix3& J = reduced.body.inertia;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(6 * k);
      const Vector3 f = frame.R.transpose() * r.segment<3>(row);
      force += f;
      moment += (points[k].X - centre).cross(f) + points[k].R_ref * r.segment<3>(row + 3);
    }
    const Vector3 acceleration = frame.R.transpose() * a + Om_rate.cross(centre) + Om.cross(Om.cross(centre));
    CHECK(error(force, reduced.body.total_mass * acceleration) < 1e-12);
    // Rotary inertia spins with the frame: it belongs to the body's tensor.
    CHECK(error(moment, J * Om_rate + Om.cross(J * Om)) < 1e-12);
    const Energy energy = alone.energy(state);
    const double kinetic =
        0.5 * reduced.body.total_mass * (v + frame.R * Om.cross(centre)).squaredNorm() + 0.5 * Om.dot(J * Om);
    CHECK_THAT(energy.kinetic, Catch::WithinRel(kinetic, 1e-13));
    CHECK(std::abs(energy.elastic) < 1e-20);
  }
}

TEST_CASE("fixed-boundary modes feel the centrifugal load of the mesh") {
  // Clamped ends, spin about z through the origin: the load on mode j is -int rho phi_j . (Om x (Om x X)).
  BeamChain chain = bent_chain();
  chain.properties.rotary_inertia = 1e-9;  // it is no mass of the field
  const BeamSuperelement reduced = chain.reduced();
  const SuperelementAlone alone(reduced.body);
  const Vector3 Om(0, 0, 3);
  const State state = alone.rigid_state({}, Vector3::Zero(), Om);
  VectorX acceleration(3 * reduced.masses.size());
  for (Eigen::Index g = 0; g < reduced.masses.size(); ++g)
    acceleration.segment<3>(3 * g) = reduced.masses[g] * Om.cross(Om.cross(Vector3(reduced.points.col(g))));
  const VectorX load = reduced.field.transpose() * acceleration;
  const VectorX r = alone.residual(state);
  CHECK(r.tail(5).norm() > 1);
  CHECK(error(r.tail(5), load.tail(5)) < 1e-8);
}
