// Two arms of superelements with enough modes to be condensed and to be evaluated by several threads, next to small
// members of all kinds: a rigid body with a carried node, a beam, a spring, joints with springs, loads.
#pragma once

#include <memory>
#include <string>

#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/silent_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bielle::test {

class SuperelementArms {
 public:
  static constexpr int modes = 20;
  SuperelementArms() {
    BeamChain beam = straight_beam({}, modes);
    beam.damping = 1e-4;
    write_superelement(beam.reduced().body, folder_ / "arm.h5");
  }
  mechanism::MechanismFile file() const {
    return mechanism::read_mechanism_text(fmt::format(R"yaml(
gravity: [0, 0, -1]
nodes:
  a: {{position: [0, 0, 0]}}
  b: {{position: [1, 0, 0]}}
  c: {{position: [1, 0, 0]}}
  d: {{position: [2, 0, 0]}}
  e: {{position: [2, 0, 0]}}
  f: {{position: [2.1, 0, 0.1]}}
  tip: {{position: [2.6, 0, 0]}}
elements:
  upper: {{type: superelement, file: {0}, nodes: {{a: a, b: b}}}}
  lower: {{type: superelement, file: {0}, nodes: {{a: c, b: d}}, position: [1, 0, 0]}}
  hand: {{type: rigid_body, node: e, mass: 0.3, inertia: [0.01, 0.02, 0.02], also: [f]}}
  finger: {{type: beam, nodes: [e, tip], elements: 2, section: {{EA: 200, GAy: 200, GAz: 200, GJ: 2, EIy: 2, EIz: 2, mass_per_length: 0.1, Jx: 1e-3, Jy: 1e-3, Jz: 1e-3}}}}
  spring: {{type: spring_damper, nodes: [ground, f], stiffness: 2, damping: 0.1}}
joints:
  shoulder: {{type: hinge, nodes: [ground, a], axis: [0, 1, 0], stiffness: 5, damping: 0.01}}
  elbow: {{type: hinge, nodes: [b, c], axis: [0, 1, 0.1], stiffness: 5, damping: 0.01}}
  wrist: {{type: rigid, nodes: [d, e]}}
loads: {{push: {{node: tip, force: [0.1, "0.1*sin(20*t)", 0.2]}}}}
)yaml",
                                                      folder_ / "arm.h5"),
                                          "arms.yaml");
  }

 private:
  TemporaryFolder folder_;
};

/// The arms with condensed amplitudes, or the same equations with amplitudes that are coupled to a component without
/// forces, which prevents their condensation.
struct ArmsSystem {
  mechanism::MechanismFile file;
  mechanism::System system;
  ArmsSystem(const SuperelementArms& arms, bool condensed)
      : file(condensed ? arms.file() : with_readers(arms.file())), system(file.model) {
    system.set_aside(find_redundant(system, file.model.environment, system.start(0)));
  }

 private:
  static mechanism::MechanismFile with_readers(mechanism::MechanismFile file) {
    using namespace mechanism;
    for (const char* name : {"upper", "lower"}) {
      const Component& body = *file.model.components_of({Section::elements, name})[0];
      const std::string reader = std::string(name) + "_reader";
      file.model.add(std::make_unique<SilentReader>(reader, body), Entry{Section::elements, reader}, Recorded::no);
    }
    return file;
  }
};

}  // namespace bielle::test
