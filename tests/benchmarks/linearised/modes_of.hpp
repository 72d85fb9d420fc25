// Modes of models from text, for benchmarks.
#pragma once

#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

namespace bielle::test {

inline constexpr double two_pi = 2 * std::numbers::pi;

/// A session of a model's text, brought into static equilibrium if asked.
struct ModesOf {
  mechanism::MechanismFile file;
  mutable mechanism::Session session;  ///< the state stays
  explicit ModesOf(const std::string& text, bool equilibrium = false)
      : file(mechanism::read_mechanism_text(text, "model.yaml")), session(file.model) {
    if (!equilibrium) return;
    mechanism::StaticsOptions statics;
    statics.newton.tolerance = 1e-12;
    compute_statics(session, statics);
  }
  mechanism::ModesReport operator()(const mechanism::ModeOptions& search = {}) const {
    return compute_modes(session, {search, {}});
  }
};

/// Returns the angular frequencies |s| [rad/s] of the modes that are not rigid, ascending.
inline std::vector<double> rates_of(const mechanism::ModesReport& report) {
  std::vector<double> rates;
  for (const mechanism::Mode& mode : report.found.modes)
    if (mode.kind != mechanism::ModeKind::rigid) rates.push_back(std::abs(mode.s));
  return rates;
}

inline std::vector<double> rates_of(const std::string& text, const mechanism::ModeOptions& search = {},
                                    bool equilibrium = false) {
  return rates_of(ModesOf(text, equilibrium)(search));
}

inline long count_rigid(const mechanism::ModesReport& report) {
  return std::count_if(report.found.modes.begin(), report.found.modes.end(),
                       [](const mechanism::Mode& mode) { return mode.kind == mechanism::ModeKind::rigid; });
}

inline void check_rates(const std::vector<double>& found, const std::vector<double>& expected, double relative) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    CAPTURE(k);
    CHECK(found[k] == Approx(expected[k]).epsilon(relative));
  }
}

}  // namespace bielle::test
