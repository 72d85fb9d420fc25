// Ties between the nodes of the interfaces' surfaces and the interface nodes.
//
// rigid    (RBE2, kinematic coupling)  u_s = R d + (R theta) x (X_s - X): the nodes s of the surface are carried, and
//          their degrees of freedom are eliminated.
// average  (RBE3, distributing coupling)  d and theta are those of the rigid motion nearest to the surface's
//          displacement: with r from the centroid,
//          u_c = int u dA / A,  theta_b = J^-1 int r x u dA,  J = int (r.r I - r r^T) dA,
//          R d = u_c + theta_b x (X - X_c),  R theta = theta_b: conditions C u = q on nodes that stay free, and a force
//          on the interface is distributed over the surface by C^T.
// free     every node of the surface is an interface of its own with its three translations.
//
// A surface may also be nodes with weights, as decks tie them: integrals are then weighted sums over the nodes
// (fe/weighted_nodes.hpp), so that an average tie is an RBE3 whose independent components are the translations.
//
// R: interface's axes to body axes, X: interface node. The kept directions of the interfaces are the boundary degrees
// of freedom. Directions that are not kept do not hold the body: for a rigid tie they are interior unknowns
// ("released"), for an average tie they are ignored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "reduce/fe/solid.hpp"
#include "reduce/fe/surface.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A direction of an interface: x y z rx ry rz in its own axes.
struct Direction {
  int interface;
  int axis;
};

/// The surface, or the nodes with weights, tied to one interface node.
struct TiedSurface {
  Tie tie;
  std::vector<int> nodes;
  SurfaceIntegrals integrals;  ///< integrals of the surfaces of rigid and average ties
  std::string subject;         ///< that of the request
};

/// All ties of a body. `b` counts the kept directions in the order of the superelement's coordinates; columns of
/// directions for which a matrix is not defined are zero.
struct Ties {
  std::vector<Interface> interfaces;
  std::vector<TiedSurface> surfaces;  ///< one for each interface
  std::vector<Direction> kept;        ///< (b)
  std::vector<Direction> released;    ///< (c) of rigid ties
  std::vector<int> averages;          ///< the kept directions of average ties, numbers in `kept`
  std::vector<bool> tied;             ///< by point: carried by an interface
  SparseRows carry_kept;              ///< (3 points, b) displacement of the tied points
  SparseRows carry_released;          ///< (3 points, c)
  SparseRows spread;                  ///< (3 points, averages): C^T
};

/// J = int (r.r I - r r^T) dA of a surface about its centroid [m^4].
Eigen::Matrix3d polar_moment(const SurfaceIntegrals& surface);

/// C^T of an average tie for one direction of the interface: the force on each node of the surface for a unit load on
/// it. Its transpose gives the interface's motion as the surface's mean.
/// @param axis  x y z rx ry rz in the interface's axes
Eigen::Matrix3Xd spread_unit_load(const SurfaceIntegrals& surface, const Interface& interface, int axis);

/// Returns the same for all six directions, (3 nodes, 6): rows x y z of the first node, of the second ...
Eigen::MatrixXd spread_unit_loads(const SurfaceIntegrals& surface, const Interface& interface);

/// Refuses a position at a hundred times the size of the body: such an arm makes the matrices useless, and is probably
/// a wrong unit.
/// @param position  position of the node that follows the surface; default: its centroid
/// @param from      the surface in messages @throws InputError
void check_position(const std::optional<Eigen::Vector3d>& position, const SurfaceIntegrals& surface, const Mesh& mesh,
                    const char* from = "its surface");

/// @throws InputError about the request: a surface that does not exist in the mesh, points outside the solid, two
///         interfaces that share points, no direction kept, two interfaces of the same name, an interface node far from
///         the body; or about no interfaces at all
Ties make_ties(const Solid& solid, const std::vector<InterfaceRequest>& requests);

}  // namespace bielle::reduce
