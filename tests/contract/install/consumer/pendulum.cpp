// A pendulum in memory, without reading or writing files. mechanism/README.md shows this program.
#include <cstdio>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;

int main() {
  Session session(read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes: {rod: {position: [0.5, 0, 0]}}
elements: {rod: {type: rigid_body, node: rod, mass: 2, inertia: [0, 0.1666667, 0.1666667]}}
joints: {pivot: {type: hinge, nodes: [ground, rod], position: [0, 0, 0], axis: [0, 1, 0]}}
)yaml",
                                      "pendulum")
                      .model);
  session.assemble();

  int steps = 0;
  session.on_step([&](Session& at) {
    ++steps;
    if (at.read("joints/pivot/coordinate")[0] > 3.1) at.stop();  // at the other side
  });
  DynamicsOptions options;
  options.duration = 2;           // [s]
  options.stepping.size = 0.001;  // [s]
  Motion motion = session.dynamics(options);
  motion.advance_to(0.5);
  std::printf("%d steps, angle %.3f rad, tip speed %.3f m/s, kinetic energy %.2f J, gravity %.2f J\n", steps,
              session.read("joints/pivot/coordinate")[0], 2 * session.node("rod").v.norm(), motion.energy().kinetic,
              motion.energy().gravity);

  const std::vector<double> saved = session.save();
  const bool whole = motion.advance_to(1.5);
  const double time = motion.time(), angle = session.read("joints/pivot/coordinate")[0];
  std::printf("%s at the other side after %.3f s\n", whole ? "never" : "stopped", time);
  session.restore(saved);
  motion.advance_to(1.5);
  const bool same = motion.time() == time && session.read("joints/pivot/coordinate")[0] == angle;
  std::printf("restored: %s\n", same ? "the same to the last bit" : "another motion");
}
