// Quantities that follow from stress at a node, and products of many frames at once.
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/elements/superelement/recovery/recovered_outputs.hpp"
#include "mechanism/elements/superelement/recovery/stress_invariants.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using Catch::Contains;

namespace {

Vector6 components(const Matrix3& s) { return {s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(0, 2), s(0, 1)}; }

Matrix6 isotropic(double young, double poisson) {
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
  Matrix6 C = Matrix6::Zero();
  C.topLeftCorner<3, 3>().setConstant(lambda);
  C.topLeftCorner<3, 3>().diagonal().array() += 2 * shear;
  C.bottomRightCorner<3, 3>().diagonal().setConstant(shear);
  return C;
}

/// Returns a body with arbitrary matrices: displacement of five nodes, stress at four of them of two materials, two
/// volumes.
Superelement sample(int coordinates = 7) {
  std::srand(11);
  Superelement body;
  body.name = "sample";
  body.mesh.points = Eigen::Matrix3Xd::Random(3, 5);
  body.displacement_recovery = MatrixX::Random(15, coordinates);
  body.stress_nodes = {4, 0, 1, 3};
  body.stress_recovery = 1e6 * MatrixX::Random(24, coordinates);
  body.stress_origin.materials = {{"steel", isotropic(2e11, 0.3)}, {"rubber", isotropic(1e7, 0.49)}};
  body.stress_origin.material_of = {0, 1, 1, 0};
  body.stress_origin.groups = {{"hub", {0, 3}}, {"pad", {1, 2}}};
  return body;
}

/// Returns the rows of all outputs, frame by frame, written together.
std::vector<std::vector<double>> written(const RecoveredOutputs& outputs, const MatrixX& q, std::size_t begin = 0) {
  std::size_t size = begin;
  for (const OutputField& field : outputs.descriptions()) size += field.size();
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(q.cols()), std::vector<double>(size, -1));
  std::vector<double*> places;
  FrameBlock block;
  block.reset(q.rows(), static_cast<int>(q.cols()));
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    block.set(static_cast<int>(k), q.col(k).data());
    places.push_back(rows[static_cast<std::size_t>(k)].data());
  }
  outputs.write(block, places, begin);
  return rows;
}

}  // namespace

TEST_CASE("principal values are those of a tensor turned anyhow, the largest first") {
  // Three, two and no different ones: tension and pressure from all sides are the cases in which formulas lose digits.
  const std::vector<Vector3> triples = {{7, 2, -5}, {3, 0, 0}, {0, 0, -3}, {-4, -4, -4}};
  for (const Vector3& principal : triples)
    for (const double angle : {0.0, 0.3, 2.0}) {
      const Matrix3 R = Eigen::AngleAxisd(angle, Vector3(1, -2, 2) / 3).toRotationMatrix();
      const Vector6 s = components(R * principal.asDiagonal() * R.transpose());
      CHECK((principal_values(s.data()) - principal).norm() < 2e-15 * 7);
    }
  const Vector6 pure_shear(0, 0, 0, 0, 0, 5);
  CHECK((principal_values(pure_shear.data()) - Vector3(5, 0, -5)).norm() < 1e-14);
  CHECK((principal_values(pure_shear.data(), 0.5) - Vector3(2.5, 0, -2.5)).norm() < 1e-14);
  CHECK(von_mises(pure_shear.data()) == Approx(5 * std::sqrt(3.0)).epsilon(1e-15));
}

TEST_CASE("fields follow from displacement and stress recovery, and strain from the material of each node") {
  const Superelement body = sample();
  RecoveredOutputs outputs;
  for (const std::string& name : RecoveredField::names()) outputs.add_field(name, body);
  const MatrixX q = MatrixX::Random(7, 3);
  constexpr std::size_t before = 5;
  const auto rows = written(outputs, q, before);
  for (Eigen::Index frame = 0; frame < q.cols(); ++frame) {
    const std::vector<double>& row = rows[static_cast<std::size_t>(frame)];
    CHECK(row[before - 1] == -1);  // the values of the others do not change
    const VectorX u = body.displacement_recovery * q.col(frame), s = body.stress_recovery * q.col(frame);
    const double* at = row.data() + before;
    CHECK((Eigen::Map<const VectorX>(at, 15) - u).norm() < 1e-15 * 7 * u.norm());
    const double *stress = at + 15, *strain = stress + 24, *equivalent = strain + 24, *principal = equivalent + 4,
                 *principal_strain = principal + 12;
    CHECK((Eigen::Map<const VectorX>(stress, 24) - s).norm() < 1e-15 * 7 * s.norm());
    for (int k = 0; k < 4; ++k) {
      const auto material = static_cast<std::size_t>(body.stress_origin.material_of[static_cast<std::size_t>(k)]);
      const Matrix6& C = body.stress_origin.materials[material].elasticity;
      const Vector6 sigma = s.segment<6>(6 * k), eps = Eigen::Map<const Vector6>(strain + 6 * k);
      CHECK((C * eps - sigma).norm() < 1e-13 * sigma.norm());
      CHECK(equivalent[k] == Approx(von_mises(sigma.data())).epsilon(1e-13));
      // Principal values belong to the tensors: trace and determinant.
      const Eigen::Map<const Vector3> p(principal + 3 * k), e(principal_strain + 3 * k);
      Matrix3 tensor;
      tensor << sigma[0], sigma[5], sigma[4], sigma[5], sigma[1], sigma[3], sigma[4], sigma[3], sigma[2];
      CHECK(p.sum() == Approx(tensor.trace()).margin(1e-13 * sigma.norm()));
      CHECK(p.prod() == Approx(tensor.determinant()).margin(1e-12 * std::pow(sigma.norm(), 3)));
      CHECK(p[0] >= p[1]);
      CHECK(p[1] >= p[2]);
      tensor << eps[0], eps[5] / 2, eps[4] / 2, eps[5] / 2, eps[1], eps[3] / 2, eps[4] / 2, eps[3] / 2, eps[2];
      CHECK(e.sum() == Approx(tensor.trace()).margin(1e-13 * eps.norm()));
      CHECK(e.squaredNorm() == Approx(tensor.squaredNorm()).epsilon(1e-12));
    }
  }
}

TEST_CASE("a frame has the same bits alone and among others, whatever the number of rows") {
  for (const int nodes : {1, 5, 16, 17, 300}) {
    Superelement body = sample(33);
    body.mesh.points = Eigen::Matrix3Xd::Random(3, nodes);
    body.displacement_recovery = MatrixX::Random(3 * nodes, 33);
    body.stress_recovery = MatrixX::Random(6 * nodes, 33);
    body.stress_nodes.resize(static_cast<std::size_t>(nodes));
    std::iota(body.stress_nodes.begin(), body.stress_nodes.end(), 0);
    body.stress_origin = {};
    RecoveredOutputs outputs;
    outputs.add_field("displacement", body);
    outputs.add_field("principal_stress", body);
    const MatrixX q = MatrixX::Random(33, 19);
    const auto together = written(outputs, q);
    for (Eigen::Index k = 0; k < q.cols(); ++k)
      CHECK(written(outputs, q.col(k)).front() == together[static_cast<std::size_t>(k)]);
  }
}

TEST_CASE("points are the nearest stress nodes, or nodes by number") {
  Superelement body = sample();
  body.mesh.points << 0, 1, 0, 0, 1,  //
      0, 0, 1, 0, 1,                  //
      0, 0, 0, 1, 0;
  RecoveredOutputs outputs;
  outputs.add_field("stress", body);
  outputs.add_field("strain", body);
  outputs.add_point("stress", "corner", {{}, Vector3(1.1, 0.9, 0.2)}, body);
  outputs.add_point("strain", "top", {3, {}}, body);
  const std::vector<OutputField>& fields = outputs.descriptions();
  CHECK(fields[2].name == "stress_at_corner");
  CHECK(fields[2].shape == std::vector<std::size_t>{6});
  CHECK_THAT(outputs.facts()[0].second, Contains("node 4 at [1, 1, 0] m"));
  const std::vector<double> row = written(outputs, MatrixX::Random(7, 1)).front();
  CHECK(std::equal(row.begin() + 48, row.begin() + 54, row.begin()));            // node 4 is the first
  CHECK(std::equal(row.begin() + 54, row.begin() + 60, row.begin() + 24 + 18));  // node 3 the last
  const auto why = [&](const MeshPlace& place) {
    return test::message_of<InputError>([&] { outputs.add_point("stress", "x", place, body); });
  };
  CHECK_THAT(why({{}, Vector3(0, 20, 0)}), Contains("the nearest node where stress is kept is 19"));
  CHECK_THAT(why({2, {}}), Contains("keeps no stress at node 2 of its mesh"));
}

TEST_CASE("what a superelement does not hold is refused with what would help") {
  Superelement body = sample();
  body.stress_origin = {};
  const auto why = [&](const std::string& field) {
    return test::message_of<InputError>([&] { RecoveredOutputs().add_field(field, body); });
  };
  CHECK_THAT(why("principal_strain"),
             Contains("does not say of which material its stress is") && Contains("reduce it"));
  CHECK(why("principal_stress") == "(nothing thrown)");
  body.stress_recovery.resize(0, 7);
  body.displacement_recovery.resize(0, 7);
  CHECK_THAT(why("von_mises"), Contains("`recovery: {stress: surface}`"));
  CHECK_THAT(why("displacement"), Contains("`recovery: {displacement: all}`"));
}
