// Runs the analyses of a mechanism file one after the other and records them.
#pragma once

#include <string>
#include <vector>

#include "mechanism/io/mechanism_file.hpp"
#include "reduce/common/progress.hpp"

namespace bielle::mechanism {

/// What the summary says of one analysis.
struct AnalysisSummary {
  std::string name;     ///< "dynamic", with the scheme
  double end_time = 0;  ///< [s]
  long steps = 0;
  long iterations = 0;                 ///< linear solves
  MarchLog march;                      ///< dynamics
  std::string slowest_equation;        ///< dynamics: the worst in the step with the most iterations
  long records = 0;                    ///< rows written
  std::vector<double> limit_points;    ///< statics by arc length: load factors at its maxima and minima
  std::vector<std::string> redundant;  ///< constraints set aside
  StartReport start;                   ///< dynamics: what the consistent start had to change
  Energy energy;                       ///< at the end [J]; dissipation and input are integrals over the analysis
  double energy_start = 0;             ///< kinetic + elastic + gravity at the start [J]
  double balance = 0;                  ///< at the end: what is missing [J]
  double largest_energy = 0;           ///< largest of kinetic, elastic and change of gravity: to judge the balance by
  double energy_noise = 0;             ///< work of the forces along what positions are known to [J]
};

/// Runs all analyses and writes the results file.
/// @param restart  a results file of the same model to go on from, at its last checkpoint; its rows up to there become
///                 those of the new file, which may be the same one. Empty: a new run
/// @throws InputError, ComputationError; the results file then holds every row recorded so far, `complete = false`
std::vector<AnalysisSummary> run_analyses(const MechanismFile& file, const std::string& results_path,
                                          Progress& progress, const std::string& restart = "");

}  // namespace bielle::mechanism
