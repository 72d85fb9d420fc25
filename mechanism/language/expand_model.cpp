#include "mechanism/language/expand_model.hpp"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

#include "mechanism/language/entry_writer.hpp"
#include "mechanism/language/include.hpp"
#include "mechanism/language/language_keys.hpp"
#include "mechanism/language/parameters.hpp"
#include "mechanism/language/placed_entry.hpp"
#include "mechanism/language/scope.hpp"
#include "mechanism/reading/read_frame.hpp"

namespace bielle::mechanism {
namespace {

/// Sections whose entries have names.
const std::vector<std::string> sections = {"nodes",  "points",   "elements", "joints", "drives",    "loads",
                                           "states", "measures", "inputs",   "events", "hydraulics"};
/// Those whose names are words in formulas.
const std::vector<std::string> measure_sections = {"states", "measures", "inputs", "events"};
/// Sections of a file that a part does not bring along: they belong to the model in which it is placed.
const std::vector<std::string> sections_of_model = {"mechanism", "gravity", "analysis", "output", "cases"};

/// Returns the forms of the entries of a section.
const KeyForms& entry_forms(const KeyTable& root, const std::string& section) {
  for (const KeyForm& form : root.find(section)->forms)
    if (form.kind == KeyForm::Kind::entries) return form.items.front();
  throw std::logic_error("the section has no entries: " + section);
}

/// Parts that a file defines.
struct Library {
  Tree definitions;  ///< of the file; may be null
  std::string file;
};

class Expander {
 public:
  Expander(const KeyTable& keys, std::string file, const Parameters& parameters)
      : keys_(keys), file_(std::move(file)), parameters_(parameters) {}

  Tree expand(const YamlNode& root) {
    Scope model;
    model.main_file = &file_;
    model.parameters = &parameters_;
    const Library library{find_value(root, "definitions"), file_};
    write_body(root, model, library, "");
    carry_points();
    return assemble(root);
  }

 private:
  struct Section {
    Pairs pairs;
    std::unordered_set<std::string> names;
    std::map<std::string, std::size_t> groups;  ///< of hydraulics: positions of its lists
  };

  // -- a part, or the model itself

  void write_body(const YamlNode& body, const Scope& scope, const Library& library, const std::string& of_part) {
    const EntryWriter::MakePoint make_point = [&](const YamlNode& point, const std::string& path) {
      return add_point(point, path);
    };
    // Nodes come first: entries, and other parts, are placed relative to them.
    Pairs ordered = body.pairs;
    std::stable_partition(ordered.begin(), ordered.end(),
                          [](const YamlNode::Pair& pair) { return pair.key->scalar == "nodes"; });
    for (const YamlNode::Pair& pair : ordered) {
      const std::string& section = pair.key->scalar;
      if (section == "hydraulics") {
        write_hydraulics(*pair.value, scope, make_point);
      } else if (is_among(section, sections)) {
        for_each_entry(*pair.value, scope, section,
                       [&](const std::string& name, const Tree& value, const Scope& entry_scope) {
                         const std::string path = section + "." + scope.prefix + name;
                         add(section, scope, name, write_entry(section, value, entry_scope, make_point, path));
                       });
      } else if (section == "parts") {
        for_each_entry(*pair.value, scope, section,
                       [&](const std::string& name, const Tree& value, const Scope& entry_scope) {
                         place_part(name, value, entry_scope, library);
                       });
      } else if (!of_part.empty() && !is_among(section, sections_of_model) && section != "parameters" &&
                 section != "definitions") {
        fail_at(*pair.key, file_, of_part, fmt::format("'{}' is no section of a part", section));
      }
    }
  }

  Tree write_entry(const std::string& section, const Tree& value, const Scope& scope,
                   const EntryWriter::MakePoint& make_point, const std::string& path) {
    const KeyForms& forms = entry_forms(keys_, section);
    const Tree written = EntryWriter(scope, make_point).write(value, forms, path);
    if (scope.placement.is_identity() || value->kind != YamlNode::Kind::map) return written;
    check_placed(*value, section, scope, path);
    const auto entry =
        std::find_if(forms.begin(), forms.end(), [](const KeyForm& form) { return form.table != nullptr; });
    if (entry == forms.end()) return written;
    return with_explicit_axes(
        written, entry->table().of_map(*value), scope,
        [&](const YamlNode& name, const std::string& where) { return frame_of_node(name.scalar, name, where); }, path);
  }

  /// Calls `use(name, value, scope)` for each entry that is there, once for each repetition.
  template <class Use>
  void for_each_entry(const YamlNode& section, const Scope& scope, const std::string& path, const Use& use) {
    if (section.kind == YamlNode::Kind::null) return;
    if (section.kind != YamlNode::Kind::map) fail_at(section, file_, path, "expected keys with values (`key: value`)");
    for (const YamlNode::Pair& pair : section.pairs) {
      const std::string place = path + "." + scope.prefix + pair.key->scalar;
      if (pair.value->kind != YamlNode::Kind::map) {
        use(scope.replaces() ? scope.text(*pair.key, place) : pair.key->scalar, pair.value, scope);
        continue;
      }
      const Tree repeat = find_value(*pair.value, "repeat"), condition = find_value(*pair.value, "if");
      const Tree value = repeat || condition ? without(*pair.value, {"repeat", "if"}) : pair.value;
      const auto use_one = [&](const Scope& local) {
        if (condition && !holds(*condition, local, place)) return;
        use(local.replaces() ? local.text(*pair.key, place) : pair.key->scalar, value, local);
      };
      if (!repeat)
        use_one(scope);
      else if (repeat->kind == YamlNode::Kind::sequence)
        repeat_entry(repeat->items, 0, scope, place, use_one);
      else
        repeat_entry({repeat}, 0, scope, place, use_one);
    }
  }

  template <class Use>
  void repeat_entry(const std::vector<Tree>& directions, std::size_t direction, const Scope& scope,
                    const std::string& path, const Use& use) {
    if (direction == directions.size()) return use(scope);
    const YamlNode& repeat = *directions[direction];
    const std::string place = path + ".repeat";
    YamlValue value = YamlValue::of_tree(directions[direction], "", repeat.file ? *repeat.file : file_);
    const YamlValue keyed = value.keyed(repeat_keys());
    const std::string as = keyed.at("as").text();
    if (as.empty() || as == "t" || parameters_.count(as))
      fail_at(repeat, file_, place, fmt::format("'{}' has a meaning in formulas already; choose another name", as));
    keyed.at("count");  // refuses a repetition without it
    const int count = whole_number(*find_value(repeat, "count"), scope, place + ".count");
    constexpr int most = 1'000'000;
    if (count < 0 || count > most)
      fail_at(repeat, file_, place + ".count", fmt::format("expected 0 to {} entries, found {}", most, count));
    const Tree from = find_value(repeat, "from");
    const int first = from ? whole_number(*from, scope, place + ".from") : 1;
    for (int k = first; k < first + count; ++k) {
      Scope local = scope.inner();
      local.values[as] = k;
      repeat_entry(directions, direction + 1, local, path, use);
    }
  }

  int whole_number(const YamlNode& node, const Scope& scope, const std::string& path) const {
    const double value = scope.number(node, path);
    if (value != std::floor(value) || std::abs(value) > 1e9)
      fail_at(node, file_, path, fmt::format("expected a whole number, found {}", value));
    return static_cast<int>(value);
  }

  bool holds(const YamlNode& condition, const Scope& scope, const std::string& path) const {
    if (condition.scalar == "true") return true;
    if (condition.scalar == "false") return false;
    return scope.number(condition, path + ".if") != 0;
  }

  void write_hydraulics(const YamlNode& body, const Scope& scope, const EntryWriter::MakePoint& make_point) {
    const EntryWriter writer(scope, make_point);
    if (body.kind != YamlNode::Kind::map) return;
    Section& section = sections_["hydraulics"];
    const KeyForms& forms = keys_.find("hydraulics")->forms;
    const KeyTable* table = forms.front().table ? &forms.front().table() : nullptr;
    for (const YamlNode::Pair& pair : body.pairs) {
      const Key* key = table ? table->find(pair.key->scalar) : nullptr;
      const std::string path = "hydraulics." + pair.key->scalar;
      const KeyForm* entries = nullptr;
      if (key)
        for (const KeyForm& form : key->forms)
          if (form.kind == KeyForm::Kind::entries) entries = &form;
      if (!entries) {
        if (!section.names.insert(pair.key->scalar).second)
          fail_at(*pair.key, file_, path, "is given by another part, or by the model, already");
        section.pairs.push_back({pair.key, key ? writer.write(pair.value, key->forms, path) : pair.value});
        continue;
      }
      Pairs list;
      for_each_entry(*pair.value, scope, path, [&](const std::string& name, const Tree& value, const Scope& local) {
        const std::string full = scope.prefix + name;
        if (!section.names.insert(pair.key->scalar + "." + full).second)
          fail_at(*value, file_, path, fmt::format("there are two entries '{}'", full));
        list.push_back({make_scalar(full, *pair.key),
                        EntryWriter(local, make_point).write(value, entries->items.front(), path + "." + full)});
      });
      const auto [group, is_new] = section.groups.emplace(pair.key->scalar, section.pairs.size());
      if (is_new) {
        section.pairs.push_back({pair.key, make_map(std::move(list), *pair.value)});
      } else {
        Pairs all = section.pairs[group->second].value->pairs;
        all.insert(all.end(), list.begin(), list.end());
        section.pairs[group->second].value = make_map(std::move(all), *pair.value);
      }
    }
  }

  // -- parts

  void place_part(const std::string& name, const Tree& entry, const Scope& outer, const Library& library) {
    const std::string path = "parts." + outer.prefix + name;
    if (++depth_ > 20) fail_at(*entry, file_, path, "parts contain each other more than 20 times over");
    Scope unplaced = outer;  // names and numbers are those of the surroundings, the place is computed below
    unplaced.placement = {};
    const EntryWriter::MakePoint no_point = [&](const YamlNode& point, const std::string& where) -> std::string {
      fail_at(point, file_, where, "expected the name of a node");
    };
    const Tree written = EntryWriter(unplaced, no_point).write_map(*entry, part_keys(), path);
    YamlValue instance = YamlValue::of_tree(written, "", written->file ? *written->file : file_);
    instance.set_parameters(parameters_);
    const YamlValue keyed = instance.keyed(part_keys());
    const auto [body, inner_library] = definition_of(*written, path, library);

    Scope scope;
    scope.outer = &outer;
    scope.main_file = &file_;
    scope.parameters = &parameters_;
    scope.prefix = outer.prefix + name + ".";
    scope.placement = outer.placement.inner(placement_of(keyed, *written, path));
    read_part_parameters(*body, *written, scope, path);
    collect_names(*body, scope);
    if (const Tree merge = find_value(*written, "merge"))
      for (const YamlNode::Pair& pair : merge->pairs) merge_node(pair, scope, path, *body);
    write_body(*body, scope, inner_library, path);
    --depth_;
  }

  std::pair<Tree, Library> definition_of(const YamlNode& entry, const std::string& path, const Library& library) {
    const Tree part = find_value(entry, "part"), file = find_value(entry, "file");
    if (!part && !file) fail_at(entry, file_, path, "give the `part` that is placed here, or its `file`");
    Library from = library;
    Tree root;
    if (file) {
      const std::string key = (file->file ? *file->file : file_) + "\n" + file->scalar;
      auto& known = files_[key];
      if (!known) known = load_with_includes(*file, file_, path + ".file");
      root = known;
      from = {find_value(*root, "definitions"), file->scalar};
      if (!part) return {root, from};
    }
    std::vector<std::string> names;
    if (from.definitions) {
      if (const Tree found = find_value(*from.definitions, part->scalar)) {
        if (found->kind != YamlNode::Kind::map)
          fail_at(*found, file_, "definitions." + part->scalar, "expected sections: nodes, elements, ..");
        return {found, from};
      }
      for (const YamlNode::Pair& pair : from.definitions->pairs) names.push_back(pair.key->scalar);
    }
    fail_at(*part, file_, path + ".part",
            fmt::format("there is no part '{}' among the `definitions` of {}{}", part->scalar, from.file,
                        names.empty() ? "" : did_you_mean(part->scalar, names)));
  }

  Placement placement_of(const YamlValue& entry, const YamlNode& tree, const std::string& path) {
    Placement placement;
    placement.frame = read_frame(entry);
    if (const auto at = entry.find("at")) {
      const Frame base = frame_of_node(at->text(), *find_value(tree, "at"), path + ".at");
      placement.frame = {base.x + base.R * placement.frame.x, base.R * placement.frame.R};
    }
    if (const auto mirror = entry.find("mirror")) placement.mirrored = mirror->word()[0] - 'x';
    return placement;
  }

  /// Returns the frame of a node of the model that has been written already.
  Frame frame_of_node(const std::string& name, const YamlNode& place, const std::string& path) {
    if (name == "ground") return {};
    const Section& nodes = sections_["nodes"];
    const auto found = node_positions_.find(name);
    if (found == node_positions_.end()) {
      std::vector<std::string> names(nodes.names.begin(), nodes.names.end());
      std::sort(names.begin(), names.end());
      fail_at(place, file_, path,
              fmt::format("there is no node '{}' whose place is known here{}", name, did_you_mean(name, names)));
    }
    const Tree& node = nodes.pairs[found->second].value;
    YamlValue value = YamlValue::of_tree(without(*node, {"velocity", "angular_velocity", "fixed", "motion", "at"}), "",
                                         node->file ? *node->file : file_);
    value.set_parameters(parameters_);
    static const KeyTable table{"a node", "", frame_keys(), {}};
    const Frame own = read_frame(value.keyed(table));
    const Tree at = find_value(*node, "at");
    if (!at) return own;
    const Frame base = frame_of_node(at->scalar, *at, path);
    return {base.x + base.R * own.x, base.R * own.R};
  }

  void read_part_parameters(const YamlNode& body, const YamlNode& entry, Scope& scope, const std::string& path) {
    const Tree own = find_value(body, "parameters"), given = find_value(entry, "parameters");
    std::vector<std::string> names;
    if (own)
      for (const YamlNode::Pair& pair : own->pairs) {
        const std::string& name = pair.key->scalar;
        const Tree other = given ? find_value(*given, name) : nullptr;
        // A value that is given here has the names of the surroundings; they have been replaced already.
        scope.values[name] = other ? scope.outer->number(*other, path + ".parameters." + name)
                                   : scope.number(*pair.value, path + ".parameters." + name);
        names.push_back(name);
      }
    if (!given) return;
    for (const YamlNode::Pair& pair : given->pairs)
      if (!scope.values.count(pair.key->scalar))
        fail_at(*pair.key, file_, path + ".parameters",
                fmt::format("'{}' is not a parameter of this part{}", pair.key->scalar,
                            names.empty() ? "; it has none" : did_you_mean(pair.key->scalar, names)));
  }

  /// Collects the names of the entries of a part, which its entries refer to.
  void collect_names(const YamlNode& body, Scope& scope) {
    for (const YamlNode::Pair& pair : body.pairs) {
      const std::string& section = pair.key->scalar;
      const auto collect = [&](const YamlNode& entries, const std::string& path) {
        for_each_entry(entries, scope, path, [&](const std::string& name, const Tree&, const Scope&) {
          names_.push_back({name, is_among(section, measure_sections)});
        });
      };
      if (section == "hydraulics") {
        for (const YamlNode::Pair& group : pair.value->pairs)
          if (group.value->kind == YamlNode::Kind::map) collect(*group.value, section);
      } else if (is_among(section, sections) || section == "parts") {
        collect(*pair.value, section);
      }
    }
    for (const auto& [name, is_measure] : names_) {
      scope.own.insert(name);
      if (is_measure) scope.measures.insert(name);
    }
    names_.clear();
  }

  void merge_node(const YamlNode::Pair& pair, Scope& scope, const std::string& path, const YamlNode& body) {
    const std::string& inside = pair.key->scalar;
    const Tree nodes = find_value(body, "nodes");
    const Tree node = nodes && nodes->kind == YamlNode::Kind::map ? find_value(*nodes, inside) : nullptr;
    if (!node) {
      std::vector<std::string> names;
      if (nodes)
        for (const YamlNode::Pair& each : nodes->pairs) names.push_back(each.key->scalar);
      fail_at(*pair.key, file_, path + ".merge",
              fmt::format("the part has no node '{}'{}", inside, did_you_mean(inside, names)));
    }
    const std::string& outside = pair.value->scalar;
    const Frame there = frame_of_node(outside, *pair.value, path + ".merge." + inside);
    const EntryWriter::MakePoint none;
    const Tree placed = EntryWriter(scope, none).write(node, entry_forms(keys_, "nodes"), path);
    YamlValue value =
        YamlValue::of_tree(placed->kind == YamlNode::Kind::map
                               ? without(*placed, {"velocity", "angular_velocity", "fixed", "motion", "at"})
                               : placed,
                           "", node->file ? *node->file : file_);
    value.set_parameters(parameters_);
    static const KeyTable table{"a node", "", frame_keys(), {}};
    const Frame here = read_frame(value.keyed(table));
    const double size = 1 + here.x.norm() + there.x.norm();
    if ((here.x - there.x).norm() > 1e-6 * size || (here.R - there.R).norm() > 1e-6)
      fail_at(*pair.key, file_, path + ".merge",
              fmt::format("node '{}' of the part is placed at ({:.6g}, {:.6g}, {:.6g}) and '{}' at ({:.6g}, {:.6g}, "
                          "{:.6g}){}: nodes that are merged have the same place and axes",
                          inside, here.x[0], here.x[1], here.x[2], outside, there.x[0], there.x[1], there.x[2],
                          (here.R - there.R).norm() > 1e-6 ? ", with other axes" : ""));
    scope.merged[inside] = outside;
  }

  // -- entries of the model

  void add(const std::string& section_name, const Scope& scope, const std::string& name, Tree value) {
    if (section_name == "nodes" && scope.merged.count(name)) return;
    Section& section = sections_[section_name];
    const std::string full = scope.prefix + name;
    if (!section.names.insert(full).second)
      fail_at(*value, file_, section_name + "." + full, "there are two entries with this name");
    if (section_name == "nodes") node_positions_[full] = section.pairs.size();
    if (section_name == "elements") element_positions_[full] = section.pairs.size();
    section.pairs.push_back({make_scalar(full, *value), std::move(value)});
  }

  std::string add_point(const YamlNode& point, const std::string& path) {
    const Tree body = find_value(point, "body");
    if (!body || body->kind != YamlNode::Kind::scalar)
      fail_at(point, file_, path, "expected the name of a node, or a point of a body: {body: name, at: [x, y, z]}");
    const std::string name = path.substr(path.find('.') + 1) + ".point";
    points_.push_back({body->scalar, name, make_map(point.pairs, point), path});
    return name;
  }

  /// Makes nodes for points of bodies, which their bodies carry.
  void carry_points() {
    for (const Point& point : points_) {
      const auto found = element_positions_.find(point.body);
      if (found == element_positions_.end()) {
        std::vector<std::string> names;
        for (const auto& [name, position] : element_positions_) names.push_back(name);
        fail_at(*point.entry, file_, point.path,
                fmt::format("there is no element '{}'{}", point.body, did_you_mean(point.body, names)));
      }
      Tree& body = sections_["elements"].pairs[found->second].value;
      const Tree type = find_value(*body, "type"), node = find_value(*body, "node");
      if (!type || type->scalar != "rigid_body" || !node)
        fail_at(
            *point.entry, file_, point.path,
            fmt::format("'{}' is no rigid_body; points of superelements stand in the section `points`", point.body));
      Tree entry = without(*point.entry, {"body", "at"});
      entry = with(*entry, "at", node);
      if (const Tree at = find_value(*point.entry, "at")) entry = with(*entry, "position", at);
      Scope model;
      add("nodes", model, point.name, entry);
      const Tree also = find_value(*body, "also");
      std::vector<Tree> carried = also ? also->items : std::vector<Tree>{};
      carried.push_back(make_scalar(point.name, *point.entry));
      body = with(*body, "also", make_list(std::move(carried), *point.entry));
    }
  }

  /// Puts the sections in the order of the file, those that only parts have behind them.
  Tree assemble(const YamlNode& root) {
    Pairs pairs;
    for (const YamlNode::Pair& pair : root.pairs) {
      const std::string& name = pair.key->scalar;
      if (name == "parts" || name == "definitions") continue;
      const auto found = sections_.find(name);
      if (found == sections_.end()) {
        pairs.push_back(pair);
        continue;
      }
      pairs.push_back({pair.key, make_map(std::move(found->second.pairs), *pair.value)});
      sections_.erase(found);
    }
    for (const std::string& name : sections)
      if (const auto found = sections_.find(name); found != sections_.end() && !found->second.pairs.empty())
        pairs.push_back({make_scalar(name, root), make_map(std::move(found->second.pairs), root)});
    return make_map(std::move(pairs), root);
  }

  struct Point {
    std::string body, name;
    Tree entry;
    std::string path;
  };
  struct Name {
    std::string name;
    bool is_measure;
  };

  const KeyTable& keys_;
  std::string file_;
  const Parameters& parameters_;
  std::map<std::string, Section> sections_;
  std::map<std::string, std::size_t> node_positions_, element_positions_;
  std::map<std::string, Tree> files_;  ///< of parts, by the file that names them and the name
  std::vector<Point> points_;
  std::vector<Name> names_;
  int depth_ = 0;
};

/// Whether an entry has something that has to be expanded.
bool entry_uses_language(const YamlNode& node) {
  if (find_pair(node, "repeat") || find_pair(node, "if")) return true;
  const auto has_body_point = [](const YamlNode& each) {
    return each.kind == YamlNode::Kind::map && find_pair(each, "body") != nullptr;
  };
  for (const char* key : {"node", "nodes"}) {
    const Tree value = find_value(node, key);
    if (!value) continue;
    if (has_body_point(*value)) return true;
    for (const Tree& item : value->items)
      if (has_body_point(*item)) return true;
  }
  return false;
}

bool uses_language(const YamlNode& root) {
  for (const YamlNode::Pair& pair : root.pairs) {
    if (pair.key->scalar == "parts" || pair.key->scalar == "definitions") return true;
    if (!is_among(pair.key->scalar, sections)) continue;
    for (const YamlNode::Pair& entry : pair.value->pairs) {
      if (entry_uses_language(*entry.value)) return true;
      if (pair.key->scalar == "hydraulics")
        for (const YamlNode::Pair& each : entry.value->pairs)
          if (entry_uses_language(*each.value)) return true;
    }
  }
  return false;
}

/// Puts the parameters, analyses and output of a case in place of the file's.
Tree with_case(const Tree& root, const std::string& file, const std::string& chosen) {
  const Tree cases = find_value(*root, "cases");
  if (chosen.empty()) return cases ? without(*root, {"cases"}) : root;
  const std::vector<std::string> names = case_names(root, file);
  if (!is_among(chosen, names))
    throw InputError(fmt::format("--case {}: {} has no such case{}", chosen, file,
                                 names.empty() ? "" : did_you_mean(chosen, names)));
  const Tree entry = find_value(*cases, chosen);
  YamlValue::of_tree(entry, "", entry->file ? *entry->file : file).keyed(case_keys());
  Tree result = without(*root, {"cases"});
  for (const char* key : {"analysis", "output"})
    if (const Tree value = find_value(*entry, key)) result = with(*result, key, value);
  if (const Tree parameters = find_value(*entry, "parameters")) {
    Tree all = find_value(*root, "parameters");
    std::vector<std::string> known;
    if (all)
      for (const YamlNode::Pair& pair : all->pairs) known.push_back(pair.key->scalar);
    for (const YamlNode::Pair& pair : parameters->pairs) {
      if (!is_among(pair.key->scalar, known))
        fail_at(*pair.key, file, "cases." + chosen + ".parameters",
                fmt::format("'{}' is not a parameter of the file{}", pair.key->scalar,
                            did_you_mean(pair.key->scalar, known)));
      all = with(*all, pair.key->scalar, pair.value);
    }
    if (all) result = with(*result, "parameters", all);
  }
  return result;
}

}  // namespace

std::vector<std::string> case_names(const Tree& root, const std::string& file) {
  std::vector<std::string> names;
  const Tree cases = root->kind == YamlNode::Kind::map ? find_value(*root, "cases") : nullptr;
  if (!cases) return names;
  if (cases->kind != YamlNode::Kind::map) fail_at(*cases, file, "cases", "expected names of cases with their keys");
  for (const YamlNode::Pair& pair : cases->pairs) names.push_back(pair.key->scalar);
  return names;
}

ExpandedModel expand_model(const Tree& root, const std::string& file, const KeyTable& keys,
                           const ModelOptions& options) {
  if (root->kind != YamlNode::Kind::map) return {root, {}, false};
  ExpandedModel model;
  const Tree whole = with_case(with_includes(root, file), file, options.chosen_case);
  model.is_changed = whole != root;
  model.root = whole;
  model.parameters = read_parameters(YamlValue::of_tree(whole, "", file), options.overrides);
  if (!uses_language(*whole)) return model;
  model.is_changed = true;
  model.root = Expander(keys, file, model.parameters).expand(*whole);
  return model;
}

}  // namespace bielle::mechanism
