// Orientations of nodes as measures: their values, rates and sentences. (The laws check their derivatives.)
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/math/rotation_parameters.hpp"
#include "mechanism/session/session.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::error;
using bielle::test::message_of;
using bielle::test::model_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_orientation {

/// Returns a free body with three different moments of inertia, which tumbles. @param more  of the node
std::string tumbling(const std::string& more) {
  return "nodes: {body: {position: [0, 0, 0], angular_velocity: [0.3, 4, 0.2], " + more + R"yaml(}}
elements: {body: {type: rigid_body, node: body, mass: 1, inertia: [1, 2, 2.7]}}
)yaml";
}

Vector3 measured(Session& session, const std::string& quantity, const std::string& components,
                 const std::string& end = "") {
  Vector3 values;
  for (int k = 0; k < 3; ++k) {
    const std::string component(1, components[static_cast<std::size_t>(k)]);
    values[k] = session.measure("body." + quantity + "." + component + end);
  }
  return values;
}

struct Known {
  std::string quantity, components;
  Matrix3 (*rotation)(const Vector3&);
};
const Known known[] = {{"rotation_vector", "xyz", &RotationVector::rotation},
                       {"bryant", "abc", &BryantAngles::rotation},
                       {"euler", "abc", &EulerAngles::rotation}};

TEST_CASE("the orientation of a node is what model files take as such") {
  for (const Known& of : known) {
    CAPTURE(of.quantity);
    Session session(model_of(tumbling(of.quantity + ": [0.4, 0.7, -0.9]")));
    CHECK(error(measured(session, of.quantity, of.components), Vector3(0.4, 0.7, -0.9)) < 1e-15);
  }
}

TEST_CASE("rates of an orientation are those of its angles over time") {
  Session session(model_of(tumbling("bryant: [0.4, 0.7, -0.9]")));
  const double h = 1e-4;
  Motion motion = session.dynamics(steps_of(1, h));
  for (int k = 0; k < 4000; ++k) motion.step();
  for (const Known& of : known) {
    CAPTURE(of.quantity);
    // R is a product of 4000 rotations, each rounded by 2e-16: it is a rotation to 1e-12, and its parameters' is one.
    CHECK(error(of.rotation(measured(session, of.quantity, of.components)), session.node("body").R) < 1e-12);
  }
  Vector3 before[3], rate[3];
  for (int k = 0; k < 3; ++k) before[k] = measured(session, known[k].quantity, known[k].components);
  motion.step();
  for (int k = 0; k < 3; ++k) rate[k] = measured(session, known[k].quantity, known[k].components, ".rate");
  motion.step();
  for (int k = 0; k < 3; ++k) {
    CAPTURE(known[k].quantity);
    const Vector3 slope = (measured(session, known[k].quantity, known[k].components) - before[k]) / (2 * h);
    // The third derivative of angles at 4 rad/s is some 4^3 to 10 4^3: an error of 1e-6 of the central difference.
    CHECK((slope - rate[k]).norm() < 1e-5);
    CHECK(rate[k].norm() > 1);
  }
}

TEST_CASE("at a singularity angles are known, and rates are not") {
  Session session(model_of(tumbling("bryant: [0.4, 0, 0]")));
  CHECK(session.measure("body.bryant.a") == Approx(0.4).epsilon(1e-15));
  Session locked(model_of(tumbling("bryant: [0, 0, 0.4]")));
  CHECK(error(measured(locked, "euler", "abc"), Vector3(0.4, 0, 0)) < 1e-15);
  CHECK_THAT(message_of<ComputationError>([&] { locked.measure("body.euler.a.rate"); }),
             Contains("measure 'body.euler.a.rate'") && Contains("singular at sin b = 0"));
}

TEST_CASE("a wrong component of an orientation is told with the nearest one") {
  Session session(model_of(tumbling("bryant: [0.4, 0, 0]")));
  CHECK_THAT(message_of<InputError>([&] { session.measure("body.bryant.d"); }), Contains("did you mean 'bryant.a'?"));
  CHECK_THAT(message_of<InputError>([&] { session.measure("body.briant.b"); }), Contains("did you mean 'bryant.b'?"));
}

}  // namespace test_orientation
