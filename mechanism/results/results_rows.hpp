// Rows of results: order of the values in a row, and the datasets that they form.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mechanism/model/activity.hpp"
#include "mechanism/model/archive.hpp"
#include "mechanism/results/results_kinds.hpp"
#include "mechanism/results/step_record.hpp"

namespace bielle::mechanism {

/// Datasets formed from rows: each quantity of each entry by name ("joints/main/coordinate"), or each quantity of all
/// entries of a kind together ("joints/hinge/coordinate"), for models with many entries.
enum class ResultsLayout { named, stacked };
const char* layout_name(ResultsLayout layout);  ///< name as in input files: "stacked"

/// A dataset to which each row adds one entry.
struct ResultsColumn {
  std::string dataset;             ///< relative to the analysis's group: "nodes/pin/position"
  std::vector<std::size_t> shape;  ///< shape of one entry
  std::string units, description;
  std::size_t begin = 0;  ///< index of its values in the row
  std::size_t size = 1;
};

/// The data that a row is computed from. The object only refers to them.
struct ResultsInstant {
  const State* state;
  const std::vector<Slots>* slots;  ///< slots of the model's members
  const Environment* environment;
  const StepRecord* step;
};

/// Computes rows from states. It is created once per run, in a time that is linear in the size of the model; `fill`
/// allocates no memory.
class ResultsRows {
 public:
  /// recorded: the quantities that the model records; all: every quantity that it can record.
  enum class Extent { recorded, all };
  /// @throws std::logic_error if two components claim the same dataset
  explicit ResultsRows(const Model& model, Extent extent = Extent::recorded);

  std::size_t size() const { return size_; }  ///< number of values in a row, without the time
  const ResultsKinds& kinds() const { return kinds_; }
  std::vector<ResultsColumn> columns(ResultsLayout layout = ResultsLayout::named) const;
  /// Finds a column in the layout by names; empty if there is none with this name.
  std::optional<ResultsColumn> find(const std::string& dataset) const;

  /// Computes the row of a state. The signs of quaternions continue those of the previous row.
  /// @param values values of the row (size())
  void fill(const State& state, const std::vector<Slots>& slots, const Environment& environment, const StepRecord& step,
            double* values);
  /// Computes the rows of several states, which is faster for components with large outputs
  /// (MeshFields::outputs_together).
  /// @param values  (instants, size())
  void fill(std::span<const ResultsInstant> instants, double* values);
  /// Reads one column in the layout by names of a single state, like a row without a previous one.
  std::vector<double> read(const ResultsColumn& column, const State& state, const std::vector<Slots>& slots,
                           const Environment& environment, const StepRecord& step) const;
  /// Begins a new series: the next row has no previous one, and its quaternions have w >= 0.
  void restart() { quaternions_known_ = false; }
  void exchange(Archive& archive);

 private:
  struct NodePlace {
    int node;
    std::size_t position, rotation, velocity, acceleration;  ///< indices in the row; velocity 0: no rates
  };
  /// The outputs of a member that are computed for several rows at once.
  struct Together {
    std::size_t member;
    const ResultsPart* part;
    std::vector<std::size_t> places;  ///< index in a row of each of the part's targets
    bool adjoining;                   ///< whether targets are contiguous: outputs are written directly into the row
    std::size_t size;                 ///< total number of outputs
  };
  void add_node_places();
  void add_together();
  void add_totals();
  void fill_apart(const ResultsInstant& instant, double* values);
  void fill_together(const Together& outputs, std::span<const ResultsInstant> instants, double* values);
  /// Writes a member's outputs to `to(target)`, beginning with the kind's targets of its part.
  template <class To>
  void write_member(std::size_t member, const ResultsPart& part, const State& state, const std::vector<Slots>& slots,
                    const Environment& environment, double* output, const To& to) const;
  void write_released(std::size_t member, const LocalState& local, double* output) const;
  static void fill_totals(const StepRecord& step, double* values);
  std::vector<double> read_entry(const ResultsEntry& entry, std::size_t field, const State& state,
                                 const std::vector<Slots>& slots, const Environment& environment) const;

  ResultsKinds kinds_;
  const Model& model_;
  Activities activities_;
  std::vector<NodePlace> nodes_;
  std::vector<ResultsColumn> totals_;  ///< columns of energies and of the solver; last in the row
  std::size_t size_ = 0;
  std::vector<double> output_;  ///< output of one component
  std::vector<Together> together_;
  std::vector<LocalState> locals_;  ///< local states of a component computed for several rows, one for each row
  std::vector<double*> targets_;    ///< its destinations, one for each row
  std::vector<double> outputs_;     ///< its outputs, if they are not contiguous in the row
  std::vector<Eigen::Vector4d> quaternions_;
  bool quaternions_known_ = false;
};

}  // namespace bielle::mechanism
