#include <numeric>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/stress.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

TEST_CASE("The components of reduced loads have the resultants of the loads") {
  const Mesh mesh = test::box_mesh({{0.4, 0.1, 0.2}, {4, 2, 2}});
  ReductionOptions options = test::steel_body(Tie::average, Tie::rigid, 2);
  LoadRequest pressure{"pressure", "z1", 1e5, {}, {}, "loads.pressure"};
  LoadRequest force{"force", "y0", {}, {}, Eigen::Vector3d(3, -2, 5), ""};
  LoadRequest traction{"traction", "y1", {}, Eigen::Vector3d(100, 200, -50), {}, ""};
  options.loads = {pressure, force, traction};
  const Superelement body = test::reduced(mesh, options);
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  const Eigen::MatrixXd u = rigid_coordinates(body, origin);
  // The work on rigid motions belongs to the pattern that follows the body, the sum of component k along axis k.
  const auto resultant = [&](const std::string& name) {
    const auto& f = body.loads.at(name).force;
    return Eigen::VectorXd((f[0].row(0) + f[1].row(1) + f[2].row(2)) * u);
  };
  const auto expected = [](const Eigen::Vector3d& total, const Eigen::Vector3d& at) {
    Eigen::VectorXd result(6);
    result << total, at.cross(total);
    return result;
  };
  CHECK((resultant("pressure") - expected({0, 0, -1e5 * 0.04}, {0.2, 0.05, 0.2})).norm() < 1e-8);
  CHECK((resultant("force") - expected({3, -2, 5}, {0.2, 0, 0.1})).norm() < 1e-12);
  CHECK((resultant("traction") - expected(Eigen::Vector3d(100, 200, -50) * 0.08, {0.2, 0.1, 0.1})).norm() < 1e-11);
  // Component z of the pressure is turned to act along x.
  const Eigen::VectorXd turned = body.loads.at("pressure").force[2].row(0) * u;
  CHECK((turned - expected({-4000, 0, 0}, {0.2, 0.05, 0.2})).norm() < 1e-8);
}

TEST_CASE("Meaningless loads are refused with their place") {
  const Mesh mesh = test::box_mesh({{0.4, 0.1, 0.2}, {4, 2, 2}});
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid);
  options.loads = {{"p", "z7", 1e5, {}, {}, "loads.p"}};
  CHECK_THROWS_WITH(test::reduced(mesh, options), Contains("loads.p: the mesh has no surface group 'z7'"));
  // The group "cut" is a face between two cells.
  Mesh cut = mesh;
  const auto tet = cut.blocks[0].nodes.col(0);
  for (const auto& [a, b, c, ab, bc, ac] :
       {std::array<int, 6>{0, 1, 2, 4, 5, 6}, {0, 1, 3, 4, 9, 7}, {1, 2, 3, 5, 8, 9}}) {
    Eigen::VectorXi face(6);
    face << tet(a), tet(b), tet(c), tet(ab), tet(bc), tet(ac);
    const Eigen::Matrix3Xd x = cut.points(Eigen::all, face);
    if (((x.colwise() - x.col(0)).rowwise().norm().array() > 1e-9).all()) {  // not on a side of the box
      cut.blocks[1].nodes.conservativeResize(Eigen::NoChange, cut.blocks[1].nodes.cols() + 1);
      cut.blocks[1].nodes.rightCols<1>() = face;
    }
  }
  cut.groups["cut"] = {2, {{CellType::tri6, {static_cast<int>(cut.blocks[1].nodes.cols()) - 1}}}, {}};
  options.loads = {{"p", "cut", 1e5, {}, {}, "loads.p"}};
  CHECK_THROWS_WITH(test::reduced(cut, options), Contains("loads.p: surface 'cut' has faces inside the body"));
}

TEST_CASE("Displacements of the surface are those of the whole mesh at its points") {
  const Mesh mesh = test::twisted_block();
  ReductionOptions options = test::steel_body(Tie::average, Tie::rigid, 3);
  const Superelement whole = test::reduced(mesh, options);
  options.displacement_recovery = RecoveryExtent::surface;
  const Superelement skin = test::reduced(mesh, options);
  REQUIRE(skin.mesh.points.cols() < mesh.point_count());
  CHECK(whole.mesh.points == mesh.points);
  CHECK(skin.mesh.cells.size() == 1);
  CHECK(skin.mesh.cells.count(9) == 1);
  CHECK(skin.stress_recovery == whole.stress_recovery);
  for (std::size_t k = 0; k < whole.stress_nodes.size(); ++k) {
    const int outside = skin.stress_nodes[k], all = whole.stress_nodes[k];
    CHECK(skin.mesh.points.col(outside) == mesh.points.col(all));
    CHECK(skin.displacement_recovery.middleRows<3>(3 * outside) == whole.displacement_recovery.middleRows<3>(3 * all));
  }
  for (const int node : skin.mesh.groups.at("x0")) {
    CHECK(std::abs(skin.mesh.points(0, node) - 0.1 * skin.mesh.points(1, node)) < 0.5);
  }
  options.stress_recovery = RecoveryExtent::all;
  CHECK_THROWS_WITH(test::reduced(mesh, options), Contains("stress: all needs displacement: all"));
  options.displacement_recovery = RecoveryExtent::none;
  options.stress_recovery = RecoveryExtent::none;
  const Superelement bare = test::reduced(mesh, options);
  CHECK(bare.displacement_recovery.size() == 0);
  CHECK(bare.stress_recovery.size() == 0);
  CHECK(bare.stress_nodes.empty());
}

TEST_CASE("A bar pulled at its ends recovers the stress of the closed form") {
  // With Poisson's ratio 0 the rigid ties of the end faces do not constrain the bar. An elongation e causes sigma = E e
  // / L everywhere.
  const Mesh mesh = test::distorted_box_mesh({{0.5, 0.1, 0.1}, {4, 3, 3}}, 0.2);
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid);
  options.materials["steel"] = Material::isotropic(200e9, 0, 7800);
  options.stress_recovery = RecoveryExtent::all;
  const Superelement body = test::reduced(mesh, options);
  REQUIRE(static_cast<Eigen::Index>(body.stress_nodes.size()) == mesh.point_count());
  Eigen::VectorXd q = Eigen::VectorXd::Zero(12);
  q(6) = 1e-4;
  const Eigen::VectorXd stress = body.stress_recovery * q;
  const double expected = 200e9 * 1e-4 / 0.5;
  for (Eigen::Index k = 0; k < mesh.point_count(); ++k) {
    CHECK(stress(6 * k) == Approx(expected).epsilon(1e-9));
    CHECK(stress.segment<5>(6 * k + 1).norm() < 1e-9 * expected);
  }
  CHECK(body.stiffness(6, 6) == Approx(200e9 * 0.01 / 0.5).epsilon(1e-10));
}

TEST_CASE("A node between two materials has the material of its stress, and belongs to the volumes of this material") {
  Mesh mesh = test::box_mesh({{0.4, 0.1, 0.1}, {4, 2, 2}});
  Group soft{3, {{CellType::tet10, {}}}, {}}, hard = soft;
  for (Eigen::Index e = 0; e < mesh.blocks[0].nodes.cols(); ++e) {
    Group& group = mesh.points(0, mesh.blocks[0].nodes.col(e)).maxCoeff() < 0.15 ? soft : hard;
    group.parts[0].cells.push_back(static_cast<int>(e));
  }
  mesh.groups["soft"] = soft;
  mesh.groups["hard"] = hard;
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid);
  options.materials["rubber"] = Material::isotropic(1e7, 0.45, 1000);
  options.regions = {{"soft", "rubber"}, {"hard", "steel"}};
  const StressOrigin origin = test::reduced(mesh, options).stress_origin;
  const Superelement body = test::reduced(mesh, options);
  REQUIRE(origin.materials.size() == 2);
  CHECK(origin.materials[0].name == "rubber");
  CHECK(origin.materials[0].elasticity == options.materials.at("rubber").elasticity);
  std::vector<int> rubber, steel;
  for (int row = 0; row < static_cast<int>(body.stress_nodes.size()); ++row) {
    const double x = mesh.points(0, body.stress_nodes[static_cast<std::size_t>(row)]);
    const int material = origin.material_of[static_cast<std::size_t>(row)];
    if (std::abs(x - 0.1) > 1e-9) {
      CHECK(material == (x < 0.1 ? 0 : 1));
    }
    (material == 0 ? rubber : steel).push_back(row);
  }
  CHECK(origin.groups.at("soft") == rubber);
  CHECK(origin.groups.at("hard") == steel);
  CHECK(origin.groups.count("x0") == 0);  // a surface
}
