// Beams under axial force: the geometric stiffness of one element, columns that buckle, strips that are pulled.
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/beam/beam_element.hpp"
#include "tests/support/dense_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;

namespace {

/// A straight beam of equal elements along x from 0 to 1 m, stretched or pressed by a force [N] at its end.
class Column {
 public:
  Column(int elements, const Vector6& section, double force, BeamBending bending = BeamBending::residual)
      : elements_(elements) {
    BeamSection law;
    law.stiffness = section.asDiagonal();
    Vector6 d0 = Vector6::Zero();
    d0[0] = 1.0 / elements;
    for (int k = 0; k <= elements; ++k) {
      Node node;
      node.name = fmt::format("n{}", k);
      node.frame.x.x() = static_cast<double>(k) / elements;
      model_.add_node(std::move(node));
    }
    for (int k = 0; k < elements; ++k)
      model_.add(std::make_unique<BeamElement>("column", BeamPlace{k + 1, elements}, k + 1, k + 2, Matrix3::Identity(),
                                               Matrix3::Identity(), d0, law, 0, bending),
                 Entry{Section::elements, "column"}, Recorded::stacked);
    dense_ = std::make_unique<DenseModel>(model_);
    state_ = dense_->start();
    for (NodeState& node : state_.nodes) node.x.x() *= 1 + force / section[0];
  }
  /// Returns the tangent of deflections along z and turns against y, two each for the nodes 0, 1, .. [w, -theta_y].
  MatrixX lateral() const {
    const MatrixX K = dense_->tangent(state_, DenseModel::Part::K);
    MatrixX plane(2 * (elements_ + 1), 2 * (elements_ + 1));
    const auto place = [](int k) { return 6 * (1 + k / 2) + (k % 2 == 0 ? 2 : 4); };  // after the six of `ground`
    for (int i = 0; i < plane.rows(); ++i)
      for (int j = 0; j < plane.cols(); ++j)
        plane(i, j) = K(place(i), place(j)) * (i % 2 == 0 ? 1 : -1) * (j % 2 == 0 ? 1 : -1);
    return plane;
  }
  /// Returns the same without the clamped node 0.
  MatrixX clamped() const { return lateral().bottomRightCorner(2 * elements_, 2 * elements_); }

 private:
  int elements_;
  Model model_;
  std::unique_ptr<DenseModel> dense_;
  State state_;
};

/// Returns EA, GAy, GAz, GJ, EIy, EIz of a section that does not stretch visibly, EI = 1 N m^2.
Vector6 slender(double shear) { return (Vector6() << 1e11, shear, shear, 1, 1, 1).finished(); }

/// Returns the force at which a clamped column buckles, by bisection [N].
double buckling_force(int elements, double shear) {
  double low = 0, high = 4;
  for (int k = 0; k < 60; ++k) {
    const double force = 0.5 * (low + high);
    const MatrixX K = Column(elements, slender(shear), -force).clamped();
    (Eigen::SelfAdjointEigenSolver<MatrixX>(K).eigenvalues()[0] > 0 ? low : high) = force;
  }
  return low;
}

}  // namespace

TEST_CASE("the geometric stiffness of one element is that of the cubic beam") {
  // J. Przemieniecki, Theory of Matrix Structural Analysis (1968), ch. 15: N/(30 L) [36 3L -36 3L; ..].
  for (const double force : {-2.0, 0.0, 30.0, 1000.0}) {
    const MatrixX K = Column(1, slender(1e10), force).lateral();
    MatrixX bending(4, 4), geometric(4, 4);
    bending << 12, 6, -12, 6, 6, 4, -6, 2, -12, -6, 12, -6, 6, 2, -6, 4;
    geometric << 36, 3, -36, 3, 3, 4, -3, -1, -36, -3, 36, -3, 3, -1, -3, 4;
    const MatrixX expected = bending + force / 30 * geometric;
    INFO(force);
    CHECK((K - expected).cwiseAbs().maxCoeff() < 1e-6 * expected.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("a column buckles at the cubic beam's load as one element, and converges to Haringx's") {
  // One element: 135 p^2 - 156 p + 12 = 0 with p = P L^2/(30 EI).
  CHECK_THAT(buckling_force(1, 1e9), Catch::WithinRel(30 * (156 - std::sqrt(156.0 * 156 - 6480)) / 270, 1e-6));
  // J. Haringx, Philips Res. Rep. 3 (1948) 401: P = GA/2 (sqrt(1 + 4 P_E/GA) - 1), of a force across the sections.
  // Varying shear along a compressed element is treated as constant, so that the fourth order is that of slender
  // columns.
  const double euler = std::numbers::pi * std::numbers::pi / 4;
  const auto order = [&](double shear) {
    const double haringx = 2 * euler / (std::sqrt(1 + 4 * euler / shear) + 1);
    const double coarse = buckling_force(2, shear) / haringx - 1, fine = buckling_force(4, shear) / haringx - 1;
    CHECK(std::abs(fine) < 4e-3);
    return std::log2(coarse / fine);
  };
  CHECK_THAT(order(1e9), Catch::WithinAbs(4, 0.1));
  CHECK_THAT(order(20), Catch::WithinAbs(2, 0.1));
}

TEST_CASE("a strip that is pulled hard deflects as in closed form, however long its elements") {
  // A cantilever under the tension N, pulled sideways by Q at its end: w = (Q/N) (L - tanh(k L)/k), k^2 = N/EI. An
  // element of `bending: residual` alone would yield sideways under N = 12 EI/L^2.
  for (const double k : {1.0, 4.0, 14.0, 30.0}) {
    const double tension = k * k, exact = (1 - std::tanh(k) / k) / tension;
    double before = 1;
    for (const int elements : {2, 4, 8, 16}) {
      const MatrixX K = Column(elements, slender(1e9), tension).clamped();
      CHECK(Eigen::SelfAdjointEigenSolver<MatrixX>(K).eigenvalues()[0] > 0);
      VectorX force = VectorX::Zero(K.rows());
      force[K.rows() - 2] = 1;
      const double error = std::abs(VectorX(K.lu().solve(force))[K.rows() - 2] / exact - 1);
      INFO(k << ", " << elements << " elements: " << error);
      CHECK(error < 0.05);
      CHECK(error < before);
      before = error;
    }
  }
}
