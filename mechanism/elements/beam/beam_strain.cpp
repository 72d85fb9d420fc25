#include "mechanism/elements/beam/beam_strain.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

constexpr double worth_a_doubt = 0.02;
constexpr double much_tension = 1.0 / 3;  // of what yields sideways: bending is then soft by about as much

}  // namespace

void BeamStrainWatch::begin() {
  strain_ = time_ = tension_ = 0;
  statics_ = false;
}

void BeamStrainWatch::add(const LocalState& state) {
  tension_ = std::max(tension_, element_.tension_share(state));
  const double strain = element_.largest_strain(state);
  if (!(strain > strain_)) return;
  strain_ = strain;
  statics_ = state.environment().statics;
  time_ = statics_ ? state.environment().load_factor : state.time();
}

void BeamStrainWatch::exchange(Archive& archive) {
  archive(strain_);
  archive(tension_);
  archive(time_);
  archive(statics_);
}

std::string BeamStrainWatch::summary() {
  const auto [element, elements] = element_.place();
  std::string text;
  if (tension_ > much_tension)
    text = fmt::format(
        "  DOUBTFUL: beam '{}' is pulled by {:.0f} % of the tension that its elements, which are too long for it, bear "
        "without yielding sideways: take at least {:.0f} of them, or `bending: constant`\n",
        element_.name(), 100 * tension_, std::ceil(elements * std::sqrt(tension_ / (0.1 * much_tension))));
  if (strain_ < worth_a_doubt) return text;
  return text +
         fmt::format("  DOUBTFUL: beam '{}' is strained by {:.2g} %{} at {}{}: its law is linear, for small strains\n",
                     element_.name(), 100 * strain_,
                     elements == 1 ? "" : fmt::format(", most in element {} of {},", element, elements),
                     statics_ ? fmt::format("load factor {:.6g}", time_) : fmt::format("t = {:.6g} s", time_),
                     element_.knows_its_shape() ? "" : ", if it is as thick as EI and EA say");
}

std::string BeamStrainWatch::what() const { return fmt::format("{}, {}", voice(), element_.place().element); }

std::string BeamStrainWatch::voice() const { return fmt::format("strain of beam '{}'", element_.name()); }

}  // namespace bielle::mechanism
