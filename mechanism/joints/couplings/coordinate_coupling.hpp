// Coupling of coordinates of joints by a weighted sum of them: gears, differentials, rack and pinion.
//
//     e = sum_k f_k c_k,   with displacements c_k, or angles counted over turns
// Coordinates are initially zero. Each is relative to the first node of its joint, so that gears on moving carriers are
// no special case: the wheels have hinges on their carrier, and the ratio of the wheels is that seen from the carrier.
// A force F that resists the growth of e acts on c_k as the generalised force -f_k F, on both nodes of its joint, on
// the carrier as well. (Forces of teeth on bearings: gear_mesh.hpp.) The coupling is rigid, e = 0
// (linear_coupling.hpp), or elastic (elastic_coupling.hpp). Reference: Geradin and Cardona (2001) ch. 7.
#pragma once

#include <string>
#include <vector>

#include "mechanism/joints/couplings/coordinate_named_by.hpp"
#include "mechanism/model/references.hpp"

namespace bielle::mechanism {

class CoordinateCoupling : public Component {
 public:
  using Component::Component;
  /// Adds one term of the sum. @param factor  not zero
  void add_term(const NamedCoordinate& coordinate, double factor);

  /// Output `force`: generalised force on each coordinate.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;

 protected:
  struct Term {
    const Joint* joint;
    std::size_t coordinate;
    double factor;
    int reference;
    const JointCoordinate& description() const { return joint->coordinates()[coordinate]; }
  };
  const std::vector<Term>& terms() const { return terms_; }
  const References& references() const { return references_; }
  std::string sum_text() const;  ///< "-2 'main'.angle + 1 'side'.angle"
  /// Returns the coordinate whose units the sum has: the one with the factor one, or the last.
  const JointCoordinate& unit() const;
  /// Returns F [N m] or [N].
  virtual double force(const LocalState& state) const = 0;

 private:
  std::vector<Term> terms_;
  References references_;
};

}  // namespace bielle::mechanism
