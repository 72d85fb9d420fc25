// One beam element: check numbers (tests/references/rigid_motions.py), identities, closed forms. (Exact tangents,
// invariance and power are proven for every element type by tests/laws.)
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/elements/beam/beam_element.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/random.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::error;
using bielle::test::Random;

namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;

int add_node(Model& model, const std::string& name, const Frame& frame) {
  Node node;
  node.name = name;
  node.frame = frame;
  return model.add_node(std::move(node));
}

/// One element between two frames, whose section frames are the node frames turned by R_A, R_B.
struct OneElement {
  Model model;
  std::unique_ptr<DenseModel> dense;
  State state;
  OneElement(const Frame& A, const Frame& B, const Vector6& d0, const BeamSection& section, BeamBending bending,
             double damping = 0, const Matrix3& R_A = Matrix3::Identity(), const Matrix3& R_B = Matrix3::Identity()) {
    const int a = add_node(model, "a", A), b = add_node(model, "b", B);
    model.add(std::make_unique<BeamElement>("shaft", BeamPlace{2, 5}, a, b, R_A, R_B, d0, section, damping, bending),
              Entry{Section::elements, "shaft"}, Recorded::stacked);
    dense = std::make_unique<DenseModel>(model);
    state = dense->start();
  }
  Vector12 force() const { return dense->residual(state).tail<12>(); }  // after the six of `ground`
  MatrixX stiffness() const { return dense->tangent(state, DenseModel::Part::K).bottomRightCorner<12, 12>(); }
};

BeamSection section_of(const Matrix6& stiffness) {
  BeamSection section;
  section.stiffness = stiffness;
  return section;
}

Vector6 check_coordinates() {
  Vector6 d;
  d << 1.1, 0.1, -0.05, 0.2, -0.3, 0.4;
  return d;
}

const Vector6 straight = (Vector6() << 1, 0, 0, 0, 0, 0).finished();
const Matrix6 one_to_six = Vector6(Vector6::LinSpaced(1, 6)).asDiagonal().toDenseMatrix();

}  // namespace

TEST_CASE("a deformed element has the forces that are the derivatives of its energy") {
  const Frame B = exp_se3(check_coordinates());
  const OneElement element({}, B, straight, section_of(one_to_six), BeamBending::constant);
  const bielle::test::ReferenceTable exact("rigid_motions");
  CHECK_THAT(element.dense->energy(element.state).elastic, Catch::WithinAbs(exact("element.energy"), 1e-14));
  Vector12 body = element.force();
  body.segment<3>(6) = B.R.transpose() * body.segment<3>(6);
  Vector12 expected;
  expected << exact.vector("element.first.force"), exact.vector("element.first.moment"),
      exact.vector("element.second.force"), exact.vector("element.second.moment");
  CHECK(error(body, expected) < 1e-10);
  CHECK_THAT(element.stiffness().trace(), Catch::WithinAbs(exact("element.trace"), 1e-10));
}

TEST_CASE("the residual bending flexibility softens the shear of the section") {
  const Frame B = exp_se3(check_coordinates());
  const OneElement element({}, B, straight, section_of(one_to_six), BeamBending::residual);
  // 1/2 + 1/(12*6) and 1/3 + 1/(12*5): shear along y belongs to bending about z, and vice versa.
  Vector6 eps = check_coordinates() - straight;
  Matrix6 C = one_to_six;
  C(1, 1) = 72.0 / 37;
  C(2, 2) = 20.0 / 7;
  // The bending parts of the shear strains, 1/37 and 1/21 of them, stretch the element.
  const double bent = Vector2(eps[1] / 37, eps[2] / 21).squaredNorm(), chord = std::hypot(1 + eps[0], std::sqrt(bent));
  eps[0] = chord + 0.1 * bent / chord - 1;
  CHECK_THAT(element.dense->energy(element.state).elastic, Catch::WithinAbs(0.5 * eps.dot(C * eps), 1e-14));
}

TEST_CASE("the skew part of a beam's stiffness is that of the moments at its nodes") {
  Random random(1);
  for (int k = 0; k < 20; ++k) {
    const Frame A = exp_se3(random.vector(6, 0.5)), B = exp_se3(random.vector(6, 0.5));
    const OneElement element(A, B, straight, section_of(random.positive_matrix(6)), BeamBending::residual, 0,
                             exp_so3(random.vector3(0.5)), exp_so3(random.vector3(0.5)));
    const Vector12 F = element.force();
    MatrixX skew_part = MatrixX::Zero(12, 12);
    skew_part.block<3, 3>(3, 3) = skew(F.segment<3>(3));
    skew_part.block<3, 3>(9, 9) = skew(F.segment<3>(9));
    const MatrixX K = element.stiffness();
    CHECK(error(K - K.transpose(), skew_part) < 1e-13 * K.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("the forces on an element are in equilibrium at any state") {
  Random random(2);
  for (int k = 0; k < 20; ++k) {
    const Frame A = exp_se3(random.vector(6, 0.5)), B = exp_se3(random.vector(6, 0.5));
    const OneElement element(A, B, straight, section_of(random.positive_matrix(6)), BeamBending::residual, 0.3,
                             exp_so3(random.vector3(0.5)), exp_so3(random.vector3(0.5)));
    const Vector12 F = element.force();
    const double size = F.cwiseAbs().maxCoeff();
    CHECK((F.segment<3>(0) + F.segment<3>(6)).norm() < 1e-14 * size);
    const Vector3 moment =
        A.x.cross(F.segment<3>(0)) + A.R * F.segment<3>(3) + B.x.cross(F.segment<3>(6)) + B.R * F.segment<3>(9);
    CHECK(moment.norm() < 2e-14 * size);
  }
}

TEST_CASE("a straight element has the exact stiffness of a Timoshenko beam for any coupled section") {
  // Tip flexibility of a cantilever: a wrench (n, m) at the tip gives the resultants A(s) (n, m), A = [I, 0; (L-s)
  // e_x~, I], and moves the tip by the integral of A^T C^-1 A, a quadratic in s: Simpson's rule is exact.
  Random random(3);
  for (double L : {0.1, 1.0, 7.0}) {
    const Matrix6 C = random.positive_matrix(6);
    const Frame A = exp_se3(random.vector(6));
    const Frame B = A * Frame{{L, 0, 0}, Matrix3::Identity()};
    const OneElement element(A, B, L * straight, section_of(C), BeamBending::residual);
    CHECK(element.force().norm() < 1e-14);
    const auto flexibility = [&](double s) {
      Matrix6 moment_arm = Matrix6::Identity();
      moment_arm.bottomLeftCorner<3, 3>() = skew(Vector3(L - s, 0, 0));
      return Matrix6(moment_arm.transpose() * C.inverse() * moment_arm);
    };
    const Matrix6 F = L / 6 * (flexibility(0) + 4 * flexibility(L / 2) + flexibility(L));
    // Both are in the axes of the section.
    MatrixX turn = MatrixX::Identity(12, 12);
    turn.block<3, 3>(0, 0) = turn.block<3, 3>(6, 6) = A.R.transpose();
    const MatrixX K = turn * element.stiffness() * turn.transpose();
    CHECK(error(K.bottomRightCorner<6, 6>() * F, Matrix6::Identity()) < 1e-12);
    // The other blocks follow from rigid motions and symmetry.
    MatrixX rigid(12, 6);
    rigid << Matrix6::Identity(), Matrix6::Identity();
    rigid.block<3, 3>(6, 3) = -skew(Vector3(L, 0, 0));
    CHECK(error(K * rigid, MatrixX::Zero(12, 6)) < 1e-12 * K.cwiseAbs().maxCoeff());
    CHECK(error(K, K.transpose()) < 1e-14 * K.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("strain and resultants are recorded in the section frame, the physical ones of the middle") {
  Random random(4);
  const Matrix6 C = random.positive_matrix(6);
  const Matrix3 R_A = exp_so3(random.vector3()), R_B = exp_so3(random.vector3());
  const Frame A = exp_se3(random.vector(6));
  const Vector6 eps = 0.1 * random.vector(6);
  const Frame H_B = A * Frame{{0, 0, 0}, R_A} * exp_se3(straight + eps);
  const Frame B = H_B * Frame{{0, 0, 0}, R_B.transpose()};
  for (BeamBending bending : {BeamBending::constant, BeamBending::residual}) {
    const OneElement element(A, B, straight, section_of(C), bending, 0, R_A, R_B);
    Vector12 out;
    Slots slots;
    slots.nodes = {1, 2};
    slots.memories = 3;
    element.model.members()[0].component->write_output({element.state, slots, element.model.environment}, out.data());
    // Constant strain is the element's own law; the residual flexibility subtracts its part from the shears.
    if (bending == BeamBending::constant) CHECK(error(out.head<6>(), eps) < 1e-14);
    CHECK(error(out.tail<6>(), C * out.head<6>()) < 1e-13);
  }
}

TEST_CASE("an element whose ends turn too far refuses with the advice to refine") {
  const auto turned = [](double degrees) { return exp_so3(Vector3(0, 0, degrees * 3.141592653589793 / 180)); };
  OneElement element({}, {{0.1, 0.2, 0}, turned(170)}, straight, section_of(one_to_six), BeamBending::residual);
  Slots slots;
  slots.nodes = {1, 2};
  slots.memories = 3;
  VectorX memory(3);
  const auto accept = [&](double degrees) {
    element.state.nodes[2].R = turned(degrees);
    element.model.members()[0].component->accept({element.state, slots, element.model.environment}, memory);
  };
  element.state.time = 0.25;
  CHECK_NOTHROW(element.force());  // an iteration may come close to it
  CHECK_NOTHROW(accept(170));
  CHECK_THROWS_WITH(accept(175),
                    "t = 0.25 s: beam 'shaft', element 2 of 5: its ends are turned by 175 degrees against each other, "
                    "and one element "
                    "follows up to 171: give the beam more `elements`");
  // The angle goes from 170 over 180 to 190 degrees: the logarithm is -170.
  element.state.memory = memory;
  element.state.nodes[2].R = turned(190);
  CHECK_THROWS_AS(element.force(), bielle::ComputationError);
  CHECK_THROWS_WITH(
      element.stiffness(),
      "t = 0.25 s: beam 'shaft', element 2 of 5: its ends have turned past 180 degrees against each other, and one "
      "element follows up to 171: give the beam more `elements`, or take smaller steps");
  // In statics the load factor is used instead of the time.
  element.dense->environment.statics = true;
  element.dense->environment.load_factor = 0.5;
  CHECK_THROWS_WITH(element.stiffness(), Catch::StartsWith("load factor 0.5: beam 'shaft', element 2 of 5: "));
}
