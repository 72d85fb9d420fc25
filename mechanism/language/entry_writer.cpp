#include "mechanism/language/entry_writer.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/language/language_keys.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "reduce/common/input/unit.hpp"

namespace bielle::mechanism {
namespace {

using Kind = KeyForm::Kind;

bool has_all_keys(const KeyTable& table, const YamlNode& map) {
  return std::all_of(map.pairs.begin(), map.pairs.end(),
                     [&](const YamlNode::Pair& pair) { return table.find(pair.key->scalar) != nullptr; });
}

/// Returns the table of a map. Among several tables it is the one that has all keys of the map.
const KeyTable* table_of(const KeyForms& forms, const YamlNode& map) {
  const KeyTable* first = nullptr;
  for (const KeyForm& form : forms) {
    if (form.kind != Kind::table) continue;
    const KeyTable& table = form.table().of_map(map);
    if (has_all_keys(table, map)) return &table;
    if (!first) first = &table;
  }
  return first;
}

/// Returns whether the keys of a map of entries are names of things in the model.
bool names_things(const KeyForm& entries) {
  static const std::vector<std::string> things = {"node",  "joint", "element", "measure", "event",
                                                  "state", "input", "drive",   "load",    "hydraulics"};
  return std::find(things.begin(), things.end(), entries.of) != things.end();
}

bool is_orientation(const std::string& key) {
  const std::vector<Key>& keys = orientation_keys();
  return std::any_of(keys.begin(), keys.end(), [&](const Key& each) { return each.name == key; });
}

/// Returns whether an orientation in a map of a table is relative to the inertial axes.
bool has_inertial_orientation(const KeyTable& table) {
  const Key* matrix = table.find("matrix");
  return matrix && matrix->forms.front().inertial;
}

/// Returns whether a value names the ground. Its axes are the inertial ones, in which the part is written.
bool is_ground(const Tree& node) { return node && node->scalar == "ground"; }

/// Returns whether the position and orientation in a map are relative to a node. They stay unchanged, because this node
/// is placed itself.
bool is_relative_frame(const KeyTable& table, const YamlNode& map) {
  const Tree at = find_value(map, "at");
  return has_inertial_orientation(table) && at && !is_ground(at);
}

/// Returns the nodes to which the items of a list in a map belong, such as those of `at: [[..], [..]]`.
std::vector<Tree> nodes_of_lists(const KeyTable& table, const YamlNode& map) {
  if (const Tree nodes = find_value(map, "nodes")) return nodes->items;
  if (!table.find("relative_to")) return {};
  const Tree seen_from = find_value(map, "relative_to");
  return {seen_from ? seen_from : make_scalar("ground", map), find_value(map, "node")};
}

/// Returns the node in whose axes the vectors of a map are: null if there is none.
Tree node_of_vectors(const YamlNode& map) {
  const Tree nodes = find_value(map, "nodes"), type = find_value(map, "type");
  if (!nodes) return find_value(map, "node");
  return type && type->scalar == "node_force" && nodes->items.size() == 2 ? nodes->items[1] : nullptr;
}

/// Returns whether other keys of a map turn the components of a vector into those along a node's axes.
bool is_along_own_axes(const std::string& key, const YamlNode& map) {
  const Tree seen_from = find_value(map, "relative_to");
  if (key == "direction") return seen_from && !is_ground(seen_from);
  if (key != "force" && key != "moment") return false;
  const Tree follower = find_value(map, "follower"), type = find_value(map, "type");
  if (follower && follower->scalar == "true") return true;
  const Tree axes = find_value(map, "axes"), nodes = find_value(map, "nodes");
  if (!type || type->scalar != "node_force" || !nodes || nodes->items.size() != 2) return false;
  const std::string along = axes ? axes->scalar : "first";
  return along != "inertial" && !is_ground(nodes->items[along == "second"]);
}

/// Marks the items of a list that belong to the ground as components along inertial axes.
void along_ground(KeyForm& list, const std::vector<Tree>& nodes) {
  if (list.kind != KeyForm::Kind::list || list.geometry != KeyForm::Geometry::none || list.items.empty()) return;
  const KeyForms last = list.items.back();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (list.items.size() <= k) list.items.push_back(last);
    if (is_ground(nodes[k]))
      for (KeyForm& form : list.items[k]) form.inertial = true;
  }
}

/// Returns the forms of a key with the geometry that other keys of the map give them.
KeyForms forms_in(const Key& key, const KeyTable& table, const YamlNode& map) {
  KeyForms forms = key.forms;
  const bool own = (key.name == "position" && is_relative_frame(table, map)) || is_along_own_axes(key.name, map);
  const bool on_ground = key.name == "at" && is_ground(node_of_vectors(map));
  const Tree quantity = key.name == "direction" ? find_value(map, "quantity") : nullptr;
  const bool turning = quantity && (quantity->scalar == "rotation" || quantity->scalar == "angular_velocity" ||
                                    quantity->scalar == "moment");
  const std::vector<Tree> nodes = nodes_of_lists(table, map);
  for (KeyForm& form : forms) {
    if (own) form.inertial = false;
    if (on_ground && form.geometry != KeyForm::Geometry::none) form.inertial = true;
    if (turning && form.geometry == KeyForm::Geometry::vector) form.geometry = KeyForm::Geometry::axial;
    along_ground(form, nodes);
  }
  return forms;
}

}  // namespace

Tree EntryWriter::write(const Tree& value, const KeyForms& forms, const std::string& path) const {
  switch (value->kind) {
    case YamlNode::Kind::null:
      return value;
    case YamlNode::Kind::scalar:
      return write_scalar(value, forms, path);
    case YamlNode::Kind::sequence:
      return write_list(*value, forms, path);
    case YamlNode::Kind::map:
      break;
  }
  const KeyTable* table = table_of(forms, *value);
  const KeyForm* entries = form_of(forms, Kind::entries);
  if (table && (!entries || has_all_keys(*table, *value))) return write_map(*value, *table, path);
  if (entries) return write_entries(*value, *entries, path);
  if (const KeyForm* name = form_of(forms, Kind::name); name && name->of == "node") {
    value_at(value, path, *scope_.main_file).keyed(body_point_keys());  // refuses unknown keys
    const Tree point = write_map(*value, body_point_keys(), path);
    return make_scalar(make_point_(*point, path), *value);
  }
  return value;  // the reader of the entry reports the error
}

Tree EntryWriter::write_map(const YamlNode& map, const KeyTable& table, const std::string& path) const {
  Pairs pairs;
  pairs.reserve(map.pairs.size());
  for (const YamlNode::Pair& pair : map.pairs) {
    const Key* key = table.find(pair.key->scalar);
    if (!key) {
      pairs.push_back(pair);
      continue;
    }
    const std::string place = path + "." + key->name;
    Tree value = scope_.placement.is_identity() ? write(pair.value, key->forms, place)
                                                : write(pair.value, forms_in(*key, table, map), place);
    if (key->name == "inertia" && scope_.placement.mirrored >= 0) value = mirrored_inertia(value);
    pairs.push_back({pair.key, std::move(value)});
  }
  Tree written = make_map(std::move(pairs), map);
  const bool placed = !scope_.placement.is_identity() && table.find("matrix");
  return placed ? place_frame(*written, table) : written;
}

Tree EntryWriter::write_entries(const YamlNode& map, const KeyForm& form, const std::string& path) const {
  const bool things = names_things(form);
  Pairs pairs;
  for (const YamlNode::Pair& pair : map.pairs) {
    const std::string text = scope_.text(*pair.key, path);
    const std::string name = things ? scope_.name_of(text).value_or(text) : text;
    pairs.push_back({make_scalar(name, *pair.key), write(pair.value, form.items.front(), path + "." + name)});
  }
  return make_map(std::move(pairs), map);
}

Tree EntryWriter::write_scalar(const Tree& node, const KeyForms& forms, const std::string& path) const {
  const std::string text = scope_.text(*node, path);
  if (const Tree direction = place_word(*node, text, forms)) return direction;
  const auto result = [&](const std::string& other) {
    return other == node->scalar ? node : make_scalar(other, *node);
  };
  for (const KeyForm& form : forms)
    if (form.kind == Kind::word && std::find(form.words.begin(), form.words.end(), text) != form.words.end())
      return result(text);
  if (form_of(forms, Kind::boolean) && (text == "true" || text == "false")) return result(text);
  if (form_of(forms, Kind::name))
    if (const auto other = scope_.name_of(text)) return result(*other);
  const KeyForm* number = numeric_form(forms);
  if (!number || (quantity_of(text) && scope_.placement.is_identity())) return result(text);
  const std::string formula = [&] {
    try {
      if (const auto quantity = quantity_of(text)) return fmt::format("{}", to_si(*quantity, number->unit));
      return scope_.formula(text, number->words);
    } catch (const InputError& error) {
      fail_at(*node, *scope_.main_file, path, fmt::format("'{}': {}", text, error.what()));
    }
  }();
  if (number->geometry == KeyForm::Geometry::pseudoscalar && scope_.placement.mirrored >= 0)
    return make_scalar(fmt::format("-({})", formula), *node);
  return result(formula);
}

/// Returns a direction that is named by a word, `x`, in the axes of its place; null if it does not change, or if the
/// text is not a direction.
Tree EntryWriter::place_word(const YamlNode& node, const std::string& text, const KeyForms& forms) const {
  if (text != "x" && text != "y" && text != "z") return nullptr;
  for (const KeyForm& form : forms) {
    if (form.kind != Kind::list || form.geometry == KeyForm::Geometry::none) continue;
    const Matrix3 A = scope_.placement.matrix(form.geometry, form.inertial);
    if (A.isIdentity(0)) return nullptr;
    const Vector3 direction = A.col(text[0] - 'x');
    return make_numbers({direction[0], direction[1], direction[2]}, node);
  }
  return nullptr;
}

/// Changes the signs of the products of inertia that contain the mirrored axis.
Tree EntryWriter::mirrored_inertia(const Tree& value) const {
  const int mirrored = scope_.placement.mirrored;
  const auto negative = [](const Tree& number) { return make_scalar(fmt::format("-({})", number->scalar), *number); };
  std::vector<Tree> items = value->items;
  if (items.size() == 6) {
    constexpr int axes[][2] = {{0, 1}, {0, 2}, {1, 2}};
    for (std::size_t k = 0; k < 3; ++k)
      if (axes[k][0] == mirrored || axes[k][1] == mirrored) items[3 + k] = negative(items[3 + k]);
  }
  for (std::size_t row = 0; items.size() == 3 && row < 3; ++row) {
    std::vector<Tree> numbers = items[row]->items;
    for (std::size_t k = 0; numbers.size() == 3 && k < 3; ++k)
      if ((static_cast<int>(row) == mirrored) != (static_cast<int>(k) == mirrored)) numbers[k] = negative(numbers[k]);
    if (!numbers.empty()) items[row] = make_list(std::move(numbers), *items[row]);
  }
  return make_list(std::move(items), *value);
}

Tree EntryWriter::write_list(const YamlNode& list, const KeyForms& forms, const std::string& path) const {
  const KeyForm* form = form_of_list(forms, list);
  std::vector<Tree> items;
  static const KeyForms unknown;
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    const KeyForms& of_item = form ? form->items[std::min(k, form->items.size() - 1)] : unknown;
    items.push_back(write(list.items[k], of_item, fmt::format("{}[{}]", path, k + 1)));
  }
  const Tree written = make_list(std::move(items), list);
  const bool vector = form && form->geometry != KeyForm::Geometry::none && list.items.size() == 3;
  return vector ? place_vector(written, *form, path) : written;
}

Tree EntryWriter::place_vector(const Tree& list, const KeyForm& form, const std::string& path) const {
  const Placement& placement = scope_.placement;
  const Matrix3 A = placement.matrix(form.geometry, form.inertial);
  const bool moved = form.geometry == KeyForm::Geometry::point && form.inertial;
  if (A.isIdentity(0) && !(moved && placement.moves())) return list;
  const Vector3 offset = moved ? placement.frame.x : Vector3(Vector3::Zero());
  const std::vector<Tree>& items = list->items;
  std::vector<std::optional<double>> numbers;
  for (const Tree& item : items) numbers.push_back(scope_.constant(*item, path));
  const bool constant = std::all_of(numbers.begin(), numbers.end(), [](const auto& number) { return number; });
  std::vector<Tree> placed;
  for (int row = 0; row < 3; ++row) {
    double number = offset[row];
    std::string formula = offset[row] == 0 ? "" : fmt::format("{}", offset[row]);
    for (int k = 0; k < 3; ++k) {
      const auto item = static_cast<std::size_t>(k);
      if (A(row, k) == 0) continue;
      if (constant)
        number += A(row, k) * *numbers[item];
      else
        formula += fmt::format("{}({})*({})", formula.empty() ? "" : " + ", A(row, k), items[item]->scalar);
    }
    if (constant) formula = fmt::format("{}", number);
    placed.push_back(make_scalar(formula.empty() ? "0" : formula, *list));
  }
  return make_list(std::move(placed), *list);
}

/// Transforms the position and orientation of an entry to its place.
Tree EntryWriter::place_frame(const YamlNode& map, const KeyTable& table) const {
  const bool on_ground = !has_inertial_orientation(table) && is_ground(find_value(map, "node"));
  const bool inertial = on_ground || (has_inertial_orientation(table) && !is_relative_frame(table, map));
  const std::string place = on_ground ? "at" : "position";
  Pairs orientation, others;
  for (const YamlNode::Pair& pair : map.pairs)
    (is_orientation(pair.key->scalar) ? orientation : others).push_back(pair);
  static const KeyTable orientation_table{"an orientation", "", orientation_keys(), {}};
  YamlValue given = YamlValue::of_tree(make_map(orientation, map), "", map.file ? *map.file : *scope_.main_file);
  given.set_parameters(*scope_.parameters);
  const Matrix3 R = scope_.placement.orientation(read_orientation(given.keyed(orientation_table)), inertial);
  if (inertial && !find_pair(map, place)) {
    const Vector3& x = scope_.placement.frame.x;
    others.push_back({make_scalar(place, map), make_numbers({x[0], x[1], x[2]}, map)});
  }
  if (!R.isIdentity(0)) {
    std::vector<Tree> rows;
    for (int row = 0; row < 3; ++row) rows.push_back(make_numbers({R(row, 0), R(row, 1), R(row, 2)}, map));
    others.push_back({make_scalar("matrix", map), make_list(std::move(rows), map)});
  }
  return make_map(std::move(others), map);
}

}  // namespace bielle::mechanism
