#include "reduce/body_file/deck_ties.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_file.hpp"
#include "reduce/fe/relative_weights.hpp"
#include "reduce/mesh/foreign_mesh.hpp"
#include "reduce/mesh/length_unit.hpp"
#include "reduce/mesh/place.hpp"
#include "reduce/superelement/inertia_tensor.hpp"

namespace bielle::reduce {

namespace {

DeckTie read_deck_tie(const YamlValue& value, double metres) {
  DeckTie tie;
  tie.name = value.at("name").text();
  if (const auto refusal = value.find("refused")) {
    tie.refusal = refusal->text();
    return tie;
  }
  tie.reference = value.at("reference").text();
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

/// Returns a name in upper case with single spaces: decks compare names in this form.
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

DeckMass read_deck_mass(const YamlValue& value, double metres) {
  DeckMass mass;
  mass.name = value.at("name").text();
  if (const auto refusal = value.find("refused")) {
    mass.refusal = refusal->text();
    return mass;
  }
  mass.mass = value.at("mass").number();
  mass.position = metres * value.at("position").vector3();
  mass.inertia = metres * metres * value.at("inertia").matrix(3, 3);
  if (const auto tie = value.find("tie")) mass.tie = tie->text();
  if (const auto place = value.find("place")) mass.place = metres * place->vector3();
  return mass;
}

/// Returns the tie or mass that a key names. @throws InputError with the nearest name
template <class Named>
const Named& named(const std::vector<Named>& all, const YamlValue& from, const std::string& file, const char* what) {
  const std::string wanted = from.text();
  std::vector<std::string> names;
  for (const Named& each : all) {
    if (folded(each.name) == folded(wanted)) return each;
    names.push_back(each.name);
  }
  from.fail(fmt::format("'{}' has no {} '{}'{}", file, what, wanted, did_you_mean(wanted, names)));
}

}  // namespace

Deck read_deck(const std::string& path, const std::optional<std::string>& length_unit,
               std::vector<std::string>& notes) {
  Deck deck;
  if (gmsh_reads(path)) return deck;
  const std::string text = ties_of_mesh(path, notes);
  const std::string name = std::filesystem::path(path).filename().string();
  const YamlValue contents = YamlValue::parse(text, fmt::format("ties of {}", name));
  const double metres = length_unit ? metres_per(*length_unit) : 1;
  const YamlValue ties = contents.at("ties"), masses = contents.at("masses");
  for (const YamlValue& value : ties.items()) deck.ties.push_back(read_deck_tie(value, metres));
  for (const YamlValue& value : masses.items()) deck.masses.push_back(read_deck_mass(value, metres));
  return deck;
}

std::string describe(const Deck& deck) {
  std::string text;
  if (!deck.ties.empty()) text += "ties (for interfaces, by {from: NAME}):\n";
  for (const DeckTie& tie : deck.ties) {
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
  if (!deck.masses.empty()) text += "point masses (for masses, by {from: NAME}), in the file's unit of mass:\n";
  for (const DeckMass& mass : deck.masses)
    text += mass.refusal.empty()
                ? fmt::format("  {}: {:.6g} at {}, {}\n", mass.name, mass.mass, place_name(mass.position),
                              !mass.has_effect() ? "without effect"
                              : mass.tie.empty() ? "at a node of the solid"
                                                 : fmt::format("carried by {}", mass.tie))
                : fmt::format("  {}: cannot be used: {}\n", mass.name, mass.refusal);
  return text;
}

std::string DeckReader::file_name() const { return std::filesystem::path(mesh_.path).filename().string(); }

const Deck& DeckReader::deck(const YamlValue& key) {
  if (deck_) return *deck_;
  try {
    deck_ = read_deck(mesh_.path, mesh_.length_unit, notes_);
  } catch (const InputError& error) {
    key.fail(error.what());
  }
  return *deck_;
}

const DeckTie& DeckReader::find(const YamlValue& from) {
  if (deck(from).ties.empty())
    from.fail(
        fmt::format("'{}' has no ties: they are the RBE2 and RBE3 of a Nastran file, and the couplings and rigid "
                    "bodies of an Abaqus or CalculiX file",
                    file_name()));
  return named(deck(from).ties, from, file_name(), "tie");
}

void DeckReader::read(const YamlValue& from, InterfaceRequest& interface) {
  const DeckTie& tie = find(from);
  if (!tie.refusal.empty()) from.fail(fmt::format("{}: {}", tie.name, tie.refusal));
  if (const auto [user, is_new] = user_of_.emplace(tie.name, interface.name); !is_new)
    from.fail(fmt::format("'{}' is the interface '{}' already", tie.name, user->second));
  interface.tie = tie.tie;
  interface.position = tie.position;
  interface.rotation = tie.rotation;
  interface.kept = tie.kept;
  interface.group = requested_nodes(tie, from);
  note_common_reference(tie, interface.name);
}

/// Requests the nodes or the surface that a tie ties. @returns the name of their group in the mesh
std::string DeckReader::requested_nodes(const DeckTie& tie, const YamlValue& key) {
  if (!tie.surface.empty()) {
    mesh_.surfaces.push_back({tie.surface, {tie.surface}, key.path()});
    return tie.surface;
  }
  const std::string group = "nodes of " + tie.name;
  if (std::none_of(mesh_.nodes.begin(), mesh_.nodes.end(),
                   [&](const NodeSelection& selection) { return selection.group == group; }))
    try {
      mesh_.nodes.push_back({group, tie.nodes, relative_weights(tie.weights), key.path()});
    } catch (const InputError& error) {
      key.fail(fmt::format("{}: {}", tie.name, error.what()));
    }
  return group;
}

/// Tells the user about an earlier interface that is the same node in the file.
void DeckReader::note_common_reference(const DeckTie& tie, const std::string& interface) {
  for (const DeckTie& other : deck_->ties) {
    const auto user = user_of_.find(other.name);
    if (user == user_of_.end() || other.name == tie.name || other.reference != tie.reference) continue;
    notes_.push_back(
        fmt::format("the interfaces '{}' ({}) and '{}' ({}) have the same node {} in '{}', but become two nodes, which "
                    "nothing connects: connect them by a rigid joint in the mechanism",
                    user->second, other.name, interface, tie.name, tie.reference, file_name()));
    return;
  }
}

MassRequest DeckReader::made(const DeckMass& mass, const YamlValue& key, double kilograms) {
  if (!mass.refusal.empty()) key.fail(fmt::format("{}: {}", mass.name, mass.refusal));
  if (mass.mass < 0) key.fail(fmt::format("{} has the mass {:g}, which is negative", mass.name, mass.mass));
  MassRequest request;
  request.name = mass.name;
  request.mass = kilograms * mass.mass;
  request.position = mass.position;
  request.inertia = kilograms * mass.inertia;
  if (!request.inertia.isZero(0))
    if (const std::string fault = inertia_fault(request.inertia); !fault.empty())
      key.fail(fmt::format("{}: {}", mass.name, fault));
  request.place = mass.place;
  if (!mass.place)
    request.group = requested_nodes(
        *std::find_if(deck_->ties.begin(), deck_->ties.end(), [&](const DeckTie& tie) { return tie.name == mass.tie; }),
        key);
  return request;
}

MassRequest DeckReader::read_mass(const YamlValue& from, const std::string& name, double kilograms) {
  const DeckMass& mass = named(read_any(from), from, file_name(), "point mass");
  if (mass.refusal.empty() && !mass.has_effect()) from.fail(fmt::format("{} has neither mass nor inertia", mass.name));
  if (const auto [user, is_new] = user_of_mass_.emplace(mass.name, name); !is_new)
    from.fail(fmt::format("'{}' is the mass '{}' already", mass.name, user->second));
  MassRequest request = made(mass, from, kilograms);
  request.name = name;
  request.subject = from.path();
  return request;
}

std::vector<MassRequest> DeckReader::read_masses(const YamlValue& key, double kilograms) {
  std::vector<MassRequest> requests;
  for (const DeckMass& mass : read_any(key)) {
    if (mass.refusal.empty() && !mass.has_effect()) continue;
    requests.push_back(made(mass, key, kilograms));
    requests.back().subject = fmt::format("{}.{}", key.path(), mass.name);
  }
  return requests;
}

const std::vector<DeckMass>& DeckReader::read_any(const YamlValue& key) {
  if (deck(key).masses.empty())
    key.fail(
        fmt::format("'{}' has no point masses: they are the CONM2 of a Nastran file, and *MASS and *ROTARY INERTIA "
                    "of an Abaqus or CalculiX file",
                    file_name()));
  return deck_->masses;
}

}  // namespace bielle::reduce
