// A joined wing under a lift that follows its tip: large increments of a load whose tangent is not symmetric. All
// sizes of steps end at the equilibrium to which the path of equilibria leads, followed by arc length.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;

namespace test_joined_wing {
namespace {

std::string beam(const std::string& name, const std::string& nodes, int elements, const std::string& section) {
  const bool front = name != "b5";
  return fmt::format(
      "  {}: {{type: beam, nodes: [{}], elements: {}, orientation: [{}, 0.51305392, 0], section: {{{}}}}}\n", name,
      nodes, elements, front ? -0.85835638 : 0.85835638, section);
}

std::string wing(double lift) {
  return "nodes:\n  p1: {position: [-7.1726, -12, -3.21539], fixed: true}\n"
         "  p2: {position: [-5.37945, -9, -2.41154]}\n  p3: {position: [-3.5863, -6, -1.6077]}\n"
         "  p4: {position: [-1.79315, -3, -0.803848]}\n  p5: {position: [0, 0, 0]}\n"
         "  p6: {position: [7.1726, -12, 3.21539], fixed: true}\nelements:\n" +
         beam("b1", "p1, p2", 10, "EA: 9.505e8, GAy: 3.128e8, GAz: 4.693e7, GJ: 8.660e6, EIy: 6.541e6, EIz: 1.395e8") +
         beam("b2", "p2, p3", 10, "EA: 8.034e8, GAy: 2.648e8, GAz: 3.972e7, GJ: 5.250e6, EIy: 3.921e6, EIz: 8.428e7") +
         beam("b3", "p3, p4", 10, "EA: 6.219e8, GAy: 2.055e8, GAz: 3.082e7, GJ: 2.453e6, EIy: 1.793e6, EIz: 3.911e7") +
         beam("b4", "p4, p5", 10, "EA: 3.899e8, GAy: 1.315e8, GAz: 1.762e7, GJ: 5.204e5, EIy: 3.477e5, EIz: 9.735e6") +
         beam("b5", "p5, p6", 40, "EA: 3.605e8, GAy: 1.315e8, GAz: 6.575e6, GJ: 7.827e4, EIy: 3.593e4, EIz: 7.935e6") +
         fmt::format("loads: {{lift: {{node: p5, force: [0, 0, {}], follower: true}}}}\n", lift);
}

struct Found {
  Vector3 tip;
  StaticsReport report;
};

Found run(double lift, const StaticsOptions& options) {
  const MechanismFile file = read_mechanism_text(wing(lift), "wing.yaml");
  Session session(file.model);
  Found found;
  found.report = compute_statics(session, options);
  found.tip = session.node("p5").x;
  return found;
}

}  // namespace

TEST_CASE("a joined wing under a lift that follows ends at the same equilibrium in any steps") {
  for (const double lift : {5e3, 2e4, 4e4, 7e4}) {
    StaticsOptions path;
    path.steps = 0;
    path.path.emplace();
    path.path->end.load_factor = 1;
    const Found exact = run(lift, path);
    CHECK(exact.report.limit_points.empty());
    for (const int steps : {0, 1, 3, 28}) {
      CAPTURE(lift, steps);
      StaticsOptions options;
      options.steps = steps;
      const Found found = run(lift, options);
      CHECK((found.tip - exact.tip).norm() < 1e-6 * exact.tip.norm());
      CHECK(found.report.log.jumps.empty());
    }
  }
}

}  // namespace test_joined_wing
