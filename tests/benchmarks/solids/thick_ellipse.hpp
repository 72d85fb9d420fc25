// NAFEMS LE10: a thick elliptic plate under pressure, the stress at the edge of its opening.
//
// NAFEMS, The Standard NAFEMS Benchmarks (1990), LE10: a quarter of a plate between the ellipses with semi-axes 2, 1
// and 3.25, 2.75 m, 0.6 m thick, E = 210 GPa, nu = 0.3, 1 MPa on the upper face; outer edge held in x and y, and in z
// along its middle line. Target: sigma_yy = -5.38 MPa at D = (2, 0) on the upper face. Its digits are those of a
// support along a line, under which the displacement of a solid grows without limit as the mesh is refined: it is known
// to 0.6 % (brick meshes up to 20 x 30 x 6 give values between -5.37 and -5.41).
#pragma once

#include <cmath>

#include "reduce/fe/stress.hpp"
#include "reduce/fe/surface.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/solid_model.hpp"

namespace bielle::test {

constexpr double thick_ellipse_target = -5.38e6;  // sigma_yy at D [Pa]

/// Computes sigma_yy at D [Pa]. @param bricks  numbers of bricks across, around and through the plate
inline double thick_ellipse_stress(const std::array<int, 3>& bricks) {
  using namespace reduce;
  const Mesh mesh = box_mesh({{1, 1, 1}, bricks}, [](const Eigen::Vector3d& x) {
    const double angle = std::acos(0.0) * x.y();
    return Eigen::Vector3d((2 + 1.25 * x.x()) * std::cos(angle), (1 + 1.75 * x.x()) * std::sin(angle),
                           0.6 * (x.z() - 0.5));
  });
  const auto outside = [](const Eigen::Vector3d& x) {
    return std::abs(std::pow(x.x() / 3.25, 2) + std::pow(x.y() / 2.75, 2) - 1) < 1e-9;
  };
  const SolidModel model(mesh, Material::isotropic(210e9, 0.3, 7800), [&](const Eigen::Vector3d& x, int i) {
    if (i == 2) return outside(x) && std::abs(x.z()) < 1e-9;
    return outside(x) || std::abs(i == 0 ? x.x() : x.y()) < 1e-9;
  });
  const SurfaceIntegrals top = integrate_surface(mesh, "z1");
  const Eigen::Matrix3Xd pressure = pressure_forces(top, 1e6);
  RowMatrix load = RowMatrix::Zero(3 * mesh.point_count(), 1);
  for (std::size_t k = 0; k < top.nodes.size(); ++k)
    load.middleRows<3>(3 * top.nodes[k]) = pressure.col(static_cast<Eigen::Index>(k));
  int d = 0;
  for (int p = 0; p < mesh.point_count(); ++p)
    if ((mesh.points.col(p) - Eigen::Vector3d(2, 0, 0.3)).norm() < 1e-9) d = p;
  return nodal_stress(model.solid, model.solve(load), {d})(1, 0);
}

}  // namespace bielle::test
