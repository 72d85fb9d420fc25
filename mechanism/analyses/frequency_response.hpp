// Frequency responses of small motions about the present state of a session.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/analyses/linearised_setting.hpp"
#include "mechanism/math/types.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"

namespace bielle::mechanism {

class DelayedMeasure;

/// A force or moment on a node along an inertial direction, an input of the model by its number, or an addition to a
/// delayed value.
struct ResponseInput {
  std::string name;  ///< name of the model's input; of another input the name in the results: "force x at node 'tip'"
  int node = -1;     ///< node index; -1: an input of the model, or `delay`
  bool moment = false;
  Vector3 direction = Vector3::Zero();    ///< unit vector
  const DelayedMeasure* delay = nullptr;  ///< the delay whose value is added to
};

/// A measure of the model, or the displacement (or rotation) of a node along an inertial direction.
struct ResponseOutput {
  std::string name;
  int node = -1;  ///< node index; -1: a measure
  bool rotation = false;
  Vector3 direction = Vector3::Zero();
  const Measure* measure = nullptr;  ///< measure; nullptr: the measure with the name
};

struct FrequencyResponseOptions {
  std::vector<ResponseInput> inputs;
  std::vector<ResponseOutput> outputs;
  std::vector<double> frequencies;  ///< [Hz] >= 0
  std::optional<SteadyRotation> rotation = {};
  /// Number of slowest modes that are superposed, plus the residual of the other modes; 0: a direct solution at each
  /// frequency.
  int modes = 0;
};

/// Properties and error of a sum over modes.
struct ModalAccuracy {
  int modes = 0;         ///< number of modes in the sum
  double fastest = 0;    ///< frequency of the fastest of them [Hz]
  int direct = 0;        ///< number of frequencies with a direct solution
  double deviation = 0;  ///< largest relative deviation from a direct solution that was not used for the sum
  double frequency = 0;  ///< its frequency [Hz]
};

struct FrequencyResponse : LinearisedSetting {
  /// For each frequency (outputs, inputs): complex amplitude of the output per unit of the input, where an amplitude x
  /// means Re(x exp(i w t)).
  std::vector<Eigen::MatrixXcd> response;
  std::vector<std::string> output_units;
  std::optional<ModalAccuracy> modal;  ///< set for a sum over modes
};

/// Computes the response; the present state of the session is not changed. @throws InputError for names that the model
/// does not have; ComputationError at a frequency of an undamped mode
FrequencyResponse compute_frequency_response(Session& session, const FrequencyResponseOptions& options);

}  // namespace bielle::mechanism
