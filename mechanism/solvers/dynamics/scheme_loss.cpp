#include "mechanism/solvers/dynamics/scheme_loss.hpp"

#include <cmath>

namespace bielle::mechanism {
namespace {

/// Returns w.M w of the dofs. @param values  values of the tangent, M alone
double mass_form(const System& system, const std::vector<double>& values, const VectorX& w) {
  const SparsePattern& pattern = system.pattern();
  const int n = system.dofs();
  double sum = 0;
  for (int column = 0; column < n; ++column) {
    double product = 0;
    for (int k = pattern.column_start()[static_cast<std::size_t>(column)];
         k < pattern.column_start()[static_cast<std::size_t>(column) + 1]; ++k)
      if (const int row = pattern.row()[static_cast<std::size_t>(k)]; row < n)
        product += values[static_cast<std::size_t>(k)] * w[row];
    sum += product * w[column];
  }
  return sum;
}

}  // namespace

double SchemeLoss::calc(const SchemeStep& step, const Environment& environment) {
  const Scheme& scheme = step.scheme();
  const VectorX e =
      0.5 * (step.algorithmic_acceleration() + step.rates().A - step.trial_acceleration() - step.rates().a);
  step.system().tangent(step.trial(), environment, {0, 0, 1, 0, 0}, nullptr, mass_);
  const double part = step.trial_size() * (1 - scheme.alpha_m - scheme.alpha_f);
  return part * part / (4 * (scheme.alpha_f - scheme.alpha_m)) * mass_form(step.system(), mass_, e);
}

void SchemeLoss::add(const SchemeStep& step, const Environment& environment) {
  if (!is_of(step.scheme())) return;
  constexpr long all = 100, one_in = 8;
  constexpr double golden = 0.6180339887498949;
  const long count = ++steps_;
  if (count <= all)
    total_ += calc(step, environment);
  else if (std::fmod(static_cast<double>(count) * golden, 1) < 1.0 / one_in)
    total_ += one_in * calc(step, environment);
}

void SchemeLoss::exchange(Archive& archive) {
  archive(total_);
  archive.within(steps_, 0, 1e15);
}

}  // namespace bielle::mechanism
