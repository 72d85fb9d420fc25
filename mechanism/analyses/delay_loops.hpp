// Delays in small motions exp(s t): the delayed value x(t - T) is exp(-s T) x.
//
// The equations of small motions are those without delays, where the delayed values d are x + e, with further inputs e
// and further outputs x. With the responses of these equations,
//     y = H_yu u + H_ye e,     x = H_xu u + H_xe e,     e = (Z - 1) x,     Z = diag exp(-s T),
// the response with delays is exact:  H_yu + H_ye (1 - (Z - 1) H_xe)^-1 (Z - 1) H_xu.
#pragma once

#include <string>
#include <vector>

#include "mechanism/analyses/frequency_response.hpp"

namespace bielle::mechanism {

/// Describes the delays of a model, each with its time: "'late' (0.02 s)", "delay(main.angle, 0.1)".
std::vector<std::string> describe_delays(const Model& model);

/// The model must outlive it.
class DelayLoops {
 public:
  explicit DelayLoops(const Model& model);
  bool none() const { return delays_.empty(); }
  /// Returns the options with the delayed values as further inputs, and the measures that they delay as further
  /// outputs.
  FrequencyResponseOptions opened(FrequencyResponseOptions options) const;
  /// Returns the response with delays.
  /// @param H  response to all inputs of the opened options (outputs, inputs) @param s  exponent of the motion [1/s]
  /// @returns  an empty matrix if no response exists, because exp(s t) is a motion of the free mechanism
  Eigen::MatrixXcd closed(const Eigen::MatrixXcd& H, std::complex<double> s) const;

 private:
  std::vector<const DelayedMeasure*> delays_;
};

}  // namespace bielle::mechanism
