// Compares frequencies and effective masses with those of beams (W. C. Young, Roark's Formulas, table of natural
// frequencies), and sets with each other.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/matrices/common_places.hpp"
#include "reduce/matrices/held_modes.hpp"
#include "reduce/matrices/set_comparison.hpp"
#include "reduce/matrices/superelement_set.hpp"
#include "tests/unit/reduce/matrices/matrix_bodies.hpp"
#include "tests/unit/reduce/matrices/verified.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

/// Returns (beta L)^2 / (2 pi) sqrt(EI / (m L^4)) [Hz] with EI of bending about y of `beam_set`.
double beam_frequency(double beta_L) { return beta_L * beta_L / (2 * M_PI) * std::sqrt(2e4 / (3 * 16)); }

const Finding& finding_of(const VerifiedSubject& subject, const std::string& name) {
  for (const Finding& finding : subject.findings)
    if (finding.check.name == name) return finding;
  throw std::runtime_error("no finding " + name);
}

}  // namespace

TEST_CASE("Free and clamped frequencies are those of the beam") {
  MatrixSet set = test::beam_set(20);
  set.interfaces["root"] = 0;
  const MatrixStudy study = study_matrices(set, 1);
  REQUIRE(study.modes);
  CHECK(signed_frequency(study.modes->eigenvalues(6)) == Approx(beam_frequency(4.730041)).epsilon(1e-5));
  const std::optional<HeldModes> held = held_modes(study, 6);
  REQUIRE(held);
  CHECK(held->held.size() == 6);
  CHECK(signed_frequency(held->modes.eigenvalues(0)) == Approx(beam_frequency(1.875104)).epsilon(1e-5));
  // The first bending mode of a cantilever has 61.31 % of the mass as effective mass.
  CHECK(held->effective_mass(0, 2) / 6 == Approx(0.6131).epsilon(1e-3));
  CHECK(held->effective_mass(0, 0) < 1e-9);
}

TEST_CASE("Effective masses equal those of the reduction of the mesh") {
  const Superelement body = test::reduced(test::twisted_block(), test::steel_body(Tie::rigid, Tie::rigid, 6));
  const MatrixSet set = matrix_set_of(body);
  const std::optional<HeldModes> held = held_modes(study_matrices(set, 1), 6);
  REQUIRE(held);
  CHECK((held->effective_mass - body.effective_mass).cwiseAbs().maxCoeff() < 1e-9 * body.total_mass);
  CHECK(held->whole_mass(4) == Approx(body.inertia(1, 1)).epsilon(1e-9));
}

TEST_CASE("Sparse and dense methods give the same results") {
  const MatrixSet set = test::beam_set(120);  // 726 unknowns
  const MatrixStudy study = study_matrices(set, 1);
  REQUIRE(study.modes);
  CHECK(signed_frequency(study.modes->eigenvalues(6)) == Approx(beam_frequency(4.730041)).epsilon(1e-5));
  MatrixSet declared = set;
  declared.has_units = true;
  CHECK(test::faults_of(declared) == "");
  test::add_to(declared.stiffness, 62, 62, -3 * declared.stiffness.coeff(62, 62));  // node 110 z
  CHECK_THAT(test::faults_of(declared), Contains("the stiffness is not positive") && Contains("node 110 z"));
}

TEST_CASE("A body that is compared with itself has no differences") {
  const VerifiedSubject found = compare(test::beam_set(6), test::beam_set(6));
  for (const Finding& finding : found.findings) {
    INFO(finding.check.name);
    CHECK(finding.check.value < 1e-9);
  }
  CHECK(std::any_of(found.lines.begin(), found.lines.end(), [](const std::string& line) {
    return line.find("cross-orthogonality in the mass, each with its counterpart: 1.0000 1.0000") == 0;
  }));
}

TEST_CASE("A reduced body has the modes of its mesh at common points") {
  const Mesh mesh = test::twisted_block();
  const Superelement body = test::reduced(mesh, test::steel_body(Tie::average, Tie::average, 20));
  const VerifiedSubject found = compare(matrix_set_of(body), test::matrices_of(mesh));
  CHECK(finding_of(found, "against_mass").check.value < 1e-10);
  REQUIRE(body.adequacy);
  CHECK(finding_of(found, "against_first_frequency").check.value == Approx(body.adequacy->mode_error(0)).epsilon(0.02));
  CHECK(finding_of(found, "against_first_shape").check.value < 1e-3);
}

TEST_CASE("Different bodies are distinguished") {
  MatrixSet stiffer = test::beam_set(6);
  stiffer.stiffness *= 1.5;
  stiffer.mass *= 1.01;
  const VerifiedSubject found = compare(stiffer, test::beam_set(6));
  CHECK(finding_of(found, "against_mass").fault == "their masses differ: 6.06 and 6 kg");
  CHECK(finding_of(found, "against_first_frequency").check.value == Approx(std::sqrt(1.5 / 1.01) - 1).epsilon(1e-6));
  CHECK(finding_of(found, "against_first_shape").passed());
}

namespace {

/// Returns the lines of a comparison that list a mode of the first body: "    1    ..".
std::vector<std::string> mode_lines(const VerifiedSubject& found) {
  std::vector<std::string> lines;
  for (const std::string& line : found.lines)
    if (line.size() > 5 && line.substr(0, 4).find_first_not_of(" 0123456789") == std::string::npos &&
        std::isdigit(line[4]))
      lines.push_back(line);
  return lines;
}

/// Returns a beam as a superelement between its ends. Its points on the axis have displacements only.
MatrixSet reduced_beam(double stiffness, double mass) {
  MatrixSet set = test::beam_set(6);
  set.stiffness *= stiffness;
  set.mass *= mass;
  MatrixOptions options;
  options.interfaces = {test::tied("root", {10}), test::tied("tip", {70})};
  return matrix_set_of(test::reduced(set, options));
}

}  // namespace

TEST_CASE("Torsional modes, which move no point on the axis, are paired by rotations") {
  const double stiffer = GENERATE(1.01, 1.3);
  const VerifiedSubject found = compare(reduced_beam(stiffer, 1), reduced_beam(1, 1));
  const std::vector<std::string> lines = mode_lines(found);
  REQUIRE(lines.size() == elastic_modes);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    INFO(lines[k]);
    int mode = 0, other = 0;
    double frequency = 0, counterpart = 0, difference = 0;
    REQUIRE(std::sscanf(lines[k].c_str(), "%d %lf %d %lf %lf", &mode, &frequency, &other, &counterpart, &difference) ==
            5);
    CHECK(other == mode);
    CHECK(difference == Approx(100 * (std::sqrt(stiffer) - 1)).epsilon(2e-3));
  }
}

TEST_CASE("A mode that moves no common point has no counterpart") {
  MatrixSet set = test::beam_set(6), twin = set;
  for (MatrixSet* each : {&set, &twin}) {  // rotations become scalars, whose counterparts are unknown
    int scalars = 0;
    for (NodalUnknown& u : each->unknowns)
      if (u.is_rotation()) u = {-1, scalars++};
  }
  const std::vector<std::string> lines = mode_lines(compare(set, twin));
  REQUIRE(lines.size() == elastic_modes);
  const auto unseen = std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
    return line.find("does not move any common point") != std::string::npos;
  });
  CHECK(unseen > 0);
  CHECK(unseen < elastic_modes / 2);
}

TEST_CASE("Inertias are compared entry by entry about one point") {
  // A displaced body has the same inertia about its own centre, and a different one about the centre of the other body.
  MatrixSet moved = test::beam_set(6);
  moved.positions.row(1).array() += 0.1;
  const VerifiedSubject shifted = compare(moved, test::beam_set(6));
  CHECK_FALSE(finding_of(shifted, "against_centre").passed());
  CHECK_THAT(finding_of(shifted, "against_inertia").fault, Contains("their inertias about (1, 0, 0) m differ: x"));
  // The difference about x is m d^2 = 6 * 0.01 kg m^2. The own moment about x, 2e-4 kg m^2, is not above the limit of
  // 1e-4 of the largest, 2 kg m^2.
  CHECK(finding_of(shifted, "against_inertia").check.value == Approx(0.06 / 2e-4).epsilon(0.02));
  MatrixSet twisted = test::beam_set(6);
  for (Eigen::Index k = 3; k < twisted.size(); k += 6) twisted.mass.coeffRef(k, k) *= 1.5;
  CHECK_THAT(finding_of(compare(twisted, test::beam_set(6)), "against_inertia").fault, Contains("xx is"));
}

TEST_CASE("The MAC in the verdict is that of the shapes on the mesh") {
  const Mesh mesh = test::twisted_block();
  const int modes = GENERATE(2, 8);
  const Superelement body = test::reduced(mesh, test::steel_body(Tie::average, Tie::average, modes));
  REQUIRE(body.adequacy);
  const MatrixSet full = test::matrices_of(mesh), reduced = matrix_set_of(body);
  const MatrixStudy of_full = study_matrices(full, 1), of_reduced = study_matrices(reduced, 1);
  const Eigen::Index count = body.adequacy->mode_mac.size();
  REQUIRE(count >= 3);
  const std::optional<Eigen::MatrixXd> shapes =
      expressed_in(full, reduced, of_reduced.modes->vectors.middleCols(6, count), 1e-6);
  REQUIRE(shapes);
  const Eigen::MatrixXd crossed = shapes->transpose() * (of_full.mass * of_full.modes->vectors.rightCols(20));
  for (Eigen::Index k = 0; k < 3; ++k) {
    // The frequencies of this body differ by more than 1 %, so that each mode has one counterpart.
    const double lacking = 1 - crossed.row(k).cwiseAbs2().maxCoeff(), found = 1 - body.adequacy->mode_mac(k);
    INFO(modes << " modes, shape " << k + 1 << ": true " << lacking << ", found " << found);
    // The part of a shape in the omitted modes follows from a static response, with an error of about lambda /
    // lambda_omitted = 0.15 here. Its mixture with other free modes is less certain (modes 1 and 3 of 8, which differ
    // by 33 %); it affects the last of the four digits that the verdict prints.
    CHECK(std::abs(found - lacking) < 0.15 * lacking + 1e-4);
  }
}
