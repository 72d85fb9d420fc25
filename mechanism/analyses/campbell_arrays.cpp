#include "mechanism/analyses/campbell_arrays.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

class CampbellWriter {
 public:
  CampbellWriter(Session& session, const SweptModes& swept) : session_(session), swept_(swept) {
    for (const SweepPoint& point : swept.points)
      if (point.given) points_.push_back(&point);
  }

  void write_points(const std::string& parameter) {
    std::vector<double> values, speeds;
    for (const SweepPoint* point : points_) {
      values.push_back(point->value);
      speeds.push_back(point->speed);
    }
    write("speed", {points_.size()}, speeds, "rad/s", "angular velocity of the shaft");
    if (!parameter.empty()) {
      write("value", {points_.size()}, values, "-", "of the parameter that was swept");
      session_.write(ResultNames{"campbell/parameter", {parameter}});
    }
    write_each("frequency", "Hz", "|s| / 2 pi; NaN where the mode was not found",
               [](const TrackedMode& mode) { return std::abs(mode.s) / (2 * std::numbers::pi); });
    write_each("damped_frequency", "Hz", "|Im s| / 2 pi",
               [](const TrackedMode& mode) { return std::abs(mode.s.imag()) / (2 * std::numbers::pi); });
    write_each("damping_ratio", "-", "-Re s / |s|",
               [](const TrackedMode& mode) { return -mode.s.real() / std::abs(mode.s); });
    write_each("whirl", "-", "1: circles forwards, -1: backwards, 0: in a plane; NaN without a sense",
               [](const TrackedMode& mode) { return mode.whirl; });
    write_each("correlation", "-", "of the shape with that of the speed before (MAC by the mass matrix)",
               [](const TrackedMode& mode) { return mode.correlation; });
    std::vector<double> s;
    for (const SweepPoint* point : points_)
      for (const TrackedMode& mode : point->tracks)
        s.insert(s.end(), {mode.found ? mode.s.real() : NAN, mode.found ? mode.s.imag() : NAN});
    write("eigenvalue", {points_.size(), modes(), 2}, s, "1/s",
          "real and imaginary part, negative after a passage through zero");
  }

  void write_critical() {
    const auto& critical = swept_.critical;
    if (critical.empty()) return;
    const auto column = [&](const char* name, const char* units, const char* what, const auto& number) {
      std::vector<double> numbers;
      for (const CriticalSpeed& each : critical) numbers.push_back(number(each));
      write(name, {critical.size()}, numbers, units, what);
    };
    column("critical_speed", "rad/s", "where a damped frequency is a multiple of the speed",
           [](const CriticalSpeed& each) { return each.speed; });
    column("critical_value", "-", "of what was swept", [](const CriticalSpeed& each) { return each.value; });
    column("critical_frequency", "Hz", "", [](const CriticalSpeed& each) { return each.frequency; });
    column("critical_order", "-", "the multiple", [](const CriticalSpeed& each) { return each.order; });
    column("critical_mode", "-", "its number, from 1", [](const CriticalSpeed& each) { return each.mode + 1.0; });
    column("critical_damping_ratio", "-", "", [](const CriticalSpeed& each) { return each.damping_ratio; });
    column("critical_whirl", "-", "as `whirl`", [](const CriticalSpeed& each) { return each.whirl; });
  }

  void write_meetings() {
    const auto& meetings = swept_.meetings;
    if (meetings.empty()) return;
    std::vector<double> speeds, frequencies, gaps, pairs;
    std::vector<std::string> kinds;
    for (const ModeMeeting& each : meetings) {
      speeds.push_back(each.speed);
      frequencies.push_back(each.frequency);
      gaps.push_back(each.gap);
      pairs.insert(pairs.end(), {each.first + 1.0, each.second + 1.0});
      kinds.emplace_back(each.veering ? "veering" : "crossing");
    }
    session_.write(ResultNames{"campbell/meeting", kinds});
    write("meeting_speed", {meetings.size()}, speeds, "rad/s", "where two frequencies cross or veer");
    write("meeting_modes", {meetings.size(), 2}, pairs, "-", "their numbers, from 1");
    write("meeting_frequency", {meetings.size()}, frequencies, "Hz", "mean of the two, damped");
    write("meeting_gap", {meetings.size()}, gaps, "Hz", "between the two; 0 of crossings");
  }

 private:
  std::size_t modes() const { return points_.front()->tracks.size(); }

  void write(const char* name, std::vector<std::size_t> shape, std::vector<double> values, const char* units,
             const char* what) {
    session_.write({fmt::format("campbell/{}", name), std::move(shape), std::move(values), units, what});
  }

  template <class Number>
  void write_each(const char* name, const char* units, const char* what, const Number& number) {
    std::vector<double> values;
    for (const SweepPoint* point : points_)
      for (const TrackedMode& mode : point->tracks) values.push_back(mode.found ? number(mode) : NAN);
    write(name, {points_.size(), modes()}, std::move(values), units, what);
  }

  Session& session_;
  const SweptModes& swept_;
  std::vector<const SweepPoint*> points_;
};

}  // namespace

void write_campbell(Session& session, const Campbell& found, const std::string& parameter) {
  if (found.swept.points.front().tracks.empty()) return;
  CampbellWriter writer(session, found.swept);
  writer.write_points(parameter);
  session.write(ResultNames{"campbell/name", found.names});
  writer.write_critical();
  writer.write_meetings();
}

const char* whirl_name(double whirl) {
  constexpr double circling = 0.1;
  if (std::isnan(whirl)) return "";
  return whirl > circling ? "forwards" : whirl < -circling ? "backwards" : "plane";
}

}  // namespace bielle::mechanism
