#include "mechanism/elements/recovered_field.hpp"

#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

double von_mises(const Eigen::Ref<const Vector6>& s) {
  const double normal = (s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) + (s[2] - s[0]) * (s[2] - s[0]);
  return std::sqrt(0.5 * normal + 3 * s.tail<3>().squaredNorm());
}

}  // namespace

const std::vector<std::string>& RecoveredField::names() {
  static const std::vector<std::string> names = {"displacement", "stress", "von_mises"};
  return names;
}

RecoveredField::RecoveredField(const std::string& name, const Superelement& body)
    : name_(name), recovery_(name == "displacement" ? body.displacement_recovery : body.stress_recovery) {
  if (recovery_.rows() == 0)
    throw InputError(
        fmt::format("the superelement '{}' holds nothing to recover {} from; reduce it with `recovery: {{{}: all}}`",
                    body.name, name, name == "displacement" ? "displacement" : "stress"));
}

OutputField RecoveredField::description() const {
  const auto rows = static_cast<std::size_t>(recovery_.rows());
  if (name_ == "displacement")
    return {name_, {rows / 3, 3}, "m", "displacement of the nodes of the superelement's mesh, body axes"};
  if (name_ == "stress")
    return {name_, {rows / 6, 6}, "Pa", "xx yy zz yz xz xy at the stress nodes of the superelement's file, body axes"};
  return {name_, {rows / 6}, "Pa", "equivalent stress at the stress nodes of the superelement's file"};
}

void RecoveredField::write(const Eigen::Ref<const VectorX>& q, double* values) const {
  if (name_ != "von_mises") {
    Eigen::Map<VectorX>(values, recovery_.rows()).noalias() = recovery_ * q;
    return;
  }
  for (Eigen::Index k = 0; k < recovery_.rows() / 6; ++k) values[k] = von_mises(recovery_.middleRows<6>(6 * k) * q);
}

}  // namespace bielle::mechanism
