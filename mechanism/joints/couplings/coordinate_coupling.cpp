#include "mechanism/joints/couplings/coordinate_coupling.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void CoordinateCoupling::add_term(const NamedCoordinate& coordinate, double factor) {
  terms_.push_back({coordinate.joint, coordinate.index, factor, references_.add(*coordinate.joint)});
}

const JointCoordinate& CoordinateCoupling::unit() const {
  const auto one = std::find_if(terms_.begin(), terms_.end(), [](const Term& t) { return std::abs(t.factor) == 1; });
  return (one == terms_.end() ? terms_.back() : *one).description();
}

std::vector<OutputField> CoordinateCoupling::output_fields() const {
  std::string units, names;
  for (const Term& term : terms_) {
    const char* separator = units.empty() ? "" : ", ";
    units += fmt::format("{}{}", separator, term.description().force_units());
    names += fmt::format("{}{}.{}", separator, term.joint->name(), term.description().name);
  }
  return {{"force", {terms_.size()}, units, fmt::format("force or torque of the coupling on {}", names)}};
}

void CoordinateCoupling::write_output(const LocalState& state, double* values) const {
  const double F = force(state);
  for (std::size_t k = 0; k < terms_.size(); ++k) values[k] = -terms_[k].factor * F;
}

std::string CoordinateCoupling::sum_text() const {
  std::string sum;
  for (const Term& term : terms_)
    sum +=
        fmt::format("{}{:.10g} '{}'.{}", sum.empty() ? (term.factor < 0 ? "-" : "") : (term.factor < 0 ? " - " : " + "),
                    std::abs(term.factor), term.joint->name(), term.description().name);
  return sum;
}

void CoordinateCoupling::describe(const LocalState& /*state*/, Description& description) const {
  description.add(sum_text() + " = 0");
}

}  // namespace bielle::mechanism
