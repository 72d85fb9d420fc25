// Numbers that go into a checkpoint and come back from it, by one and the same walk over what is kept:
//     void exchange(Archive& archive) { archive(time_); archive(state_); ... }
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class Archive {
 public:
  Archive() = default;  ///< to collect
  /// To restore. @param values  as collected
  explicit Archive(std::vector<double> values) : values_(std::move(values)), restoring_(true) {}

  bool restoring() const { return restoring_; }
  const std::vector<double>& values() const { return values_; }

  bool exhausted() const { return next_ == values_.size(); }  ///< when restoring: all has been asked for

  /// @throws std::out_of_range when there are fewer numbers than asked for
  void operator()(double& value) {
    if (restoring_)
      value = values_.at(next_++);
    else
      values_.push_back(value);
  }
  /// Counts are exact up to 2^53.
  void operator()(long& value) { as_number(value); }
  void operator()(int& value) { as_number(value); }
  void operator()(bool& value) { as_number(value); }
  /// The size is kept too: it may differ from run to run.
  void operator()(VectorX& vector) {
    vector.conservativeResize(static_cast<Eigen::Index>(size_of(static_cast<std::size_t>(vector.size()))));
    for (double& value : vector) (*this)(value);
  }
  /// The size is kept too.
  void operator()(std::vector<char>& flags) {
    flags.resize(size_of(flags.size()));
    for (char& flag : flags) as_number(flag);
  }
  template <int rows, int columns>
  void operator()(Eigen::Matrix<double, rows, columns>& matrix) {
    static_assert(rows > 0 && columns > 0);
    for (double& value : matrix.reshaped()) (*this)(value);
  }
  void operator()(NodeState& node) {
    (*this)(node.x);
    (*this)(node.R);
    (*this)(node.v);
    (*this)(node.Omega);
    (*this)(node.a);
    (*this)(node.Omegadot);
  }
  void operator()(State& state) {
    (*this)(state.time);
    for (NodeState& node : state.nodes) (*this)(node);
    for (VectorX* vector : {&state.amplitude, &state.amplitude_rate, &state.amplitude_acceleration, &state.first_order,
                            &state.first_order_rate, &state.multiplier, &state.memory})
      (*this)(*vector);
    (*this)(state.idle);
    // As many numbers whether there are such reactions or not: checkpoints are rows of one length.
    bool balanced = state.reaction.size() > 0;
    (*this)(balanced);
    VectorX reaction = balanced ? state.reaction : VectorX(VectorX::Zero(state.multiplier.size()));
    (*this)(reaction);
    if (restoring()) state.reaction = balanced ? reaction : VectorX();
  }

 private:
  /// The size that was kept. @throws std::out_of_range when there are not so many numbers: they are none of ours
  std::size_t size_of(std::size_t now) {
    auto size = static_cast<double>(now);
    (*this)(size);
    if (restoring_ && !(size >= 0 && size <= static_cast<double>(values_.size() - next_)))
      throw std::out_of_range("a size that is none");
    return static_cast<std::size_t>(size);
  }
  template <class Number>
  void as_number(Number& value) {
    auto number = static_cast<double>(value);
    (*this)(number);
    value = static_cast<Number>(number);
  }
  std::vector<double> values_;
  std::size_t next_ = 0;
  bool restoring_ = false;
};

}  // namespace bielle::mechanism
