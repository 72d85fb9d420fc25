// A drive whose effort is sought acts as one whose force or torque is a constant.
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/system/system.hpp"

using namespace bielle::mechanism;

namespace test_sought_drive {
namespace {

std::string model(const std::string& type, const std::string& law) {
  return fmt::format(
      "nodes:\n  a: {{position: [0.3, 0.1, -0.2], rotation_vector: [0.3, -0.5, 0.8]}}\n"
      "  b: {{position: [1.1, 0.5, 0.4], rotation_vector: [-0.7, 0.2, 0.4]}}\n"
      "joints: {{axle: {{type: {}, nodes: [a, b], position: [0.5, 0.2, 0.1], axis: [1, 2, 3]}}}}\n"
      "drives: {{it: {{joint: axle, {}}}}}\n",
      type, law);
}

}  // namespace

TEST_CASE("a sought effort adds what a constant one adds: forces, derivatives, power") {
  struct Case {
    const char *type, *law;
  };
  for (const Case& each : {Case{"hinge", "torque"}, Case{"prismatic", "force"}, Case{"cylindrical", "force"},
                           Case{"spherical", "coordinate: ry, torque"}}) {
    CAPTURE(each.type);
    const MechanismFile constant =
        read_mechanism_text(model(each.type, fmt::format("{}: 2.5", each.law)), "constant.yaml");
    const MechanismFile sought =
        read_mechanism_text(model(each.type, fmt::format("{}: sought", each.law)), "sought.yaml");
    const System one(constant.model), other(sought.model);
    REQUIRE(one.size() == other.size());
    State state = one.start(0), same = other.start(0);
    REQUIRE(same.memory.size() == state.memory.size() + 1);
    const VectorX dq = 0.1 * VectorX::LinSpaced(one.dofs(), -1, 2), v = VectorX::LinSpaced(one.dofs(), 0.5, -0.3);
    for (auto [system, at] : {std::pair{&one, &state}, std::pair{&other, &same}}) {
      system->displace(*at, State(*at), dq);
      system->set_rates(*at, v, VectorX::Zero(one.dofs()));
    }
    same.memory.tail(1).setConstant(2.5);  // members are numbered in the order of the file: the drive's comes last
    VectorX r(one.size()), r_same(one.size());
    one.residual(state, {}, r);
    other.residual(same, {}, r_same);
    CHECK((r - r_same).lpNorm<Eigen::Infinity>() == 0);
    CHECK(r.lpNorm<Eigen::Infinity>() > 1);
    std::vector<double> K, K_same;
    one.tangent(state, {}, TangentWeights{}, nullptr, K);
    other.tangent(same, {}, TangentWeights{}, nullptr, K_same);
    REQUIRE(K.size() == K_same.size());
    for (std::size_t k = 0; k < K.size(); ++k) CHECK(K[k] == Approx(K_same[k]).margin(1e-15));
    CHECK(one.energy(state, {}).input == Approx(other.energy(same, {}).input).epsilon(1e-14));
    CHECK(one.energy(state, {}).input != 0);
  }
}

}  // namespace test_sought_drive
