// Stresses at the stress points of beams, as measures.
//
// The stress at a point is linear in the resultants f of the middle of the element (BeamSection::stress):
//     sigma = [sigma_xx, tau_xy, tau_xz] = S f,   von Mises stress = sqrt(sigma_xx^2 + 3 tau_xy^2 + 3 tau_xz^2).
// The von Mises stress has a kink at zero; its derivatives there are taken as zero.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "mechanism/elements/beam/beam_element.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

/// Name of the largest von Mises stress at all stress points of an element, or of all elements of a beam.
inline constexpr const char* largest_beam_stress = "von_mises.max";

/// @param sigma  sigma_xx, tau_xy, tau_xz [Pa] @returns [Pa]
inline double von_mises_stress(const Vector3& sigma) {
  return std::sqrt(sigma[0] * sigma[0] + 3 * sigma.tail<2>().squaredNorm());
}

/// Returns the names of the measures of one element, "stress.p1.xx", "von_mises.p1", .., "von_mises.max"; none without
/// points.
std::vector<std::string> beam_stress_names(std::size_t points);

/// Makes the measure of a name. @param measure  one of `beam_stress_names` @returns nullptr for any other name
std::unique_ptr<Measure> make_beam_stress(const std::string& name, const BeamElement& element,
                                          const std::string& measure);

/// Returns the largest von Mises stress of several elements. @param elements  elements with stress points
std::unique_ptr<Measure> make_largest_stress(const std::string& name, std::vector<const BeamElement*> elements);

}  // namespace bielle::mechanism
