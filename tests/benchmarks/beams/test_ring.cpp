// Vibrations of a thin ring in and out of its plane.
//
// R. Hoppe (1871), A. Love, A Treatise on the Mathematical Theory of Elasticity, art. 293: n waves around, without
// extension, m R^4 omega^2 = EI n^2 (n^2-1)^2/(n^2+1) in the plane and EI n^2 (n^2-1)^2/(n^2+EI/GJ) out of it.
#include <cmath>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::StaticModel;

namespace {

/// Returns a quarter of a ring, R = m = EI = 1, GJ = 1/1.3, thickness 1e-3 of the radius, with the symmetries of even
/// n.
VectorX frequencies(int elements, bool in_plane, const std::string& bending) {
  StaticModel ring(fmt::format(
      "nodes: {{a: {{position: [1, 0, 0]}}, b: {{position: [0, 1, 0]}}}}\n"
      "elements: {{b: {{type: beam, nodes: [a, b], arc_centre: [0, 0, 0], orientation: [-1, 0, 0], bending: {}, "
      "elements: {}, "
      "section: {{EA: 12e6, GAy: 4e6, GAz: 4e6, GJ: 1/1.3, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 2e-7, Jy: 1e-7, Jz: "
      "1e-7}}}}}}\n",
      bending, elements));
  if (in_plane) {
    ring.keep_directions({0, 1, 5});
    for (const auto& [node, direction] : {std::pair{"a", 1}, {"a", 5}, {"b", 0}, {"b", 5}}) ring.hold(node, direction);
  } else {
    ring.keep_directions({2, 3, 4});
    for (const auto& [node, direction] : {std::pair{"a", 3}, {"b", 4}}) ring.hold(node, direction);
  }
  const MatrixX K = ring.stiffness(), M = ring.dense.tangent(ring.state, DenseModel::Part::M)(ring.free, ring.free);
  const bielle::SymmetricEigenpairs eigen = bielle::symmetric_eigenpairs(0.5 * (K + K.transpose()), M).value();
  // The ring is free out of its plane: the first frequency is zero.
  return eigen.values.segment(in_plane ? 0 : 1, 2).cwiseMax(0).cwiseSqrt();
}

}  // namespace

TEST_CASE("the frequencies of a ring are those of Hoppe and Love") {
  for (const bool in_plane : {true, false})
    for (const char* bending : {"residual", "constant"}) {
      Eigen::Vector2d exact;
      for (int k = 0; k < 2; ++k) {
        const double n2 = 4 * (k + 1) * (k + 1);
        exact[k] = std::sqrt(n2 * (n2 - 1) * (n2 - 1) / (n2 + (in_plane ? 1 : 1.3)));
      }
      std::vector<Eigen::Vector2d> errors;
      for (int elements : {4, 8, 16, 32})
        errors.emplace_back(frequencies(elements, in_plane, bending).cwiseQuotient(exact).array() - 1);
      CAPTURE(in_plane, bending, errors[0].transpose(), errors[1].transpose(), errors[2].transpose(),
              errors[3].transpose());
      if (bending[0] == 'c') {
        for (int k = 0; k < 2; ++k) CHECK_THAT(std::log2(errors[2][k] / errors[3][k]), Catch::WithinAbs(2, 0.1));
        CHECK(errors[3].cwiseAbs().maxCoeff() < 2e-3);
      } else {
        // The order is observed down to 1e-6, the effect of extension and thickness.
        for (int k = 0; k < 2; ++k) CHECK(std::log2(std::abs(errors[1][k] / errors[2][k])) > 3.7);
        CHECK(errors[3].cwiseAbs().maxCoeff() < 2e-6);
      }
    }
}
