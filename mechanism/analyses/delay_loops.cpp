#include "mechanism/analyses/delay_loops.hpp"

#include <fmt/format.h>

#include "mechanism/measures/delayed_measure.hpp"

namespace bielle::mechanism {
namespace {

std::vector<const DelayedMeasure*> delays_in(const Model& model) {
  std::vector<const DelayedMeasure*> delays;
  for (const Member& member : model.members())
    if (const auto* delay = dynamic_cast<const DelayedMeasure*>(member.component.get())) delays.push_back(delay);
  return delays;
}

}  // namespace

std::vector<std::string> describe_delays(const Model& model) {
  std::vector<std::string> texts;
  for (const Member& member : model.members())
    if (const auto* delay = dynamic_cast<const DelayedMeasure*>(member.component.get()))
      texts.push_back(member.entry.section == Section::states
                          ? fmt::format("'{}' ({:.6g} s)", delay->name(), delay->time())
                          : delay->name());
  return texts;
}

DelayLoops::DelayLoops(const Model& model) : delays_(delays_in(model)) {}

FrequencyResponseOptions DelayLoops::opened(FrequencyResponseOptions options) const {
  for (const DelayedMeasure* delay : delays_) {
    ResponseInput input;
    input.name = delay->name();
    input.delay = delay;
    options.inputs.push_back(input);
    ResponseOutput output;
    output.name = delay->of().name();
    output.measure = &delay->of();
    options.outputs.push_back(output);
  }
  return options;
}

Eigen::MatrixXcd DelayLoops::closed(const Eigen::MatrixXcd& H, std::complex<double> s) const {
  const auto count = static_cast<Eigen::Index>(delays_.size());
  const Eigen::Index outputs = H.rows() - count, inputs = H.cols() - count;
  Eigen::VectorXcd change(count);
  for (Eigen::Index k = 0; k < count; ++k)
    change[k] = std::exp(-s * delays_[static_cast<std::size_t>(k)]->time()) - 1.0;
  const Eigen::MatrixXcd loop =
      Eigen::MatrixXcd::Identity(count, count) - change.asDiagonal() * H.bottomRightCorner(count, count);
  const Eigen::FullPivLU<Eigen::MatrixXcd> factors(loop);
  if (!factors.isInvertible()) return {};
  return H.topLeftCorner(outputs, inputs) +
         H.topRightCorner(outputs, count) *
             factors.solve(Eigen::MatrixXcd(change.asDiagonal() * H.bottomLeftCorner(count, inputs)));
}

}  // namespace bielle::mechanism
