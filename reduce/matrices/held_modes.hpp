// Modes of a body whose interfaces are held, with their effective masses.
#pragma once

#include "reduce/matrices/matrix_study.hpp"

namespace bielle::reduce {

struct HeldModes {
  Unknowns held, free;
  NaturalModes modes;              ///< modes of the free unknowns
  Eigen::MatrixXd effective_mass;  ///< (modes,6) x y z [kg], rx ry rz about the centre of mass [kg m^2]; empty: no
                                   ///< rigid motions
  Eigen::RowVectorXd whole_mass;   ///< (6) the same numbers of the whole body
};

/// Unknowns of the interfaces that the set declares, or else of the nodes with six unknowns.
Unknowns held_unknowns(const MatrixSet& set);

/// @returns nothing if no unknown is held or free
/// @throws NotPositiveDefinite if the held body is not stiff; its unknown() counts in `free`
std::optional<HeldModes> held_modes(const MatrixStudy& study, int count);

}  // namespace bielle::reduce
