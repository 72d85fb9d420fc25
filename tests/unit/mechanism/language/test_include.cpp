// Models that consist of several files.
#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mechanism/language/expanded.hpp"

using bielle::test::expanded;
using bielle::test::message_of;
using Catch::Contains;

namespace {

/// A folder with the files of a model.
struct Folder {
  bielle::test::TemporaryFolder files;

  Folder() { std::filesystem::create_directory(files / "below"); }
  void write(const std::string& name, const std::string& text) const { files.file(name, text); }
  /// Returns the model in which every entry is written out.
  std::string model(const std::string& text) const { return expanded(text, "", files / "model.yaml"); }
  std::string refusal(const std::string& text) const {
    return message_of<bielle::InputError>([&] { model(text); });
  }
};

}  // namespace

TEST_CASE("entries of several files are put together") {
  const Folder folder;
  folder.write("below/arm.yaml",
               "include: hand.yaml\nparameters: {mass: 2, length: 1}\nnodes: {arm: {position: [length, 0, 0]}}\n");
  folder.write("below/hand.yaml", "parameters: {mass: 5}\nnodes: {hand: {}}\n");
  const std::string text =
      folder.model("include: [below/arm.yaml, below/hand.yaml]\nparameters: {length: 3}\nnodes: {base: {}}\n");
  CHECK_THAT(text, Contains("mass: 2") && Contains("length: 3") && !Contains("length: 1") && !Contains("include"));
  CHECK(text.find("hand:") < text.find("arm:"));
  CHECK(text.find("arm:") < text.find("base:"));
}

TEST_CASE("files that cannot be put together are refused where they stand") {
  const Folder folder;
  folder.write("a.yaml", "nodes:\n  pin: {}\ngravity: [0, 0, -9.81]\n");
  folder.write("b.yaml", "include: a.yaml\n\nnodes:\n  pin: {}\n");
  folder.write("circle.yaml", "include: back.yaml\n");
  folder.write("back.yaml", "include: circle.yaml\n");
  folder.write("broken.yaml", "nodes:\n  a: {]\n");
  folder.write("twice.yaml", "nodes: {a: {}}\nnodes: {b: {}}\n");
  CHECK_THAT(folder.refusal("include: b.yaml\n"), Contains("b.yaml:4: nodes.pin") && Contains("a.yaml, line 2"));
  CHECK_THAT(folder.refusal("include: a.yaml\ngravity: [0, 0, 0]\n"),
             Contains("model.yaml:2: gravity") && Contains("a.yaml, line 3"));
  CHECK_THAT(folder.refusal("include: circle.yaml\n"),
             Contains("back.yaml:1: include") && Contains("includes itself") && Contains("back.yaml"));
  CHECK_THAT(folder.refusal("include: model.yaml\n"), Contains("model.yaml:1: include") && Contains("itself"));
  CHECK_THAT(folder.refusal("\ninclude: none.yaml\n"), Contains("model.yaml:2: include") && Contains("no such file"));
  CHECK_THAT(folder.refusal("include: broken.yaml\n"), Contains("broken.yaml:2"));
  CHECK_THAT(folder.refusal("include: twice.yaml\n"), Contains("twice.yaml:2") && Contains("twice"));
  CHECK_THAT(folder.refusal("include: {a: 1}\n"), Contains("name of a file"));
  CHECK_THAT(folder.refusal("include: ''\n"), Contains("name of a file"));
}
