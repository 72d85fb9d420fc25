// Tests of rigid masses and coatings on a body.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bodies.hpp"
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"
#include "reduce/reduction/missed_modes.hpp"
#include "reduce/reduction/reduce_pieces.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "reduce/reduction/told_masses.hpp"
#include "tests/support/cell_box.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;
using Eigen::Matrix3d, Eigen::Vector3d;

namespace test_added_masses {

MassRequest mass_on(const std::string& group, double mass) {
  MassRequest request;
  request.name = "motor";
  request.group = group;
  request.mass = mass;
  request.subject = "masses.motor";
  return request;
}

MassRequest mass_at(const Vector3d& place, double mass) {
  MassRequest request = mass_on("", mass);
  request.place = place;
  return request;
}

const Matrix3d skew_inertia = (Matrix3d() << 0.3, 0.02, -0.05, 0.02, 0.4, 0.01, -0.05, 0.01, 0.25).finished();

/// Returns a bar of length 1 and Poisson's ratio 0, clamped at x = 0 and guided along x by its other faces.
ReductionOptions rod(int modes) {
  ReductionOptions options;
  options.name = "rod";
  options.materials = {{"cork", Material::isotropic(4e8, 0, 2000)}};
  options.regions = {{"all", "cork"}};
  options.interfaces = {test::interface("root", "x0", Tie::rigid)};
  options.modes.count = modes;
  return options;
}

/// Returns the frequencies of the modes whose effective mass is along x [Hz].
std::vector<double> axial_frequencies(const Superelement& body) {
  std::vector<double> found;
  for (Eigen::Index k = 0; k < body.modes(); ++k)
    if (body.effective_mass(k, 0) > 1e-3 * body.total_mass) found.push_back(body.frequencies(k));
  return found;
}

TEST_CASE("the frequencies of a rod with a mass at its end are the closed form", "[reduction]") {
  // The roots of beta tan beta = mass of the rod / mass at its end give f = beta c / (2 pi L), c = sqrt(E / rho).
  const Mesh mesh = test::cell_box(CellType::hex20, {1, 0.1, 0.1}, {8, 1, 1});
  ReductionOptions options = rod(20);
  options.masses = {mass_on("x1", 2000 * 0.01 * 0.5)};
  const std::vector<double> found = axial_frequencies(test::reduced(mesh, options));
  REQUIRE(found.size() >= 2);
  const double c = std::sqrt(4e8 / 2000.0);
  const double beta[] = {1.076873986, 3.643597167};  // roots of beta tan beta = 2
  for (int k = 0; k < 2; ++k) {
    REQUIRE(std::abs(beta[k] * std::tan(beta[k]) - 2) < 1e-7);
    CHECK(found[static_cast<std::size_t>(k)] ==
          Approx(beta[k] * c / (2 * std::numbers::pi)).epsilon(k == 0 ? 2e-6 : 2e-4));
  }
}

TEST_CASE("the frequencies of a rod with lumped masses are the closed form of the difference scheme", "[reduction]") {
  // n equal elements with half of their mass at each end have f_k = c n / (pi L) sin((2 k - 1) pi / (4 n)).
  constexpr int n = 6;
  const Mesh mesh = test::cell_box(CellType::hex8, {1, 0.1, 0.1}, {n, 1, 1});
  ReductionOptions options = rod(30);
  options.lumped = true;
  const std::vector<double> found = axial_frequencies(test::reduced(mesh, options));
  REQUIRE(found.size() >= 2);
  const double c = std::sqrt(4e8 / 2000.0);
  for (int k = 1; k <= 2; ++k)
    CHECK(found[static_cast<std::size_t>(k - 1)] ==
          Approx(c * n / std::numbers::pi * std::sin((2 * k - 1) * std::numbers::pi / (4 * n))).epsilon(1e-8));
}

TEST_CASE("a mass on the surface of an interface is a rigid body on its node", "[reduction]") {
  // Both models have the same modes, since the interface node is held.
  const Mesh mesh = test::twisted_block();
  ReductionOptions bare = test::steel_body(Tie::rigid, Tie::average, 5), loaded = bare;
  const Vector3d position(0.7, 0.1, -0.2);
  bare.interfaces[1].position = loaded.interfaces[1].position = Vector3d(0.5, 0, 0.1);
  loaded.masses = {mass_on("x1", 30)};
  loaded.masses[0].position = position;
  loaded.masses[0].inertia = skew_inertia;
  const Superelement a = test::reduced(mesh, bare), b = test::reduced(mesh, loaded);
  REQUIRE(a.size() == b.size());
  CHECK((a.frequencies - b.frequencies).norm() < 1e-9 * a.frequencies.norm());

  const Matrix3d arm = skew(Vector3d(position - Vector3d(0.5, 0, 0.1)));
  Eigen::Matrix<double, 6, 6> rigid;  // [m, -m d~; m d~, J - m d~ d~] at the node
  rigid << 30 * Matrix3d::Identity(), -30 * arm, 30 * arm, skew_inertia - 30 * arm * arm;
  Eigen::MatrixXd expected = a.mass;
  expected.block<6, 6>(6, 6) += rigid;
  // The signs of modes may differ, so that boundary coordinates and modes are compared separately.
  const double scale = expected.cwiseAbs().maxCoeff();
  CHECK((b.mass.topLeftCorner<12, 12>() - expected.topLeftCorner<12, 12>()).norm() < 1e-10 * scale);
  CHECK((b.mass.topRightCorner(12, 5).cwiseAbs() - expected.topRightCorner(12, 5).cwiseAbs()).norm() < 1e-7 * scale);
  CHECK((b.stiffness - a.stiffness).norm() < 1e-9 * a.stiffness.norm());

  // S_kl is an integral over elements dm at xi, whose displacement is W_x + theta x xi.
  const Matrix3d second = skew_inertia.trace() / 2 * Matrix3d::Identity() - skew_inertia;
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix<double, 3, 6> along = Eigen::Matrix<double, 3, 6>::Zero();  // rows: displacement per xi
    along.rightCols<3>() = skew(Vector3d::Unit(k));
    Eigen::RowVectorXd centre = Eigen::RowVectorXd::Zero(6);
    centre(k) = 1;
    centre.tail<3>() = -arm.row(k);
    const Eigen::Matrix<double, 6, 6> s = 30 * centre.transpose() * centre + along.transpose() * second * along;
    const Eigen::MatrixXd found =
        b.inertia_components[static_cast<std::size_t>(k)] - a.inertia_components[static_cast<std::size_t>(k)];
    CHECK((found.block<6, 6>(6, 6) - s).norm() < 1e-10 * scale);
  }
}

TEST_CASE("a spinning body with a point mass stiffens as under the load of its centrifugal force", "[reduction]") {
  // The mass is at the node of an interface. K_sigma of the body with the mass is that of the body alone plus that of
  // the force.
  const Mesh mesh = test::box_mesh({{0.6, 0.1, 0.1}, {6, 1, 1}});
  ReductionOptions bare = test::steel_body(Tie::rigid, Tie::average, 0), loaded = bare;
  loaded.masses = {mass_on("x1", 20)};
  const Superelement a = test::reduced(mesh, bare), b = test::reduced(mesh, loaded);
  // The fields of Om_2^2 and Om_3^2 load the mass along x, as the unit load on coordinate 6 does.
  const double force = 20 * (0.6 - b.centre.x());
  for (const std::size_t spin : {1, 2}) {
    const Eigen::MatrixXd change = b.spin_stiffness[spin] - a.spin_stiffness[spin];
    const Eigen::MatrixXd pull = force * a.load_stiffness[6];
    INFO(spin << ": " << change.norm() << " " << pull.norm());
    CHECK((change.block<6, 6>(6, 6) - pull.block<6, 6>(6, 6)).norm() < 1e-8 * pull.norm());
    CHECK((change - pull).norm() < 1e-8 * pull.norm());
  }
}

TEST_CASE("bodies with masses and coatings pass all checks of a reduction, with any ties", "[reduction]") {
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 6);
  switch (GENERATE(0, 1, 2, 3)) {
    case 0:
      break;
    case 1:
      options = test::steel_body(Tie::free, Tie::average, 6);
      break;
    case 2:
      options = test::steel_body(Tie::average, Tie::average, 6);
      options.inertia_relief = true;
      break;
    case 3:
      options.interfaces.pop_back();
      break;
  }
  options.masses = {mass_on("z1", 12), mass_at({0.3, 0.02, 0.1}, 3)};
  options.masses[0].position = Vector3d(0.3, 0.1, 0.4);
  options.masses[0].inertia = skew_inertia;
  options.masses[1].name = "sensor";
  options.coatings = {{"paint", "y0", 200, "masses.paint"}};
  options.lumped = GENERATE(false, true);
  options.modes_proven = true;
  ReductionReport report;
  const Superelement body = test::reduced(test::twisted_block(), options, &report);
  bool counted = false;
  for (const Check& check : report.checks) {
    INFO(check.name << " = " << check.value);
    CHECK(check.passed());
    counted = counted || check.name == "missed_modes";
    if (check.name.ends_with("virial")) CHECK(check.value < 1e-8);
  }
  CHECK(counted);
  CHECK((body.mass - body.inertia_components[0] - body.inertia_components[1] - body.inertia_components[2]).norm() <
        1e-12 * body.mass.norm());
}

TEST_CASE("a mass at a place follows rigid motions exactly, and one at a node follows the node", "[reduction]") {
  const Mesh mesh = test::twisted_block();
  const Solid solid = test::steel_solid(mesh);
  const int node = 40;
  const AddedMasses masses(solid, {mass_at(mesh.points.col(node), 2)}, "block");
  const AddedMass& mass = *masses.begin();
  const Eigen::MatrixXd motion = mass.motion(RowMatrix(rigid_motions(mesh.points, mass.position)));
  CHECK((motion - Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff() < 1e-11);
  RowMatrix alone = RowMatrix::Zero(3 * solid.points(), 1);
  alone(3 * node + 1, 0) = 1;
  CHECK(std::abs(mass.motion(alone)(1, 0) - 1) < 1e-4);
}

TEST_CASE("each piece has the masses that lie in it", "[reduction]") {
  const Mesh mesh = test::box_mesh({{0.8, 0.1, 0.1}, {8, 1, 1}});
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 3);
  options.masses = {mass_at({0.7, 0.05, 0.1}, 4)};
  options.coatings = {{"paint", "z1", 50, "masses.paint"}};
  Progress quiet(true);
  const std::vector<CutPlane> cuts{{"cut_1", {0.4, 0, 0}, {1, 0, 0}, "pieces.planes"}};
  std::vector<Check> checks;
  const CutBody body = reduce_pieces(mesh, cuts, options, {Tie::rigid, true}, quiet, 2, &checks);
  const double half = 7800 * 0.4 * 0.01 + 50 * 0.4 * 0.1;
  CHECK(body.pieces[0].total_mass == Approx(half).epsilon(1e-12));
  CHECK(body.pieces[1].total_mass == Approx(half + 4).epsilon(1e-12));
  for (const Check& check : checks) CHECK(check.passed());

  options.masses = {mass_on("z1", 4)};
  CHECK_THROWS_WITH(reduce_pieces(mesh, cuts, options, {Tie::rigid, false}, quiet, 2),
                    Contains("a mass belongs to one; move the cut, or divide the mass"));
}

TEST_CASE("masses on unknown surfaces, far away or outside of the body are refused", "[reduction]") {
  const Mesh mesh = test::twisted_block();
  const auto refusal = [&](const MassRequest& request) {
    ReductionOptions options = test::steel_body(Tie::rigid, Tie::average);
    options.masses = {request};
    return test::message_of<InputError>([&] { test::reduced(mesh, options); });
  };
  CHECK_THAT(refusal(mass_on("x2", 1)),
             Contains("masses.motor: the mesh has no surface group 'x2'; expected one of 'x0'"));
  CHECK_THAT(refusal(mass_at({5, 0, 0}, 1)), Contains("masses.motor: stands 4.5"));
  MassRequest far = mass_on("z1", 1);
  far.position = Vector3d(300, 0, 0);
  CHECK_THAT(refusal(far), Contains("masses.motor: its position is 3") && Contains("m from its surface"));
  far.group.clear();
  far.place = mesh.points.col(40);
  CHECK_THAT(refusal(far), Contains("m from its place"));
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average);
  options.coatings = {{"paint", "zz", 1, "masses.paint"}};
  CHECK_THAT(test::message_of<InputError>([&] { test::reduced(mesh, options); }),
             Contains("masses.paint: the mesh has no surface group 'zz'"));
}

TEST_CASE("masses so large that the body is lost in rounding are refused", "[reduction]") {
  const Mesh mesh = test::box_mesh({{1, 0.1, 0.1}, {8, 1, 1}});
  const double own = 7800 * 0.01;
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average);
  const auto refusal = [&] { return test::message_of<InputError>([&] { test::reduced(mesh, options); }); };
  for (const double mass : {2e6 * own, 1e300}) {
    options.masses = {mass_at({0.5, 0, 0}, mass)};
    CHECK_THAT(refusal(), Contains("masses.motor: its mass of") && Contains("a million times that of the body, 78 kg"));
  }
  options.masses[0].mass = 1;
  options.masses[0].inertia = 1e300 * Matrix3d::Identity();
  CHECK_THAT(refusal(), Contains("masses.motor: its inertia of 1.5e+300 kg m^2"));
  options.masses.clear();
  options.coatings = {{"paint", "z1", 1e300, "masses.paint"}};
  CHECK_THAT(refusal(), Contains("masses.paint: its mass of 1e+299 kg") && Contains("`per_area` is in kg/m^2"));
  options.coatings[0].mass_per_area = 0.5e6 * own / 0.1;
  options.masses = {mass_at({0.5, 0, 0}, 0.5e6 * own)};
  CHECK(refusal() == "(nothing thrown)");  // below the limits, the checks of the superelement pass
}

TEST_CASE("a place outside of the mesh by more than half a cell gives a warning", "[reduction]") {
  const Mesh mesh = test::box_mesh({{1, 0.1, 0.1}, {8, 1, 1}});  // cells 125 mm long
  const Solid solid = test::steel_solid(mesh);
  const auto told = [&](double z) {
    ReductionOptions options;
    options.masses = {mass_at({0.5, 0.05, z}, 1)};
    return told_masses(solid, AddedMasses(solid, options.masses, "box"), options);
  };
  for (const double z : {-0.06, 0.0, 0.05, 0.1, 0.16}) CHECK(told(z).size() == 1);
  for (const double z : {-0.07, 0.17}) {
    REQUIRE(told(z).size() == 2);
    CHECK_THAT(told(z)[1], Contains("is 70 mm outside of the mesh, whose elements are 125 mm long there"));
  }
}

}  // namespace test_added_masses
