#include "reduce/superelement/assembled_pieces.hpp"

#include <algorithm>
#include <map>

namespace bielle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Adds the interfaces that are not yet there.
void add_interfaces(const Superelement& piece, std::vector<Interface>& interfaces) {
  for (const Interface& interface : piece.interfaces)
    if (std::none_of(interfaces.begin(), interfaces.end(),
                     [&](const Interface& known) { return known.name == interface.name; }))
      interfaces.push_back(interface);
}

Index kept_directions(const Interface& interface) {
  return std::count(interface.kept.begin(), interface.kept.end(), true);
}

/// Returns the first coordinate of each interface, by name.
std::map<std::string, Index> first_coordinates(const std::vector<Interface>& interfaces) {
  std::map<std::string, Index> result;
  Index next = 0;
  for (const Interface& interface : interfaces) {
    result[interface.name] = next;
    next += kept_directions(interface);
  }
  return result;
}

/// Returns the coordinate of the whole body for each coordinate of the piece. @param modes  first coordinate of its
/// modes in the whole
std::vector<Index> coordinates_of(const Superelement& piece, const std::map<std::string, Index>& first, Index modes) {
  std::vector<Index> result;
  for (const Interface& interface : piece.interfaces)
    for (Index k = 0; k < kept_directions(interface); ++k) result.push_back(first.at(interface.name) + k);
  for (Index k = 0; k < piece.modes(); ++k) result.push_back(modes + k);
  return result;
}

void add_matrices(const Superelement& piece, const std::vector<Index>& coordinates, Superelement& whole) {
  const auto add = [&](const MatrixXd& part, MatrixXd& sum) {
    for (Index j = 0; j < part.cols(); ++j)
      for (Index i = 0; i < part.rows(); ++i) sum(coordinates[i], coordinates[j]) += part(i, j);
  };
  add(piece.stiffness, whole.stiffness);
  add(piece.mass, whole.mass);
  add(piece.damping, whole.damping);
  for (std::size_t k = 0; k < 6; ++k) add(piece.inertia_components[k], whole.inertia_components[k]);
}

/// Adds mass, centre and inertia about the centre to those of the sum.
void add_mass_properties(const Superelement& piece, Superelement& whole) {
  const double mass = whole.total_mass + piece.total_mass;
  const Eigen::Vector3d centre = (whole.total_mass * whole.centre + piece.total_mass * piece.centre) / mass;
  const auto moved = [&](const Superelement& body) {
    const Eigen::Vector3d r = body.centre - centre;
    return Eigen::Matrix3d(body.inertia +
                           body.total_mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose()));
  };
  whole.inertia = moved(whole) + Eigen::Matrix3d(moved(piece));
  whole.centre = centre;
  whole.total_mass = mass;
}

}  // namespace

Superelement assembled(const std::vector<Superelement>& pieces) {
  Superelement whole;
  Index modes = 0;
  for (const Superelement& piece : pieces) {
    add_interfaces(piece, whole.interfaces);
    modes += piece.modes();
  }
  const std::map<std::string, Index> first = first_coordinates(whole.interfaces);
  Index directions = 0;
  for (const Interface& interface : whole.interfaces) directions += kept_directions(interface);
  const Index n = directions + modes;
  whole.stiffness = whole.mass = whole.damping = MatrixXd::Zero(n, n);
  whole.inertia_components.fill(MatrixXd::Zero(n, n));
  whole.frequencies.resize(modes);
  whole.effective_mass.resize(modes, 6);
  Index mode = 0;
  for (const Superelement& piece : pieces) {
    add_matrices(piece, coordinates_of(piece, first, directions + mode), whole);
    add_mass_properties(piece, whole);
    whole.frequencies.segment(mode, piece.modes()) = piece.frequencies;
    whole.effective_mass.middleRows(mode, piece.modes()) = piece.effective_mass;
    mode += piece.modes();
  }
  return whole;
}

}  // namespace bielle
