#include "mechanism/language/expand_model.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/language/cases.hpp"
#include "mechanism/language/each_entry.hpp"
#include "mechanism/language/entry_writer.hpp"
#include "mechanism/language/include.hpp"
#include "mechanism/language/language_keys.hpp"
#include "mechanism/language/parameters.hpp"
#include "mechanism/language/part_library.hpp"
#include "mechanism/language/placed_entry.hpp"
#include "mechanism/language/written_model.hpp"
#include "mechanism/reading/read_frame.hpp"

namespace bielle::mechanism {
namespace {

/// Sections whose names are words in formulas.
const std::vector<std::string> measure_sections = {"states", "measures", "inputs", "events"};
/// Sections that a part does not contribute to the model in which it is placed.
const std::vector<std::string> sections_of_model = {"mechanism", "gravity", "analysis", "output", "cases"};

/// Returns the forms of the entries of a key; null if its value has none.
const KeyForms* entry_forms(const KeyTable& table, const std::string& key) {
  const Key* found = table.find(key);
  const KeyForm* form = found ? form_of(found->forms, KeyForm::Kind::entries) : nullptr;
  return form ? &form->items.front() : nullptr;
}

/// Returns the table of a map among forms; null if there is none.
const KeyTable* table_of_entry(const KeyForms& forms, const YamlNode& map) {
  const KeyForm* form = form_of(forms, KeyForm::Kind::table);
  return form ? &form->table().of_map(map) : nullptr;
}

/// Returns the table of a definition of a part.
const KeyTable& definition_keys(const KeyTable& keys) { return entry_forms(keys, "definitions")->front().table(); }

/// Returns the name of the body that carries a node; null if there is none.
Tree carrier_of(const YamlNode& node) {
  return node.kind == YamlNode::Kind::map ? find_value(node, "carried_by") : nullptr;
}

class Expander {
 public:
  Expander(const KeyTable& keys, const std::string& file, const Parameters& parameters)
      : keys_(keys),
        file_(file),
        parameters_(parameters),
        model_(file, parameters),
        library_(file, definition_keys(keys)) {}

  Tree expand(const YamlNode& root) {
    Scope scope;
    scope.main_file = &file_;
    scope.parameters = &parameters_;
    write_body(root, scope, library_.definitions_of(root, file_), "");
    return model_.finish(root);
  }

 private:
  /// Writes the sections of the model, or of a part. @param path  of the part; empty: the model
  void write_body(const YamlNode& body, const Scope& scope, const Definitions& definitions, const std::string& path) {
    // Nodes come first: entries, and other parts, are placed relative to them.
    Pairs ordered = body.pairs;
    std::stable_partition(ordered.begin(), ordered.end(),
                          [](const YamlNode::Pair& pair) { return pair.key->scalar == "nodes"; });
    for (const YamlNode::Pair& pair : ordered) {
      const std::string& section = pair.key->scalar;
      if (is_among(section, sections_of_entries()))
        write_section(section, *pair.value, scope);
      else if (section == "hydraulics")
        write_hydraulics(*pair.value, scope);
      else if (section == "parts")
        for_each_entry(*pair.value, scope, section,
                       [&](const std::string& name, const Tree& value, const Scope& local) {
                         place_part(name, value, local, definitions);
                       });
      else if (!path.empty() && !is_among(section, sections_of_model) && section != "parameters" &&
               section != "definitions")
        fail_at(*pair.key, file_, path, fmt::format("'{}' is no section of a part", section));
    }
  }

  void write_section(const std::string& section, const YamlNode& entries, const Scope& scope) {
    const KeyForms& forms = *entry_forms(keys_, section);
    std::vector<std::pair<std::string, Tree>> merged;  // nodes that are nodes of the surroundings
    for_each_entry(entries, scope, section, [&](const std::string& name, const Tree& value, const Scope& local) {
      const std::string path = section + "." + scope.prefix + name;
      const auto outside = section == "nodes" ? scope.merged.find(name) : scope.merged.end();
      const bool is_merged = outside != scope.merged.end();
      if (is_merged) check_merged(name, *value, *outside->second, local, path);
      const std::string full = is_merged ? outside->second->scalar : scope.prefix + name;
      Tree entry = write_entry(section, value, forms, local, path);
      if (const Tree body = section == "nodes" ? carrier_of(*entry) : nullptr) {
        model_.carry(full, *body, path + ".carried_by");
        entry = without(*entry, {"carried_by"});
      }
      if (is_merged)
        merged.emplace_back(name, std::move(entry));
      else
        model_.add(section, full, std::move(entry));
    });
    for (const auto& [name, entry] : merged) check_place(name, entry, scope);
  }

  /// Refuses keys of a part's node that would be lost because it is merged with a node of the surroundings.
  void check_merged(const std::string& name, const YamlNode& node, const YamlNode& outside, const Scope& scope,
                    const std::string& path) const {
    for (const char* key : {"fixed", "motion", "velocity", "angular_velocity"}) {
      const Tree value = node.kind == YamlNode::Kind::map ? find_value(node, key) : nullptr;
      const bool is_scalar = value && value->kind == YamlNode::Kind::scalar;
      if (value && !(is_scalar && !holds(*value, scope, path + "." + key)))
        fail_at(*value, file_, path + "." + key,
                fmt::format("node '{}' of the part is the node '{}' here: `{}` belongs to that one", name,
                            outside.scalar, key));
    }
  }

  /// Checks that a merged node is at the place of the node of the surroundings.
  void check_place(const std::string& name, const Tree& entry, const Scope& scope) const {
    const YamlNode& outside = *scope.merged.at(name);
    const std::string path = "parts." + scope.prefix + "merge." + name;
    const Frame there = model_.frame_of_node(outside.scalar, outside, path);
    const Frame here = model_.frame_of_entry(entry, path);
    const bool turned = (here.R - there.R).norm() > 1e-6;
    if (turned || (here.x - there.x).norm() > 1e-6 * (1 + here.x.norm() + there.x.norm()))
      fail_at(outside, file_, path,
              fmt::format("node '{}' of the part is placed at ({:.6g}, {:.6g}, {:.6g}) and '{}' at ({:.6g}, {:.6g}, "
                          "{:.6g}){}: nodes that are merged have the same place and axes",
                          name, here.x[0], here.x[1], here.x[2], outside.scalar, there.x[0], there.x[1], there.x[2],
                          turned ? ", with other axes" : ""));
  }

  void write_hydraulics(const YamlNode& body, const Scope& scope) {
    if (body.kind != YamlNode::Kind::map && body.kind != YamlNode::Kind::null)
      fail_at(body, file_, "hydraulics", "expected keys with values (`key: value`)");
    const KeyTable* table = table_of_entry(keys_.find("hydraulics")->forms, body);
    for (const YamlNode::Pair& pair : body.pairs) {
      const std::string list = pair.key->scalar, path = "hydraulics." + list;
      const Key* key = table ? table->find(list) : nullptr;
      const KeyForms* forms = table ? entry_forms(*table, list) : nullptr;
      if (!forms) {
        model_.set_hydraulic(pair, key ? writer(scope).write(pair.value, key->forms, path) : pair.value);
        continue;
      }
      for_each_entry(*pair.value, scope, path, [&](const std::string& name, const Tree& value, const Scope& local) {
        const std::string full = scope.prefix + name;
        model_.add_hydraulic(list, full, writer(local).write(value, *forms, path + "." + full));
      });
    }
  }

  Tree write_entry(const std::string& section, const Tree& value, const KeyForms& forms, const Scope& scope,
                   const std::string& path) const {
    const Tree written = writer(scope).write(value, forms, path);
    if (scope.placement.is_identity() || value->kind != YamlNode::Kind::map) return written;
    check_placed(*value, section, scope, path);
    const KeyTable* table = table_of_entry(forms, *value);
    if (!table) return written;
    const NodeFrame frame_of = [&](const YamlNode& name, const std::string& place) {
      return model_.frame_of_node(name.scalar, name, place);
    };
    return with_explicit_axes(written, *table, scope, frame_of, path);
  }

  EntryWriter writer(const Scope& scope) const { return EntryWriter(scope, make_point_); }

  // -- parts

  void place_part(const std::string& name, const Tree& entry, const Scope& outer, const Definitions& definitions) {
    const std::string path = "parts." + outer.prefix + name;
    if (++depth_ > 20) fail_at(*entry, file_, path, "parts contain each other more than 20 times over");
    Scope unplaced = outer;  // names and numbers are those of the surroundings; the placement is computed below
    unplaced.placement = {};
    const Tree written = EntryWriter(unplaced, refuse_point_).write_map(*entry, part_keys(), path);
    YamlValue value = value_at(written, path, file_);
    value.set_parameters(parameters_);
    const YamlValue keyed = value.keyed(part_keys());
    if (const auto part = keyed.find("part")) part->text();  // throws if it is not a text, or not a map
    if (const auto map = keyed.find("parameters")) map->entries();
    if (const auto map = keyed.find("merge"))
      for (const auto& [inside, outside] : map->entries()) outside.text();
    const Part part = library_.find(*written, definitions, path);

    Scope scope;
    scope.outer = &outer;
    scope.main_file = &file_;
    scope.parameters = &parameters_;
    scope.prefix = outer.prefix + name + ".";
    scope.placement = outer.placement.inner(placement_of(keyed, *written, path));
    if (const Tree at = find_value(*written, "at"); at && at->scalar != "ground")
      scope.placement = placement_of(keyed, *written, path);
    read_part_parameters(*part.body, *written, scope, path);
    const std::vector<std::string> nodes = collect_names(*part.body, scope);
    if (const Tree merge = find_value(*written, "merge"))
      for (const YamlNode::Pair& pair : merge->pairs) {
        const std::string& inside = pair.key->scalar;
        if (!is_among(inside, nodes))
          fail_at(*pair.key, file_, path + ".merge",
                  fmt::format("the part has no node '{}'{}", inside, did_you_mean(inside, nodes)));
        scope.merged.emplace(inside, pair.value);
      }
    write_body(*part.body, scope, part.definitions, path);
    --depth_;
  }

  /// @returns the placement in the surroundings; for a part `at` a node, the placement in the model
  Placement placement_of(const YamlValue& entry, const YamlNode& tree, const std::string& path) const {
    Placement placement;
    placement.frame = read_frame(entry);
    if (const auto at = entry.find("at"))
      placement.frame = model_.frame_of_node(at->text(), *find_value(tree, "at"), path + ".at") * placement.frame;
    if (const auto mirror = entry.find("mirror")) placement.mirrored = mirror->word()[0] - 'x';
    return placement;
  }

  void read_part_parameters(const YamlNode& body, const YamlNode& entry, Scope& scope, const std::string& path) const {
    const Tree own = find_value(body, "parameters"), given = find_value(entry, "parameters");
    std::vector<std::string> names;
    if (own && own->kind != YamlNode::Kind::map && own->kind != YamlNode::Kind::null)
      fail_at(*own, file_, path + ".parameters", "expected keys with values (`key: value`)");
    if (own)
      for (const YamlNode::Pair& pair : own->pairs) {
        const std::string& name = pair.key->scalar;
        check_word(name, *pair.key, file_, path + ".parameters");
        const Tree other = given ? find_value(*given, name) : nullptr;
        const std::string place = path + ".parameters." + name;
        scope.values[name] = other ? scope.outer->number(*other, place) : scope.number(*pair.value, place);
        names.push_back(name);
      }
    if (!given) return;
    for (const YamlNode::Pair& pair : given->pairs)
      if (!scope.values.count(pair.key->scalar))
        fail_at(*pair.key, file_, path + ".parameters",
                fmt::format("'{}' is not a parameter of this part{}", pair.key->scalar,
                            names.empty() ? "; it has none" : did_you_mean(pair.key->scalar, names)));
  }

  /// Collects the names of a part's entries, to which other entries of the part refer. @returns the names of its nodes
  static std::vector<std::string> collect_names(const YamlNode& body, Scope& scope) {
    std::vector<std::pair<std::string, bool>> names;  // each name, and whether it is a word in formulas
    std::vector<std::string> nodes;
    for (const YamlNode::Pair& pair : body.pairs) {
      const std::string& section = pair.key->scalar;
      const UseEntry collect = [&](const std::string& name, const Tree&, const Scope&) {
        names.emplace_back(name, is_among(section, measure_sections));
        if (section == "nodes") nodes.push_back(name);
      };
      if (is_among(section, sections_of_entries()) || section == "parts")
        for_each_entry(*pair.value, scope, section, collect);
      if (section == "hydraulics")
        for (const YamlNode::Pair& list : pair.value->pairs)
          if (list.value->kind == YamlNode::Kind::map) for_each_entry(*list.value, scope, section, collect);
    }
    for (const auto& [name, is_measure] : names) {
      scope.own.insert(name);
      if (is_measure) scope.measures.insert(name);
    }
    return nodes;
  }

  const KeyTable& keys_;
  const std::string& file_;
  const Parameters& parameters_;
  WrittenModel model_;
  PartLibrary library_;
  const EntryWriter::MakePoint make_point_ = [this](const YamlNode& point, const std::string& path) {
    return model_.add_point(point, path);
  };
  const EntryWriter::MakePoint refuse_point_ = [this](const YamlNode& point, const std::string& path) -> std::string {
    fail_at(point, file_, path, "expected the name of a node; a part is not placed at, or merged with, a point");
  };
  int depth_ = 0;
};

bool is_body_point(const YamlNode& node) { return node.kind == YamlNode::Kind::map && find_pair(node, "body"); }

/// Returns whether an entry has something that has to be expanded.
bool entry_uses_language(const YamlNode& entry) {
  for (const char* key : {"repeat", "if", "carried_by"})
    if (find_pair(entry, key)) return true;
  for (const char* key : {"node", "nodes"})
    if (const Tree value = find_value(entry, key))
      if (is_body_point(*value) ||
          std::any_of(value->items.begin(), value->items.end(), [](const Tree& item) { return is_body_point(*item); }))
        return true;
  return false;
}

bool uses_language(const YamlNode& root) {
  const auto any_of = [](const YamlNode& section) {
    return std::any_of(section.pairs.begin(), section.pairs.end(),
                       [](const YamlNode::Pair& pair) { return entry_uses_language(*pair.value); });
  };
  for (const YamlNode::Pair& pair : root.pairs) {
    if (pair.key->scalar == "parts" || pair.key->scalar == "definitions") return true;
    if (is_among(pair.key->scalar, sections_of_entries()) && any_of(*pair.value)) return true;
    if (pair.key->scalar == "hydraulics")
      for (const YamlNode::Pair& list : pair.value->pairs)
        if (any_of(*list.value)) return true;
  }
  return false;
}

}  // namespace

ExpandedModel expand_model(const Tree& root, const std::string& file, const KeyTable& keys,
                           const ModelOptions& options) {
  if (root->kind != YamlNode::Kind::map) return {root, {}, false};
  ExpandedModel model;
  model.root = with_case(with_includes(root, file), file, keys, options.chosen_case);
  model.parameters = read_parameters(YamlValue::of_tree(model.root, "", file).keyed(keys), options.overrides);
  if (uses_language(*model.root)) model.root = Expander(keys, file, model.parameters).expand(*model.root);
  model.is_changed = model.root != root;
  return model;
}

}  // namespace bielle::mechanism
