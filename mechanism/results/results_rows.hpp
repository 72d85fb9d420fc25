// A row of results: which numbers of the state stand where, and which datasets they make.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mechanism/model/archive.hpp"
#include "mechanism/results/results_kinds.hpp"
#include "mechanism/results/step_record.hpp"

namespace bielle::mechanism {

/// How rows become datasets: each quantity of each entry by name ("joints/main/coordinate"), or each quantity of all
/// entries of a kind at once ("joints/hinge/coordinate"), for models with many entries.
enum class ResultsLayout { named, stacked };
const char* layout_name(ResultsLayout layout);  ///< as in input files: "stacked"

/// A dataset that grows by one entry per row.
struct ResultsColumn {
  std::string dataset;             ///< relative to the analysis's group: "nodes/pin/position"
  std::vector<std::size_t> shape;  ///< of one entry
  std::string units, description;
  std::size_t begin = 0;  ///< of its numbers in the row
  std::size_t size = 1;
};

/// What a row is made of. A view of things that live elsewhere.
struct ResultsInstant {
  const State* state;
  const std::vector<Slots>* slots;  ///< of the model's members
  const Environment* environment;
  const StepRecord* step;
};

/// Fills rows from states. Made once per run, in a time that is linear in the size of the model; `fill` allocates
/// nothing.
class ResultsRows {
 public:
  /// recorded: what the model records; all: what it could.
  enum class Extent { recorded, all };
  /// @throws std::logic_error when two components claim the same dataset
  explicit ResultsRows(const Model& model, Extent extent = Extent::recorded);

  std::size_t size() const { return size_; }  ///< numbers in a row, without the time
  const ResultsKinds& kinds() const { return kinds_; }
  std::vector<ResultsColumn> columns(ResultsLayout layout = ResultsLayout::named) const;
  /// A column of the layout by names; nothing: there is none of that name.
  std::optional<ResultsColumn> find(const std::string& dataset) const;

  /// Writes the row of a state. Quaternions take the sign that continues the row before.
  /// @param values (size())
  void fill(const State& state, const std::vector<Slots>& slots, const Environment& environment, const StepRecord& step,
            double* values);
  /// The rows of several states, which is faster for components with large outputs (MeshFields::outputs_together).
  /// @param values  (instants, size())
  void fill(std::span<const ResultsInstant> instants, double* values);
  /// One column of the layout by names of a state alone, as a row that follows no other has it.
  std::vector<double> read(const ResultsColumn& column, const State& state, const std::vector<Slots>& slots,
                           const Environment& environment, const StepRecord& step) const;
  /// The next row follows no other: its quaternions have w >= 0.
  void restart() { quaternions_known_ = false; }
  void exchange(Archive& archive);

 private:
  struct NodePlace {
    int node;
    std::size_t position, rotation, velocity, acceleration;  ///< begins in the row; velocity 0: no rates
  };
  /// Outputs of a member that are computed for several rows at once.
  struct Together {
    std::size_t member;
    const ResultsPart* part;
    std::vector<std::size_t> places;  ///< of each of the part's targets in a row
    bool adjoining;                   ///< they follow each other as the outputs do: these go straight into the row
    std::size_t size;                 ///< of all of them
  };
  void add_node_places();
  void add_together();
  void add_totals();
  void fill_apart(const ResultsInstant& instant, double* values);
  void fill_together(const Together& outputs, std::span<const ResultsInstant> instants, double* values);
  /// A member's outputs go where `to(target)` says, from the kind's targets of its part on.
  template <class To>
  void write_member(std::size_t member, const ResultsPart& part, const State& state, const std::vector<Slots>& slots,
                    const Environment& environment, double* output, const To& to) const;
  static void fill_totals(const StepRecord& step, double* values);
  std::vector<double> read_entry(const ResultsEntry& entry, std::size_t field, const State& state,
                                 const std::vector<Slots>& slots, const Environment& environment) const;

  ResultsKinds kinds_;
  const Model& model_;
  std::vector<NodePlace> nodes_;
  std::vector<ResultsColumn> totals_;  ///< of energies and the solver; after all others in the row
  std::size_t size_ = 0;
  std::vector<double> output_;  ///< of one component
  std::vector<Together> together_;
  std::vector<LocalState> locals_;  ///< of such a component, for each row
  std::vector<double*> targets_;    ///< likewise
  std::vector<double> outputs_;     ///< likewise, where they do not adjoin in the row
  std::vector<Eigen::Vector4d> quaternions_;
  bool quaternions_known_ = false;
};

}  // namespace bielle::mechanism
