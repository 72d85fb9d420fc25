#include "mechanism/elements/superelement/recovery/stress_peaks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

#include "mechanism/elements/superelement/recovery/stress_invariants.hpp"
#include "mechanism/elements/superelement/recovery/stress_tiles.hpp"
#include "reduce/common/files/hdf5_file.hpp"

namespace bielle::mechanism {
namespace {

struct PeakKind {
  const char* dataset;
  const char* sentence;
  double sign;  ///< -1: the smallest value is recorded
};

/// They are in the order of StressPeaks::Kind.
constexpr std::array<PeakKind, 3> peak_kinds = {{{"von_mises", "largest von Mises stress", 1},
                                                 {"largest_principal", "largest principal stress", 1},
                                                 {"least_principal", "least principal stress", -1}}};

/// Returns whether a peak exceeds another one. If values are equal, the first in time is taken, then the first node, so
/// that the result does not depend on the order of evaluation.
bool exceeds(const StressPeak& one, const StressPeak& other, double sign) {
  if (one.row < 0 || other.row < 0) return one.row >= 0 && other.row < 0;
  if (one.value != other.value) return sign * one.value > sign * other.value;
  return one.time != other.time ? one.time < other.time : one.row < other.row;
}

/// Name of the region of all nodes. A volume group in the file may have the same name.
constexpr const char* the_whole = "all";

/// Returns a name of a group that differs from that of the whole body and from those of the other groups.
std::string own_name(std::string group, const std::vector<std::string>& groups) {
  if (group != the_whole) return group;
  do group += "_volume";
  while (std::find(groups.begin(), groups.end(), group) != groups.end());
  return group;
}

}  // namespace

const std::vector<std::string>& StressPeaks::names() {
  static const std::vector<std::string> names = {"von_mises", "principal_stress"};
  return names;
}

StressPeaks::StressPeaks(std::string body, std::shared_ptr<const StressRecovery> stress,
                         std::vector<std::string> wanted, Coordinates coordinates)
    : body_(std::move(body)),
      stress_(std::move(stress)),
      wanted_(std::move(wanted)),
      von_mises_(wants("von_mises")),
      principal_(wants("principal_stress")),
      coordinates_(std::move(coordinates)),
      regions_{the_whole},
      q_(stress_->matrix.cols()),
      times_(together) {
  std::vector<std::vector<int>> groups(stress_->nodes.size());
  for (std::size_t g = 0; g < stress_->groups.size(); ++g) {
    const bool is_whole = stress_->group_rows[g].size() == stress_->nodes.size();
    // Geometries without groups have a group of this name; the whole body is a region already.
    if (is_whole && stress_->groups[g] == the_whole) continue;
    for (const int row : stress_->group_rows[g])
      groups[static_cast<std::size_t>(row)].push_back(static_cast<int>(regions_.size()));
    regions_.push_back(own_name(stress_->groups[g], stress_->groups));
    if (is_whole) said_with_whole_.push_back(regions_.size() - 1);
  }
  group_begin_ = {0};
  for (const std::vector<int>& of_node : groups) {
    group_of_.insert(group_of_.end(), of_node.begin(), of_node.end());
    group_begin_.push_back(static_cast<int>(group_of_.size()));
  }
  peaks_.resize(regions_.size());
  waiting_.reset(q_.size(), together);
}

bool StressPeaks::wants(const std::string& name) const {
  return std::find(wanted_.begin(), wanted_.end(), name) != wanted_.end();
}

void StressPeaks::begin() {
  std::fill(peaks_.begin(), peaks_.end(), Peaks::value_type{});
  count_ = 0;
}

void StressPeaks::add(const LocalState& state) {
  statics_ = state.environment().statics;
  if (count_ == 0) waiting_.reset(q_.size(), together);
  coordinates_(state, q_.data());
  waiting_.set(count_, q_.data());
  times_[static_cast<std::size_t>(count_)] = statics_ ? state.environment().load_factor : state.time();
  if (++count_ == together) look();
}

void StressPeaks::look() {
  if (count_ == 0) return;
  if (const auto threads = static_cast<std::size_t>(omp_get_max_threads()); of_thread_.size() < threads)
    of_thread_.resize(threads);
  for (Peaks& peaks : of_thread_) peaks = peaks_;
  for_each_stress(*stress_, waiting_, [&](int row, int frame, const double* s) {
    if (frame < count_)
      look_at(row, times_[static_cast<std::size_t>(frame)], s,
              of_thread_[static_cast<std::size_t>(omp_get_thread_num())]);
  });
  for (const Peaks& peaks : of_thread_)
    for (std::size_t region = 0; region < peaks_.size(); ++region)
      for (std::size_t kind = 0; kind < kinds; ++kind)
        if (exceeds(peaks[region][kind], peaks_[region][kind], peak_kinds[kind].sign))
          peaks_[region][kind] = peaks[region][kind];
  count_ = 0;
}

template <class Act>
void StressPeaks::for_each_region_of(int row, Act&& act) const {
  act(std::size_t{0});
  const auto k = static_cast<std::size_t>(row);
  for (int g = group_begin_[k]; g < group_begin_[k + 1]; ++g)
    act(static_cast<std::size_t>(group_of_[static_cast<std::size_t>(g)]));
}

void StressPeaks::offer(int row, Kind kind, const StressPeak& peak, Peaks& peaks) const {
  for_each_region_of(row, [&](std::size_t region) {
    StressPeak& held = peaks[region][kind];
    if (exceeds(peak, held, peak_kinds[kind].sign)) held = peak;
  });
}

/// Returns whether a principal stress within mean +- reach can be a new peak.
bool StressPeaks::may_raise(int row, double mean, double reach, const Peaks& peaks) const {
  bool may = false;
  for_each_region_of(row, [&](std::size_t region) {
    const StressPeak &largest = peaks[region][largest_principal], &least = peaks[region][least_principal];
    may = may || largest.row < 0 || mean + reach >= largest.value || mean - reach <= least.value;
  });
  return may;
}

void StressPeaks::look_at(int row, double time, const double* s, Peaks& peaks) const {
  const double equivalent = von_mises(s);
  if (von_mises_) offer(row, von_mises_stress, {equivalent, time, row}, peaks);
  if (!principal_) return;
  // Principal stresses are mean + 2/3 von Mises times the cosine of some angle. This excludes most nodes.
  constexpr double rounding = 1e-9;
  const double mean = (s[0] + s[1] + s[2]) / 3, reach = 2.0 / 3 * equivalent;
  if (!may_raise(row, mean, reach + rounding * (std::abs(mean) + reach), peaks)) return;
  const Vector3 principal = principal_values(s);
  offer(row, largest_principal, {principal[0], time, row}, peaks);
  offer(row, least_principal, {principal[2], time, row}, peaks);
}

void StressPeaks::exchange(Archive& archive) {
  if (archive.restoring())
    count_ = 0;
  else
    look();
  for (auto& region : peaks_)
    for (StressPeak& peak : region) {
      archive(peak.value);
      archive(peak.time);
      archive.within(peak.row, -1, static_cast<double>(stress_->nodes.size()) - 1);
    }
}

std::string StressPeaks::group_of(std::size_t region, std::size_t kind) const {
  return fmt::format("peaks/{}/{}/{}/", body_, link_name(regions_[region]), peak_kinds[kind].dataset);
}

std::vector<std::string> StressPeaks::datasets() {
  std::vector<std::string> all;
  for (std::size_t region = 0; region < regions_.size(); ++region)
    for (std::size_t kind = 0; kind < kinds; ++kind)
      for (const char* name : {"value", "time", "node", "position"}) all.push_back(group_of(region, kind) + name);
  return all;
}

std::vector<ResultArray> StressPeaks::results() {
  look();
  std::vector<ResultArray> arrays;
  for (std::size_t region = 0; region < regions_.size(); ++region)
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const StressPeak& peak = peaks_[region][kind];
      if (peak.row < 0) continue;
      const std::string group = group_of(region, kind);
      const Vector3 point = stress_->points.col(peak.row);
      arrays.push_back({group + "value", {}, {peak.value}, "Pa", peak_kinds[kind].sentence});
      arrays.push_back(
          {group + "time", {}, {peak.time}, statics_ ? "-" : "s", statics_ ? "load factor" : "when it was reached"});
      arrays.push_back({group + "node",
                        {},
                        {static_cast<double>(stress_->nodes[static_cast<std::size_t>(peak.row)])},
                        "-",
                        "of the superelement's mesh, from 0"});
      arrays.push_back({group + "position", {3}, {point.x(), point.y(), point.z()}, "m", "of the node, mesh axes"});
    }
  return arrays;
}

std::string StressPeaks::summary() {
  look();
  std::string text;
  for (std::size_t region = 0; region < regions_.size(); ++region) {
    if (std::find(said_with_whole_.begin(), said_with_whole_.end(), region) != said_with_whole_.end()) continue;
    const std::string where = region == 0 ? "" : fmt::format(" in '{}'", regions_[region]);
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const StressPeak& peak = peaks_[region][kind];
      if (peak.row < 0) continue;
      const Vector3 x = stress_->points.col(peak.row);
      text +=
          fmt::format("  {} of '{}'{}: {:.6g} Pa at {}, at node {} of its mesh, [{:.6g}, {:.6g}, {:.6g}] m\n",
                      peak_kinds[kind].sentence, body_, where, peak.value,
                      statics_ ? fmt::format("load factor {:.6g}", peak.time) : fmt::format("t = {:.6g} s", peak.time),
                      stress_->nodes[static_cast<std::size_t>(peak.row)], x.x(), x.y(), x.z());
    }
  }
  return text;
}

std::string StressPeaks::what() const {
  return fmt::format("peaks of '{}' {} in {}", body_, fmt::join(wanted_, " "), fmt::join(regions_, " "));
}

}  // namespace bielle::mechanism
