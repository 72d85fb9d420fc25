// Loads per length on beams against closed forms. (Exact tangents, invariance and power are proven by tests/laws.)
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "tests/support/dense_solution.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/random.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using bielle::test::Random;
using bielle::test::StaticModel;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Returns a cantilever of length 2 along x: EIz = 3, GAy = 50, GJ = 2.
std::string cantilever(int elements, const std::string& load) {
  return "nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: [2, 0, 0]}}\n"
         "elements: {b: {type: beam, nodes: [root, tip], elements: " +
         std::to_string(elements) +
         ", orientation: [0, 1, 0], section: {EA: 1e3, GAy: 50, GAz: 40, GJ: 2, EIy: 5, EIz: 3}, distributed: " + load +
         "}}\n";
}

/// Returns the linear displacements of the tip: load at the reference, stiffness of the unloaded beam.
Vector6 linear_tip(const std::string& yaml) {
  StaticModel beam(yaml);
  const VectorX r = beam.dense.residual(beam.state)(beam.free);
  beam.dense.environment.load_factor = 0;
  return -bielle::test::solution(beam.stiffness(), r).head<6>();
}

/// Returns the sum of the forces of a model's loads and their moment about the origin, at its start.
Vector6 resultant(const std::string& yaml) {
  const auto model = model_from_text(yaml);
  const DenseModel dense(*model);
  const State state = dense.start();
  const VectorX r = dense.residual(state);
  Vector6 sum = Vector6::Zero();
  for (int k = 0; k < dense.nodes(); ++k) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(k)];
    sum.head<3>() -= r.segment<3>(6 * k);
    sum.tail<3>() -= node.x.cross(r.segment<3>(6 * k)) + node.R * r.segment<3>(6 * k + 3);
  }
  return sum;
}

}  // namespace

TEST_CASE("a uniform force gives the exact deflection of a cantilever, whatever the number of elements") {
  const double q = 1e-3, L = 2, EI = 3, GA = 50;
  for (int elements : {1, 3}) {
    const Vector6 tip = linear_tip(cantilever(elements, "{force: [2e-3, 1e-3, 0]}"));
    CHECK_THAT(tip[0], WithinRel(2e-3 * L * L / 2 / 1e3, 1e-12));
    CHECK_THAT(tip[1], WithinRel(q * (std::pow(L, 4) / 8 / EI + L * L / 2 / GA), 1e-12));
    CHECK_THAT(tip[5], WithinRel(q * L * L * L / 6 / EI, 1e-12));
  }
}

TEST_CASE("a force that grows along the beam converges with the fourth power of the element length") {
  // q = s: w = 11 L^4/(120 EI) + L^2/(3 GA).
  const double L = 2, EI = 3, GA = 50, exact = 11 * std::pow(L, 4) / 120 / EI + L * L / 3 / GA;
  std::vector<double> errors;
  for (int elements : {1, 2, 4, 8})
    errors.push_back(std::abs(linear_tip(cantilever(elements, "{force: [0, s, 0]}"))[1] / exact - 1));
  CAPTURE(errors);
  for (std::size_t k = 1; k < errors.size(); ++k)
    CHECK((errors[k] < 1e-13 || std::log2(errors[k - 1] / errors[k]) > 3.9));
}

TEST_CASE("the recorded resultant of loads per length is that of their forces on the nodes") {
  for (const char* load :
       {"{force: [1, 2, s], at: [0.1, 0.2]}", "{force: [1, -2, 's^2'], at: [0.1, 0.2], follower: true}",
        "{moment: [s, 1, 2], follower: true}", "{force: [0, 3, 0], moment: [1, s, 2]}"}) {
    CAPTURE(load);
    const auto model = model_from_text(cantilever(2, load));
    DenseModel dense(*model);
    State state = dense.start();
    Random random(3);
    dense.move(state, random.vector(dense.size(), 0.4));
    VectorX forces = -dense.residual(state);
    dense.environment.load_factor = 0;
    forces += dense.residual(state);
    dense.environment.load_factor = 1;
    Vector6 expected = Vector6::Zero(), recorded = Vector6::Zero();
    for (int k = 0; k < dense.nodes(); ++k) {
      const NodeState& node = state.nodes[static_cast<std::size_t>(k)];
      expected.head<3>() += forces.segment<3>(6 * k);
      expected.tail<3>() += node.x.cross(forces.segment<3>(6 * k)) + node.R * forces.segment<3>(6 * k + 3);
    }
    for (const auto& member : model->members()) {
      if (member.component->output_fields().front().name != "distributed_force") continue;
      Declaration declaration;
      member.component->declare(declaration);
      Slots slots;
      slots.nodes = declaration.nodes;
      Vector6 out;
      member.component->write_output({state, slots, dense.environment}, out.data());
      recorded += out;
    }
    CHECK((recorded - expected).norm() < 1e-12 * expected.norm());
  }
}

TEST_CASE("moments per length twist and bend a cantilever") {
  const double m = 1e-3, L = 2;
  for (int elements : {1, 3})
    CHECK_THAT(linear_tip(cantilever(elements, "{moment: [1e-3, 0, 0]}"))[3], WithinRel(m * L * L / 2 / 2, 1e-12));
  std::vector<double> errors;
  for (int elements : {2, 4, 8, 16})
    errors.push_back(
        std::abs(linear_tip(cantilever(elements, "{moment: [0, 0, 1e-3]}"))[1] / (m * L * L * L / 3 / 3) - 1));
  CAPTURE(errors);
  for (std::size_t k = 1; k < errors.size(); ++k) CHECK_THAT(std::log2(errors[k - 1] / errors[k]), WithinAbs(2, 0.05));
}

TEST_CASE("the weight of a beam and an equal force per length are the same at any state") {
  const auto yaml = [](const std::string& gravity, const std::string& load) {
    return "gravity: " + gravity +
           "\nnodes: {a: {position: [0, 0, 0], rotation_vector: [1, 0, 2]}, b: {position: [2, 0.3, 0]}}\n"
           "elements: {b: {type: beam, nodes: [a, b], elements: 2, arc_through: [1, 1, 0.5], section: {EA: 10, GAy: 5, "
           "GAz: 4, GJ: 2, EIy: 5, EIz: 3, mass_per_length: 1.5, Jx: 0.2, Jy: 0.1, Jz: 0.1}" +
           load + "}}\n";
  };
  const auto heavy = model_from_text(yaml("[1, -2, 3]", ""));
  const auto loaded = model_from_text(yaml("[0, 0, 0]", ", distributed: {force: [1.5, -3, 4.5]}"));
  const DenseModel weight(*heavy), load(*loaded);
  Random random(5);
  State state = weight.start();
  weight.move(state, 0.5 * random.vector(weight.size()));
  // The inertia contains an additional mass without weight (beam_inertia.hpp), which has no effect at rest.
  CHECK((weight.residual(state) - load.residual(state)).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("forces beside the line and jumps along the beam have the right resultant") {
  // 2 N/m along y over the first 0.3 of the length 2, at z = 0.5 of the section (section axes are the inertial ones).
  const Vector6 sum = resultant(cantilever(2, "{force: [0, 'if(s < 0.3, 2, 0)', 0], at: [0, 0.5]}"));
  CHECK((sum.head<3>() - Vector3(0, 1.2, 0)).norm() < 1e-13);
  CHECK((sum.tail<3>() - Vector3(-0.5 * 1.2, 0, 0.3 * 1.2)).norm() < 1e-13);
  // Two loads on one beam add up.
  const Vector6 two = resultant(cantilever(3, "[{force: [0, 0, 1]}, {moment: [0, s, 0], follower: true}]"));
  CHECK((two - (Vector6() << 0, 0, 2, 0, -2 + 1, 0).finished()).norm() < 1e-13);
}

TEST_CASE("loads per length grow with the load factor") {
  const auto model =
      model_from_text(cantilever(2, "[{force: [1, 2, s], at: [0.1, 0.2]}, {moment: [s, 1, 2], follower: true}]"));
  DenseModel dense(*model);
  const VectorX whole = dense.residual(dense.start());
  dense.environment.load_factor = 0.25;
  CHECK((dense.residual(dense.start()) - 0.25 * whole).cwiseAbs().maxCoeff() < 1e-15);
}

namespace {

/// Returns the pressure that makes the stiffness of a quarter ring singular in the mode of two waves, R = 1, EI = 1.
double buckling_pressure(int elements, bool follower) {
  // Section y points to the centre: with the start at angle 0 on the way to 90 degrees it is -x.
  StaticModel ring(
      "nodes: {a: {position: [1, 0, 0]}, b: {position: [0, 1, 0]}}\n"
      "elements: {b: {type: beam, nodes: [a, b], arc_centre: [0, 0, 0], orientation: [-1, 0, 0], elements: " +
      std::to_string(elements) + ", section: {EA: 1e6, GAy: 1e6, GAz: 1e6, GJ: 1, EIy: 1, EIz: 1}, distributed: " +
      (follower ? "{force: [0, 1, 0], follower: true}" : "{force: ['-cos(pi/2*s)', '-sin(pi/2*s)', 0]}") + "}}\n");
  ring.keep_directions({0, 1, 5});
  for (const auto& [node, direction] : {std::pair{"a", 1}, {"a", 5}, {"b", 0}, {"b", 5}}) ring.hold(node, direction);
  // Inextensible to 1e-5: the ring stays a circle until it buckles.
  return ring.critical_load(2, 0.5, 1e-9, 1e-7);
}

}  // namespace

TEST_CASE("a ring buckles at 3 EI/R^3 under pressure that follows it and at 4 EI/R^3 under dead radial forces") {
  // M. Levy (1884); A. Boresi, J. Appl. Mech. 22 (1955) 95. Extension 1e-6 and shear change the loads by 1e-5 at most.
  for (const auto& [follower, exact] : {std::pair{true, 3.0}, {false, 4.0}}) {
    std::vector<double> errors;
    for (int elements : {4, 8, 16}) errors.push_back(buckling_pressure(elements, follower) / exact - 1);
    CAPTURE(follower, errors);
    CHECK(std::abs(errors.back()) < 1e-3);
    // Dead forces are integrated as accurately as the line is represented; the direction of followers is that of the
    // helix.
    CHECK_THAT(std::log2(errors[1] / errors[2]), WithinAbs(follower ? 2 : 4, 0.1));
  }
}

TEST_CASE("a load that the elements' points would lose in part is refused with what they make of it") {
  const auto refusal = [](const std::string& load) {
    return bielle::test::message_of<bielle::InputError>([&] {
      model_from_text(
          "nodes: {a: {position: [0, 0, 0], fixed: true}, b: {position: [2, 0, 0]}}\n"
          "elements:\n  beam: {type: beam, nodes: [a, b], elements: 3, section: {EA: 1, GAy: 1, GAz: 1, "
          "GJ: 1, EIy: 1, EIz: 1}, distributed: " +
          load + "}\n");
    });
  };
  CHECK_THAT(refusal("{force: [0, \"if(abs(s-0.5)<0.01, 100, 0)\", 0]}"),
             Catch::Contains("distributed.force[2]") && Catch::Contains("3 elements"));
  CHECK_THAT(refusal("{moment: [\"1/(s-0.51)^2\", 0, 0]}"), Catch::Contains("distributed.moment[1]"));
  CHECK_THAT(refusal("{force: [\"sqrt(s-0.5)\", 0, 0]}"), Catch::Contains("distributed.force[1]"));
  CHECK_THAT(refusal("[]"), Catch::Contains("at least one load"));
  CHECK(refusal("{force: [2 kN/m, 1 N/mm, 0], at: [10 mm, 0], moment: [1 kN m/m, 0, 0]}") == "(nothing thrown)");
  CHECK_THAT(refusal("{force: [2 kN, 0, 0]}"),
             Catch::Contains("distributed.force[1]: expected a value in N/m, found one in 'kN'"));
  // Kinks that the formula shows are integrated on both sides of them.
  CHECK(refusal("{force: [\"100*(s>0.49)*(s<0.51)\", \"sin(3*s)\", 0]}") == "(nothing thrown)");
}
