#include "mechanism/elements/rigid_body/solid_space.hpp"

#include <cmath>
#include <numbers>

namespace bielle::mechanism {
namespace {

constexpr int cells = 24;  // along each coordinate

double middle_of(int cell) { return (cell + 0.5) / cells; }

/// @param place   three coordinates in 0..1
/// @param weight  weight of a cell: volume per unit of the coordinates
template <class Place, class Weight>
void sample(const Place& place, const Weight& weight, SolidSpace& space) {
  double sum = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k) {
        const Vector3 c(middle_of(i), middle_of(j), middle_of(k));
        space.places.push_back(place(c));
        space.shares.push_back(weight(c));
        sum += space.shares.back();
      }
  for (double& share : space.shares) share /= sum;
}

Vector3 around(double radius, double turns, double height) {
  const double angle = 2 * std::numbers::pi * turns;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

double density_at(const Vector3& x, const std::vector<PlacedSpace>& solids) {
  double density = 0;
  for (const PlacedSpace& solid : solids)
    if (solid.space.contains(solid.frame.R.transpose() * (x - solid.frame.x))) density += solid.density;
  return density;
}

/// Returns the last of the solids before `but` that is cut out at a point; -1: none.
int earlier_cut_at(const Vector3& x, const std::vector<PlacedSpace>& solids, std::size_t but) {
  for (std::size_t k = but; k-- > 0;)
    if (solids[k].density < 0 && solids[k].space.contains(solids[k].frame.R.transpose() * (x - solids[k].frame.x)))
      return static_cast<int>(k);
  return -1;
}

bool later_cut_at(const Vector3& x, const std::vector<PlacedSpace>& solids, std::size_t after) {
  for (std::size_t k = after + 1; k < solids.size(); ++k)
    if (solids[k].density < 0 && solids[k].space.contains(solids[k].frame.R.transpose() * (x - solids[k].frame.x)))
      return true;
  return false;
}

}  // namespace

SolidSpace box_space(const Vector3& edges) {
  SolidSpace space;
  space.contains = [half = Vector3(edges / 2)](const Vector3& x) {
    return (x.cwiseAbs().array() <= half.array()).all();
  };
  sample([&](const Vector3& c) { return Vector3((c.array() - 0.5) * edges.array()); },
         [](const Vector3&) { return 1.0; }, space);
  return space;
}

SolidSpace sphere_space(double radius) {
  SolidSpace space;
  space.contains = [radius](const Vector3& x) { return x.norm() <= radius; };
  const auto place = [&](const Vector3& c) {
    const double r = radius * std::cbrt(c.x()), height = 2 * c.z() - 1;
    return around(r * std::sqrt(1 - height * height), c.y(), r * height);
  };
  sample(
      place, [](const Vector3&) { return 1.0; }, space);
  return space;
}

SolidSpace tube_space(double outer, double inner, double length) {
  SolidSpace space;
  space.contains = [=](const Vector3& x) {
    const double r = x.head<2>().norm();
    return r <= outer && r >= inner && std::abs(x.z()) <= length / 2;
  };
  const auto place = [&](const Vector3& c) {
    return around(std::sqrt(inner * inner + c.x() * (outer * outer - inner * inner)), c.y(), (c.z() - 0.5) * length);
  };
  sample(
      place, [](const Vector3&) { return 1.0; }, space);
  return space;
}

SolidSpace cone_space(double below, double above, double length) {
  SolidSpace space;
  const auto radius_at = [=](double part) { return below + part * (above - below); };
  space.contains = [=](const Vector3& x) {
    const double part = x.z() / length + 0.5;
    return part >= 0 && part <= 1 && x.head<2>().norm() <= radius_at(part);
  };
  const auto place = [&](const Vector3& c) {
    return around(radius_at(c.z()) * std::sqrt(c.x()), c.y(), (c.z() - 0.5) * length);
  };
  sample(
      place, [&](const Vector3& c) { return radius_at(c.z()) * radius_at(c.z()); }, space);
  return space;
}

SolidSpace ring_space(double radius, double section) {
  SolidSpace space;
  space.contains = [=](const Vector3& x) { return std::hypot(x.head<2>().norm() - radius, x.z()) <= section; };
  const auto from_centre_line = [=](const Vector3& c) { return around(section * std::sqrt(c.x()), c.z(), 0); };
  const auto place = [&](const Vector3& c) {
    const Vector3 s = from_centre_line(c);
    return around(radius + s.x(), c.y(), s.y());
  };
  sample(
      place, [&](const Vector3& c) { return radius + from_centre_line(c).x(); }, space);
  return space;
}

std::vector<EmptyCut> empty_cuts(const std::vector<PlacedSpace>& solids) {
  std::vector<EmptyCut> result;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const PlacedSpace& cut = solids[k];
    if (!(cut.density < 0)) continue;
    EmptyCut empty{k, 0, -1};
    for (std::size_t p = 0; p < cut.space.places.size(); ++p) {
      const Vector3 x = cut.frame.x + cut.frame.R * cut.space.places[p];
      if (!(density_at(x, solids) < 1e-6 * cut.density) || later_cut_at(x, solids, k)) continue;
      empty.share += cut.space.shares[p];
      if (empty.other < 0) empty.other = earlier_cut_at(x, solids, k);
    }
    if (empty.share > 0) result.push_back(empty);
  }
  return result;
}

}  // namespace bielle::mechanism
