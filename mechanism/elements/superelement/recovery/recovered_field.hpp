// A field of a superelement that is recovered from its local coordinates, for `output: {fields: ...}`:
//
//   displacement      u = T q of every mesh node, body axes [m]
//   stress            sigma = S q at the stress nodes: xx yy zz yz xz xy, body axes [Pa]
//   strain            C^-1 sigma with C of the node's material, engineering shears, same order and axes [-]
//   von_mises         equivalent stress [Pa]
//   principal_stress  s1 >= s2 >= s3 [Pa]
//   principal_strain  e1 >= e2 >= e3 [-]
//
// Strain is not stored in the superelement: stress at a node is an average over cells of one material, which equals C
// times the same average of the strain.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/superelement/recovery/stress_recovery.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

class RecoveredField {
 public:
  static const std::vector<std::string>& names();

  /// @param name  one of `names`
  explicit RecoveredField(const std::string& name);

  const std::string& name() const { return name_; }
  bool of_stress() const { return !displacement_; }       ///< derived from stress, not from displacement
  std::size_t components() const { return components_; }  ///< number of components at a node
  OutputField description(std::size_t nodes) const;       ///< describes the field at a number of nodes
  /// @throws InputError if the superelement does not contain the data that the field requires in addition to stress
  void check(const StressRecovery& stress, const std::string& superelement) const;

  /// Computes the field at a node. @param row  index of the node in `stress` @param s  stress there (6) [Pa] @param
  /// values  (components())
  void derive(const StressRecovery& stress, int row, const double* s, double* values) const;

 private:
  enum class Kind { displacement, stress, strain, von_mises, principal_stress, principal_strain };
  std::string name_;
  Kind kind_;
  bool displacement_;
  std::size_t components_;
};

}  // namespace bielle::mechanism
