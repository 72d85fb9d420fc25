// A recorder collects data of a component over all accepted steps of an analysis, whether they are recorded or not:
// largest values.
//
// Unlike components, a recorder is not const: a session creates its own, and passes each step to it once.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/archive.hpp"
#include "mechanism/model/result_array.hpp"

namespace bielle::mechanism {

class StepRecorder {
 public:
  StepRecorder() = default;
  virtual ~StepRecorder() = default;
  StepRecorder(const StepRecorder&) = delete;
  StepRecorder& operator=(const StepRecorder&) = delete;

  virtual void begin() = 0;  ///< begins an analysis: clears the data of the one before
  /// Adds an accepted step of a motion, a point of statics, or the start of a motion.
  virtual void add(const LocalState& state) = 0;
  /// Exchanges the data gathered so far with an archive. The number of values is the same at any time, and the values
  /// do not depend on whether a run was interrupted.
  virtual void exchange(Archive& archive) = 0;
  /// Returns the results. The arrays are written to the group of the analysis.
  virtual std::vector<ResultArray> results() = 0;
  /// Names of all datasets that `results` may return, known from the beginning.
  virtual std::vector<std::string> datasets() {
    std::vector<std::string> names;
    for (const ResultArray& array : results()) names.push_back(array.dataset);
    return names;
  }
  virtual std::string summary() = 0;  ///< the results as lines for the user; each ends with a line break
  /// Returns the name of a group of step recorders (the elements of a beam), of which the loudest alone writes a
  /// summary; a recorder with an empty name always writes its own.
  virtual std::string voice() const { return {}; }
  virtual double loudness() const { return 0; }
  /// Returns the gathered quantity and its component: "peaks of 'rod': von_mises". A run can only be continued if it is
  /// the same.
  virtual std::string what() const = 0;
};

}  // namespace bielle::mechanism
