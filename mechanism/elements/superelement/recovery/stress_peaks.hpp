// Records the largest stresses of a superelement over all accepted steps of an analysis, for `output: {peaks: ...}`:
//
//   von_mises         the largest equivalent stress
//   principal_stress  the largest principal stress (most tensile) and the least (most compressive)
//
// They are determined for the whole body (`all`) and for each volume group, each with its node, place and time; among
// equal values the earliest is taken, then the first node. No field is stored: local coordinates are collected, and the
// stress of all nodes is computed for several steps at once. The stress is identical bit by bit to the fields in a
// results file, for any grouping of the steps.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mechanism/elements/superelement/recovery/stress_recovery.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

/// A largest (or smallest) value.
struct StressPeak {
  double value = 0;  ///< value [Pa]
  double time = 0;   ///< time [s], in statics the load factor
  int row = -1;      ///< index among the nodes of the recovery; -1: no value yet
};

class StressPeaks : public StepRecorder {
 public:
  static const std::vector<std::string>& names();  ///< names that can be requested

  /// Function that writes the local coordinates at a state, in the order of the superelement's file.
  using Coordinates = std::function<void(const LocalState& state, double* q)>;
  /// @param body    name of the element @param wanted  some of `names`
  StressPeaks(std::string body, std::shared_ptr<const StressRecovery> stress, std::vector<std::string> wanted,
              Coordinates coordinates);

  void begin() override;
  void add(const LocalState& state) override;
  void exchange(Archive& archive) override;
  std::vector<ResultArray> results() override;
  std::vector<std::string> datasets() override;
  std::string summary() override;
  std::string what() const override;

 private:
  enum Kind { von_mises_stress, largest_principal, least_principal, kinds };
  using Peaks = std::vector<std::array<StressPeak, kinds>>;  ///< for each region
  /// Number of steps that are collected and evaluated together.
  static constexpr int together = 16;

  bool wants(const std::string& name) const;
  std::string group_of(std::size_t region, std::size_t kind) const;  ///< group of the results, with a '/' at its end
  void look();                                                       ///< evaluates the collected steps
  void look_at(int row, double time, const double* s, Peaks& peaks) const;
  void offer(int row, Kind kind, const StressPeak& peak, Peaks& peaks) const;
  bool may_raise(int row, double mean, double reach, const Peaks& peaks) const;
  template <class Act>
  void for_each_region_of(int row, Act&& act) const;

  std::string body_;
  std::shared_ptr<const StressRecovery> stress_;
  std::vector<std::string> wanted_;
  bool von_mises_, principal_;  ///< whether they are requested
  Coordinates coordinates_;
  /// Names of the whole body, `all`, then of the volume groups; a group that is named `all` but is not the whole body
  /// is called `all_volume`.
  std::vector<std::string> regions_;
  std::vector<std::size_t> said_with_whole_;  ///< groups that contain all nodes
  std::vector<int> group_begin_,
      group_of_;  ///< regions of each node in addition to the whole: from begin[row] to begin[row+1]
  Peaks peaks_;
  std::vector<Peaks> of_thread_;
  FrameBlock waiting_;
  VectorX q_;
  std::vector<double> times_;  ///< times of the collected steps
  int count_ = 0;              ///< number of collected steps
  bool statics_ = false;
};

}  // namespace bielle::mechanism
