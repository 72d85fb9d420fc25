#include "mechanism/solvers/start/undriven_motions.hpp"

#include <cmath>

#include "mechanism/model/start_coordinates.hpp"
#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {
namespace {

/// Returns a basis of the null space, orthonormal with respect to the weights (dofs).
MatrixX null_space(const System& system, const NewtonMatrix& linear, const VectorX& weights, int most) {
  constexpr double nothing = 1e-4;  // remainder of a vector of length one if all motions are determined
  constexpr int passes = 4;         // each pass reduces a motion with a soft stiffness k by the factor e D/k
  MatrixX basis(system.dofs(), 0);
  VectorX r = VectorX::Zero(system.size()), projected(system.size());
  for (int k = 0; k < most; ++k) {
    VectorX trial(system.dofs());
    for (Eigen::Index i = 0; i < trial.size(); ++i)  // the direction is not aligned with any axis
      trial[i] =
          std::sin(1 + 1.7 * static_cast<double>(i) + 2.3 * k * static_cast<double>(i + 1)) / std::sqrt(weights[i]);
    trial /= std::sqrt(trial.dot(weights.cwiseProduct(trial)));
    VectorX motion = trial;
    for (int pass = 0; pass < passes; ++pass) {
      r.head(system.dofs()) = -weights.cwiseProduct(motion);
      linear.solve(r, projected);
      motion = projected.head(system.dofs());
    }
    for (int again = 0; again < 2; ++again) {
      const VectorX along = basis.transpose() * weights.cwiseProduct(motion);
      motion -= basis * along;
    }
    const double length = std::sqrt(motion.dot(weights.cwiseProduct(motion)));
    if (!(length > nothing)) break;
    basis.conservativeResize(Eigen::NoChange, k + 1);
    basis.col(k) = motion / length;
  }
  return basis;
}

/// Coordinates that may name a motion, with their change in each motion.
struct Candidates {
  std::vector<std::string> names;
  std::vector<VectorX> changes;  ///< (motions) for each
  void add(const std::string& name, const VectorX& change) {
    names.push_back(name);
    changes.push_back(change);
  }
};

Candidates of_joints(const System& system, const Environment& environment, const State& state, const MatrixX& basis,
                     double length) {
  Candidates result;
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const std::vector<StartCoordinate> all = start_coordinates_of(*system.model().members()[m].component);
    for (std::size_t k = 0; k < all.size(); ++k) {
      VectorX change = VectorX::Zero(basis.cols());
      for (const auto& [dof, derivative] : coordinate_row(system, environment, state, m, k).by_position)
        change += derivative * basis.row(dof).transpose();
      result.add(coordinate_name(system, m, all[k]), change / (all[k].units == "m" ? length : 1));
    }
  }
  return result;
}

Candidates of_nodes(const System& system, const MatrixX& basis, double length) {
  Candidates result;
  for (int i = 0; i < system.dofs(); ++i)
    result.add(system.unknown_name(i), basis.row(i).transpose() / (system.kind(i) == Kind::translation ? length : 1));
  return result;
}

/// Selects the coordinate that changes most, and removes its motion from all.
/// @returns its change; 0 if none changes
double take_largest(Candidates& of, Candidates& others, double least, std::vector<std::string>& names) {
  std::size_t largest = 0;
  double size = 0;
  for (std::size_t k = 0; k < of.changes.size(); ++k)
    if (const double change = of.changes[k].norm(); change > size * (1 + 1e-9)) {
      size = change;
      largest = k;
    }
  if (!(size > least)) return 0;
  names.push_back(of.names[largest]);
  const VectorX direction = of.changes[largest] / size;
  for (Candidates* each : {&of, &others})
    for (VectorX& change : each->changes) change -= direction.dot(change) * direction;
  return size;
}

}  // namespace

UndrivenMotions find_undriven(const System& system, const Environment& environment, const State& state, int most) {
  constexpr double e = 1e-9;
  UndrivenMotions result;
  if (system.dofs() == 0) return result;
  Environment unloaded = environment;
  unloaded.gravity.setZero();
  unloaded.load_factor = 0;
  unloaded.statics = true;
  State resting = state;
  system.set_rates(resting, VectorX::Zero(system.dofs()), VectorX::Zero(system.dofs()));
  resting.multiplier.setZero();
  resting.reaction.resize(0);
  NewtonMatrix linear(system);
  const TangentWeights weights{1, 0, 0, 0, 1, true};
  linear.assemble(resting, unloaded, weights, nullptr);
  const VectorX held = small_diagonal(system, linear, state, e);
  if (!linear.try_factor(resting, unloaded, weights, nullptr, &held)) linear.throw_singular(state.time);
  result.directions = null_space(system, linear, held, most);
  const double extent = model_extent(state), length = extent > 0 ? extent : 1;
  Candidates joints = of_joints(system, unloaded, resting, result.directions, length),
             nodes = of_nodes(system, result.directions, length);
  double size = 0;  // size of all motions, by their largest coordinate
  for (const VectorX& change : nodes.changes) size = std::max(size, change.norm());
  for (Eigen::Index k = 0; k < result.directions.cols(); ++k)
    if (take_largest(joints, nodes, 1e-3 * size, result.names) == 0) take_largest(nodes, joints, 0, result.names);
  return result;
}

}  // namespace bielle::mechanism
