#include "mechanism/hydraulics/actuators/chamber_space.hpp"

#include <algorithm>

namespace bielle::mechanism {
namespace {

constexpr double transition = 0.02;  // of the shorter stage on either side

/// Of a step of the height 1 over -1 < x < 1: its integral from -1 on, itself, its slope by x.
struct SmoothStep {
  double integral, value, slope;
};
SmoothStep smooth_step(double x) {
  if (x <= -1) return {0, 0, 0};
  if (x >= 1) return {x, 1, 0};
  const double u = 0.5 * (x + 1), u3 = u * u * u;
  return {2 * u3 * u * (2.5 - u * (3 - u)), u3 * (10 - u * (15 - 6 * u)), 15 * u * u * (1 - u) * (1 - u)};
}

}  // namespace

ChamberSpace::ChamberSpace(double begin, double dead, double grows, std::vector<Stage> stages)
    : begin_(begin), first_area_(stages.front().area), grows_(grows) {
  double end = begin;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    largest_ = std::max(largest_, stages[k].area);
    end += stages[k].length;
    if (k + 1 == stages.size()) break;
    borders_.push_back({end, 0.5 * transition * std::min(stages[k].length, stages[k + 1].length),
                        stages[k + 1].area - stages[k].area});
  }
  at_begin_ = dead;
  if (grows < 0) at_begin_ += dead - at(end).V;
}

ChamberSpace::Value ChamberSpace::at(double l) const {
  Value value{first_area_ * (l - begin_), first_area_, 0};
  for (const Border& border : borders_) {
    const SmoothStep step = smooth_step((l - border.middle) / border.half_width);
    value.V += border.rise * border.half_width * step.integral;
    value.V_l += border.rise * step.value;
    value.V_ll += border.rise * step.slope / border.half_width;
  }
  return {at_begin_ + grows_ * value.V, grows_ * value.V_l, grows_ * value.V_ll};
}

double ChamberSpace::largest_area() const { return largest_; }

}  // namespace bielle::mechanism
