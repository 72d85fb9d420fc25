// Tests of requests for plain and reduced integration, and of the mode whose strain energy reduced integration lowers
// most.
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"
#include "reduce/reduction/integration_checks.hpp"
#include "tests/support/cell_box.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace test_integration_checks {
namespace {

const Material material = Material::isotropic(200, 0.3, 1);

/// Returns a nodal displacement field of a mesh.
RowMatrix field(const Mesh& mesh, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& u) {
  RowMatrix x(3 * mesh.point_count(), 1);
  for (Eigen::Index k = 0; k < mesh.point_count(); ++k) x.middleRows<3>(3 * k) = u(mesh.points.col(k));
  return x;
}

}  // namespace

TEST_CASE("plain and reduced integration are accepted for meshes with cells to which they apply") {
  const auto refused = [](CellType type, Integration integration) {
    const Mesh mesh = test::cell_box(type, {1, 1, 1}, {1, 1, 1});
    try {
      check_integration(mesh, integration);
    } catch (const InputError&) {
      return true;
    }
    return false;
  };
  for (const CellType type : {CellType::hex8, CellType::wedge6, CellType::hex20, CellType::tet10}) {
    CAPTURE(cell_name(type));
    CHECK_FALSE(refused(type, Integration::standard));
    CHECK(refused(type, Integration::plain) == (type != CellType::hex8 && type != CellType::wedge6));
    CHECK(refused(type, Integration::reduced) == (type != CellType::hex20));
  }
}

TEST_CASE(
    "an hourglass mode is found by its strain energy with full integration; residual vectors do not count as modes") {
  // The mesh is a cube of one cell from 0 to 2. The linear field has constant strain. With x, y, z from the centre, the
  // hourglass field has the strains y^2 - z^2, z^2 - x^2, x^2 - y^2 and no shear, which are all zero at the 2 x 2 x 2
  // points.
  const Mesh mesh = test::cell_box(CellType::hex20, {2, 2, 2}, {1, 1, 1});
  Solid solid = make_solid(mesh, {{"m", material}}, {{"all", "m"}}, Integration::reduced);
  const auto energy = [&](const RowMatrix& u, Integration integration) {
    Solid other = solid;
    other.integration = integration;
    return (u.array() * assemble_stiffness(other, node_graph(mesh, 1), 1).multiply(u, 1).array()).sum();
  };
  const RowMatrix stretch = field(mesh, [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), 0, 0); });
  const RowMatrix hourglass = field(mesh, [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d x = p - Eigen::Vector3d::Ones();
    return Eigen::Vector3d(x.x() * (x.y() * x.y() - x.z() * x.z()), x.y() * (x.z() * x.z() - x.x() * x.x()),
                           x.z() * (x.x() * x.x() - x.y() * x.y()));
  });
  REQUIRE(energy(hourglass, Integration::standard) > 1e3 * std::abs(energy(hourglass, Integration::reduced)));
  Basis basis;
  basis.shapes.resize(stretch.rows(), 4);
  basis.shapes << hourglass, stretch, stretch + hourglass, stretch + 10 * hourglass;
  basis.eigenvalues.resize(3);
  for (int k = 0; k < 3; ++k) basis.eigenvalues[k] = energy(basis.shapes.col(k + 1), Integration::reduced);
  basis.residual_vectors = 1;
  const std::optional<HourglassMode> worst = worst_hourglass_mode(solid, basis, 1);
  REQUIRE(worst);
  CHECK(worst->mode == 1);
  const double expected =
      energy(basis.shapes.col(2), Integration::standard) / energy(basis.shapes.col(2), Integration::reduced);
  CHECK(expected > 1.1);
  CHECK(worst->ratio == Approx(expected).epsilon(1e-9));
  basis.residual_vectors = 3;
  CHECK_FALSE(worst_hourglass_mode(solid, basis, 1));
}

}  // namespace test_integration_checks
