#include "mechanism/elements/control/sampled_law.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {

double OutputStage::operator()(double y) const {
  const double rounded = quantum > 0 ? std::round(y / quantum) * quantum : y;
  return std::clamp(rounded, least, most);
}

VectorX SampledLinear::step(const VectorX& u, const OutputStage& stage, Eigen::Ref<VectorX> x) const {
  VectorX y = block_.D * u;
  if (x.size() > 0) {
    y += block_.C * x;
    x = (block_.A * x + block_.B * u).eval();
  }
  for (double& each : y) each = stage(each);
  return y;
}

VectorX SampledPid::step(const VectorX& u, const OutputStage& stage, Eigen::Ref<VectorX> x) const {
  enum { sum, before, slope, begun };
  const double e = u[0];
  if (x[begun] == 0) x[before] = e;
  const double T = gains_.filter, change = gains_.integral * h_ * (e + x[before]) / 2;
  x[slope] = (T * x[slope] + gains_.derivative * (e - x[before])) / (T + h_);
  const double rest = gains_.proportional * e + x[slope], whole = rest + x[sum] + change;
  const bool winds_up = (whole > stage.most && change > 0) || (whole < stage.least && change < 0);
  if (!winds_up) x[sum] += change;
  x[before] = e;
  x[begun] = 1;
  return VectorX::Constant(1, stage(rest + x[sum]));
}

std::string SampledPid::about() const {
  return fmt::format("PID controller, {:.6g}, {:.6g} 1/s, {:.6g} s, filter {:.6g} s", gains_.proportional,
                     gains_.integral, gains_.derivative, gains_.filter);
}

}  // namespace bielle::mechanism
