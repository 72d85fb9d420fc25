// Craig and Bampton's method on a beam: relative frequency errors against the number of fixed-boundary modes.
//
// Reference: the same method on an Euler-Bernoulli beam with its four boundary freedoms and exact clamped-clamped
// modes (tests/references/fixed_boundary_modes.py). A slender solid beam must show the same
// errors against its own full model, but for shear and the mesh, which lower the errors of the higher modes: by up to
// 20 % with 32 bricks along the beam, 4.5 % with 64, hence 3 % are allowed with 96.
#include <map>
#include <numbers>
#include <string>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

/// A strip 1 m x 15 mm x 5 mm; it bends along z first.
const test::Box strip{{1, 0.015, 0.005}, {96, 1, 1}};
const Material steel = Material::isotropic(210e9, 0.3, 7800);

Superelement reduced_strip(Tie a, int modes) {
  ReductionOptions options;
  options.name = "strip";
  options.materials = {{"steel", steel}};
  options.regions = {{"all", "steel"}};
  options.interfaces.resize(2);
  options.interfaces[0].name = options.interfaces[0].group = "x0";
  options.interfaces[1].name = options.interfaces[1].group = "x1";
  options.interfaces[0].tie = a;
  options.interfaces[1].tie = Tie::average;
  options.modes.count = modes;
  Progress quiet(true);
  return reduce_body(test::box_mesh(strip), options, quiet, 2);
}

/// Returns the modes that bend along z: their mass lies in component 33.
std::vector<int> bending_modes(const Superelement& body) {
  std::vector<int> result;
  for (Eigen::Index k = body.interface_directions(); k < body.size(); ++k) {
    if (body.inertia_components[2](k, k) > 0.9) {
      result.push_back(static_cast<int>(k));
    }
  }
  return result;
}

/// Frequencies [Hz] of the body restricted to some coordinates, from the first elastic one.
Eigen::VectorXd restricted(const Superelement& body, const std::vector<int>& coordinates, int rigid) {
  const Eigen::VectorXd scale = body.mass.diagonal()(coordinates).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd k =
      scale.asDiagonal() * Eigen::MatrixXd(body.stiffness(coordinates, coordinates)) * scale.asDiagonal();
  const Eigen::MatrixXd m =
      scale.asDiagonal() * Eigen::MatrixXd(body.mass(coordinates, coordinates)) * scale.asDiagonal();
  const bielle::SymmetricEigenpairs eigen = bielle::symmetric_eigenpairs(k, m).value();
  return eigen.values.tail(eigen.values.size() - rigid).cwiseSqrt() / (2 * std::numbers::pi);
}

/// The frequencies of a full model that bend along z are those near b^2 times the first of Euler and Bernoulli.
Eigen::VectorXd nearest(const Eigen::VectorXd& all, const std::vector<double>& guesses) {
  Eigen::VectorXd result(guesses.size());
  for (std::size_t k = 0; k < guesses.size(); ++k) {
    Eigen::Index at = 0;
    (all.array() - guesses[k]).abs().minCoeff(&at);
    result(static_cast<Eigen::Index>(k)) = all(at);
    CHECK(all(at) == Approx(guesses[k]).epsilon(0.02));
  }
  return result;
}

void check_table(const Superelement& body, const std::vector<int>& boundary, int rigid, const Eigen::VectorXd& full,
                 const std::string& ends, const std::map<int, int>& counts) {
  const test::ReferenceTable table("fixed_boundary_modes");
  const std::vector<int> modes = bending_modes(body);
  for (const auto& [kept, count] : counts) {
    REQUIRE(static_cast<int>(modes.size()) >= kept);
    std::vector<int> coordinates = boundary;
    coordinates.insert(coordinates.end(), modes.begin(), modes.begin() + kept);
    const Eigen::VectorXd found = restricted(body, coordinates, rigid);
    for (int k = 0; k < count; ++k) {
      const double error = found(k) / full(k) - 1;
      const double exact = table(ends + "." + std::to_string(kept) + ".error_" + std::to_string(k + 1));
      INFO(kept << " modes, frequency " << k + 1 << ": error " << error << ", in closed form " << exact);
      // The full model bends in three dimensions. Its motions outside the plane of the strip (twist by an unsymmetric
      // mesh) come to less than 1e-6.
      CHECK(error > -1e-9);
      CHECK(error == Approx(exact).epsilon(0.03).margin(1e-6));
    }
  }
}

}  // namespace

TEST_CASE("Free-free and cantilever frequencies of a reduced beam err as in closed form") {
  const double first = std::sqrt(210e9 * 0.005 * 0.005 / 12 / 7800) / (2 * std::numbers::pi);
  const auto hertz = [&](double beta) { return beta * beta * first; };
  const test::ReferenceTable exact("fixed_boundary_modes");
  const test::SolidModel free_strip(test::box_mesh(strip), steel);
  const Eigen::VectorXd free_full =
      nearest(free_strip.frequencies(14), {hertz(exact("free.root_1")), hertz(exact("free.root_2")),
                                           hertz(exact("free.root_3")), hertz(exact("free.root_4"))});
  check_table(reduced_strip(Tie::average, 20), {2, 4, 8, 10}, 2, free_full, "free",
              {{0, 2}, {1, 3}, {2, 3}, {4, 4}, {6, 4}, {8, 4}});

  const test::SolidModel cantilever(test::box_mesh(strip), steel,
                                    [](const Eigen::Vector3d& x, int) { return x.x() < 1e-9; });
  const Eigen::VectorXd held_full =
      nearest(cantilever.frequencies(8),
              {hertz(exact("held.root_1")), hertz(exact("held.root_2")), hertz(exact("held.root_3"))});
  check_table(reduced_strip(Tie::rigid, 20), {8, 10}, 0, held_full, "held", {{0, 2}, {1, 3}, {2, 3}, {4, 3}, {6, 3}});
}

TEST_CASE("Frequencies of a thick cantilever and of the free beam agree with Timoshenko's theory") {
  // 1 x 0.1 x 0.1 m of steel, shear factor 5/6. Solids lie within 0.3 % of it in the first modes; a fully clamped end,
  // which hinders the contraction, adds 0.5 %.
  ReductionOptions options;
  options.materials = {{"steel", steel}};
  options.regions = {{"all", "steel"}};
  options.interfaces.resize(1);
  options.interfaces[0].name = options.interfaces[0].group = "x0";
  options.modes.count = 3;
  options.stress_recovery = RecoveryExtent::none;
  Progress quiet(true);
  const Mesh mesh = test::box_mesh({{1, 0.1, 0.1}, {24, 3, 3}});
  const Superelement held = reduce_body(mesh, options, quiet, 2);
  const test::ReferenceTable exact("timoshenko_beam");
  for (const auto& [mode, name] : {std::pair{0, "thick.clamped_1"}, {1, "thick.clamped_1"}, {2, "thick.clamped_2"}}) {
    CHECK(held.frequencies(mode) > exact(name));
    CHECK(held.frequencies(mode) < 1.008 * exact(name));
  }
  const Eigen::VectorXd found = test::SolidModel(mesh, steel).frequencies(2);
  CHECK(found(0) == Approx(exact("thick.free")).epsilon(3e-3));
  CHECK(found(1) == Approx(exact("thick.free")).epsilon(3e-3));
}
