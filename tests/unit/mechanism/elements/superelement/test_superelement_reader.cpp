// Superelements as input: placement, nodes that are made, damping, loads, messages.
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/superelement/superelement_body.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/superelement/modal_damping.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace {

/// Files in a folder and models that name them.
struct Files {
  TemporaryFolder folder;
  Files() {
    write_superelement(straight_beam().reduced().body, folder / "beam.h5");
    write_superelement(bent_chain().reduced().body, folder / "bent.h5");
  }
  std::unique_ptr<Model> model(const std::string& nodes, const std::string& keys) const {
    return model_from_text("nodes: {" + nodes + "}\nelements:\n  rod: {type: superelement, file: " + folder.path() +
                           "/" + keys + "}\n");
  }
  std::string message(const std::string& nodes, const std::string& keys) const {
    return message_of<bielle::InputError>([&] { model(nodes, keys); });
  }
};

const SuperelementBody& body_of(const Model& model) {
  return dynamic_cast<const SuperelementBody&>(*model.members()[0].component);
}

}  // namespace

TEST_CASE("a superelement alone makes its nodes as meshed and starts without stress") {
  const Files files;
  const auto model = files.model("", "bent.h5");
  const BeamChain chain = bent_chain();
  for (const char* name : {"a", "b", "c"}) {
    const Node& node = model->node(*model->find_node(std::string("rod.") + name));
    const BeamInterface& interface = chain.interfaces[static_cast<std::size_t>(name[0] - 'a')];
    CHECK(error(node.frame.x, chain.nodes[static_cast<std::size_t>(interface.node)]) < 1e-15);
    CHECK(error(node.frame.R, interface.rotation) < 1e-15);
    CHECK_FALSE(node.internal);
  }
  CHECK(model->members()[0].entry == Entry{Section::elements, "rod"});
  const DenseModel dense(*model);
  CHECK(dense.residual(dense.start()).cwiseAbs().maxCoeff() < 1e-12);

  const auto attributes = model->members()[0].component->attributes();
  const std::map<std::string, std::string> facts(attributes.begin(), attributes.end());
  CHECK(facts.at("file") == std::filesystem::absolute(files.folder / "bent.h5").string());
  CHECK(facts.at("interface c") == "rod.c");
}

TEST_CASE("a superelement says what holds it, what acts on it and how far it is valid") {
  const Files files;
  const auto lines_of = [&](const std::string& keys) {
    const auto model = files.model("", keys);
    Description description(*model);
    const State state;
    const Slots slots;
    const Environment environment;
    body_of(*model).describe({state, slots, environment}, description);
    return fmt::format("{}", fmt::join(description.lines(), "\n"));
  };
  const std::string text = lines_of("bent.h5, loads: {push: t, spread: {factor: 2, follower: false}}");
  CHECK_THAT(text, Contains("interface 'b' on node 'rod.b'"));
  CHECK_THAT(text, Contains("load 'push' times t, turning with the body; it bends the body, and does not stiffen it"));
  CHECK_THAT(text, Contains("load 'spread' times 2, fixed in space; it bends the body, and does not stiffen it"));
  CHECK_THAT(text, Contains("its own strains are small: errors below 0.1 % up to 0.2 rad between interfaces"));
  BeamChain loose = straight_beam();
  loose.prestress = false;
  write_superelement(loose.reduced().body, files.folder / "loose.h5");
  CHECK_THAT(lines_of("loose.h5"),
             Contains("no geometric stiffness of interface loads in the file") && !Contains("0.2 rad"));
}

TEST_CASE("a superelement is placed by position and orientation and joins nodes of any axes without stress") {
  const Files files;
  const auto model = files.model(
      "pin: {position: [3, 2, 1], rotation_vector: [1, 2, 3]}, wrist: {position: [3, 3.000002, 1], rotation_vector: "
      "[0, 0, -2]}",
      "beam.h5, position: [3, 2, 1], rotation_vector: [0, 0, 1.5707963267948966], nodes: {b: wrist, a: pin}");
  CHECK(model->nodes().size() == 3);
  const DenseModel dense(*model);
  // The wrist is 2e-6 off: part of the undeformed body.
  CHECK(dense.residual(dense.start()).cwiseAbs().maxCoeff() < 1e-10);
  const SuperelementBody& body = body_of(*model);
  Declaration declaration;
  body.declare(declaration);
  CHECK(declaration.nodes == std::vector<int>{1, 2});
  CHECK(declaration.amplitudes.size() == 4);
  CHECK(declaration.amplitudes[2].name == "mode 3");
  CHECK(declaration.memory.empty());  // the energy is a function of the positions
}

TEST_CASE("nodes made for a superelement start with the rigid motion of those that are named") {
  const Files files;
  const auto model = files.model(
      "pin: {position: [0.3, -0.1, 0], rotation_vector: [1, 0, 0], velocity: [1, 2, 3], angular_velocity: [0, 0, 2]}",
      "bent.h5, nodes: {a: pin}");
  const Node& pin = model->node(1);
  const Vector3 omega = pin.frame.R * pin.angular_velocity;
  for (int k : {2, 3}) {
    const Node& node = model->node(k);
    CHECK(error(node.velocity, pin.velocity + omega.cross(node.frame.x - pin.frame.x)) < 1e-14);
    CHECK(error(node.frame.R * node.angular_velocity, omega) < 1e-14);
  }
}

TEST_CASE("a node made for an interface without rotations does not turn") {
  TemporaryFolder folder;
  BeamChain chain = bent_chain();
  chain.interfaces[2].kept = {true, true, true, false, false, false};
  write_superelement(chain.reduced().body, folder / "tied.h5");
  const std::string text = "elements:\n  rod: {type: superelement, file: " + folder.path() + "/tied.h5}\n";
  const auto model = model_from_text(text);
  const Node& node = model->node(*model->find_node("rod.c"));
  CHECK(node.freedom[2] == Freedom::free);
  for (std::size_t d : {3, 4, 5}) CHECK(node.freedom[d] == Freedom::fixed);

  chain.interfaces[2].kept = {true, true, true, true, true, false};
  write_superelement(chain.reduced().body, folder / "tied.h5");
  CHECK_THAT(message_of<bielle::InputError>([&] { model_from_text(text); }),
             Contains("interface 'c' leaves some directions of its node free: name a node for it"));
}

TEST_CASE("bodies of one file share its matrices until the file is written again") {
  TemporaryFolder folder;
  write_superelement(bent_chain().reduced().body, folder / "bent.h5");
  const auto element = [&](const std::string& name, const std::string& keys) {
    return "  " + name + ": {type: superelement, file: " + folder.path() + "/bent.h5" + keys + "}\n";
  };
  const auto model = model_from_text("elements:\n" + element("one", "") + element("other", ", damping: {ratio: 0.1}"));
  const auto body = [&](std::size_t k) -> const SuperelementBody& {
    return dynamic_cast<const SuperelementBody&>(*model->members()[k].component);
  };
  CHECK(&body(0).matrices() == &body(1).matrices());
  CHECK(error(body(0).damping(), body(1).damping()) > 0.1);

  BeamChain stiffer = bent_chain();
  stiffer.modes = 3;
  write_superelement(stiffer.reduced().body, folder / "bent.h5");
  const auto later = model_from_text("elements:\n" + element("one", ""));
  CHECK(dynamic_cast<const SuperelementBody&>(*later->members()[0].component).matrices().modes == 3);
  CHECK(body(0).matrices().modes == 5);
}

TEST_CASE("damping in the mechanism file replaces that of the superelement's") {
  const Files files;
  const auto damping_of = [&](const std::string& keys) -> MatrixX {
    return body_of(*files.model("", "bent.h5" + keys)).damping();
  };
  const auto model = files.model("", "bent.h5, damping: {rayleigh: [0.3, 0.02]}");
  const SuperelementMatrices& matrices = body_of(*model).matrices();
  CHECK(error(body_of(*model).damping(), 0.3 * matrices.M + 0.02 * matrices.K) < 1e-13);
  CHECK(error(damping_of(""), 1e-2 * matrices.K) < 1e-13);

  // Ratios: the free modes diagonalise the damping, 2 zeta omega.
  const MatrixX C = damping_of(", damping: {ratio: [0.02, 0.05]}");
  const bielle::SymmetricEigenpairs eigen = bielle::symmetric_eigenpairs(matrices.K, matrices.M).value();
  const MatrixX modal = eigen.vectors.transpose() * C * eigen.vectors;
  for (Eigen::Index i = 0; i < modal.rows(); ++i)
    for (Eigen::Index j = 0; j < modal.cols(); ++j) {
      const double ratio = i < 6 ? 0 : (i == 6 ? 0.02 : 0.05);
      const double expected = i == j && i >= 6 ? 2 * ratio * std::sqrt(eigen.values[i]) : 0;
      CHECK_THAT(modal(i, j), Catch::WithinAbs(expected, 1e-9));
    }
}

TEST_CASE("load patterns follow the body unless told otherwise") {
  const Files files;
  const std::string turned = "bent.h5, rotation_vector: [0, 0, 1.5707963267948966], loads: {push: ";
  const auto force_of = [&](const std::string& load) {
    const auto model = files.model("", turned + load + "}");
    const DenseModel dense(*model);
    const VectorX r = dense.residual(dense.start());
    Vector3 sum = Vector3::Zero();
    for (int k = 1; k <= 3; ++k) sum -= r.segment<3>(6 * k);
    return sum;
  };
  // "push" is the force (1, -2, 0.5); a quarter turn about z makes it (2, 1, 0.5).
  CHECK(error(force_of("3"), Vector3(6, 3, 1.5)) < 1e-12);
  CHECK(error(force_of("{factor: \"3 + t\"}"), Vector3(6, 3, 1.5)) < 1e-12);
  CHECK(error(force_of("{factor: 3, follower: false}"), Vector3(3, -6, 1.5)) < 1e-12);
}

TEST_CASE("mistakes in a superelement's entry are named") {
  const Files files;
  CHECK_THAT(files.message("", "no.h5"), Contains("model.yaml:3: elements.rod.file: ") && Contains("no.h5"));
  CHECK_THAT(files.message("", "beam.h5, dampng: 0"),
             Contains("'dampng' is not a key of a superelement; did you mean 'damping'?"));
  CHECK_THAT(files.message("pin: {position: [0, 0, 0]}", "bent.h5, nodes: {A: pin}"),
             Contains("'A' is no interface of 'beam'; did you mean 'a'?"));
  CHECK_THAT(files.message("pin: {position: [0, 0, 0]}", "beam.h5, nodes: {a: pn}"), Contains("there is no node 'pn'"));
  CHECK_THAT(
      files.message("pin: {position: [0, 0.001, 0]}", "beam.h5, nodes: {a: pin}"),
      Contains("model.yaml:3: elements.rod.nodes.a: node 'pin' stands at [0, 0.001, 0], but interface 'a' of 'beam' "
               "at [0, 0, 0], 0.001 m away; the body stands as meshed"));
  CHECK_THAT(files.message("pin: {position: [0, 0.001, 0]}", "beam.h5, position: [0, 0, 1], nodes: {a: pin}"),
             Contains("at [0, 0, 1], 1 m away") && !Contains("as meshed"));
  CHECK_THAT(files.message("rod.a: {position: [0, 0, 0]}", "beam.h5"), Contains("there is already a node 'rod.a'"));
  CHECK_THAT(files.message("", "bent.h5, loads: {pus: 1}"),
             Contains("'pus' is no load pattern of 'beam'; did you mean 'push'?"));
  CHECK_THAT(files.message("", "beam.h5, loads: {pull: 1}"), Contains("'beam' has no load patterns"));
  CHECK_THAT(files.message("", "bent.h5, loads: {push: {factor: 1, folower: true}}"),
             Contains("did you mean 'follower'?"));
  CHECK_THAT(files.message("", "beam.h5, damping: {ratio: -1}"), Contains("elements.rod.damping.ratio"));
  CHECK_THAT(files.message("", "beam.h5, damping: {ratio: 0.1, rayleigh: [0, 1]}"),
             Contains("either `ratio` or `rayleigh`"));
  CHECK_THAT(files.message("", "beam.h5, damping: {rayleigh: [0, 1, 2]}"), Contains("expected [alpha, beta]"));
  CHECK_THAT(files.message("", "beam.h5, damping: {ratio: [0,0,0,0,0,0,0,0,0,0,0,0]}"),
             Contains("expected 1 to 10 damping ratios") && Contains("found 12"));
}

TEST_CASE("placement and damping of a superelement may have units, which must fit") {
  const Files files;
  const auto damping = [&](const std::string& keys) {
    const auto model = files.model("", "beam.h5, " + keys);
    return MatrixX(body_of(*model).damping());
  };
  CHECK((damping("damping: {rayleigh: [60 1/min, 2 ms]}") - damping("damping: {rayleigh: [1, 0.002]}")).norm() <
        1e-14 * damping("damping: {rayleigh: [1, 0.002]}").norm());
  const auto placed = files.model("", "beam.h5, position: [12 mm, 0, 0], bryant: [0, 0, 90 deg]");
  CHECK(error(placed->node(*placed->find_node("rod.a")).frame.x, Vector3(0.012, 0, 0)) < 1e-15);
  CHECK_THAT(files.message("", "beam.h5, damping: {rayleigh: [1, 2 m]}"),
             Contains("damping.rayleigh[2]: expected a value in s, found one in 'm'"));
  CHECK_THAT(files.message("", "bent.h5, loads: {push: 2 N}"),
             Contains("expected a number without a unit") && Contains("'N'"));
}
