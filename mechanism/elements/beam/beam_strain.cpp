#include "mechanism/elements/beam/beam_strain.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

constexpr double worth_a_warning = 0.02;
// Bending under tension decays from a clamp like exp(-x/l), which one cubic can only represent over a few lengths l:
// with seven in each of four elements the deflection of a strip is accurate to 1 %; the first frequency of a blade of
// two elements with ten in each is 10 % too high. Moments next to the clamp require elements of one or two lengths.
constexpr double too_long = 7;
constexpr double advised = 3.5;

}  // namespace

void BeamStrainWatch::begin() {
  strain_ = time_ = layers_ = 0;
  statics_ = false;
}

void BeamStrainWatch::add(const LocalState& state) {
  const auto [strain, layers] = element_.validity(state);
  layers_ = std::max(layers_, layers);
  if (!(strain > strain_)) return;
  strain_ = strain;
  statics_ = state.environment().statics;
  time_ = statics_ ? state.environment().load_factor : state.time();
}

void BeamStrainWatch::exchange(Archive& archive) {
  archive(strain_);
  archive(layers_);
  archive(time_);
  archive(statics_);
}

std::string BeamStrainWatch::summary() {
  const auto [element, elements] = element_.place();
  std::string text;
  if (layers_ > too_long)
    text = fmt::format(
        "  warning: under its tension beam '{}' bends within {:.2g} m of clamps and side loads alone, and its "
        "elements are {:.2g} m long: take at least {:.0f} of them\n",
        element_.name(), element_.length() / layers_, element_.length(), std::ceil(elements * layers_ / advised));
  if (strain_ < worth_a_warning) return text;
  return text +
         fmt::format("  warning: beam '{}' is strained by {:.2g} %{} at {}{}: its law is linear, for small strains\n",
                     element_.name(), 100 * strain_,
                     elements == 1 ? "" : fmt::format(", most in element {} of {},", element, elements),
                     statics_ ? fmt::format("load factor {:.6g}", time_) : fmt::format("t = {:.6g} s", time_),
                     element_.knows_its_shape() ? "" : ", if it is as thick as EI and EA say");
}

double BeamStrainWatch::loudness() const { return std::max(strain_ / worth_a_warning, layers_ / too_long); }

std::string BeamStrainWatch::what() const { return fmt::format("{}, {}", voice(), element_.place().element); }

std::string BeamStrainWatch::voice() const { return fmt::format("strain of beam '{}'", element_.name()); }

}  // namespace bielle::mechanism
