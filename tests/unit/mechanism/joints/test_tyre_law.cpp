// The slip law of tyres: its derivatives against finite differences, below and beyond the peak of the friction.
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/joints/tyres/tyre_law.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::mechanism;
using bielle::test::jacobian;

namespace {

constexpr double shape = 1.6, radial = 1e5, slip_stiffness = 2e4, relaxed = 0.5;

SpringTyreLaw magic_formula() {
  SpringTyreLaw law;
  law.stiffness = radial;
  law.damping = 300;
  law.rolling_resistance = 0.01;
  law.speed = 0.1;
  TyreSlip slip;
  slip.stiffness << slip_stiffness, 0.8 * slip_stiffness;
  slip.relaxation << relaxed, 0.7;
  slip.friction = 0.9;
  slip.camber = 500;
  slip.trail = 0.03;
  slip.shape = shape;
  slip.peak = peak_of_formula(shape, 0);
  law.slip = slip;
  return law;
}

VectorX forces_of(const SpringTyreLaw& law, const VectorX& z) {
  const TyreForces F = law.calc(z, true);
  VectorX all(7);
  all << F.N.value, F.F_x.value, F.F_y.value, F.along_roll.value, F.moment.value, F.u_x_rate.value, F.u_y_rate.value;
  return all;
}

}  // namespace

TEST_CASE("the derivatives of a tyre's forces are right below and beyond the peak of the magic formula") {
  const SpringTyreLaw law = magic_formula();
  // B rho_c = tan(pi/2/C): the peak of sin(C atan(B rho)).
  CHECK(law.slip->peak == Approx(shape * std::tan(std::acos(-1) / 2 / shape)));
  const double load = 2000, held = law.slip->friction * load;
  for (const double slip : {0.3, 4.0, 12.0}) {  // |C v'|/(mu N |V_r|), of the lateral slip
    const double rolls = 10, across = slip * held * rolls / law.slip->stiffness.y();
    // A tread that is deflected less, and one that is deflected more than the friction holds.
    for (const double part : {0.4, 1.3}) {
      CAPTURE(slip, part);
      VectorX z(tyre_variables);
      z << load / radial, 0.05, 0.01, 0.2, across, rolls, 0.3, 1e-3, part * held * 0.7 / law.slip->stiffness.y();
      const TyreForces F = law.calc(z, true);
      const MatrixX exact = jacobian(
          [&](const VectorX& step) {
            VectorX moved = z;
            moved.array() += step.array() * z.array().abs();  // each variable by a part of its size
            return forces_of(law, moved);
          },
          tyre_variables, 1e-6);
      const std::array<TyreNumber, 7> found{F.N, F.F_x, F.F_y, F.along_roll, F.moment, F.u_x_rate, F.u_y_rate};
      for (std::size_t k = 0; k < found.size(); ++k) {
        CAPTURE(k);
        const VectorX row = exact.row(static_cast<Eigen::Index>(k)).transpose();
        const VectorX scaled = found[k].gradient.cwiseProduct(z.cwiseAbs());
        CHECK((scaled - row).norm() <= 1e-7 * (std::abs(found[k].value) + row.norm()));
      }
    }
  }
}

TEST_CASE("a tread that is deflected beyond the friction returns within a millisecond") {
  SpringTyreLaw law = magic_formula();
  law.slip->shape.reset();  // the brush model, whose friction is mu N in full sliding
  law.slip->peak = 3;
  law.slip->camber = law.slip->trail = 0;
  const double load = 2000, excess = 1.5, u = excess * law.slip->friction * load * 0.7 / law.slip->stiffness.y();
  TyreValues z = TyreValues::Zero();
  z[tyre_e] = load / radial;
  z[tyre_V_r] = 1;  // above v_0: no damping of the standing tread
  z[tyre_u_y] = u;
  // Without slip the sliding decay is (|f|/(mu N) - 1) sigma_x/T, T = 1 ms (tyre_law.hpp).
  CHECK(law.calc(z, true).u_y_rate.value == Approx(-(excess - 1) * relaxed / 1e-3 * u / 0.7).epsilon(1e-12));
}
