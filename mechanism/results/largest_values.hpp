// The largest forces, stresses and pressures of the recorded rows of an analysis, for its summary.
//
// The rows are there anyway, so that nothing has to be computed for it. Values between recorded rows are not seen.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mechanism/results/results_kinds.hpp"

namespace bielle::mechanism {

class LargestValues {
 public:
  explicit LargestValues(const ResultsKinds& kinds);

  /// Forgets the rows so far.
  /// @param rows  the rows that follow, in words: "the recorded rows"
  /// @param time  name of the time of a row, "t" or "load factor", and its unit with a space before it
  void begin(std::string rows, std::string time, std::string unit);
  /// Takes a row of results into account. @param values  all values of the row
  void add(double time, const double* values);
  /// Returns a line for each quantity that some entry records and that was not zero in all rows.
  std::string summary() const;

 private:
  /// A quantity that is compared over all entries which record it.
  enum class Quantity {
    joint_force,
    joint_moment,
    drive_force,
    drive_torque,
    contact_force,
    tension,
    element_force,
    beam_stress,
    body_stress,
    pressure
  };
  /// Numbers of a row of whose norm the largest is sought: a force, a stress.
  struct Group {
    Quantity quantity;
    std::size_t begin, count;
    std::size_t entry;  ///< index in `names_`
  };
  struct Largest {
    double value = 0, time = 0;
    std::size_t entry = 0;
  };
  static constexpr std::size_t quantities = 10;

  void add_field(const ResultsKind& kind, const ResultsField& field, std::size_t number, std::size_t entry);
  std::vector<std::string> names_;  ///< "joint 'main'"
  std::vector<Group> groups_;
  Largest largest_[quantities];
  std::string rows_, time_, unit_;
};

}  // namespace bielle::mechanism
