// Motions of sets of matrices at their nodes and points, and places that two sets have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "reduce/matrices/matrix_study.hpp"

namespace bielle::reduce {

/// Motions at places that have all three displacements: nodes first, then points of shapes.
struct PlacedMotions {
  std::vector<Eigen::Index> nodes;    ///< the nodes among the places
  std::vector<std::int64_t> numbers;  ///< of places in the file
  Eigen::Matrix3Xd places;            ///< [m]
  Eigen::MatrixXd displacements;      ///< (3 places, motions), body axes
  std::vector<bool> turns;            ///< places that have all three rotations as well
  Eigen::MatrixXd rotations;          ///< (3 places, motions), body axes; zero at places without them
};

PlacedMotions placed_motions(const MatrixSet& set, const Eigen::MatrixXd& motions);

/// Places of two sets at a distance of at most `tolerance` from each other.
struct CommonPlaces {
  std::vector<Eigen::Index> a, b;  ///< pairs, by the places of a
  Eigen::Index moved = 0;          ///< nodes whose number is at another place in the other set
};

CommonPlaces common_places(const PlacedMotions& a, const PlacedMotions& b, double tolerance);

/// Motions of two sets at their common places: rows x y z of each place, then rotations times a length where both have
/// them. These tell torsion, which moves no place on its axis.
struct CommonMotions {
  Eigen::MatrixXd a, b;  ///< (rows, motions) [m]
};

/// @param length  factor that makes rotations comparable with displacements [m]
CommonMotions common_motions(const PlacedMotions& a, const PlacedMotions& b, const CommonPlaces& common, double length);

/// Values of the unknowns of another set in these motions (n,motions); nothing if an unknown has no counterpart.
/// Displacements follow from any place, rotations and scalars from those of a set with the same nodes or count.
/// @param motions  (n of `from`, motions)
std::optional<Eigen::MatrixXd> expressed_in(const MatrixSet& to, const MatrixSet& from, const Eigen::MatrixXd& motions,
                                            double tolerance);

}  // namespace bielle::reduce
