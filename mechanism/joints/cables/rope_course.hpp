// The pulleys that a rope touches, and how far it winds round them.
//
// The first place and the last are touched always, and so are eyelets (radius 0). A pulley between is touched while the
// rope bends round it. Its wrap, the angle from where the rope comes onto it to where it leaves, is counted over turns.
// The rope leaves the pulley where the wrap has fallen to zero, and runs straight from the place before to the place
// after it. There, a pulley of the radius rho whose centre is at the distance s from the rope, on the inner side, is
//     s - rho
// clear of it; at zero the rope comes onto it, in the sense in which it then bends: that in which it left, or the other
// one where it has been led round the pulley. At both zeros the way along the rim and the straight way are the same, so
// that lengths, forces and energies go on smoothly. Distances are seen along the pulleys' axes; wheels that are offset
// along them are as if in one plane.
#pragma once

#include <span>
#include <vector>

#include "mechanism/joints/cables/rope_span.hpp"

namespace bielle::mechanism {

/// Less than this is rounding: of wraps [rad], and of distances over radii. A rope that just touches a pulley stays as
/// it is.
inline constexpr double just_touching = 1e-9;

/// The places that a rope touches, in order, with the radii that it winds round with their signs.
struct RopeCourse {
  std::vector<int> places;
  std::vector<Pulley> pulleys;
};

/// A RopePlace tells how a rope passes a place between its ends.
struct RopePlace {
  double sense = 1;  ///< +1, -1: touched, the sense in which it is turned; 0: clear of the rope
  double wrap = 0;   ///< touched: the angle, counted [rad]; clear: the sense that it would be turned in, +1 or -1
};

class RopeCourses {
 public:
  /// @param pulleys  all places, the ends included
  explicit RopeCourses(std::vector<Pulley> pulleys) : pulleys_(std::move(pulleys)) {}
  const std::vector<Pulley>& pulleys() const { return pulleys_; }
  int last() const { return static_cast<int>(pulleys_.size()) - 1; }
  /// Whether the rope may leave a place.
  bool may_leave(int place) const {
    return place > 0 && place < last() && pulleys_[static_cast<std::size_t>(place)].radius != 0;
  }
  static bool touches(const RopePlace& place) { return place.sense != 0; }

  /// The course by what each place does. @param places  of all, those of the ends are not looked at
  void get_course(std::span<const RopePlace> places, RopeCourse& course) const;
  /// The wrap at a touched place between the ends, with the turns that bring it nearest to `expected`.
  /// @param at  inertial frames of all pulleys
  double wrap(std::span<const Frame> at, std::span<const RopePlace> places, int place, double expected) const;
  /// How far a clear place is from the rope [m]; negative where the rope would cut through it.
  double clearance(std::span<const Frame> at, std::span<const RopePlace> places, int place) const;
  /// The sense in which a clear place would be turned, after a motion.
  double side(std::span<const Frame> at, std::span<const RopePlace> places, int place) const;
  /// Lets the rope leave the places round which it bends backwards, and come onto those that it cuts through, until
  /// there are none. Wraps become those at this state.
  void settle(std::span<const Frame> at, std::span<RopePlace> places) const;
  /// The places tell how the rope passes them as drawn: it winds by less than one turn round each pulley that it bends
  /// round, and is clear of a pulley that it would bend round backwards.
  /// @param turns  more turns than that, of each place
  /// @throws std::domain_error  where pulleys overlap: which two places
  std::vector<RopePlace> as_drawn(std::span<const Frame> at, const std::vector<int>& turns) const;

 private:
  /// A place relative to the straight rope between the touched places around it.
  struct Offset {
    double s = 0;         ///< of the rope from the centre, along u x z [m]
    double along = 0;     ///< of the centre, from the first tangent point [m]
    double length = 0;    ///< of the straight rope [m]
    double to_end = 0;    ///< of the centre, from the nearer end of that rope [m]
    bool exists = false;  ///< the places around do not overlap
    bool within() const { return exists && along > 0 && along < length; }
  };
  Offset offset(std::span<const Frame> at, std::span<const RopePlace> places, int place) const;
  /// With its sign: that of the rope's sense; of an end as given.
  double radius(std::span<const RopePlace> places, int place) const;
  int neighbour(std::span<const RopePlace> places, int place, int step) const;
  /// Whether pulleys leave no way between them, one of them turned in a sense.
  bool overlap(std::span<const Frame> at, std::span<const RopePlace> places, int place, double sense, int other) const;
  std::vector<Pulley> pulleys_;
};

}  // namespace bielle::mechanism
