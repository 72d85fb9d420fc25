// Measures of contacts: the smallest gap, the forces, the number of touching pairs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/contacts/contact.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

/// "floor.gap", the smallest gap; its gradient is that of the pair and the place with this gap.
class GapMeasure final : public Measure {
 public:
  GapMeasure(std::string name, const Contact& contact) : Measure(std::move(name)), contact_(contact) {}
  std::string units() const override { return "m"; }
  double value(const LocalState& state) const override { return contact_.nearest_of_all(state.of(0)).found.gap; }
  double calc(const LocalState& state, MeasureGradient& gradient) const override;

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&contact_}; }
  const Contact& contact_;
};

/// "floor.force.x", the force on the second shapes of all pairs along an inertial axis, or "floor.force", the sum of
/// the magnitudes of all pairs. It has no derivative at the beginning of contact.
class ContactForceMeasure final : public Measure {
 public:
  /// @param direction  0, 1, 2 for an axis; 3 for the magnitude
  ContactForceMeasure(std::string name, const Contact& contact, int direction)
      : Measure(std::move(name)), contact_(contact), direction_(direction) {}
  std::string units() const override { return "N"; }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;

 private:
  /// Returns the component or magnitude of a force, and the direction of its derivative.
  double part(const Vector3& force, Vector3& along) const;
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&contact_}; }
  const Contact& contact_;
  int direction_;
};

/// "floor.touching": the number of touching pairs, without derivative.
class TouchingMeasure final : public Measure {
 public:
  TouchingMeasure(std::string name, const Contact& contact) : Measure(std::move(name)), contact_(contact) {}
  std::string units() const override { return "-"; }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&contact_}; }
  const Contact& contact_;
};

}  // namespace bielle::mechanism
