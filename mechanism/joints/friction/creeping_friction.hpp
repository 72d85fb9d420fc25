// Coulomb's law made smooth at rest (FrictionLaw::Model::coulomb): R = N h(|v|) v. Surfaces never stick: they creep.
#pragma once

#include "mechanism/joints/friction/joint_friction.hpp"

namespace bielle::mechanism {

class CreepingFriction final : public JointFriction {
 public:
  using JointFriction::JointFriction;

 private:
  Resistance resistance(const LocalState& state, const Vector& v) const override;
};

}  // namespace bielle::mechanism
