#include "mechanism/elements/beam/load_pieces.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/elements/beam/span_motion.hpp"
#include "mechanism/math/gauss.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Integrates a formula, or its magnitude, over the beam, by three Gauss points in each of `parts` equal parts of the
/// pieces between kinks of each element.
template <class Value>
double load_integral(const std::vector<double>& ends, int parts, const Value& value) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    for (int part = 0; part < parts; ++part)
      for (std::size_t g = 0; g < 3; ++g) {
        const double length = (ends[k + 1] - ends[k]) / parts;
        sum += length * Gauss3::weight[g] * value(ends[k] + length * (part + Gauss3::place[g]));
      }
  return sum;
}

}  // namespace

std::vector<double> pieces_between(const std::vector<double>& places, double s_A, double s_B) {
  std::vector<double> ends{0, 1};
  for (const double s : places) {
    const double z = (s - s_A) / (s_B - s_A);
    if (z > 1e-9 && z < 1 - 1e-9) ends.push_back(z);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

std::vector<double> load_pieces(std::span<const StateFormula> components, double s_A, double s_B) {
  std::vector<double> places;
  for (const StateFormula& component : components) component.add_break_points(span_place, places);
  return pieces_between(places, s_A, s_B);
}

bool reads_span_motion(const StateFormula& formula) {
  for (std::size_t k = span_v; k < span_variable_count; ++k)
    if (formula.uses(k)) return true;
  return false;
}

void check_load_integral(const YamlValue& value, const StateFormula& formula, std::span<const StateFormula> components,
                         int elements) {
  if (formula.is_constant() || formula.reads_state() || reads_span_motion(formula)) return;
  const Expression plain = value.expression(span_variables());
  std::vector<double> times = plain.break_points(span_time);
  times.push_back(0);
  times.push_back(1);
  for (const double t : times) {
    const auto value_at = [&](double s) {
      SpanValues variables{};
      variables[span_place] = s;
      variables[span_time] = t;
      return plain(variables);
    };
    double coarse = 0, fine = 0, size = 0;
    try {
      for (int k = 0; k < elements; ++k) {
        const double s_A = static_cast<double>(k) / elements, s_B = static_cast<double>(k + 1) / elements;
        std::vector<double> ends = load_pieces(components, s_A, s_B);
        for (double& z : ends) z = s_A + z * (s_B - s_A);
        constexpr int many = 32;
        coarse += load_integral(ends, 1, value_at);
        fine += load_integral(ends, many, value_at);
        size += load_integral(ends, many, [&](double s) { return std::abs(value_at(s)); });
      }
    } catch (const ComputationError& error) {  // the message names the place
      throw InputError(error.what());
    }
    constexpr double allowed = 1e-2;
    if (std::abs(coarse - fine) > allowed * size)
      value.fail(
          fmt::format("with {} the beam gets {:.4g} of the load's integral, which is {:.4g} (at t = {:.4g} s): write "
                      "jumps as comparisons of `s` with numbers, or give more elements",
                      counted(elements, "element"), coarse, fine, t));
  }
}

}  // namespace bielle::mechanism
