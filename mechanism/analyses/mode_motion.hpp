// Words for the motion of a part in a mode: "fore-aft", "bending about y", "flap".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/analyses/blade_pattern.hpp"

namespace bielle::mechanism {

/// Smallest share of a motion that is named by a word; a more mixed motion has no word.
inline constexpr double mode_share = 0.6;

struct ModeMotion {
  std::string family;   ///< "bending"; may be empty
  std::string motion;   ///< family of the motion with its direction, "bending about y", "fore-aft"; may be empty
  std::string pattern;  ///< pattern of the blades among themselves, or sense of whirl: "collective"; may be empty
  int copies = 1;       ///< number of blades that have patterns
};

class MotionWords {
 public:
  MotionWords(const System& system, const ModesReport& report);
  /// Describes the motion of a group.
  ModeMotion operator()(const ModeGroup& group, std::size_t mode) const;

 private:
  struct Amplitudes;  ///< motions of the nodes in the mode
  bool turns(const ModeGroup& group) const;
  /// Returns the blades if the group is two or more turning entries of one kind around the axis, otherwise nothing.
  std::vector<Blade> blades_of(const ModeGroup& group) const;
  std::optional<Matrix3> standing_axes(const ModeGroup& group) const;
  ModeMotion deformation(const ModeGroup& group, const Amplitudes& amplitudes) const;
  ModeMotion rigid_motion(const ModeGroup& group, const Amplitudes& amplitudes) const;
  std::string about_joint(const ModeGroup& group, const Amplitudes& amplitudes) const;
  std::string pattern_of(const std::vector<Blade>& blades, const ModeGroup& group, const Amplitudes& amplitudes) const;
  std::string whirl(std::size_t mode) const;

  const System& system_;
  const ModesReport& report_;
  const State& state_;
  /// Unit vector of the rotation in the sense of the rotation; zero if nothing rotates.
  Vector3 axis_ = Vector3::Zero();
  bool whirls_ = false;  ///< whether senses of whirl are those that an observer at rest sees
};

}  // namespace bielle::mechanism
