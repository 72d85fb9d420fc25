#include "mechanism/analyses/blade_pattern.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/analyses/mode_motion.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

Vector3 centre(const State& state, const std::vector<int>& nodes) {
  Vector3 sum = Vector3::Zero();
  for (const int node : nodes) sum += state.nodes[static_cast<std::size_t>(node)].x;
  return sum / static_cast<double>(nodes.size());
}

/// Describes an asymmetric pattern by its effect on the hub: the moment of motions out of the plane, or the force of
/// motions in it. Both have the directions of the tangents of the blades, up to a sign that all have in common.
const char* hub_motion(const std::vector<BladeAmplitude>& blades, const Vector3& axis, bool out_of_plane,
                       const Matrix3& standing) {
  std::complex<double> side = 0, up = 0;
  for (const BladeAmplitude& blade : blades) {
    const Vector3 tangent = axis.cross(blade.radial);
    side += standing.col(1).dot(tangent) * blade.amplitude;
    up += standing.col(2).dot(tangent) * blade.amplitude;
  }
  const double whole = std::norm(side) + std::norm(up);
  if (std::norm(side) >= mode_share * whole) return out_of_plane ? "tilt" : "horizontal";
  if (std::norm(up) >= mode_share * whole) return out_of_plane ? "yaw" : "vertical";
  return "asymmetric";
}

}  // namespace

std::vector<Blade> blades_around(const Vector3& axis, const ModeGroup& group, const State& state) {
  Vector3 middle = Vector3::Zero();
  for (const std::vector<int>& nodes : group.nodes)
    middle += centre(state, nodes) / static_cast<double>(group.nodes.size());
  constexpr double off_axis = 1e-2, same_azimuth = 1e-2;
  const double least = off_axis * model_extent(state);
  std::vector<Blade> blades;
  for (const std::vector<int>& nodes : group.nodes) {
    const Vector3 arm = centre(state, nodes) - middle, across = arm - axis * axis.dot(arm);
    if (across.norm() < least) return {};
    const Vector3 radial = across.normalized();
    const auto blade = std::find_if(blades.begin(), blades.end(),
                                    [&](const Blade& each) { return (each.radial - radial).norm() < same_azimuth; });
    if (blade == blades.end())
      blades.push_back({radial, nodes});
    else
      blade->nodes.insert(blade->nodes.end(), nodes.begin(), nodes.end());
  }
  const bool equal = std::all_of(blades.begin(), blades.end(),
                                 [&](const Blade& each) { return each.nodes.size() == blades.front().nodes.size(); });
  return equal && blades.size() > 1 ? blades : std::vector<Blade>();
}

std::string blade_pattern(const std::vector<BladeAmplitude>& blades, const Vector3& axis, bool out_of_plane,
                          bool has_sense, const std::optional<Matrix3>& standing) {
  const Vector3 first = axis.unitOrthogonal(), second = axis.cross(first);
  std::complex<double> sum = 0, sum_forward = 0, sum_backward = 0;
  double squares = 0;
  for (const auto& [radial, amplitude] : blades) {
    const std::complex<double> phase = std::polar(1.0, std::atan2(radial.dot(second), radial.dot(first)));
    sum += amplitude;
    sum_forward += amplitude * phase;
    sum_backward += amplitude * std::conj(phase);
    squares += std::norm(amplitude);
  }
  const double whole = static_cast<double>(blades.size()) * squares;
  if (!(whole > 0)) return {};
  const double collective = std::norm(sum) / whole, forward = std::norm(sum_forward) / whole,
               backward = std::norm(sum_backward) / whole;
  if (collective >= mode_share) return "collective";
  if (blades.size() == 2) return forward >= mode_share ? "differential" : "";
  if (1 - collective - forward - backward >= mode_share) return "reactionless";
  if (forward + backward < mode_share) return {};
  if (has_sense && forward >= mode_share) return "forward";
  if (has_sense && backward >= mode_share) return "backward";
  return standing ? hub_motion(blades, axis, out_of_plane, *standing) : "asymmetric";
}

}  // namespace bielle::mechanism
