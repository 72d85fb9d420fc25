#include "mechanism/hydraulics/actuators/chamber_space.hpp"

#include <algorithm>

#include "mechanism/math/smooth_step.hpp"

namespace bielle::mechanism {
namespace {

constexpr double transition = 0.02;  // length of a transition, relative to the shorter adjacent stage

}  // namespace

ChamberSpace::ChamberSpace(double begin, double dead, double grows, std::vector<Stage> stages)
    : begin_(begin), first_area_(stages.front().area), grows_(grows) {
  double end = begin;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    largest_ = std::max(largest_, stages[k].area);
    end += stages[k].length;
    if (k + 1 == stages.size()) break;
    const double width = transition * std::min(stages[k].length, stages[k + 1].length);
    borders_.push_back({end - 0.5 * width, width, stages[k + 1].area - stages[k].area});
  }
  at_begin_ = dead;
  if (grows < 0) at_begin_ += dead - at(end).V;
}

ChamberSpace::Value ChamberSpace::at(double l) const {
  Value value{first_area_ * (l - begin_), first_area_, 0};
  for (const Border& border : borders_) {
    const SmoothStep step = smooth_step((l - border.begin) / border.width);
    value.V += border.rise * border.width * step.integral;
    value.V_l += border.rise * step.value;
    value.V_ll += border.rise * step.slope / border.width;
  }
  return {at_begin_ + grows_ * value.V, grows_ * value.V_l, grows_ * value.V_ll};
}

double ChamberSpace::largest_area() const { return largest_; }

}  // namespace bielle::mechanism
