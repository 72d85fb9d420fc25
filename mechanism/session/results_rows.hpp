// The layout of a row of results: which dataset gets which numbers of the state.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/session/step_record.hpp"
#include "mechanism/system/archive.hpp"
#include "mechanism/system/model.hpp"

namespace bielle::mechanism {

/// A dataset that grows by one entry per row.
struct ResultsColumn {
  std::string dataset;             ///< relative to the analysis's group: "nodes/pin/position"
  std::vector<std::size_t> shape;  ///< of one entry
  std::string units, description;
  std::size_t begin = 0;  ///< of its numbers in the row
  std::size_t size = 1;
};

/// A group with its attributes.
struct ResultsGroup {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
};

/// Fills rows from states. Made once per run; `fill` allocates nothing.
class ResultsRows {
 public:
  /// recorded: what the model records; all: what it could.
  enum class Extent { recorded, all };
  /// @throws std::logic_error when two components claim the same dataset
  explicit ResultsRows(const Model& model, Extent extent = Extent::recorded);

  std::size_t size() const { return size_; }  ///< numbers in a row, without the time
  const std::vector<ResultsColumn>& columns() const { return columns_; }
  const std::vector<ResultsGroup>& groups() const { return groups_; }
  const ResultsColumn* find(const std::string& dataset) const;  ///< nullptr: there is none

  /// Writes the row of a state. Quaternions take the sign that continues the row before.
  /// @param values (size())
  void fill(const State& state, const std::vector<Slots>& slots, const Environment& environment, const StepRecord& step,
            double* values);
  /// One column of a state alone, as a row that follows no other has it.
  std::vector<double> read(const ResultsColumn& column, const State& state, const std::vector<Slots>& slots,
                           const Environment& environment, const StepRecord& step) const;
  /// The next row follows no other: its quaternions have w >= 0.
  void restart() { quaternions_known_ = false; }
  void exchange(Archive& archive);

 private:
  struct NodePlace {
    int node;
    std::size_t position, rotation, quaternion;  ///< begins in the row, and its quaternion's number
    bool rates;                                  ///< velocity and acceleration follow the rotation
  };
  struct FieldPlace {
    std::size_t begin, size;  ///< in the row
    bool summed;              ///< added to what other members put there
  };
  struct MemberPlace {
    std::size_t member;
    std::vector<FieldPlace> fields;
  };
  std::size_t add_column(const std::string& dataset, std::vector<std::size_t> shape, const std::string& units,
                         const std::string& description, bool summed = false);
  void add_nodes();
  void add_chains();
  void add_members();
  void add_attributes(const std::string& group, const std::vector<std::pair<std::string, std::string>>& attributes);
  bool records(const std::string& group) const { return extent_ == Extent::all || model_.records(group); }
  static void fill_node(const NodePlace& place, const NodeState& node, const Eigen::Vector4d& quaternion,
                        double* values);
  void fill_member(const MemberPlace& place, const State& state, const std::vector<Slots>& slots,
                   const Environment& environment, double* output, double* values) const;
  void fill_step(const StepRecord& step, double* values) const;

  const Model& model_;
  Extent extent_;
  std::vector<ResultsColumn> columns_;
  std::map<std::string, std::size_t> column_of_;  ///< by dataset
  std::vector<ResultsGroup> groups_;
  std::vector<NodePlace> nodes_;
  std::vector<MemberPlace> members_;
  std::size_t size_ = 0, energy_ = 0, solver_ = 0;
  std::vector<double> output_;  ///< of one component
  std::vector<Eigen::Vector4d> quaternions_;
  bool quaternions_known_ = false;
};

}  // namespace bielle::mechanism
