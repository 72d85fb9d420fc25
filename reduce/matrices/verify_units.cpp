// The guess of units: three numbers of a body whose sizes are known. The density of the box with the mass and inertia
// of the body lies between 5 kg/m^3 (a hollow frame) and 30000 kg/m^3 (tungsten is at 19300); the length between 1 mm
// and 1 km; the first elastic frequency times the length is a velocity between 0.05 m/s (a whip) and 6000 m/s, about
// that of sound in steel and aluminium.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/matrices/set_mass.hpp"
#include "reduce/matrices/unit_systems.hpp"
#include "reduce/matrices/verified_subjects.hpp"

namespace bielle::reduce {

namespace {

/// Numbers of a body in unknown units; 0: unknown.
struct Sizes {
  double density = 0, length = 0, frequency = 0;
};

/// Decades by which a number is outside a range.
double outside(double x, double least, double most) {
  if (!(x > 0)) return 0;
  return std::max({0.0, std::log10(least / x), std::log10(x / most)});
}

double implausibility(const Sizes& sizes, const UnitSystem& units) {
  const double length = sizes.length * units.length;
  const double density = sizes.density * units.mass / std::pow(units.length, 3);
  return outside(density, 5, 3e4) + outside(length, 1e-3, 1e3) +
         outside(sizes.frequency / units.time * length, 0.05, 6e3);
}

/// Returns the distance of the density from that of usual parts, half filled with metal, among systems that are equally
/// plausible.
double unlikelihood(const Sizes& sizes, const UnitSystem& units) {
  if (!(sizes.density > 0)) return 0;
  return std::abs(std::log10(sizes.density * units.mass / std::pow(units.length, 3) / 3000));
}

}  // namespace

VerifiedSubject verify_units(const MatrixStudy& study) {
  VerifiedSubject subject{"units", {}, {}};
  if (study.set.has_units || !study.geometric) return subject;
  const SetMass mass = mass_of(study);
  if (!(mass.mass() > 0)) return subject;
  Eigen::Vector3d box = mass.box();
  box = Eigen::Vector3d(box.cwiseMax(0.02 * box.maxCoeff()));  // a line of masses has no width
  Sizes sizes{mass.mass() / box.prod(), std::max(study.length, box.maxCoeff()), 0};
  if (!std::isfinite(sizes.density)) sizes.density = 0;
  if (study.modes && study.modes->eigenvalues.size() > 6)
    sizes.frequency = std::max(0.0, signed_frequency(study.modes->eigenvalues(6)));
  const double found = implausibility(sizes, unit_systems[0]);
  const auto* likely = std::min_element(unit_systems.begin(), unit_systems.end(), [&](const auto& a, const auto& b) {
    const double ia = implausibility(sizes, a), ib = implausibility(sizes, b);
    return ia != ib ? ia < ib : unlikelihood(sizes, a) < unlikelihood(sizes, b);
  });
  const bool certain = found > 0 && likely != unit_systems.begin();
  add_finding(
      subject, {"units", certain ? found : 0.0, 0, "the numbers are plausible in metres, kilograms and seconds"},
      fmt::format("the file declares no units, and in SI units the body would be {0:.3g} m long with a density of "
                  "{1:.3g} kg/m^3 and a first elastic frequency of {2:.3g} Hz; its units are probably {3}: "
                  "`--units {3}`, or `units: {3}` in a body file, converts them",
                  sizes.length, sizes.density, sizes.frequency, likely->name));
  if (!certain)
    subject.lines.emplace_back("the file declares no units: its numbers are taken as metres, kilograms and seconds");
  return subject;
}

}  // namespace bielle::reduce
