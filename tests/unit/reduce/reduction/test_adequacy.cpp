#include <catch2/catch.hpp>

#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/solid_model.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

Adequacy judged(const Mesh& mesh, const ReductionOptions& options) {
  const Superelement body = test::reduced(mesh, options);
  REQUIRE(body.adequacy);
  return *body.adequacy;
}

/// Returns the relative excess of each number of `found` over that of `truth`.
Eigen::VectorXd excess(const Eigen::VectorXd& found, const Eigen::VectorXd& truth) {
  return (found.head(truth.size()).cwiseQuotient(truth).array() - 1).matrix();
}

}  // namespace

TEST_CASE("The effect of omitted modes on free frequencies is estimated, however few modes are kept") {
  const Mesh mesh = test::twisted_block();
  const Eigen::VectorXd full =
      test::SolidModel(mesh, test::steel()).frequencies(4);  // average ties do not stiffen a free body
  const int modes = GENERATE(0, 2, 4, 10);
  const Adequacy found = judged(mesh, test::steel_body(Tie::average, Tie::average, modes));
  const Eigen::VectorXd truth =
      excess(found.frequencies, full.head(std::min<Eigen::Index>(3, found.frequencies.size())));
  for (Eigen::Index k = 0; k < truth.size(); ++k) {
    INFO(modes << " modes, frequency " << k + 1 << ": true " << truth(k) << ", found " << found.mode_error(k));
    CHECK(found.mode_error(k) < 1.02 * truth(k) + 1e-6);
    CHECK(found.mode_error(k) > 0.7 * truth(k) - 1e-6);
  }
}

TEST_CASE("The first omitted mode is the last one of a reduction with one more mode") {
  const Mesh mesh = test::twisted_block();
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 12);
  const Eigen::VectorXd twelve = test::reduced(mesh, options).frequencies;
  const auto next = [&](std::optional<int> count, std::optional<double> below) {
    options.modes.count = count;
    options.modes.below = below;
    return judged(mesh, options).next_mode;
  };
  const double between = (twelve(6) + twelve(7)) / 2;
  CHECK(next(5, {}) == Approx(twelve(5)).epsilon(1e-9));
  CHECK(next({}, between) == Approx(twelve(7)).epsilon(1e-9));
  CHECK(next(20, between) == Approx(twelve(7)).epsilon(1e-9));
  CHECK(next(3, between) == Approx(twelve(3)).epsilon(1e-9));
  CHECK(next(0, {}) == 0);
  CHECK(judged(mesh, options).wanted == 0);
}

TEST_CASE("Rigid ties stiffen the body by the reported bound, and not much more") {
  const Mesh mesh = test::twisted_block();
  const Eigen::VectorXd average = test::SolidModel(mesh, test::steel()).frequencies(4);
  const Adequacy found = judged(mesh, test::steel_body(Tie::rigid, Tie::rigid, 40));
  REQUIRE(found.tie_error.size() == 6);
  CHECK(found.rigid_ties == std::vector<std::string>{"a", "b"});
  const Eigen::VectorXd truth = excess(found.frequencies, average);
  for (Eigen::Index k = 0; k < 4; ++k) {
    INFO("frequency " << k + 1 << ": true " << truth(k) << ", found " << found.tie_error(k));
    CHECK(found.tie_error(k) < truth(k));
    CHECK(found.tie_error(k) > 0.6 * truth(k));
  }
  CHECK(judged(mesh, test::steel_body(Tie::average, Tie::free, 4)).tie_error.size() == 0);
}

TEST_CASE("The estimated mesh error of frequencies is within a factor of 2 of the true one, 2.5 in torsion") {
  // In a bar two elements wide, the smoothed stress represents the warping of the sections no better than the elements.
  const bool quadratic = GENERATE(true, false);
  const Eigen::Vector3d size(1, 0.2, 0.3);
  const int n = quadratic ? 2 : 4;
  const Mesh coarse = test::box_mesh({size, {5 * n, n, n}, quadratic});
  const Eigen::VectorXd fine = test::SolidModel(test::box_mesh({size, {20, 4, 6}}), test::steel()).frequencies(4);
  const Eigen::VectorXd truth = excess(test::SolidModel(coarse, test::steel()).frequencies(4), fine);
  const Adequacy found = judged(coarse, test::steel_body(Tie::average, Tie::average, 30));
  CHECK(found.order == (quadratic ? 2 : 1));
  for (Eigen::Index k = 0; k < 4; ++k) {
    INFO("frequency " << k + 1 << ": true " << truth(k) << ", estimated " << found.mesh_error(k));
    CHECK(found.mesh_error(k) > truth(k) / (quadratic && k == 2 ? 2.5 : 2));
    CHECK(found.mesh_error(k) < truth(k) * 2);
  }
}

TEST_CASE("All modes together have the complete response to accelerations; a few modes have less") {
  const Mesh mesh = test::box_mesh({{0.2, 0.1, 0.1}, {2, 1, 1}});
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 108);  // 36 points inside
  options.interfaces.pop_back();
  CHECK((judged(mesh, options).inertia_answer - Eigen::Vector3d::Ones()).norm() < 1e-9);
  options.modes.count = 2;  // bending
  const Eigen::Vector3d few = judged(mesh, options).inertia_answer;
  CHECK(few.x() < 0.1);
  CHECK(few.y() > 0.8);
  CHECK(few.y() < 1);
}

TEST_CASE("The judgement of a reduction can be switched off") {
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 2);
  options.judged = false;
  CHECK_FALSE(test::reduced(test::twisted_block(), options).adequacy);
}
