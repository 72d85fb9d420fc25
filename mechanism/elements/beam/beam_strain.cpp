#include "mechanism/elements/beam/beam_strain.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

constexpr double worth_a_doubt = 0.02;

}  // namespace

void BeamStrainWatch::begin() {
  strain_ = time_ = 0;
  statics_ = false;
}

void BeamStrainWatch::add(const LocalState& state) {
  const double strain = element_.largest_strain(state);
  if (!(strain > strain_)) return;
  strain_ = strain;
  statics_ = state.environment().statics;
  time_ = statics_ ? state.environment().load_factor : state.time();
}

void BeamStrainWatch::exchange(Archive& archive) {
  archive(strain_);
  archive(time_);
  archive(statics_);
}

std::string BeamStrainWatch::summary() {
  const auto [element, elements] = element_.place();
  if (strain_ < worth_a_doubt) return "";
  return fmt::format("  DOUBTFUL: beam '{}' is strained by {:.2g} %{} at {}{}: its law is linear, for small strains\n",
                     element_.name(), 100 * strain_,
                     elements == 1 ? "" : fmt::format(", most in element {} of {},", element, elements),
                     statics_ ? fmt::format("load factor {:.6g}", time_) : fmt::format("t = {:.6g} s", time_),
                     element_.knows_its_shape() ? "" : ", if it is as thick as EI and EA say");
}

std::string BeamStrainWatch::what() const { return fmt::format("{}, {}", voice(), element_.place().element); }

std::string BeamStrainWatch::voice() const { return fmt::format("strain of beam '{}'", element_.name()); }

}  // namespace bielle::mechanism
