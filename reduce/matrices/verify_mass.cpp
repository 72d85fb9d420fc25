#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/matrices/set_mass.hpp"
#include "reduce/matrices/verified_subjects.hpp"
#include "reduce/reduction/rigid_motions.hpp"

namespace bielle::reduce {

namespace {

std::string three(const Eigen::Vector3d& x) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", x.x(), x.y(), x.z()); }

/// Mass properties of other sources are printed with five digits or more, and a sum of lumped masses is that of another
/// mass matrix: 0.1 % is agreement.
constexpr double stated_limit = 1e-3;

void compare_mass(const SetMass& found, const StatedMass& other, const std::string& words, const std::string& prefix,
                  bool with_inertia, VerifiedSubject& subject) {
  const double gyration = std::sqrt(std::max(found.inertia.trace() / 2 / found.mass(), 1e-300));
  add_finding(subject,
              {prefix + "_mass", std::abs(other.mass / found.mass() - 1), stated_limit, "the mass is what " + words},
              fmt::format("the mass matrix has {:.6g} kg, {} {:.6g} kg", found.mass(), words, other.mass));
  add_finding(subject,
              {prefix + "_centre", (other.centre - found.centre).norm() / gyration, stated_limit,
               "the centre of mass is what " + words},
              fmt::format("the mass matrix has its centre at ({}) m, {} ({}) m", three(found.centre), words,
                          three(other.centre)));
  if (!with_inertia) return;
  add_finding(subject,
              {prefix + "_inertia", (other.inertia - found.inertia).norm() / found.inertia.norm(), stated_limit,
               "the inertia is what " + words},
              fmt::format("the inertia about the centre is xx yy zz {} kg m^2 in the mass matrix, {} {} kg m^2",
                          three(found.inertia.diagonal()), words, three(other.inertia.diagonal())));
}

StatedMass sum_of_points(const NodalShapes& shapes) {
  StatedMass sum;
  sum.mass = shapes.masses.sum();
  sum.centre = shapes.points * shapes.masses / sum.mass;
  for (Eigen::Index p = 0; p < shapes.masses.size(); ++p) {
    const Eigen::Matrix3d arm = skew(shapes.points.col(p) - sum.centre);
    sum.inertia -= shapes.masses(p) * arm * arm;
    if (!shapes.inertias.empty()) sum.inertia += shapes.inertias[static_cast<std::size_t>(p)];
  }
  return sum;
}

}  // namespace

VerifiedSubject verify_mass(const MatrixStudy& study) {
  VerifiedSubject subject{"mass", {}, {}};
  if (!study.geometric) {
    subject.lines.push_back("no mass properties, since there are no rigid motions by the positions");
    return subject;
  }
  const SetMass found = mass_of(study);
  const double mass = found.mass();
  const double spread = (found.along.array() - mass).abs().maxCoeff() / std::max(std::abs(mass), 1e-300);
  add_finding(subject,
              {"mass_directions", std::max(spread, found.odd), text_rounding,
               "the mass is that of one rigid body in all directions"},
              spread > found.odd
                  ? fmt::format("the mass differs between directions: along x, y, z {} kg", three(found.along))
                  : "accelerated along x, y or z the mass causes forces across or moments that no rigid body has");
  add_finding(subject, {"mass_positive", mass > 0 ? 0.0 : 1.0, 0, "the mass is positive"},
              fmt::format("the mass is {:.6g} kg", mass));
  if (!(mass > 0)) return subject;
  subject.lines.push_back(fmt::format("mass {:.6g} kg, centre of mass ({}) m", mass, three(found.centre)));
  const auto inertia = [](const Eigen::Matrix3d& J) {
    return fmt::format("xx yy zz {}, xy xz yz {:.6g}, {:.6g}, {:.6g} kg m^2", three(J.diagonal()), J(0, 1), J(0, 2),
                       J(1, 2));
  };
  subject.lines.push_back("inertia about the centre: " + inertia(found.inertia));
  subject.lines.push_back("inertia about the origin: " + inertia(found.at_origin));
  subject.lines.push_back(fmt::format("principal moments: {} kg m^2", three(found.principal())));
  if (study.set.stated) compare_mass(found, *study.set.stated, "the file states", "stated", true, subject);
  if (study.set.shapes && study.set.shapes->masses.size() > 0)
    compare_mass(found, sum_of_points(*study.set.shapes), "the sum of its point masses has", "point_masses",
                 !study.set.shapes->inertias.empty(), subject);
  return subject;
}

}  // namespace bielle::reduce
