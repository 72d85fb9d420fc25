// The pulleys that a rope touches, and the angles by which it is wound on them.
//
// The first and the last place are always touched, and so are eyelets (radius 0). A pulley in between is touched as
// long as the rope bends round it. Its wrap, the angle from the point where the rope arrives to the point where it
// leaves, is counted over turns. The rope leaves the pulley when the wrap has decreased to zero, and then runs straight
// from the place before to the place after it. The distance of a pulley of radius rho from the rope, with its centre at
// the distance s on the inner side, is
//     s - rho
// At zero distance the rope touches it. It then bends in the sense in which it left, or in the other one if it has been
// led round the pulley. At both zeros the path along the rim and the straight path are equal, so that lengths, forces
// and energies are continuous. Distances are projected along the pulleys' axes; wheels with an offset along them are
// treated as if in one plane.
#pragma once

#include <span>
#include <vector>

#include "mechanism/joints/cables/rope_span.hpp"

namespace bielle::mechanism {

/// Smaller wraps [rad] and distances relative to radii are rounding errors. A rope that just touches a pulley is not
/// changed.
inline constexpr double just_touching = 1e-9;

/// The places that a rope touches, in order, with signed radii.
struct RopeCourse {
  std::vector<int> places;
  std::vector<Pulley> pulleys;
};

/// State of the rope at a place between its ends.
struct RopePlace {
  double sense = 1;  ///< +1, -1: touched, with this sense of bending; 0: not touched
  double wrap = 0;   ///< touched: wrap angle, counted [rad]; not touched: the sense of bending on contact, +1 or -1
};

class RopeCourses {
 public:
  /// @param pulleys  all places, including the ends
  explicit RopeCourses(std::vector<Pulley> pulleys) : pulleys_(std::move(pulleys)) {}
  const std::vector<Pulley>& pulleys() const { return pulleys_; }
  int last() const { return static_cast<int>(pulleys_.size()) - 1; }
  /// Tells whether the rope may leave a place.
  bool may_leave(int place) const {
    return place > 0 && place < last() && pulleys_[static_cast<std::size_t>(place)].radius != 0;
  }
  static bool touches(const RopePlace& place) { return place.sense != 0; }

  /// Computes the course from the states of the places. @param places  all places; those of the ends are not used
  void get_course(std::span<const RopePlace> places, RopeCourse& course) const;
  /// Returns the wrap at a touched place between the ends, with the turns that bring it closest to `expected`.
  /// @param at  inertial frames of all pulleys
  double wrap(std::span<const Frame> at, std::span<const RopePlace> places, int place, double expected) const;
  /// Returns the distance of an untouched place from the rope [m]; negative if the rope would cut through it.
  double clearance(std::span<const Frame> at, std::span<const RopePlace> places, int place) const;
  /// Returns the sense in which the rope would bend at an untouched place, after a motion.
  double side(std::span<const Frame> at, std::span<const RopePlace> places, int place) const;
  /// Lets the rope leave the places at which it bends backwards, and touch those that it cuts through, until there are
  /// no such places. Wraps are set to their values at this state.
  void settle(std::span<const Frame> at, std::span<RopePlace> places) const;
  /// Returns the initial states of the places, in which the rope is wound by less than one turn on each pulley that it
  /// bends round, and does not touch a pulley that it would bend round backwards.
  /// @param turns  additional turns on each place
  /// @throws std::domain_error naming the two places, if pulleys overlap
  std::vector<RopePlace> as_drawn(std::span<const Frame> at, const std::vector<int>& turns) const;

 private:
  /// Position of a place relative to the straight rope between the neighbouring touched places.
  struct Offset {
    double s = 0;         ///< distance of the rope from the centre, along u x z [m]
    double along = 0;     ///< position of the centre, from the first tangent point [m]
    double length = 0;    ///< length of the straight rope [m]
    double to_end = 0;    ///< distance of the centre from the nearer end of that rope [m]
    bool exists = false;  ///< the neighbouring places do not overlap
    bool within() const { return exists && along > 0 && along < length; }
  };
  Offset offset(std::span<const Frame> at, std::span<const RopePlace> places, int place) const;
  /// Returns the radius of a place with the sign of the rope's sense; at an end, with the given sign.
  double radius(std::span<const RopePlace> places, int place) const;
  int neighbour(std::span<const RopePlace> places, int place, int step) const;
  /// Tells whether pulleys overlap so that no rope fits between them, if one of them is touched in a given sense.
  bool overlap(std::span<const Frame> at, std::span<const RopePlace> places, int place, double sense, int other) const;
  std::vector<Pulley> pulleys_;
};

}  // namespace bielle::mechanism
