// The accuracy of eigenvalues, their correction and the count of motions without stiffness, of equations of one or two
// unknowns.
#include "mechanism/solvers/linearised/growing_motions.hpp"
#include "mechanism/solvers/linearised/mode_judgement.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using Complex = std::complex<double>;

namespace test_mode_judgement {
namespace {

LinearisedEquations equations(const MatrixX& M, const MatrixX& C, const MatrixX& K) {
  const Eigen::Index n = K.rows();
  LinearisedEquations e;
  e.dofs = static_cast<int>(n);
  e.M = M.sparseView();
  e.C = C.sparseView();
  e.K = K.sparseView();
  e.W.resize(n, n);
  e.B.resize(0, n);
  e.S.resize(0, n);
  e.F.resize(n, 0);
  for (int k = 0; k < e.dofs; ++k) e.group.push_back(k);
  e.turns.assign(static_cast<std::size_t>(n), 0);
  e.left_over = VectorX::Zero(n);
  return e;
}

LinearisedEquations oscillator(double m, double c, double k) {
  return equations(MatrixX::Constant(1, 1, m), MatrixX::Constant(1, 1, c), MatrixX::Constant(1, 1, k));
}

Mode judged(const LinearisedEquations& e, Complex s, const Eigen::VectorXcd& u, const ModeOptions& options = {}) {
  Mode mode;
  mode.s = s;
  mode.u = u;
  ModeJudgement(e, EquationRounding(e), options).judge(mode);
  return mode;
}

const Eigen::VectorXcd one = Eigen::VectorXcd::Ones(1);

}  // namespace

TEST_CASE("an eigenvalue is corrected to that of its vector", "[linearised]") {
  // s = 10 i, and -1 +- sqrt(99) i with damping: an error of 1e-6 becomes one of 1e-12.
  for (const double damping : {0.0, 2.0}) {
    const Complex s(-damping / 2, std::sqrt(100 - damping * damping / 4));
    const Mode mode = judged(oscillator(1, damping, 100), s * (1 + 1e-6), one);
    CHECK(std::abs(mode.s - s) < 1e-10);
    CHECK(mode.kind == ModeKind::oscillating);
  }
}

TEST_CASE("the uncertainty of an eigenvalue is that of its square, also near zero", "[linearised]") {
  // Springs k_2 between two masses of 1 kg and k_1 to the ground: rounding of k_2 changes s^2 by d, and s by
  // |sqrt(s^2 + d) - s|, which is d/(2 |s|) next to a large s, and sqrt(d) next to zero.
  constexpr double k2 = 1e10;
  const Eigen::VectorXcd together = Eigen::VectorXcd::Ones(2);
  for (const double k1 : {1e-8, 1e-5, 1e4, 1e8}) {
    MatrixX K(2, 2);
    K << k1 + k2, -k2, -k2, k2;
    const LinearisedEquations e = equations(MatrixX::Identity(2, 2), MatrixX::Zero(2, 2), K);
    const Complex s(0, std::sqrt(k1 / 2));
    const double d = EquationRounding(e)(together, s, together) / 2;  // over the mass of the motion
    const double least = std::abs(std::sqrt(s * s - d) - s), most = std::abs(std::sqrt(s * s + d) - s);
    const double uncertainty = judged(e, s, together).uncertainty;
    CAPTURE(k1, d, least, most, uncertainty);
    CHECK(uncertainty > 0.7 * std::max(least, most));
    CHECK(uncertainty < 2.5 * std::max(least, most));
  }
}

TEST_CASE("a change of the equations makes slow motions uncertain by its root", "[linearised]") {
  // A change by 1e-8 of the square of a rate of 5 1/s: |ds| = sqrt(1e-8) 5 next to zero, 1e-8 of rate and s elsewhere.
  ModeOptions options;
  options.drift = 1e-8;
  options.rate = 5;
  const Mode slow = judged(oscillator(1, 0, 1e-8), Complex(0, 1e-4), one, options);
  CHECK(slow.uncertainty == Approx(5e-4).epsilon(1e-3));
  const Mode fast = judged(oscillator(1, 0, 100), Complex(0, 10), one, options);
  CHECK(fast.uncertainty == Approx(1.5e-7).epsilon(1e-3));
  CHECK(judged(oscillator(1, 0, -9e-8), 3e-4, one, options).kind != ModeKind::growing);
  CHECK(judged(oscillator(1, 0, -1e-6), 1e-3, one, options).kind == ModeKind::growing);
}

TEST_CASE("a motion that a damper decelerates is not the absence of forces", "[linearised]") {
  // m s^2 + c s = 0 at s = -c/m, where both terms cancel.
  const LinearisedEquations damped = oscillator(1, 2, 0), stiff = oscillator(1, 0, 1);
  CHECK_FALSE(ModeJudgement(damped, EquationRounding(damped), {}).is_nothing(-2, one));
  CHECK(ModeJudgement(stiff, EquationRounding(stiff), {}).is_nothing(1e-9, one));
  CHECK_FALSE(ModeJudgement(stiff, EquationRounding(stiff), {}).is_nothing(1e-3, one));
}

TEST_CASE("a motion whose stiffness is zero but for rounding does not outweigh it", "[linearised]") {
  // The turn of a shaft as a whole has no stiffness; terms of the size of rate^2 cancel in it.
  constexpr double rate = 50;
  const auto count = [&](double stiffness) {
    MatrixX K = MatrixX::Zero(2, 2);
    K.diagonal() << stiffness * rate * rate, 1e4;
    return count_outweighed(equations(MatrixX::Identity(2, 2), MatrixX::Zero(2, 2), K), rate);
  };
  CHECK(count(-1e-9) == 0);
  CHECK(count(1e-9) == 0);
  CHECK(count(-1e-3) == 1);
}

}  // namespace test_mode_judgement
