#include "reduce/reduction/free_body.hpp"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/reduction/reduced_matrices.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/reduction/tie_second_order.hpp"

namespace bielle::reduce {

namespace {

/// Acceleration a0 + A r [m/s^2 per unit of the load] and the load that belongs to it.
struct FreeBodyLoad {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  InterfaceLoad applied;  // no load for spins
};

FreeBodyLoad spin_load(int k, int l, const MassProperties& body) {
  const Eigen::Vector3d ek = Eigen::Vector3d::Unit(k), el = Eigen::Vector3d::Unit(l);
  const Eigen::Vector3d moment = (ek.cross(body.inertia * el) + el.cross(body.inertia * ek)) / 2;
  FreeBodyLoad load;
  load.gradient = (skew(ek) * skew(el) + skew(el) * skew(ek)) / 2 + skew(-body.inertia.inverse() * moment);
  return load;
}

FreeBodyLoad interface_load(const std::vector<Interface>& interfaces, Direction direction, const MassProperties& body) {
  const Interface& interface = interfaces[direction.interface];
  const Eigen::Vector3d unit = interface.rotation.col(direction.axis % 3);
  FreeBodyLoad load;
  InterfaceLoad& applied = load.applied;
  applied.interface = direction.interface;
  (direction.axis < 3 ? applied.force : applied.moment) = unit;
  load.translation = applied.force / body.mass;
  const Eigen::Vector3d moment = applied.moment + (interface.position - body.centre).cross(applied.force);
  load.gradient = skew(body.inertia.inverse() * moment);
  return load;
}

std::vector<Direction> kept_directions(const std::vector<Interface>& interfaces) {
  std::vector<Direction> result;
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    for (int axis = 0; axis < 6; ++axis) {
      if (interfaces[i].kept[axis]) {
        result.push_back({static_cast<int>(i), axis});
      }
    }
  }
  return result;
}

std::vector<FreeBodyLoad> all_loads(const std::vector<Interface>& interfaces, const MassProperties& body) {
  std::vector<FreeBodyLoad> loads;
  for (const auto& [k, l] : voigt_pairs) {
    loads.push_back(spin_load(k, l, body));
  }
  for (const Direction direction : kept_directions(interfaces)) {
    loads.push_back(interface_load(interfaces, direction, body));
  }
  return loads;
}

/// Returns the amplitudes of the linear fields in the accelerations of the loads: (12, loads).
Eigen::MatrixXd field_amplitudes(const std::vector<FreeBodyLoad>& loads) {
  Eigen::MatrixXd result(LinearFields::count, loads.size());
  for (std::size_t f = 0; f < loads.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      result(4 * i, f) = loads[f].translation(i);
      result.block<3, 1>(4 * i + 1, f) = loads[f].gradient.row(i).transpose();
    }
  }
  return result;
}

/// Solves K~_bb q = f for self-equilibrated f; q has no rigid part in the metric of `scale`.
Eigen::MatrixXd solve_free(const Eigen::MatrixXd& k, const Eigen::VectorXd& scale, const Eigen::MatrixXd& f) {
  const Eigen::MatrixXd scaled = scale.asDiagonal() * k * scale.asDiagonal();
  const SymmetricEigenpairs eigen = symmetric_eigenpairs((scaled + scaled.transpose()) / 2);
  const Eigen::Index rigid = 6, elastic = std::max<Eigen::Index>(0, k.rows() - rigid);
  const Eigen::MatrixXd vectors = scale.asDiagonal() * eigen.vectors.rightCols(elastic);
  return product(vectors, eigen.values.tail(elastic).cwiseInverse().asDiagonal() * transposed_product(vectors, f));
}

}  // namespace

std::vector<Eigen::Matrix3d> virials(const std::vector<Interface>& interfaces, const MassProperties& body) {
  const Eigen::Matrix3d second =
      body.inertia.trace() / 2 * Eigen::Matrix3d::Identity() - body.inertia;  // int rho r r^T
  std::vector<Eigen::Matrix3d> result;
  for (const FreeBodyLoad& load : all_loads(interfaces, body)) {
    result.push_back(-load.gradient * second);
    if (load.applied.interface >= 0) {
      result.back() += load.applied.force * (interfaces[load.applied.interface].position - body.centre).transpose();
    }
  }
  return result;
}

GeometricStiffness geometric_stiffness(const Solid& solid, const BodyMatrices& matrices, const Ties& ties,
                                       const Basis& basis, const MassProperties& body,
                                       const Eigen::MatrixXd& reduced_stiffness, bool with_loads, Progress& progress) {
  std::vector<FreeBodyLoad> loads = all_loads(ties.interfaces, body);
  if (!with_loads) {
    loads.resize(voigt_pairs.size());
  }
  const auto count = static_cast<Eigen::Index>(loads.size());
  const Eigen::Index kept = basis.kept();
  const Eigen::MatrixXd amplitudes = field_amplitudes(loads);
  const RowMatrix constraint_modes = basis.shapes.leftCols(kept);

  Eigen::MatrixXd interface_forces = -inner_products(constraint_modes, basis.linear.inertia) * amplitudes;
  if (with_loads) {
    interface_forces.rightCols(kept) += Eigen::MatrixXd::Identity(kept, kept);
  }
  const double length = std::sqrt(body.inertia.trace() / body.mass);
  Eigen::VectorXd scale(kept);
  for (Eigen::Index d = 0; d < kept; ++d) {
    scale(d) = ties.kept[d].axis < 3 ? 1 : 1 / length;
  }
  const Eigen::MatrixXd q = solve_free(reduced_stiffness.topLeftCorner(kept, kept), scale, interface_forces);
  const RowMatrix fields = constraint_modes * q - basis.linear.held * amplitudes;
  const bool carries = std::any_of(ties.surfaces.begin(), ties.surfaces.end(),
                                   [](const TiedSurface& surface) { return surface.tie == Tie::rigid; });
  RowMatrix tie_forces;  // forces of rigid ties, which only they use
  if (carries) tie_forces = matrices.stiffness_times(fields) + basis.linear.inertia * amplitudes;

  const TieSecondOrder second_order(solid, ties, matrices.masses(), basis);
  GeometricStiffness result;
  constexpr Eigen::Index chunk = 18;  // matrices of the mesh in memory at a time: all of a body with two interfaces
  for (Eigen::Index first = 0; first < count; first += chunk) {
    const Eigen::Index width = std::min(chunk, count - first);
    std::vector<Eigen::MatrixXd> reduced =
        width == count ? matrices.geometric_stiffness(fields, basis.shapes)
                       : matrices.geometric_stiffness(fields.middleCols(first, width), basis.shapes);
    for (Eigen::Index f = 0; f < width; ++f) {
      const Eigen::Index field = first + f;
      Eigen::MatrixXd& k = reduced[f];
      second_order.add(tie_forces, field, loads[field].applied, k);
      second_order.add_masses({loads[field].translation, loads[field].gradient, body.centre}, k);
      k = Eigen::MatrixXd(k + k.transpose()) / 2;
      field < 6 ? void(result.spin[field] = std::move(k)) : result.load.push_back(std::move(k));
    }
    progress.update(static_cast<double>(first + width) / static_cast<double>(count));
  }
  result.rotations = second_order.rotations();
  if (with_loads) result.load_fields = fields.rightCols(kept);
  return result;
}

}  // namespace bielle::reduce
