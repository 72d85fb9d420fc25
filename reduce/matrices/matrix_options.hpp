// The request for the reduction of matrices, independent of any file format. The `subject` of a request is the key by
// which the user makes it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "reduce/reduction/options.hpp"

namespace bielle::reduce {

/// An interface: a node of the matrices, or several nodes tied to a node of its own.
struct NodeInterface {
  std::string name;
  std::vector<std::int64_t> nodes;          ///< their numbers in the file
  std::vector<double> weights;              ///< of an average tie; empty: equal ones
  Tie tie = Tie::rigid;                     ///< of several nodes
  std::optional<Eigen::Vector3d> position;  ///< of a tie [m]; default: the mean of its nodes
  std::optional<Eigen::Matrix3d> rotation;  ///< interface axes -> body axes; default: axes of the node, of the body
  std::optional<std::array<bool, 6>> kept;  ///< default: all directions that the node has
  std::string subject;                      ///< "interfaces.hub"
};

/// A named point: a node, or a place among the nodes.
struct NodePoint {
  std::string name;
  std::optional<std::int64_t> node;
  std::optional<Eigen::Vector3d> place;  ///< [m]
  std::array<bool, 6> residual{};        ///< loads x y z rx ry rz, body axes, that get residual vectors
  std::string subject;                   ///< "points.tip"
};

/// Names of the rows of a recovered quantity: a list for all rows in order, or names of some rows by their number from
/// 1.
struct QuantityRows {
  std::vector<std::string> all;
  std::vector<std::pair<std::string, std::int64_t>> chosen;
  std::string subject;  ///< "matrices.quantities.gauges.rows"
};

struct MatrixOptions {
  std::string name;  ///< name of the body; empty: that of the file
  std::string input_text;
  /// If the list is empty, the interfaces are the nodes that the file declares, or else all nodes.
  std::vector<NodeInterface> interfaces;
  ModeRequest modes;                   ///< without a request: all modes of a small body
  std::vector<double> damping_ratios;  ///< as in ReductionOptions; without both: the file's damping, if it has one
  std::optional<std::array<double, 2>> rayleigh;
  std::vector<NodePoint> points;
  std::map<std::string, QuantityRows> quantity_rows;  ///< by quantity; those that are missing keep the file's names
  bool inertia_relief = false;  ///< residual vectors for the accelerations of the body itself (inertia_loads.hpp)
  /// Angular velocity about one axis of the body to which the file's geometric stiffness belongs [rad/s].
  std::optional<Eigen::Vector3d> spin;
};

}  // namespace bielle::reduce
