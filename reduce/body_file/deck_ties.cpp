#include "reduce/body_file/deck_ties.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_file.hpp"
#include "reduce/mesh/foreign_mesh.hpp"
#include "reduce/mesh/length_unit.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

DeckTie read_deck_tie(const YamlValue& value, double metres) {
  DeckTie tie;
  tie.name = value.at("name").text();
  if (const auto refusal = value.find("refused")) {
    tie.refusal = refusal->text();
    return tie;
  }
  tie.tie = value.at("tie").text() == "average" ? Tie::average : Tie::rigid;
  tie.position = metres * value.at("position").vector3();
  for (int k = 0; k < 3; ++k) tie.rotation.col(k) = value.at("axes").at(k).vector3();
  const std::vector<std::string> words = direction_names({true, true, true, true, true, true});
  for (const YamlValue& direction : value.at("directions").items())
    for (std::size_t k = 0; k < words.size(); ++k) tie.kept[k] |= direction.text() == words[k];
  if (const auto surface = value.find("surface")) {
    tie.surface = surface->text();
    return tie;
  }
  for (const YamlValue& node : value.at("nodes").items()) tie.nodes.push_back(node.integer());
  for (const YamlValue& weight : value.at("weights").items()) tie.weights.push_back(weight.number());
  return tie;
}

/// Upper-case letters and single spaces, as decks compare names.
std::string folded(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c != ' ')
      result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    else if (!result.empty() && result.back() != ' ')
      result += ' ';
  if (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

}  // namespace

std::vector<DeckTie> deck_ties(const std::string& path, const std::optional<std::string>& length_unit,
                               std::vector<std::string>& notes) {
  std::vector<DeckTie> ties;
  if (gmsh_reads(path)) return ties;
  const std::string text = ties_of_mesh(path, notes);
  const std::string name = std::filesystem::path(path).filename().string();
  const YamlValue deck = YamlValue::parse(text, fmt::format("ties of {}", name));
  const double metres = length_unit ? metres_per(*length_unit) : 1;
  const YamlValue list = deck.at("ties");
  for (const YamlValue& value : list.items()) ties.push_back(read_deck_tie(value, metres));
  return ties;
}

std::string describe(const std::vector<DeckTie>& ties) {
  std::string text;
  for (const DeckTie& tie : ties) {
    if (!tie.refusal.empty()) {
      text += fmt::format("  {}: no interface: {}\n", tie.name, tie.refusal);
      continue;
    }
    const std::string tied =
        tie.surface.empty() ? counted(tie.nodes.size(), "node") : fmt::format("surface '{}'", tie.surface);
    text += fmt::format("  {}: {}, {}, at {}, axes x {} y {}, directions {}\n", tie.name, tied,
                        tie.tie == Tie::average ? "average" : "rigid", place_name(tie.position),
                        direction_name(tie.rotation.col(0)), direction_name(tie.rotation.col(1)),
                        fmt::join(direction_names(tie.kept), " "));
  }
  return text.empty() ? "" : "ties (for interfaces, by {from: NAME}):\n" + text;
}

const DeckTie& DeckTieReader::find(const YamlValue& from) {
  if (!ties_) {
    try {
      ties_ = deck_ties(mesh_.path, mesh_.length_unit, notes_);
    } catch (const InputError& error) {
      from.fail(error.what());
    }
  }
  const std::string file = std::filesystem::path(mesh_.path).filename().string();
  if (ties_->empty())
    from.fail(
        fmt::format("'{}' has no ties: they are the RBE2 and RBE3 of a Nastran file, and the couplings and rigid "
                    "bodies of an Abaqus or CalculiX file",
                    file));
  const std::string wanted = from.text();
  std::vector<std::string> names;
  for (const DeckTie& tie : *ties_) {
    if (folded(tie.name) == folded(wanted)) return tie;
    names.push_back(tie.name);
  }
  from.fail(fmt::format("'{}' has no tie '{}'{}", file, wanted, did_you_mean(wanted, names)));
}

void DeckTieReader::read(const YamlValue& from, InterfaceRequest& interface) {
  const DeckTie& tie = find(from);
  if (!tie.refusal.empty()) from.fail(fmt::format("{}: {}", tie.name, tie.refusal));
  if (const auto [user, is_new] = user_of_.emplace(tie.name, interface.name); !is_new)
    from.fail(fmt::format("'{}' is the interface '{}' already", tie.name, user->second));
  interface.tie = tie.tie;
  interface.position = tie.position;
  interface.rotation = tie.rotation;
  interface.kept = tie.kept;
  if (!tie.surface.empty()) {
    interface.group = tie.surface;
    mesh_.surfaces.push_back({tie.surface, {tie.surface}, from.path()});
  } else {
    interface.group = from.path();
    mesh_.nodes.push_back({interface.group, tie.nodes, tie.weights, from.path()});
  }
}

}  // namespace bielle::reduce
