// The step recorders of all components of a model, over the steps of an analysis.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/model/model.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

class StepRecorders {
 public:
  explicit StepRecorders(const Model& model);
  ~StepRecorders();

  /// Begins an analysis. @throws InputError if two of its results would have the same name because of the names of
  /// components
  void begin();
  /// @param slots  slots of the model's members
  void add(const State& state, const std::vector<Slots>& slots, const Environment& environment);
  VectorX numbers();  ///< the data for a checkpoint
  /// Restores the data of a checkpoint. @throws InputError if the numbers belong to other step recorders
  void set(const VectorX& numbers);
  std::vector<ResultArray> results();
  std::string summary();

 private:
  struct One {
    std::size_t member;
    std::unique_ptr<StepRecorder> recorder;
  };
  void check_datasets();
  std::vector<std::string> names_;  ///< names of the model's members
  std::vector<One> all_;
};

}  // namespace bielle::mechanism
