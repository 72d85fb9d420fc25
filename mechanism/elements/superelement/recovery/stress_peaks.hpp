// The largest stresses of a superelement over all accepted steps of an analysis: `output: {peaks: ...}`.
//
//   von_mises         the largest equivalent stress
//   principal_stress  the largest principal stress (most tensile) and the least (most compressive)
//
// of the whole body (`all`) and of each volume group, each with its node, place and time; of equal ones the first in
// time, then the first node. No field is stored: local coordinates are collected, and the stress of all nodes follows
// for several steps at once. It has the bits of the fields that a results file holds, however the steps are collected.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mechanism/elements/superelement/recovery/stress_recovery.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

/// A largest (or least) value.
struct StressPeak {
  double value = 0;  ///< [Pa]
  double time = 0;   ///< [s], in statics the load factor
  int row = -1;      ///< place among the nodes of the recovery; -1: nothing was seen yet
};

class StressPeaks : public StepRecorder {
 public:
  static const std::vector<std::string>& names();  ///< what can be asked for

  /// Writes the local coordinates at a state, in the order of the superelement's file.
  using Coordinates = std::function<void(const LocalState& state, double* q)>;
  /// @param body    name of the element @param wanted  out of `names`
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
  using Peaks = std::vector<std::array<StressPeak, kinds>>;  ///< of each region
  /// Several steps at once; each waits for those after it.
  static constexpr int together = 16;

  bool wants(const std::string& name) const;
  std::string group_of(std::size_t region, std::size_t kind) const;  ///< of the results, with a '/' at its end
  void look();                                                       ///< at the steps that wait
  void look_at(int row, double time, const double* s, Peaks& peaks) const;
  void offer(int row, Kind kind, const StressPeak& peak, Peaks& peaks) const;
  bool may_raise(int row, double mean, double reach, const Peaks& peaks) const;
  template <class Act>
  void for_each_region_of(int row, Act&& act) const;

  std::string body_;
  std::shared_ptr<const StressRecovery> stress_;
  std::vector<std::string> wanted_;
  bool von_mises_, principal_;  ///< wanted
  Coordinates coordinates_;
  /// The whole body, `all`, then the volume groups; one of the name `all` that is not the whole is `all_volume`.
  std::vector<std::string> regions_;
  std::vector<std::size_t> said_with_whole_;  ///< groups of all nodes
  std::vector<int> group_begin_,
      group_of_;  ///< regions of each node besides the whole: from begin[row] to begin[row+1]
  Peaks peaks_;
  std::vector<Peaks> of_thread_;
  FrameBlock waiting_;
  VectorX q_;
  std::vector<double> times_;  ///< of those that wait
  int count_ = 0;              ///< that wait
  bool statics_ = false;
};

}  // namespace bielle::mechanism
