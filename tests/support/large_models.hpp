// Mechanisms of any number of parts, as texts of mechanism files, for measurements and tests of the growth of cost with
// size. Each is one connected system, so that a sparse solver cannot decouple it.
#pragma once

#include <string>
#include <vector>

namespace bielle::test {

struct LargeModel {
  std::string name;            ///< "hinges"
  std::string what;            ///< "rigid links on hinges"
  std::string (*text)(int n);  ///< text of a mechanism of n parts
  bool stands = true;          ///< has an equilibrium where it is drawn
};

/// Returns rigid links of 1 m and 1 kg, horizontal from the ground, each on a hinge with a spring.
std::string hinged_links(int n);
/// Links with a drive in each joint, and a measure of each, named in its section.
std::string driven_links(int n);
/// Masses off their nodes, joined by spherical joints: each node has one direction about which it has no inertia.
std::string masses_on_joints(int n);
/// Returns point masses along a line, joined by prestressed springs.
std::string masses_on_springs(int n);
/// Returns one clamped beam of 100 m, divided into n elements.
std::string beam_of_elements(int n);
/// Returns a ladder of planar four-bars with springs, in whose file all upper joints precede the lower ones: each loop
/// has three redundant constraints.
std::string ladder_of_loops(int n);
/// Links like those of `hinged_links`, each a placed part: a body, a hinge, a spring and a measure. A node of each is
/// merged with the end of the link before it, `link_7.end`.
std::string links_of_parts(int n);

/// Returns all large models.
const std::vector<LargeModel>& large_models();

}  // namespace bielle::test
