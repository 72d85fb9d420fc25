#include "reduce/reduction/tie_second_order.hpp"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "reduce/dense/dense_products.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

Eigen::Matrix3d symmetric(const Eigen::Matrix3d& a) { return (a + a.transpose()) / 2; }

/// Returns w = J_A^-1 (M + a x F): the load on an average tie as a field of forces w x r on the surface.
Eigen::Vector3d spread_moment(const TiedSurface& surface, const Interface& interface, const InterfaceLoad& load) {
  const Eigen::Vector3d arm = interface.position - surface.integrals.centroid;
  return polar_moment(surface.integrals).inverse() * (load.moment + arm.cross(load.force));
}

Eigen::MatrixXd rigid_rotation(const Ties& ties, int number, const Basis& basis) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, basis.shapes.cols());
  const auto add = [&](const std::vector<Direction>& directions, const auto& row_of) {
    for (std::size_t d = 0; d < directions.size(); ++d) {
      if (directions[d].interface == number && directions[d].axis >= 3) {
        result += ties.interfaces[number].rotation.col(directions[d].axis - 3) * row_of(static_cast<Eigen::Index>(d));
      }
    }
  };
  add(ties.kept, [&](Eigen::Index d) { return Eigen::RowVectorXd::Unit(basis.shapes.cols(), d); });
  add(ties.released, [&](Eigen::Index d) { return Eigen::RowVectorXd(basis.released.row(d)); });
  return result;
}

/// Returns int u r^T dA of a surface, columns one below the other (9,n), u the displacement.
Eigen::MatrixXd first_moments(const SurfaceIntegrals& surface, const Basis& basis) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(9, basis.shapes.cols());
  for (std::size_t k = 0; k < surface.nodes.size(); ++k) {
    const Eigen::Vector3d moment = surface.first_moments.col(static_cast<Eigen::Index>(k));
    for (int i = 0; i < 3; ++i) {
      result.middleRows<3>(3 * i) += moment(i) * basis.shapes.middleRows<3>(3 * surface.nodes[k]);
    }
  }
  return result;
}

/// Returns the term of the rotation of a surface whose mean a load follows. @param n  sum of F a^T, a from the centroid
/// to each force @param w  see spread_moment
Eigen::Matrix3d mean_rotation_term(const SurfaceIntegrals& surface, const Eigen::Matrix3d& n,
                                   const Eigen::Vector3d& w) {
  return n.trace() * Eigen::Matrix3d::Identity() - symmetric(n) + symmetric(skew(w) * surface.second_moment);
}

}  // namespace

TieSecondOrder::MeanMotion TieSecondOrder::mean_motion(const SurfaceIntegrals& surface, const Basis& basis) {
  MeanMotion motion{Eigen::MatrixXd::Zero(3, basis.shapes.cols()), first_moments(surface, basis)};
  const Eigen::Matrix3d inverse = polar_moment(surface).inverse();
  for (int j = 0; j < 3; ++j)
    motion.rotation += inverse * skew(Eigen::Vector3d::Unit(j)) * motion.deformation.middleRows<3>(3 * j);
  for (int j = 0; j < 3; ++j)
    motion.deformation.middleRows<3>(3 * j) += skew(surface.second_moment.col(j)) * motion.rotation;  // - theta x S e_j
  return motion;
}

TieSecondOrder::TieSecondOrder(const Solid& solid, const Ties& ties, const AddedMasses& masses, const Basis& basis)
    : solid_(solid), ties_(ties), masses_(masses) {
  const Eigen::Index n = basis.shapes.cols();
  for (std::size_t i = 0; i < ties.interfaces.size(); ++i) {
    const TiedSurface& surface = ties.surfaces[i];
    Eigen::MatrixXd rotation = Eigen::MatrixXd::Zero(3, n), deformation;
    if (surface.tie == Tie::rigid) {
      rotation = rigid_rotation(ties, static_cast<int>(i), basis);
    } else if (surface.tie == Tie::average) {
      MeanMotion motion = mean_motion(surface.integrals, basis);
      rotation = std::move(motion.rotation);
      deformation = std::move(motion.deformation);
    }
    rotations_.push_back(std::move(rotation));
    deformations_.push_back(std::move(deformation));
  }
  for (const AddedMass& mass : masses) of_masses_.push_back(mean_motion(mass.surface, basis));
}

Eigen::Matrix3d TieSecondOrder::rotation_term(const RowMatrix& tie_forces, Eigen::Index field,
                                              const InterfaceLoad& load, std::size_t number) const {
  const TiedSurface& surface = ties_.surfaces[number];
  const Interface& interface = ties_.interfaces[number];
  if (surface.tie == Tie::rigid) {
    Eigen::Matrix3d n = Eigen::Matrix3d::Zero();
    for (const int node : surface.nodes) {
      n += tie_forces.block<3, 1>(3 * node, field) * (solid_.mesh.points.col(node) - interface.position).transpose();
    }
    return symmetric(n) - n.trace() * Eigen::Matrix3d::Identity();
  }
  if (surface.tie == Tie::average && load.interface == static_cast<int>(number)) {
    const Eigen::Matrix3d n = load.force * (interface.position - surface.integrals.centroid).transpose();
    return mean_rotation_term(surface.integrals, n, spread_moment(surface, interface, load));
  }
  return Eigen::Matrix3d::Zero();
}

void TieSecondOrder::add_deformation(const InterfaceLoad& load, Eigen::MatrixXd& k) const {
  const auto number = static_cast<std::size_t>(load.interface);
  if (ties_.surfaces[number].tie != Tie::average) {
    return;
  }
  add_deformation(spread_moment(ties_.surfaces[number], ties_.interfaces[number], load), rotations_[number],
                  deformations_[number], k);
}

void TieSecondOrder::add_deformation(const Eigen::Vector3d& w, const Eigen::MatrixXd& rotation,
                                     const Eigen::MatrixXd& d, Eigen::MatrixXd& k) {
  const Eigen::RowVectorXd trace = d.row(0) + d.row(4) + d.row(8);
  const Eigen::MatrixXd lever =
      w(0) * d.topRows<3>() + w(1) * d.middleRows<3>(3) + w(2) * d.bottomRows<3>() - w * trace;  // D w - w tr D
  const Eigen::MatrixXd half = transposed_product(rotation, lever);
  k -= half + half.transpose();
}

void TieSecondOrder::add_release(const InterfaceLoad& load, Eigen::MatrixXd& k) const {
  const Interface& interface = ties_.interfaces[static_cast<std::size_t>(load.interface)];
  if (load.moment.isZero() || std::count(interface.kept.begin() + 3, interface.kept.end(), true) != 2) {
    return;
  }
  const auto released = std::find(interface.kept.begin() + 3, interface.kept.end(), false) - interface.kept.begin() - 3;
  const Eigen::Vector3d axis = interface.rotation.col(released);
  const Eigen::MatrixXd& theta = rotations_[static_cast<std::size_t>(load.interface)];
  const Eigen::RowVectorXd turn = axis.transpose() * theta;
  const Eigen::RowVectorXd tilt = load.moment.cross(axis).transpose() * theta;  // m.(d x theta)
  k -= (turn.transpose() * tilt + tilt.transpose() * turn) / 2;
}

void TieSecondOrder::add(const RowMatrix& tie_forces, Eigen::Index field, const InterfaceLoad& load,
                         Eigen::MatrixXd& k) const {
  for (std::size_t i = 0; i < ties_.interfaces.size(); ++i) {
    if (ties_.surfaces[i].tie != Tie::free) {
      k += congruent(rotation_term(tie_forces, field, load, i), rotations_[i]);
    }
  }
  if (load.interface >= 0) {
    add_deformation(load, k);
    add_release(load, k);
  }
}

void TieSecondOrder::add_masses(const LinearAcceleration& acceleration, Eigen::MatrixXd& k) const {
  std::size_t number = 0;
  for (const AddedMass& mass : masses_) {
    const MeanMotion& motion = of_masses_[number++];
    const Eigen::Vector3d arm = mass.position - mass.surface.centroid;
    const Eigen::Vector3d at_centre =
        acceleration.translation + acceleration.gradient * (mass.position - acceleration.centre);
    const Eigen::Matrix3d n = -mass.mass * at_centre * arm.transpose() - acceleration.gradient * mass.second_moment();
    const Eigen::Vector3d moment(n(2, 1) - n(1, 2), n(0, 2) - n(2, 0), n(1, 0) - n(0, 1));  // sum of a x F
    const Eigen::Vector3d w = polar_moment(mass.surface).inverse() * moment;
    k += congruent(mean_rotation_term(mass.surface, n, w), motion.rotation);
    add_deformation(w, motion.rotation, motion.deformation, k);
  }
}

}  // namespace bielle::reduce
