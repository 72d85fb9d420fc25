// Stresses of superelements in whole runs: fields, signals at points, and peaks over all steps.
#include <filesystem>
#include <numeric>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/run_analyses.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using Catch::Contains;

namespace {

constexpr int nodes = 40;

/// A beam whose stress is any linear function of its deformation: rigid motions cause none. It has 40 nodes and two
/// volumes that share some.
void write_rod(const std::string& path) {
  std::srand(5);
  Superelement rod = test::straight_beam().reduced().body;
  rod.mesh.points = Eigen::Matrix3Xd::Random(3, nodes);
  rod.stress_recovery = 1e3 * MatrixX::Random(6 * nodes, rod.size()) * rod.stiffness;
  const Eigen::Matrix<double, 6, 6> C = 1e9 * Eigen::Matrix<double, 6, 6>::Identity();
  rod.stress_origin.materials = {{"any", C}};
  for (int k = 0; k < nodes; ++k) {
    rod.stress_nodes.push_back(k);
    rod.stress_origin.material_of.push_back(0);
    if (k < 25) rod.stress_origin.groups["web"].push_back(k);
    if (k > 20) rod.stress_origin.groups["pad 1.5"].push_back(k);
  }
  write_superelement(rod, path);
}

struct Rods {
  test::TemporaryFolder folder;
  Rods() { write_rod(folder / "rod.h5"); }

  /// Two alike swing from pivots and bend.
  std::string text(const std::string& output, const std::string& steps = "step: 5e-4") const {
    const std::string file = folder / "rod.h5";
    return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{tip: {{position: [1, 0, 0]}}}}
elements:
  rod: {{type: superelement, file: "{0}", nodes: {{b: tip}}}}
  other: {{type: superelement, file: "{0}", position: [0, 3, 0]}}
  load: {{type: point_mass, node: tip, mass: 0.3}}
joints:
  pivot: {{type: hinge, nodes: [ground, rod.a], axis: [0, 1, 0]}}
  second: {{type: hinge, nodes: [ground, other.a], axis: [0, 1, 0]}}
output: {{{1}}}
analysis: [{{type: dynamic, duration: 0.05, {2}}}]
)yaml",
                       file, output, steps);
  }
  std::vector<AnalysisSummary> run(const std::string& model, const std::string& name,
                                   const std::string& restart = "") const {
    Progress progress(true);
    return run_analyses(read_mechanism_text(model, "rods.yaml"), folder / name, progress, restart);
  }
  std::string message(const std::string& output) const {
    return test::message_of<InputError>([&] { read_mechanism_text(text(output), "rods.yaml"); });
  }
};

void check_same(const Hdf5File& a, const Hdf5File& b, const std::string& group) {
  REQUIRE(a.names_in(group) == b.names_in(group));
  for (const std::string& name : a.names_in(group)) {
    const std::string object = group + "/" + name;
    INFO(object);
    if (a.is_group(object))
      check_same(a, b, object);
    else
      CHECK(a.read(object) == b.read(object));
  }
}

}  // namespace

TEST_CASE("peaks are the largest of the fields at every step, by volume, also where no field is recorded") {
  const Rods rods;
  for (const std::string steps : {"step: 5e-4", "step: 5e-4, tolerance: 1e-6"}) {
    const std::string peaks = "peaks: {rod: [principal_stress, von_mises]}";
    const auto summary = rods.run(rods.text("fields: {rod: [von_mises, principal_stress]}, " + peaks, steps), "all.h5");
    rods.run(rods.text("every: 9, " + peaks, steps), "few.h5");
    const Hdf5File all = Hdf5File::open(rods.folder / "all.h5"), few = Hdf5File::open(rods.folder / "few.h5");
    check_same(all, few, "/analysis_1/peaks");
    const std::vector<double> time = all.read("/time"), equivalent = all.read("/elements/rod/von_mises"),
                              principal = all.read("/elements/rod/principal_stress");
    REQUIRE(time.size() > 40);  // more than two of the blocks in which steps are looked at
    const std::vector<std::tuple<std::string, int, int>> regions = {
        {"all", 0, nodes}, {"web", 0, 25}, {"pad 1%2E5", 21, nodes}};
    for (const auto& [region, begin, end] : regions) {
      double most = 0, largest = -1e30, least = 1e30, when = 0, node = 0;
      for (std::size_t row = 0; row < time.size(); ++row)
        for (int k = begin; k < end; ++k) {
          const std::size_t place = row * nodes + static_cast<std::size_t>(k);
          if (equivalent[place] > most) {
            most = equivalent[place];
            when = time[row];
            node = k;
          }
          largest = std::max(largest, principal[3 * place]);
          least = std::min(least, principal[3 * place + 2]);
        }
      const std::string group = "/peaks/rod/" + region;
      CHECK(all.read_number(group + "/von_mises/value") == most);
      CHECK(all.read_number(group + "/von_mises/time") == when);
      CHECK(all.read_number(group + "/von_mises/node") == node);
      CHECK(all.read_number(group + "/largest_principal/value") == largest);
      CHECK(all.read_number(group + "/least_principal/value") == least);
      CHECK(all.read_vector(group + "/von_mises/position") ==
            VectorX(read_superelement(rods.folder / "rod.h5").mesh.points.col(static_cast<int>(node))));
    }
    CHECK_THAT(summary[0].text, Contains("largest von Mises stress of 'rod': ") &&
                                    Contains("least principal stress of 'rod' in 'pad 1.5': ") &&
                                    Contains(" Pa at t = "));
    CHECK_FALSE(all.has("/peaks/other"));
  }
}

TEST_CASE("a volume called all has its peaks, whether it is the whole body or a part of it") {
  // Geometries without groups are one volume `all`.
  const Rods rods;
  Superelement rod = read_superelement(rods.folder / "rod.h5");
  std::vector<int> every(nodes);
  std::iota(every.begin(), every.end(), 0);
  const std::string text = rods.text("peaks: {rod: [von_mises]}");
  for (const bool whole : {true, false}) {
    rod.stress_origin.groups = {{"all", whole ? every : std::vector<int>{3, 4, 5}}, {"web", {0, 1, 2, 3}}};
    write_superelement(rod, rods.folder / "rod.h5");
    rods.run(text, "peaks.h5");
    const Hdf5File file = Hdf5File::open(rods.folder / "peaks.h5");
    const std::vector<std::string> regions = file.names_in("/analysis_1/peaks/rod");
    CHECK(regions ==
          (whole ? std::vector<std::string>{"all", "web"} : std::vector<std::string>{"all", "all_volume", "web"}));
    const double largest = file.read_number("/analysis_1/peaks/rod/all/von_mises/value");
    CHECK(largest >= file.read_number("/analysis_1/peaks/rod/web/von_mises/value"));
    if (whole) continue;
    CHECK(largest > file.read_number("/analysis_1/peaks/rod/all_volume/von_mises/value"));
    const double node = file.read_number("/analysis_1/peaks/rod/all_volume/von_mises/node");
    CHECK((node >= 3 && node <= 5));
  }
}

TEST_CASE("peaks of a run that goes on from a checkpoint are those of the run that was not interrupted, to the bit") {
  const Rods rods;
  const std::string text = rods.text("every: 4, checkpoint: 13, peaks: {rod: [von_mises, principal_stress]}");
  rods.run(text, "whole.h5");
  const std::string part = rods.folder / "part.h5";
  std::filesystem::copy_file(rods.folder / "whole.h5", part);
  {
    Hdf5File file = Hdf5File::open_to_extend(part);
    REQUIRE(file.shape("/checkpoints/analysis_1/rows")[0] > 4);
    file.truncate_rows("/checkpoints/analysis_1/rows", 3);
  }
  rods.run(text, "rest.h5", part);
  const Hdf5File whole = Hdf5File::open(rods.folder / "whole.h5"), rest = Hdf5File::open(rods.folder / "rest.h5");
  check_same(whole, rest, "/analysis_1");
  check_same(whole, rest, "/checkpoints/analysis_1");
  // The peaks are not all of the time after the checkpoint: they were carried over.
  CHECK(whole.read_number("/peaks/rod/all/von_mises/value") > 0);
  const std::string other = rods.text("every: 4, checkpoint: 13, peaks: {rod: [von_mises]}");
  CHECK_THAT(test::message_of<InputError>([&] { rods.run(other, "other.h5", part); }),
             Contains("peaks of 'rod' differs"));
}

TEST_CASE("fields and signals of two alike are those of each, and signals those of the fields at their nodes") {
  const Rods rods;
  const Eigen::Matrix3Xd points = read_superelement(rods.folder / "rod.h5").mesh.points;
  const std::string signals = fmt::format("stress_at: {{rod: {{root: [{}, {}, {}]}}, other: {{root: 7}}}}",
                                          points(0, 7), points(1, 7), points(2, 7));
  rods.run(rods.text("fields: {rod: [stress, strain], other: [stress, strain]}, strain_at: {rod: {gauge: 30}, other: "
                     "{gauge: 30}}, " +
                     signals),
           "both.h5");
  rods.run(rods.text("fields: {rod: [stress]}"), "one.h5");
  const Hdf5File both = Hdf5File::open(rods.folder / "both.h5"), one = Hdf5File::open(rods.folder / "one.h5");
  CHECK(both.read("/elements/rod/stress") == one.read("/elements/rod/stress"));
  for (const std::string rod : {"rod", "other"}) {
    const std::string place = "/elements/" + rod;
    const std::vector<double> stress = both.read(place + "/stress"), strain = both.read(place + "/strain"),
                              root = both.read(place + "/stress_at_root"),
                              gauge = both.read(place + "/strain_at_gauge");
    REQUIRE(root.size() == 6 * both.read("/time").size());
    CHECK(std::any_of(root.begin(), root.end(), [](double s) { return std::abs(s) > 1; }));
    for (std::size_t k = 0; k < root.size(); ++k) {
      const std::size_t row = k / 6 * 6 * nodes + k % 6;
      REQUIRE(root[k] == stress[row + 6 * 7]);
      REQUIRE(gauge[k] == strain[row + 6 * 30]);
      REQUIRE(strain[row + 6 * 30] == Approx(stress[row + 6 * 30] / 1e9).margin(1e-300));
    }
    CHECK_THAT(both.read_text_attribute(place, "stress_at_root"), Contains("node 7 at ["));
  }
}

TEST_CASE("peaks of statics go by load factor") {
  const Rods rods;
  std::string text = rods.text("peaks: {rod: [von_mises]}");
  text = text.substr(0, text.find("analysis:")) +
         "loads: {push: {node: tip, force: [5, 0, 0]}}\nanalysis: [{type: static, steps: 4}]\n";
  text.replace(text.find("position: [1, 0, 0]}"), 20, "position: [1, 0, 0], fixed: [z]}");
  text.replace(text.find("gravity: [0, 0, -9.81]"), 22, "gravity: [0, 0, 0]");
  text.replace(text.find("position: [0, 3, 0]"), 19, "position: [0, 3, 0], nodes: {b: wall}");
  text.replace(text.find("nodes: {tip"), 7, "nodes: {wall: {position: [1, 3, 0], fixed: true}, tip: ~}\n#");
  text.replace(text.find("tip: ~}\n#{tip: "), 15, "tip: ");
  const auto summary = rods.run(text, "static.h5");
  const Hdf5File file = Hdf5File::open(rods.folder / "static.h5");
  CHECK(file.read_number("/peaks/rod/all/von_mises/time") == 1);
  CHECK_THAT(summary[0].text, Contains("Pa at load factor 1, at node"));
}

TEST_CASE("wrong requests of stress are refused with file, line and what there is") {
  const Rods rods;
  CHECK_THAT(rods.message("peaks: {rod: [von_mise]}"),
             Contains("rods.yaml:11: output.peaks.rod[1]: 'von_mise'") && Contains("did you mean 'von_mises'?"));
  CHECK_THAT(rods.message("peaks: {rodd: [von_mises]}"), Contains("did you mean 'rod'"));
  CHECK_THAT(rods.message("peaks: {load: [von_mises]}"), Contains("a point_mass has no stresses of a mesh"));
  CHECK_THAT(rods.message("peaks: {rod: []}"), Contains("expected one or more of von_mises, principal_stress"));
  CHECK_THAT(rods.message("peaks: {rod: [von_mises, von_mises]}"), Contains("is asked for twice"));
  CHECK_THAT(rods.message("stress_at: {load: {root: 1}}"), Contains("`stress_at` is for superelements"));
  CHECK_THAT(rods.message("stress_at: {rod: {root: 99}}"), Contains("keeps no stress at node 99 of its mesh"));
  CHECK_THAT(rods.message("stress_at: {rod: {root: [50, 0, 0]}}"),
             Contains("the nearest node where stress is kept is"));
  CHECK_THAT(rods.message("stress_at: {rod: {a/b: 1}}"), Contains("expected a name without '/'"));
  CHECK_THAT(rods.message("stress_at: {rod: {root: [1 kg, 0, 0]}}"),
             Contains("stress_at.rod.root[1]: expected a value in m, found one in 'kg'"));
  CHECK_THAT(rods.message("strain_att: {rod: {root: 1}}"), Contains("did you mean 'strain_at'"));
}
