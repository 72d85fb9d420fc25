// Quantities that another program recovers from the coordinates, such as the stress of its gauges or the forces in its
// elements (output transformation matrices): the group /quantities of a superelement's file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace bielle {

class Hdf5File;

struct RecoveredQuantity {
  std::vector<std::string> rows;   ///< names of the rows
  std::vector<std::string> units;  ///< of each row, "Pa"
  Eigen::MatrixXd matrix;          ///< (rows,n): in terms of the coordinates

  /// Returns the unit of all rows, or those of each with commas between.
  std::string all_units() const;
};

using RecoveredQuantities = std::map<std::string, RecoveredQuantity>;

/// Writes into the group that the file has entered.
void write_quantities(const RecoveredQuantities& quantities, Hdf5File& file);

/// Reads from the group that the file has entered; the result is empty for files without quantities.
/// @throws InputError if the parts of one do not fit together
RecoveredQuantities read_quantities(const Hdf5File& file);

/// Returns the first fault of the quantities of a body with n coordinates in a sentence, or nothing.
std::string fault_of(const RecoveredQuantities& quantities, Eigen::Index n);

}  // namespace bielle
