// Bodies in pieces as input: one entry against one entry for each piece, names, damping, loads, messages.
#include <catch2/catch.hpp>

#include "mechanism/elements/superelement/superelement_body.hpp"
#include "tests/support/cut_chain.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

namespace test_superelement_pieces {
namespace {

struct Files {
  TemporaryFolder folder;
  bielle::CutBody body = cut_beam();
  Files() {
    write_cut_body(body, folder / "beam.h5");
    for (std::size_t k = 0; k < body.pieces.size(); ++k)
      write_superelement(body.pieces[k], folder / ("part_" + std::to_string(k + 1) + ".h5"));
  }
  /// `keys` of the entry, after the file.
  std::string text(const std::string& nodes, const std::string& keys, const std::string& others = "") const {
    return "nodes: {" + nodes + "}\nelements:\n  blade: {type: superelement, file: " + folder.path() + "/beam.h5" +
           keys + "}\n" + others;
  }
  std::string part(int k, const std::string& keys) const {
    return "  p" + std::to_string(k) + ": {type: superelement, file: " + folder.path() + "/part_" + std::to_string(k) +
           ".h5, " + keys + "}\n";
  }
  std::string message(const std::string& nodes, const std::string& keys, const std::string& others = "") const {
    return message_of<bielle::InputError>([&] { model_from_text(text(nodes, keys, others)); });
  }
};

const std::string ends = "hub: {position: [1, 2, 0], rotation_vector: [0, 0, 0.4]}, end: {position: [1, 3, 0]}";
const std::string placed = "position: [1, 2, 0], rotation_vector: [0, 0, \"pi/2\"]";
const std::string on_ends = ", " + placed + ", nodes: {root: hub, tip: end}";

}  // namespace

TEST_CASE("one entry makes a superelement of each piece, which share the nodes of the cuts") {
  const Files files;
  const auto model = model_from_text(files.text(ends, on_ends));
  REQUIRE(model->members().size() == 3);
  CHECK(model->members_of({Section::elements, "blade"}).size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const Member& member = model->members()[k];
    const std::string name = "blade." + std::to_string(k + 1);
    CHECK(member.component->name() == name);
    CHECK(member.entry == Entry{Section::elements, "blade"});
    CHECK(member.results == Entry{Section::elements, name});
    const auto attributes = member.component->attributes();
    const std::map<std::string, std::string> facts(attributes.begin(), attributes.end());
    CHECK(facts.at("group") == "/pieces/" + std::to_string(k + 1));
  }
  CHECK(model->nodes().size() == 5);  // with the ground
  const Node& cut = model->node(*model->find_node("blade.cut_2"));
  CHECK((cut.frame.x - Vector3(1, 2.6, 0)).norm() < 1e-14);
  const DenseModel dense(*model);
  CHECK(dense.residual(dense.start()).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("pieces in one entry are what they are in entries of their own") {
  const Files files;
  const std::string loads = ", loads: {wind: 3}, damping: {rayleigh: [0, 0.01]}";
  const auto together = model_from_text(files.text(ends, on_ends + loads));
  // The cuts' nodes have the body's axes, which the placement turns.
  const std::string turned = "rotation_vector: [0, 0, \"pi/2\"]}";
  const auto apart = model_from_text(
      "nodes: {" + ends + ", c1: {position: [1, 2.3, 0], " + turned + ", c2: {position: [1, 2.6, 0], " + turned +
      "}\nelements:\n" + files.part(1, placed + ", nodes: {root: hub, cut_1: c1}, damping: {rayleigh: [0, 0.01]}") +
      files.part(2, placed + ", nodes: {cut_1: c1, cut_2: c2}" + loads) +
      files.part(3, placed + ", nodes: {cut_2: c2, tip: end}" + loads));
  const DenseModel a(*together), b(*apart);
  State state_a = a.start(), state_b = b.start();
  std::srand(3);
  const VectorX move = 0.05 * VectorX::Random(a.size());
  a.move(state_a, move);
  b.move(state_b, move);
  const VectorX force = b.residual(state_b);
  CHECK((a.residual(state_a) - force).norm() < 1e-9 * force.norm());
  CHECK(a.residual(a.start()).cwiseAbs().maxCoeff() > 1);  // the wind blows
  for (const auto part : {DenseModel::Part::K, DenseModel::Part::C, DenseModel::Part::M}) {
    const MatrixX expected = b.tangent(state_b, part);
    CHECK((a.tangent(state_a, part) - expected).norm() < 1e-9 * expected.norm());
  }
}

TEST_CASE("a cut's node may be named, and others hang on it") {
  const Files files;
  const auto model = model_from_text(files.text("waist: {position: [0.3, 0, 0]}", ", nodes: {cut_1: waist}",
                                                "  pod: {type: point_mass, node: blade.cut_2, mass: 2}\n"));
  CHECK_FALSE(model->find_node("blade.cut_1"));
  CHECK(model->find_node("blade.cut_2"));
  CHECK(model->find_node("blade.root"));
}

TEST_CASE("a ratio of damping in the mechanism is that of the whole body's first mode") {
  const Files files;
  const auto model = model_from_text(files.text("", ", damping: {ratio: 0.02}"));
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& piece = dynamic_cast<const SuperelementBody&>(*model->members()[k].component);
    // 2 zeta / omega of 3 Hz, the frequency in the file.
    const double beta = 2 * 0.02 / (2 * std::acos(-1.0) * 3);
    CHECK((piece.damping() - beta * piece.matrices().K).norm() < 1e-12 * piece.damping().norm());
  }
}

TEST_CASE("what does not fit a body in pieces is refused with its place") {
  const Files files;
  CHECK_THAT(
      files.message("a: {position: [0, 0, 0]}", ", nodes: {cut_3: a}"),
      Contains("elements.blade.nodes.cut_3") && Contains("'cut_3' is no interface of 'beam'; did you mean 'cut_1'"));
  CHECK_THAT(files.message("a: {position: [0.31, 0, 0]}", ", nodes: {cut_1: a}"), Contains("0.01 m away"));
  CHECK_THAT(files.message("", ", loads: {wnd: 1}"),
             Contains("'wnd' is no load pattern of 'beam'; did you mean 'wind'"));
  CHECK_THAT(files.message("", ", damping: {ratio: [0.1, 0.2]}"), Contains("a body in pieces has one ratio"));
  CHECK_THAT(files.message("", ", frame: {interface: root}"), Contains("no interface is that of all pieces"));
  CHECK_THAT(files.message("", ", frame: men"),
             Contains("'men' is not a frame of a superelement; did you mean 'mean'"));
  CHECK_THAT(files.message("", ", frame: {interface: root}"), Contains("no interface is that of all pieces"));
  CHECK_THAT(files.message("", ", frame: men"),
             Contains("'men' is not a frame of a superelement; did you mean 'mean'"));
  CHECK_THAT(files.message("", ", damping: {}"), Contains("expected either `ratio` or `rayleigh`"));
  CHECK_THAT(files.message("a: {position: [5, 0, 0]}", "", "  blade.2: {type: point_mass, node: a, mass: 1}\n"),
             Contains("a piece of this body is called 'blade.2', as another element is"));
  CHECK_THAT(files.message("blade.cut_1: {position: [5, 0, 0]}", ""),
             Contains("there is already a node 'blade.cut_1'"));
}

}  // namespace test_superelement_pieces
