#include "mechanism/analyses/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/analyses/delay_loops.hpp"
#include "mechanism/analyses/modal_response.hpp"
#include "mechanism/analyses/response_equations.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;

[[noreturn]] void throw_no_response(double frequency) {
  throw ComputationError(
      fmt::format("there is no response at {:.6g} Hz: it is a frequency at which the mechanism moves without any force",
                  frequency));
}

/// Returns the exponent s of motions with a frequency [Hz].
Complex exponent(double frequency) { return {0, 2 * std::numbers::pi * frequency}; }

/// Computes the response by one factorisation for each frequency.
class DirectResponse {
 public:
  DirectResponse(const LinearResponse& response, const FrequencyResponseOptions& options)
      : response_(response), options_(options), rights_(response.right_sides(options.inputs, options.outputs)) {}

  Eigen::MatrixXcd operator()(Complex s) const {
    const ShiftedOperator D(response_.equations(), s);
    if (!D.regular()) throw_no_response(s.imag() / (2 * std::numbers::pi));
    return response_.at(D, options_.inputs, options_.outputs, rights_);
  }

 private:
  const LinearResponse& response_;
  const FrequencyResponseOptions& options_;
  std::vector<VectorX> rights_;
};

/// Computes the response as a sum over modes.
class SuperposedResponse {
 public:
  SuperposedResponse(const LinearResponse& response, const FrequencyResponseOptions& options)
      : response_(response), equations_(response.equations()), options_(options) {}

  void run(FrequencyResponse& result) const {
    const double most =
                     2 * std::numbers::pi * *std::max_element(options_.frequencies.begin(), options_.frequencies.end()),
                 least =
                     2 * std::numbers::pi * *std::min_element(options_.frequencies.begin(), options_.frequencies.end());
    if (most == 0)
      throw InputError("`modes`: a sum over modes is for frequencies above 0; the answer at 0 alone is found directly");
    ModeOptions search;
    search.count = options_.modes;
    const Modes found = find_modes(equations_, search);
    const std::vector<ModalPole> poles = modal_poles(equations_, found.modes);
    const bool rigid = found.modes.size() > poles.size();
    const DirectResponse direct(response_, options_);
    const ModalResponse superposed(response_, poles, options_, most, direct);
    result.modal = superposed.accuracy(least);
    result.modal->modes = static_cast<int>(poles.size());
    for (const ModalPole& pole : poles)
      result.modal->fastest = std::max(result.modal->fastest, std::abs(pole.s) / (2 * std::numbers::pi));
    constexpr double enough = 1e-3;
    if (result.modal->deviation > enough) check_rigid(*result.modal, found.modes, poles);
    for (const double frequency : options_.frequencies) {
      const Complex s = exponent(frequency);
      if (frequency == 0 && rigid) {
        result.response.push_back(direct(s));
        continue;
      }
      check_not_a_mode(poles, s);
      result.response.push_back(superposed.at(s));
    }
  }

 private:
  /// Throws if a rigid mode takes part in the answers: its response to forces is proportional to 1/s^2 and 1/s, which
  /// the smooth remainder cannot represent.
  void check_rigid(const ModalAccuracy& accuracy, const std::vector<Mode>& modes,
                   const std::vector<ModalPole>& poles) const {
    for (const Mode& mode : modes)
      if (mode.kind == ModeKind::rigid && takes_part(mode, poles))
        throw ComputationError(
            fmt::format("modes cannot be superposed: a rigid mode that no force resists has a part in these answers "
                        "(at {:.6g} Hz the "
                        "sum differs from the direct answer by {:.2g} of it): hold the mechanism, or leave `modes` out",
                        accuracy.frequency, accuracy.deviation));
  }
  /// Tells whether an input excites the mode and an output observes it.
  bool takes_part(const Mode& mode, const std::vector<ModalPole>& poles) const {
    constexpr double something = 1e-6;
    const int n = equations_.unknowns();
    const double size = mode.u.norm();
    bool moved = false, seen = false;
    for (const VectorX& right : response_.right_sides(options_.inputs, options_.outputs))
      if (std::abs(right.head(n).cast<Complex>().dot(mode.u)) > something * right.head(n).norm() * size) moved = true;
    Eigen::VectorXcd solution = Eigen::VectorXcd::Zero(n + equations_.constraints());
    solution.head(n) = mode.u;
    const LinearMotion motion = response_.motion(0, solution);
    const Eigen::VectorXcd values = response_.values(options_.outputs, motion);
    VectorX usual = VectorX::Zero(values.size());
    for (const ModalPole& pole : poles)
      usual = usual.cwiseMax(response_.values(options_.outputs, response_.motion(pole.s, pole.right)).cwiseAbs() /
                             pole.right.head(n).norm());
    for (Eigen::Index i = 0; i < values.size(); ++i)
      if (std::abs(values[i]) > something * usual[i] * size) seen = true;
    return moved && seen;
  }
  static void check_not_a_mode(const std::vector<ModalPole>& poles, Complex s) {
    constexpr double rounding = 1e-13;
    for (const ModalPole& pole : poles)
      if (std::abs(pole.s - s) <= rounding * std::abs(s)) throw_no_response(s.imag() / (2 * std::numbers::pi));
  }

  const LinearResponse& response_;
  const LinearisedEquations& equations_;
  const FrequencyResponseOptions& options_;
};

}  // namespace

FrequencyResponse compute_frequency_response(Session& session, const FrequencyResponseOptions& options) {
  const DelayLoops loops(session.model());
  const FrequencyResponseOptions opened = loops.opened(options);
  const ResponseEquations equations(session, opened.inputs, opened.outputs, options.rotation);
  const LinearResponse& response = equations.response();
  if (equations.harmonics() > 0 && !loops.none())
    throw InputError(fmt::format(
        "`rotation`: responses with harmonics of a rotation are those of mechanisms without delays; this one has {}",
        fmt::join(describe_delays(session.model()), ", ")));
  FrequencyResponse result;
  static_cast<LinearisedSetting&>(result) = equations.setting();
  for (const ResponseOutput& output : options.outputs) result.output_units.push_back(response.units(output));
  if (options.modes > 0) {
    if (equations.harmonics() > 0)
      throw InputError("`modes`: responses with harmonics of a rotation are found directly: leave the key out");
    SuperposedResponse(response, opened).run(result);
  } else {
    const DirectResponse direct(response, opened);
    for (const double frequency : options.frequencies) result.response.push_back(direct(exponent(frequency)));
  }
  if (loops.none()) return result;
  for (std::size_t k = 0; k < options.frequencies.size(); ++k) {
    result.response[k] = loops.closed(result.response[k], exponent(options.frequencies[k]));
    if (result.response[k].size() == 0) throw_no_response(options.frequencies[k]);
  }
  return result;
}

}  // namespace bielle::mechanism
