// Measures of a session by name, whether or not a formula of the model uses them.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::message_of;

namespace {

Session measured_arm() {
  return Session(read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  arm: {position: [0.5, 0, 0]}
  tip.1: {position: [1, 0, 0]}
elements:
  arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1], also: [tip.1]}
  spring: {type: spring_damper, nodes: [ground, tip.1], stiffness: 50, length: 0.5}
joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, -1, 0]}}
inputs: {push: 3}
states: {slow: {filter: main.angle, time_constant: 0.5}}
measures: {twice: 2*main.angle}
)yaml",
                                     "arm.yaml")
                     .model);
}

}  // namespace

TEST_CASE("a session reads measures by name: those of the model, and all that its parts offer") {
  Session session = measured_arm();
  DynamicsOptions options;
  options.duration = 0.3;
  options.stepping.size = 1e-3;
  Motion motion = session.dynamics(options);
  while (motion.step()) {
    CHECK(session.measure("main.angle") == session.read("joints/main/coordinate")[0]);
    CHECK(session.measure("twice") == 2 * session.measure("main.angle"));
  }
  // No formula of the model uses these.
  CHECK(session.measure("main.angle.rate") == session.read("joints/main/rate")[0]);
  CHECK(session.measure("main.reaction.z") == session.read("joints/main/reaction")[2]);
  CHECK(session.measure("spring.elongation") == Approx(session.read("elements/spring/length")[0] - 0.5));
  CHECK(session.measure("tip.1.position.z") == session.node("tip.1").x.z());
  CHECK(session.measure("slow") == session.read("measures/slow")[0]);
  session.set_input("push", 5);
  CHECK(session.measure("push") == 5);
}

TEST_CASE("a measure that is not there is answered with the nearest name") {
  const Session session = measured_arm();
  const auto said = [&](const std::string& name) { return message_of<InputError>([&] { session.measure(name); }); };
  CHECK(said("man.angle") == "there is no measure, joint, node or element 'man'; did you mean 'main'?");
  CHECK(said("main.angel") == "'main' has no 'angel'; did you mean 'angle'?");
  CHECK(said("tip.1.positon.z") == "'tip.1' has no 'positon.z'; did you mean 'position.z'?");
  CHECK(said("twise") == "there is no measure, joint, node or element 'twise'; did you mean 'twice'?");
  CHECK_THAT(said("main"), Catch::StartsWith("'main' alone is no measure; expected one of 'angle'"));
}
