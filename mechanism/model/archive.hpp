// An archive holds the numbers of a checkpoint. The same function writes and reads them:
//     void exchange(Archive& archive) { archive(time_); archive(state_); ... }
//
// Each number that is read is checked, because a checkpoint may be damaged or belong to another model. Each must be
// finite (except the memory of components, which system/check_state.hpp checks); a count or a choice must be a whole
// number within its range; every list must have the length that it has here.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class Archive {
 public:
  Archive() = default;  ///< an archive that collects numbers
  /// Constructs an archive that restores numbers. @param values  the numbers that were collected
  explicit Archive(std::vector<double> values) : values_(std::move(values)), restoring_(true) {}

  bool restoring() const { return restoring_; }
  const std::vector<double>& values() const { return values_; }

  bool exhausted() const { return next_ == values_.size(); }  ///< when restoring: every number has been read

  /// All of these: @throws std::out_of_range with a sentence if the number that is read is not of the kind asked for,
  /// or if too few are left
  void operator()(double& value) {
    exchange(value);
    if (restoring_ && !std::isfinite(value)) refuse("is not finite");
  }
  /// Whole numbers are exact up to 2^53.
  void operator()(long& value) { whole(value, -most_exact, most_exact); }
  void operator()(int& value) { whole(value, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()); }
  void operator()(bool& value) { whole(value, 0, 1); }
  /// Exchanges a whole number within a range, both ends included.
  template <class Number>
  void within(Number& value, double least, double most) {
    whole(value, least, most);
  }
  /// Exchanges a size >= 0, which may be infinite.
  void size_or_infinite(double& value) {
    exchange(value);
    if (restoring_ && !(value >= 0)) refuse("is no size");
  }
  /// Exchanges a number that is only displayed: it is not checked.
  void shown(double& value) { exchange(value); }
  void operator()(VectorX& vector) {
    check_length(static_cast<std::size_t>(vector.size()));
    for (double& value : vector) (*this)(value);
  }
  /// Exchanges a list whose length is not known here.
  void of_any_length(VectorX& vector) {
    vector.resize(static_cast<Eigen::Index>(length(static_cast<std::size_t>(vector.size()))));
    for (double& value : vector) (*this)(value);
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
                            &state.first_order_rate, &state.multiplier})
      (*this)(*vector);
    check_length(static_cast<std::size_t>(state.memory.size()));
    for (double& value : state.memory) exchange(value);
    flags(state.idle, static_cast<std::size_t>(state.multiplier.size()));
    // The archive has the same length whether such reactions exist or not: checkpoints are rows of one length.
    bool balanced = state.reaction.size() > 0;
    (*this)(balanced);
    VectorX reaction = balanced && !restoring() ? state.reaction : VectorX(VectorX::Zero(state.multiplier.size()));
    (*this)(reaction);
    if (restoring()) state.reaction = balanced ? reaction : VectorX();
  }

 private:
  static constexpr double most_exact = 9007199254740992;

  void exchange(double& value) {
    if (!restoring_) {
      values_.push_back(value);
      return;
    }
    if (next_ == values_.size()) throw std::out_of_range("there are fewer numbers than are needed");
    value = values_[next_++];
  }
  [[noreturn]] void refuse(const char* why) const {
    throw std::out_of_range(fmt::format("number {} (from 0), {}, {}", next_ - 1, values_[next_ - 1], why));
  }
  template <class Number>
  void whole(Number& value, double least, double most) {
    auto number = static_cast<double>(value);
    exchange(number);
    if (!restoring_) return;
    if (!(number == std::floor(number))) refuse("is not whole");
    if (!(number >= least && number <= most)) refuse("is out of its range");
    value = static_cast<Number>(number);
  }
  std::size_t length(std::size_t now) {
    auto size = static_cast<double>(now);
    exchange(size);
    if (restoring_ && !(size >= 0 && size == std::floor(size) && size <= static_cast<double>(values_.size() - next_)))
      refuse("is no length of a list");
    return static_cast<std::size_t>(size);
  }
  void check_length(std::size_t now) {
    if (length(now) != now) refuse("is not the length of the list there");
  }
  /// A list has one flag for each constraint, or is empty. (system/idle_constraints.hpp)
  void flags(std::vector<char>& flags, std::size_t count) {
    flags.resize(length(flags.size()));
    if (restoring_ && !flags.empty() && flags.size() != count) refuse("is not the number of constraints");
    for (char& flag : flags) whole(flag, 0, 2);
  }
  std::vector<double> values_;
  std::size_t next_ = 0;
  bool restoring_ = false;
};

}  // namespace bielle::mechanism
