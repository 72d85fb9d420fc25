// Interfaces on the nodes of foreign matrices: which unknowns the kept directions carry, and which stay inside.
#pragma once

#include <string>
#include <vector>

#include "reduce/matrices/matrix_options.hpp"
#include "reduce/matrices/matrix_set.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// u = carry q + inside z, with the kept directions q (b) and the interior unknowns z (m); for average ties moreover
/// spread^T u = their part of q.
struct NodeTies {
  std::vector<Interface> interfaces;
  SparseColumns carry;              ///< (n,b); columns of average ties are zero
  SparseColumns inside;             ///< (n,m)
  std::vector<Eigen::Index> inner;  ///< (m) unknown of each interior one; -1 for a direction that an interface releases
  std::vector<int> averages;        ///< kept directions of average ties, numbers in q
  SparseColumns spread;             ///< (n, averages): force on the nodes for a unit load on each of these directions
};

/// Returns the interfaces that a file has without a request: the nodes that it declares, or all nodes that have
/// unknowns.
/// @throws InputError if these are more than 200: full matrices need a body file that names interfaces
std::vector<NodeInterface> default_interfaces(const MatrixSet& set);

/// @throws InputError about a request: no such node, a node in two interfaces, a direction without an unknown, nodes of
///         an average tie without translations or in one line
NodeTies tie_nodes(const MatrixSet& set, const std::vector<NodeInterface>& requests);

/// "hub rx": the interface and direction of a kept direction.
std::string name_of_kept(const std::vector<Interface>& interfaces, Eigen::Index kept);

/// Index of the node with this number. @throws InputError with the nearest numbers
int node_index(const MatrixSet& set, std::int64_t number);

}  // namespace bielle::reduce
