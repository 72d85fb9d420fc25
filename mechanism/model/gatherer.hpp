// What a component gathers over all accepted steps of an analysis, whether they are recorded or not: largest values.
//
// A gatherer is not const as components are: a session makes its own, and tells it of each step once.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/archive.hpp"
#include "mechanism/model/result_array.hpp"

namespace bielle::mechanism {

class Gatherer {
 public:
  Gatherer() = default;
  virtual ~Gatherer() = default;
  Gatherer(const Gatherer&) = delete;
  Gatherer& operator=(const Gatherer&) = delete;

  virtual void begin() = 0;  ///< an analysis begins: forgets the one before
  /// A step of a motion or a point of statics was accepted, or a motion starts here.
  virtual void add(const LocalState& state) = 0;
  /// What it has so far. As many numbers at any time, and the same whether a run was interrupted or not.
  virtual void exchange(Archive& archive) = 0;
  /// What it has found. Its arrays belong into the group of the analysis.
  virtual std::vector<ResultArray> results() = 0;
  /// Names of all datasets that `results` may give, known from the beginning.
  virtual std::vector<std::string> datasets() {
    std::vector<std::string> names;
    for (const ResultArray& array : results()) names.push_back(array.dataset);
    return names;
  }
  virtual std::string summary() = 0;  ///< the same in lines for the user; each ends with a line break
  /// Among gatherers with the same voice (the elements of a beam) the loudest alone has a summary. A gatherer with an
  /// empty voice speaks for itself.
  virtual std::string voice() const { return {}; }
  virtual double loudness() const { return 0; }
  /// What it gathers, of whom: "peaks of 'rod': von_mises". Only with the same can a run go on.
  virtual std::string what() const = 0;
};

}  // namespace bielle::mechanism
