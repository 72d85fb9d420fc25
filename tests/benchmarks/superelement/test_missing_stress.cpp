// The stress of a free bar that spins about its middle, between two interfaces: rho w^2 (L^2 - x^2)/2 in closed form, x
// from the middle, L half the length; the part of it that modes represent, and the message of the run.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/run_analyses.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace {

constexpr double density = 7800, speed = 300, half = 0.5;

void write_bar(const std::string& path, bool relieved) {
  reduce::ReductionOptions options;
  options.name = "bar";
  options.materials = {{"steel", reduce::Material::isotropic(210e9, 0.3, density)}};
  options.regions = {{"all", "steel"}};
  options.modes.count = 16;
  options.inertia_relief = relieved;
  options.damping_ratios = {1};
  options.stress_recovery = reduce::RecoveryExtent::all;
  for (const char* group : {"x0", "x1"}) {
    reduce::InterfaceRequest request;
    request.name = request.group = group;
    options.interfaces.push_back(request);
  }
  Progress quiet(true);
  write_superelement(reduce::reduce_body(box_mesh({{2 * half, 0.04, 0.04}, {24, 1, 1}}), options, quiet, 2), path);
}

struct Spin {
  std::string summary;
  double stress = 0;   ///< along the bar at its middle, at the end
  double missing = 0;  ///< value in the results; 0 if there is none
};

/// @param output  requested output of the run
Spin spin(const TemporaryFolder& folder, const std::string& output) {
  const std::string text = fmt::format(
      "nodes:\n"
      "  a: {{position: [0, 0.02, 0.02], velocity: [0, {1}, 0], angular_velocity: [0, 0, {0}]}}\n"
      "  b: {{position: [1, 0.02, 0.02], velocity: [0, {2}, 0], angular_velocity: [0, 0, {0}]}}\n"
      "elements: {{m: {{type: superelement, file: {3}/bar.h5, nodes: {{x0: a, x1: b}}}}}}\n"
      "analysis: [{{type: dynamic, duration: 2e-3, step: 2e-5}}]\n{4}",
      speed, -speed * half, speed * half, folder.path(), output);
  Spin result;
  Progress quiet(true);
  for (const AnalysisSummary& summary : run_analyses(read_mechanism_text(text, "spin.yaml"), folder / "spin.h5", quiet))
    result.summary += summary.text;
  const Hdf5File file = Hdf5File::open(folder / "spin.h5");
  if (file.has("/analysis_1/elements/m/stress_at_middle")) {
    const Eigen::MatrixXd stress = file.read_matrix("/analysis_1/elements/m/stress_at_middle");
    result.stress = stress(stress.rows() - 1, 0);
  }
  if (file.has("/analysis_1/validity/m/missing_stress"))
    result.missing = file.read_number("/analysis_1/validity/m/missing_stress");
  return result;
}

}  // namespace

TEST_CASE("a spinning bar says how much of its stress its modes lack, and with inertia relief it lacks none") {
  const TemporaryFolder folder;
  const std::string asked = "output: {stress_at: {m: {middle: [0.5, 0.02, 0.02]}}}\n";
  const double exact = density * speed * speed * half * half / 2;
  write_bar(folder / "bar.h5", false);
  const Spin lacking = spin(folder, asked);
  CHECK(lacking.stress == Approx(2.0 / 3 * exact).epsilon(0.01));
  // The mean stress L^2/3 has five sixths of the mean square of (L^2 - x^2)/2, which is 2/15 L^4.
  CHECK(lacking.missing == Approx(std::sqrt(1.0 / 6)).epsilon(0.03));
  CHECK_THAT(lacking.summary, Contains("warning: superelement 'm' lacks about 4") && Contains("% of its stress") &&
                                  Contains("deflect by ") && Contains("inertia_relief: true"));
  CHECK_THAT(spin(folder, "").summary, !Contains("lacks"));  // no stress is requested

  write_bar(folder / "bar.h5", true);
  const Spin whole = spin(folder, asked);
  CHECK(whole.stress == Approx(exact).epsilon(0.01));
  CHECK(whole.missing < 1e-3);
  CHECK_THAT(whole.summary, !Contains("lacks"));
}

TEST_CASE("a file that does not know its answer to accelerations gives no warning") {
  const TemporaryFolder folder;
  write_bar(folder / "bar.h5", false);
  Superelement body = read_superelement(folder / "bar.h5");
  body.inertia_answer = {};
  body.strains.resize(0, 0);
  write_superelement(body, folder / "bar.h5");
  const Spin found = spin(folder, "output: {peaks: {m: [von_mises]}}\n");
  CHECK_THAT(found.summary, !Contains("lacks"));
  CHECK_FALSE(Hdf5File::open(folder / "spin.h5").has("/analysis_1/validity/m/missing_stress"));
}
