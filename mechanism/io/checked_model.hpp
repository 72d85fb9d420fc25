// A model that is only checked: assembled, described, and written as it stands.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/start/start_report.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct CheckedModel {
  /// Assembles the model. A failure is stored and not thrown. @param of  must outlive this object
  explicit CheckedModel(const MechanismFile& of);

  const MechanismFile& file;
  System system;
  State state;                 ///< assembled; as drawn if it cannot be assembled
  StartReport report;          ///< changes of the drawn positions
  std::vector<int> redundant;  ///< multipliers of redundant constraints, which are set aside
  /// The reason why the model cannot be assembled, a ComputationError; null if it can.
  std::exception_ptr failure;
};

/// Writes a results file with the position of a checked model as its only row, in an analysis of type `check`.
/// @throws InputError if the file would replace something else; ComputationError if it cannot be written
void write_checked_model(const CheckedModel& checked, const std::string& results_path);

}  // namespace bielle::mechanism
