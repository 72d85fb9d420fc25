#include "mechanism/elements/superelement/recovery/recovered_field.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "mechanism/elements/superelement/recovery/stress_invariants.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

struct FieldKind {
  const char* name;
  std::size_t components;
  const char* units;
  const char* description;
};

/// The kinds of fields, in the order of RecoveredField::Kind.
constexpr std::array<FieldKind, 6> field_kinds = {
    {{"displacement", 3, "m", "displacement of the nodes of the superelement's mesh, body axes"},
     {"stress", 6, "Pa", "xx yy zz yz xz xy at the stress nodes of the superelement's file, body axes"},
     {"strain", 6, "-", "xx yy zz and engineering shears yz xz xy at the stress nodes, body axes"},
     {"von_mises", 1, "Pa", "equivalent stress at the stress nodes of the superelement's file"},
     {"principal_stress", 3, "Pa", "s1 >= s2 >= s3 at the stress nodes of the superelement's file"},
     {"principal_strain", 3, "-", "e1 >= e2 >= e3 at the stress nodes of the superelement's file"}}};

Vector6 strain_of(const StressRecovery& stress, int row, const double* s) {
  const auto material = static_cast<std::size_t>(stress.material_of[static_cast<std::size_t>(row)]);
  return stress.compliance[material] * Eigen::Map<const Vector6>(s);
}

}  // namespace

const std::vector<std::string>& RecoveredField::names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const FieldKind& kind : field_kinds) all.emplace_back(kind.name);
    return all;
  }();
  return names;
}

RecoveredField::RecoveredField(const std::string& name) : name_(name) {
  const auto found = std::find(names().begin(), names().end(), name) - names().begin();
  kind_ = static_cast<Kind>(found);
  displacement_ = kind_ == Kind::displacement;
  components_ = field_kinds.at(static_cast<std::size_t>(found)).components;
}

OutputField RecoveredField::description(std::size_t nodes) const {
  const FieldKind& about = field_kinds[static_cast<std::size_t>(kind_)];
  std::vector<std::size_t> shape = {nodes};
  if (components_ > 1) shape.push_back(components_);
  return {name_, std::move(shape), about.units, about.description};
}

void RecoveredField::check(const StressRecovery& stress, const std::string& superelement) const {
  if ((kind_ == Kind::strain || kind_ == Kind::principal_strain) && stress.compliance.empty())
    throw InputError(fmt::format(
        "the superelement '{}' does not say of which material its stress is, which {} takes; reduce it anew",
        superelement, name_));
}

void RecoveredField::derive(const StressRecovery& stress, int row, const double* s, double* values) const {
  switch (kind_) {
    case Kind::displacement:
      break;  // displacements do not follow from stress
    case Kind::stress:
      std::copy_n(s, 6, values);
      break;
    case Kind::strain:
      Eigen::Map<Vector6>(values, 6) = strain_of(stress, row, s);
      break;
    case Kind::von_mises:
      *values = von_mises(s);
      break;
    case Kind::principal_stress:
      Eigen::Map<Vector3>(values, 3) = principal_values(s);
      break;
    case Kind::principal_strain:
      Eigen::Map<Vector3>(values, 3) = principal_values(strain_of(stress, row, s).data(), 0.5);
      break;
  }
}

}  // namespace bielle::mechanism
