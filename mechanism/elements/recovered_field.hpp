// Fields of a whole superelement, recovered from its local coordinates: what `output: {fields: ...}` records.
//
//   displacement  u = T q of every mesh node, body axes [m]
//   stress        sigma = S q at the stress nodes: xx yy zz yz xz xy, body axes [Pa]
//   von_mises     sqrt(((sxx-syy)^2 + (syy-szz)^2 + (szz-sxx)^2)/2 + 3 (syz^2 + sxz^2 + sxy^2)), likewise [Pa]
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/component.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

class RecoveredField {
 public:
  static const std::vector<std::string>& names();  ///< displacement, stress, von_mises

  /// @throws InputError when the superelement holds nothing to recover it from, saying how it would
  RecoveredField(const std::string& name, const Superelement& body);

  const std::string& name() const { return name_; }
  OutputField description() const;
  /// @param q  local coordinates in the file's order; @param values  as many as `description().size()`
  void write(const Eigen::Ref<const VectorX>& q, double* values) const;

 private:
  std::string name_;
  MatrixX recovery_;  ///< rows of three components per node, or six
};

}  // namespace bielle::mechanism
