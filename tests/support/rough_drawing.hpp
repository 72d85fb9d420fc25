// Roughly drawn mechanisms: every body is displaced and turned from its correct place, in random directions.
#pragma once

#include <string>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "tests/support/random.hpp"

namespace bielle::test {

class RoughDrawing {
 public:
  /// @param displacement  displacement of each body [m] @param turn  its rotation [rad]
  RoughDrawing(unsigned seed, double displacement, double turn)
      : random_(seed), displacement_(displacement), turn_(turn) {}

  /// Adds a body of 1 kg with its node. @param x,R  correct place
  void add_body(const std::string& name, const mechanism::Vector3& x, const mechanism::Matrix3& R) {
    using mechanism::Vector3;
    const Vector3 drawn = x + random_.vector_of_length(displacement_);
    const Vector3 psi = mechanism::log_so3(mechanism::Matrix3(R * mechanism::exp_so3(random_.vector_of_length(turn_))));
    nodes_ +=
        fmt::format("  {}: {{position: [{:.17g}, {:.17g}, {:.17g}], rotation_vector: [{:.17g}, {:.17g}, {:.17g}]}}\n",
                    name, drawn.x(), drawn.y(), drawn.z(), psi.x(), psi.y(), psi.z());
    elements_ +=
        fmt::format("  {}: {{type: rigid_body, node: {}, mass: 1, inertia: [0.01, 0.02, 0.02]}}\n", name, name);
  }
  /// Returns the model file. @param joints  entries, each on a line of its own
  std::string text(const std::string& joints) const {
    return "nodes:\n" + nodes_ + "elements:\n" + elements_ + "joints:\n" + joints;
  }

 private:
  Random random_;
  double displacement_, turn_;
  std::string nodes_, elements_;
};

/// "[x, y, z]"
inline std::string list(const mechanism::Vector3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

}  // namespace bielle::test
