// Inertia tensors of input files, and the condition that a body can have them. A distribution of positive mass has no
// negative principal moments, and none exceeds the sum of the two others.
#pragma once

#include <string>

#include <Eigen/Core>

#include "reduce/common/input/key_form.hpp"

namespace bielle {

class YamlValue;

/// Returns the forms of an inertia tensor [kg m^2]: three principal values, six entries, or three rows of three.
KeyForms inertia_tensor_forms();

/// @throws InputError when the value is none of these forms, or the three rows are not symmetric
Eigen::Matrix3d read_inertia_tensor(const YamlValue& value);

/// Explains why no body of positive mass has this inertia about its centre of mass, with its principal moments; empty
/// if the inertia is valid. Moments of thin plates and rods are exactly at the bound and are rounded in input files: a
/// violation by 0.1 % is accepted. The moment of a line of mass about itself may be zero.
std::string inertia_fault(const Eigen::Matrix3d& inertia);

}  // namespace bielle
