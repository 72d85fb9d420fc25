// Stress and strain that a mechanism recovers, against the solid itself: tension, bending and shear of a bar in closed
// form. Quadratic cells represent these fields exactly, and a superelement whose end faces are interfaces node by node
// has them among its constraint modes: the reduction loses nothing.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/run_analyses.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/fe/stress.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace test_recovered_stress {
namespace {

constexpr double young = 210e9, poisson = 0.3;
/// Strain, and curvature [1/m]. The terms that a linear body lacks are of second order in rotations: those of the bent
/// ends, half the amount, have squares of the amount times the strain at the surface, a tenth of the amount. Positions
/// of 0.5 m are rounded to 1e-16 m over cells of 0.05 m, which is 2e-7 of that strain. So errors are some ten times the
/// amount.
constexpr double amount = 1e-7, bound = 10 * amount;

struct State {
  const char* name;
  Eigen::Vector3d (*displacement)(const Eigen::Vector3d& x);
  Eigen::Matrix<double, 6, 1> (*stress)(const Eigen::Vector3d& x);
};

const std::vector<State> states = {
    {"tension", [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), -poisson * x.y(), -poisson * x.z()); },
     [](const Eigen::Vector3d&) { return Eigen::Matrix<double, 6, 1>(young, 0, 0, 0, 0, 0); }},
    {"bending",
     [](const Eigen::Vector3d& x) {
       return Eigen::Vector3d(-x.x() * x.y(), (x.x() * x.x() + poisson * (x.y() * x.y() - x.z() * x.z())) / 2,
                              poisson * x.y() * x.z());
     },
     [](const Eigen::Vector3d& x) { return Eigen::Matrix<double, 6, 1>(-young * x.y(), 0, 0, 0, 0, 0); }}};

Superelement bar(const Mesh& mesh) {
  ReductionOptions options;
  options.name = "bar";
  options.materials = {{"steel", Material::isotropic(young, poisson, 7800)}};
  options.regions = {{"solid", "steel"}};
  for (const char* end : {"x0", "x1"}) {
    options.interfaces.emplace_back();
    options.interfaces.back().name = options.interfaces.back().group = end;
    options.interfaces.back().tie = Tie::free;
    options.interfaces.back().kept = {true, true, true, false, false, false};
  }
  options.modes.count = 0;
  options.stress_recovery = RecoveryExtent::all;
  Progress quiet(true);
  return reduce_body(mesh, options, quiet, 2);
}

/// All interfaces are moved as in the closed form, in one load step.
std::string model(const Superelement& body, const std::string& file, const State& state) {
  std::string nodes, interfaces;
  for (const Interface& interface : body.interfaces) {
    const Eigen::Vector3d &x = interface.position, u = amount * state.displacement(x);
    nodes += fmt::format(
        "  {}: {{position: [{:.17g}, {:.17g}, {:.17g}], fixed: [rx, ry, rz], motion: {{x: {:.17g}, y: {:.17g}, z: "
        "{:.17g}}}}}\n",
        interface.name, x.x(), x.y(), x.z(), u.x(), u.y(), u.z());
    interfaces += fmt::format("{0}: {0}, ", interface.name);
  }
  return fmt::format(
      "nodes:\n{}elements:\n  bar: {{type: superelement, file: \"{}\", nodes: {{{}}}}}\n"
      "output: {{fields: {{bar: [stress, strain, principal_stress]}}, peaks: {{bar: [principal_stress]}}}}\n"
      "analysis: [{{type: static}}]\n",
      nodes, file, interfaces);
}

}  // namespace

TEST_CASE("stress and strain recovered in a mechanism are those of the solid in closed form") {
  const Mesh mesh = test::distorted_box_mesh({{0.5, 0.1, 0.1}, {4, 2, 2}}, 0.2);
  const Superelement body = bar(mesh);
  const Material steel = Material::isotropic(young, poisson, 7800);
  REQUIRE(body.stress_origin.groups.at("solid").size() == body.stress_nodes.size());
  const test::TemporaryFolder folder;
  write_superelement(body, folder / "bar.h5");
  for (const State& state : states) {
    INFO(state.name);
    Progress quiet(true);
    mechanism::run_analyses(mechanism::read_mechanism_text(model(body, folder / "bar.h5", state), "bar.yaml"),
                            folder / "run.h5", quiet);
    const Hdf5File results = Hdf5File::open(folder / "run.h5");
    const std::vector<double> stress = results.read("/elements/bar/stress"),
                              strain = results.read("/elements/bar/strain"),
                              principal = results.read("/elements/bar/principal_stress");
    // Results of the full solid, from its nodal displacements.
    RowMatrix u(3 * mesh.point_count(), 1);
    for (Eigen::Index a = 0; a < mesh.point_count(); ++a)
      u.block<3, 1>(3 * a, 0) = amount * state.displacement(mesh.points.col(a));
    const Solid solid = make_solid(mesh, {{"steel", steel}}, {{"all", "steel"}});
    const RowMatrix full = nodal_stress(solid, u, body.stress_nodes);
    const double scale = amount * young * (std::string(state.name) == "bending" ? 0.1 : 1);
    double largest = 0;
    for (std::size_t k = 0; k < body.stress_nodes.size(); ++k) {
      using Vector6 = Eigen::Matrix<double, 6, 1>;
      const Vector6 exact = amount * state.stress(mesh.points.col(body.stress_nodes[k]));
      const Vector6 s = Eigen::Map<const Vector6>(&stress[6 * k]), e = Eigen::Map<const Vector6>(&strain[6 * k]);
      REQUIRE((s - exact).norm() < bound * scale);
      REQUIRE((s - full.middleRows<6>(6 * static_cast<Eigen::Index>(k))).norm() < bound * scale);
      // E eps = (1, -nu, -nu) sigma
      const Vector6 strained = exact[0] / young * Vector6(1, -poisson, -poisson, 0, 0, 0);
      REQUIRE((e - strained).norm() < bound * scale / young);
      REQUIRE(principal[3 * k] == Approx(std::max(exact[0], 0.0)).margin(bound * scale));
      REQUIRE(principal[3 * k + 2] == Approx(std::min(exact[0], 0.0)).margin(bound * scale));
      largest = std::max(largest, principal[3 * k]);
    }
    CHECK(results.read_number("/peaks/bar/solid/largest_principal/value") == largest);
  }
}

}  // namespace test_recovered_stress
