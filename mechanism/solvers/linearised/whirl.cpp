#include "mechanism/solvers/linearised/whirl.hpp"

#include "mechanism/solvers/linearised/mode_parts.hpp"

namespace bielle::mechanism {
namespace {

/// Inertias of a node's free translations and rotations: means of their diagonal entries, or zero if none is free.
struct NodeInertia {
  double mass = 0, moment = 0;
};

NodeInertia node_inertia(const System& system, const VectorX& diagonal, int node) {
  NodeInertia inertia;
  const NodeFreedom& freedom = system.kinematics().freedom(node);
  if (freedom.count == 0 || system.kinematics().carry(node)) return inertia;
  const int translations = freedom.count - freedom.rotations;
  if (translations > 0) inertia.mass = diagonal.segment(freedom.begin, translations).mean();
  if (freedom.rotations > 0) inertia.moment = diagonal.segment(freedom.begin + translations, freedom.rotations).mean();
  return inertia;
}

/// Sums over the nodes.
struct Orbits {
  double around = 0, across = 0, whole = 0;
  void add(double inertia, const Eigen::Vector3cd& moved, const Eigen::Matrix3d& frame) {
    const Eigen::Vector3cd local = frame.transpose().cast<std::complex<double>>() * moved;
    around -= 2 * inertia * (std::conj(local[0]) * local[1]).imag();
    across += inertia * local.head<2>().squaredNorm();
    whole += inertia * local.squaredNorm();
  }
};

}  // namespace

std::optional<double> whirl_of(const System& system, const State& state, const LinearisedEquations::Sparse& M,
                               const Mode& mode, const Vector3& axis) {
  Matrix3 frame;
  frame.col(0) = axis.unitOrthogonal();
  frame.col(1) = axis.cross(frame.col(0));
  frame.col(2) = axis;
  const NodeShapes shapes = node_shapes(system, state, mode);
  const VectorX diagonal = M.diagonal();
  Orbits orbits;
  for (int k = 0; k < static_cast<int>(state.nodes.size()); ++k) {
    const NodeInertia inertia = node_inertia(system, diagonal, k);
    orbits.add(inertia.mass, shapes.displacement.col(k), frame);
    orbits.add(inertia.moment, shapes.rotation.col(k), frame);
  }
  constexpr double least = 0.1;
  if (!(orbits.across > least * orbits.whole)) return std::nullopt;
  return orbits.around / orbits.across;
}

}  // namespace bielle::mechanism
