#include "reduce/reduction/free_body.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "reduce/fe/geometric_stiffness.hpp"
#include "reduce/reduction/reduced_matrices.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

constexpr std::array<std::array<int, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// Acceleration a0 + A r [m/s^2 per unit of the load] and the load that goes with it.
struct FreeBodyLoad {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  int interface = -1;                                                                 // none for spins
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  // on it, body axes
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
  load.interface = direction.interface;
  (direction.axis < 3 ? load.force : load.moment) = unit;
  load.translation = load.force / body.mass;
  const Eigen::Vector3d moment = load.moment + (interface.position - body.centre).cross(load.force);
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
  for (const auto& [k, l] : pairs) {
    loads.push_back(spin_load(k, l, body));
  }
  for (const Direction direction : kept_directions(interfaces)) {
    loads.push_back(interface_load(interfaces, direction, body));
  }
  return loads;
}

/// Amplitudes of the linear fields in the accelerations of the loads: (12, loads).
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

/// q with K~_bb q = f for self-equilibrated f, without rigid motion in the metric of `scale`.
Eigen::MatrixXd solve_free(const Eigen::MatrixXd& k, const Eigen::VectorXd& scale, const Eigen::MatrixXd& f) {
  const Eigen::MatrixXd scaled = scale.asDiagonal() * k * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((scaled + scaled.transpose()) / 2);
  const Eigen::Index rigid = 6, elastic = std::max<Eigen::Index>(0, k.rows() - rigid);
  const auto vectors = eigen.eigenvectors().rightCols(elastic);
  return scale.asDiagonal() * vectors * eigen.eigenvalues().tail(elastic).cwiseInverse().asDiagonal() *
         vectors.transpose() * scale.asDiagonal() * f;
}

Eigen::Matrix3d symmetric(const Eigen::Matrix3d& a) { return (a + a.transpose()) / 2; }

/// Second-order term of one interface: theta^T H theta / 2 is its energy.
Eigen::Matrix3d tie_stiffness(const Solid& solid, const TiedSurface& surface, const Interface& interface,
                              const RowMatrix& tie_forces, Eigen::Index field, const FreeBodyLoad& load, int number) {
  if (surface.tie == Tie::rigid) {
    Eigen::Matrix3d n = Eigen::Matrix3d::Zero();
    for (const int node : surface.nodes) {
      n += tie_forces.block<3, 1>(3 * node, field) * (solid.mesh.points.col(node) - interface.position).transpose();
    }
    return symmetric(n) - n.trace() * Eigen::Matrix3d::Identity();
  }
  if (surface.tie == Tie::average && load.interface == number) {
    const Eigen::Vector3d arm = interface.position - surface.integrals.centroid;
    const Eigen::Matrix3d n = load.force * arm.transpose();
    const Eigen::Vector3d w = polar_moment(surface.integrals).inverse() * (load.moment + arm.cross(load.force));
    return n.trace() * Eigen::Matrix3d::Identity() - symmetric(n) +
           symmetric(skew(w) * surface.integrals.second_moment);
  }
  return Eigen::Matrix3d::Zero();
}

/// Rotation of an interface, body axes, in terms of q: (3, n).
Eigen::MatrixXd interface_rotation(const Ties& ties, int number, const Basis& basis) {
  const Interface& interface = ties.interfaces[number];
  const TiedSurface& surface = ties.surfaces[number];
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, basis.shapes.cols());
  if (surface.tie == Tie::average) {
    const Eigen::Matrix3d inverse = polar_moment(surface.integrals).inverse();
    for (std::size_t k = 0; k < surface.nodes.size(); ++k) {
      result += inverse * skew(surface.integrals.first_moments.col(static_cast<Eigen::Index>(k))) *
                basis.shapes.middleRows<3>(3 * surface.nodes[k]);
    }
  } else if (surface.tie == Tie::rigid) {
    const auto add = [&](const std::vector<Direction>& directions, const auto& row_of) {
      for (std::size_t d = 0; d < directions.size(); ++d) {
        if (directions[d].interface == number && directions[d].axis >= 3) {
          result += interface.rotation.col(directions[d].axis - 3) * row_of(static_cast<Eigen::Index>(d));
        }
      }
    };
    add(ties.kept, [&](Eigen::Index d) { return Eigen::RowVectorXd::Unit(basis.shapes.cols(), d); });
    add(ties.released, [&](Eigen::Index d) { return Eigen::RowVectorXd(basis.released.row(d)); });
  }
  return result;
}

}  // namespace

std::vector<Eigen::Matrix3d> virials(const std::vector<Interface>& interfaces, const MassProperties& body) {
  const Eigen::Matrix3d second =
      body.inertia.trace() / 2 * Eigen::Matrix3d::Identity() - body.inertia;  // int rho r r^T
  std::vector<Eigen::Matrix3d> result;
  for (const FreeBodyLoad& load : all_loads(interfaces, body)) {
    result.push_back(-load.gradient * second);
    if (load.interface >= 0) {
      result.back() += load.force * (interfaces[load.interface].position - body.centre).transpose();
    }
  }
  return result;
}

GeometricStiffness geometric_stiffness(const Solid& solid, const NodeGraph& graph, const SymmetricMatrix& stiffness,
                                       const Ties& ties, const Basis& basis, const MassProperties& body,
                                       const Eigen::MatrixXd& reduced_stiffness, bool with_loads, Progress& progress,
                                       int threads) {
  std::vector<FreeBodyLoad> loads = all_loads(ties.interfaces, body);
  if (!with_loads) {
    loads.resize(pairs.size());
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
  RowMatrix tie_forces = stiffness.multiply(fields, threads) + basis.linear.inertia * amplitudes;

  std::vector<Eigen::MatrixXd> rotations;
  for (std::size_t i = 0; i < ties.interfaces.size(); ++i) {
    rotations.push_back(interface_rotation(ties, static_cast<int>(i), basis));
  }
  GeometricStiffness result;
  constexpr Eigen::Index chunk = 18;  // matrices of the mesh in memory at a time: all of a body with two interfaces
  for (Eigen::Index first = 0; first < count; first += chunk) {
    const Eigen::Index width = std::min(chunk, count - first);
    std::vector<Eigen::MatrixXd> reduced =
        reduced_geometric_stiffness(solid, graph, fields.middleCols(first, width), basis.shapes, threads);
    for (Eigen::Index f = 0; f < width; ++f) {
      const Eigen::Index field = first + f;
      Eigen::MatrixXd& k = reduced[f];
      for (std::size_t i = 0; i < ties.interfaces.size(); ++i) {
        if (ties.surfaces[i].tie != Tie::free) {
          k += rotations[i].transpose() *
               tie_stiffness(solid, ties.surfaces[i], ties.interfaces[i], tie_forces, field, loads[field],
                             static_cast<int>(i)) *
               rotations[i];
        }
      }
      k = Eigen::MatrixXd(k + k.transpose()) / 2;
      field < 6 ? void(result.spin[field] = std::move(k)) : result.load.push_back(std::move(k));
    }
    progress.update(static_cast<double>(first + width) / static_cast<double>(count));
  }
  return result;
}

}  // namespace bielle::reduce
