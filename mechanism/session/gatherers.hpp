// All that the components of a model gather over the steps of an analysis.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/model/gatherer.hpp"
#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

class Gatherers {
 public:
  explicit Gatherers(const Model& model);
  ~Gatherers();

  /// An analysis begins. @throws InputError when names of components make two of its results one
  void begin();
  /// @param slots  of the model's members
  void add(const State& state, const std::vector<Slots>& slots, const Environment& environment);
  VectorX numbers();  ///< for a point to go on from
  /// Goes back to such a point. @throws InputError when the numbers are those of others
  void set(const VectorX& numbers);
  std::vector<ResultArray> results();
  std::string summary();

 private:
  struct One {
    std::size_t member;
    std::unique_ptr<Gatherer> gatherer;
  };
  void check_datasets();
  std::vector<std::string> names_;  ///< of the model's members
  std::vector<One> all_;
};

}  // namespace bielle::mechanism
