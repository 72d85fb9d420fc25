// Samples: for each component type one or more small models in which the laws are checked.
//
// Adding a type: one Sample in samples_*.cpp. The component under test has the name `it`; the model is a mechanism file
// with the parts that `it` needs. Stiffness, mass and sizes should be of order one (if they are not, set `scales`), so
// that the rounding of one term does not hide another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/io/component_table.hpp"

namespace bielle::laws {

/// A value that must be refused.
struct BadValue {
  std::string key;    ///< key of `it`, nested with dots: "section.young"
  std::string value;  ///< YAML; empty: the key is left out
  std::string says;   ///< must occur in the message besides the key
};

/// Sizes of the random states: positions, rates and unknowns in SI.
struct Scales {
  double length = 1;         ///< [m] deformations go up to `deformation` times this
  double deformation = 0.3;  ///< relative motion of nodes, translations per length and rotations [rad]
  double rate = 1;           ///< [1/s]: velocities length * rate, angular velocities rate, accelerations with rate^2
  double amplitude = 1;      ///< size of second-order scalars
  double first_order = 1;    ///< range of first-order unknowns: random within start +- this
  double multiplier = 1;     ///< [N], [N m]
  /// Forces vary over this share of the scales of length and of a radian (near corners and edges at which the contact
  /// changes). Differences use smaller steps accordingly.
  double smooth_within = 1;
  /// Forces have a kink in the unloaded state: the laws are checked away from it.
  bool kinks_unloaded = false;
};

/// Size of terms that a type omits in its tangents. With w the largest rate [1/s] of a state and M its largest mass,
/// entries may be wrong by K w^2 M in the stiffness and C w M in the damping; at rest nothing may be missing.
struct Neglected {
  double K = 0, C = 0;
};

struct Sample {
  mechanism::Section section;
  std::string type;     ///< name in component_table
  std::string variant;  ///< the particular feature of the sample; may be empty
  std::string model;    ///< text of the mechanism file
  std::vector<BadValue> bad;
  Scales scales{};
  bool inertial = false;      ///< acts along directions fixed in space: rigid motion of the model changes its forces
  bool has_no_power = false;  ///< keeps no account of energy, with the reason in a comment at the sample
  Neglected neglected{};
  std::function<void(const std::string& folder)> files{};  ///< writes files that the model refers to
  std::string place{};  ///< the map that holds `it`, if this is not the section: "hydraulics.lines"
};

const std::vector<Sample>& samples();

// Parts of the list.
std::vector<Sample> element_samples();
std::vector<Sample> joint_samples();
std::vector<Sample> higher_pair_samples();
std::vector<Sample> contact_samples();
std::vector<Sample> coupling_samples();
std::vector<Sample> friction_samples();
std::vector<Sample> drive_samples();
std::vector<Sample> flexible_samples();
std::vector<Sample> state_samples();
std::vector<Sample> hydraulic_samples();

}  // namespace bielle::laws
