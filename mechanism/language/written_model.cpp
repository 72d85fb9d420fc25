#include "mechanism/language/written_model.hpp"

#include <set>

#include <fmt/format.h>

#include "mechanism/language/language_keys.hpp"
#include "mechanism/reading/read_frame.hpp"

namespace bielle::mechanism {
namespace {

/// Returns a name for the node at a point of a body: "spring.point_2" for "elements.spring.nodes[2]".
std::string name_of_point(const std::string& path) {
  std::string name;
  for (const char letter : path.substr(path.find('.') + 1))
    if (letter != ']') name += letter == '[' ? '_' : letter;
  const std::size_t last = name.rfind('.') + 1;
  for (const std::string key : {"nodes", "node"})
    if (name.compare(last, key.size(), key) == 0) return name.replace(last, key.size(), "point");
  return name + ".point";
}

/// Returns the node in whose axes a node is placed; null for the inertial ones.
Tree base_of_node(const YamlNode& node) { return node.kind == YamlNode::Kind::map ? find_value(node, "at") : nullptr; }

}  // namespace

WrittenModel::WrittenModel(std::string main_file, const Parameters& parameters)
    : main_file_(std::move(main_file)), parameters_(parameters) {}

void WrittenModel::add(const std::string& section_name, const std::string& name, Tree value) {
  append(sections_[section_name], name, std::move(value), section_name + "." + name);
}

void WrittenModel::add_hydraulic(const std::string& list_name, const std::string& name, Tree value) {
  append(hydraulic_lists_[list_name], name, std::move(value), fmt::format("hydraulics.{}.{}", list_name, name));
}

void WrittenModel::append(Section& section, const std::string& name, Tree value, const std::string& path) const {
  const auto [known, is_new] = section.places.emplace(name, section.pairs.size());
  if (!is_new) {
    const YamlNode& first = *section.pairs[known->second].value;
    fail_at(*value, main_file_, path,
            fmt::format("there are two entries with this name; the first is in {}, line {}",
                        first.file ? *first.file : main_file_, first.line));
  }
  section.pairs.push_back({make_scalar(name, *value), std::move(value)});
}

void WrittenModel::set_hydraulic(const YamlNode::Pair& pair, Tree value) {
  Section& section = sections_["hydraulics"];
  if (!section.places.emplace(pair.key->scalar, section.pairs.size()).second)
    fail_at(*pair.key, main_file_, "hydraulics." + pair.key->scalar,
            "is given by another part, or by the model, already");
  section.pairs.push_back({pair.key, std::move(value)});
}

std::string WrittenModel::add_point(const YamlNode& point, const std::string& path) {
  const Tree body = find_value(point, "body");
  if (!body || body->kind != YamlNode::Kind::scalar)
    fail_at(point, main_file_, path, "expected the name of a node, or a point of a body: {body: name, at: [x, y, z]}");
  const std::string name = name_of_point(path);
  points_.emplace(name, carried_.size());
  carried_.push_back({body->scalar, name, make_map(point.pairs, point), true, path});
  return name;
}

void WrittenModel::carry(const std::string& node, const YamlNode& body, const std::string& path) {
  if (body.kind != YamlNode::Kind::scalar) fail_at(body, main_file_, path, "expected the name of a rigid body");
  carried_.push_back({body.scalar, node, make_scalar(body.scalar, body), false, path});
}

std::vector<std::string> WrittenModel::names_in(const std::string& section) const {
  std::vector<std::string> names;
  if (const auto found = sections_.find(section); found != sections_.end())
    for (const auto& [name, place] : found->second.places) names.push_back(name);
  return names;
}

Tree WrittenModel::node(const std::string& name, const YamlNode& place, const std::string& path) const {
  if (const auto nodes = sections_.find("nodes"); nodes != sections_.end())
    if (const auto found = nodes->second.places.find(name); found != nodes->second.places.end())
      return nodes->second.pairs[found->second].value;
  const auto point = points_.find(name);
  const auto elements = sections_.find("elements");
  if (point != points_.end() && elements != sections_.end()) {
    const Carried& carried = carried_[point->second];
    if (const auto body = elements->second.places.find(carried.body); body != elements->second.places.end())
      return node_of_point(carried, *elements->second.pairs[body->second].value);
  }
  fail_at(
      place, main_file_, path,
      fmt::format("there is no node '{}' whose place is known here{}", name, did_you_mean(name, names_in("nodes"))));
}

Frame WrittenModel::frame_of_node(const std::string& name, const YamlNode& place, const std::string& path) const {
  // A loop, not a recursion: any number of nodes may be placed relative to each other.
  std::vector<std::pair<std::string, Tree>> open;  // nodes to be placed, each relative to the next one
  std::set<std::string> names;
  Frame frame;
  Tree at = make_scalar(name, place);
  for (; at && at->scalar != "ground"; at = base_of_node(*open.back().second)) {
    if (const auto known = frames_.find(at->scalar); known != frames_.end()) {
      frame = known->second;
      break;
    }
    if (!names.insert(at->scalar).second)
      fail_at(*at, main_file_, path,
              fmt::format("nodes are placed relative to each other in a circle, by way of '{}'", at->scalar));
    open.emplace_back(at->scalar, node(at->scalar, *at, path));
  }
  for (auto each = open.rbegin(); each != open.rend(); ++each) {
    frame = frame * own_frame(*each->second);
    frames_.emplace(each->first, frame);
  }
  return frame;
}

Frame WrittenModel::frame_of_entry(const Tree& entry, const std::string& path) const {
  const Tree at = base_of_node(*entry);
  return at ? frame_of_node(at->scalar, *at, path) * own_frame(*entry) : own_frame(*entry);
}

Frame WrittenModel::own_frame(const YamlNode& entry) const {
  if (entry.kind != YamlNode::Kind::map) return {};
  YamlValue value = YamlValue::of_tree(
      without(entry, {"velocity", "angular_velocity", "fixed", "fixed_axes", "motion", "at", "carried_by"}), "",
      entry.file ? *entry.file : main_file_);
  value.set_parameters(parameters_);
  static const KeyTable table{"a node", "", frame_keys(), {}};
  return read_frame(value.keyed(table));
}

void WrittenModel::check_carrier(const Carried& carried, const YamlNode& body) const {
  const Tree type = find_value(body, "type");
  if (!type || type->scalar != "rigid_body" || !find_value(body, "node"))
    fail_at(*carried.place, main_file_, carried.path,
            fmt::format("'{}' is no rigid_body; points of superelements stand in the section `points`", carried.body));
}

Tree WrittenModel::node_of_point(const Carried& point, const YamlNode& body) const {
  check_carrier(point, body);
  const Tree entry = with(*without(*point.place, {"body", "at"}), "at", find_value(body, "node"));
  const Tree at = find_value(*point.place, "at");
  return at ? with(*entry, "position", at) : entry;
}

void WrittenModel::carry_nodes() {
  Section& elements = sections_["elements"];
  // Nodes that each body carries, collected first so that each list grows only once.
  std::map<std::size_t, std::vector<Tree>> also;
  for (const Carried& carried : carried_) {
    const auto found = elements.places.find(carried.body);
    if (found == elements.places.end())
      fail_at(
          *carried.place, main_file_, carried.path,
          fmt::format("there is no element '{}'{}", carried.body, did_you_mean(carried.body, names_in("elements"))));
    const Tree& body = elements.pairs[found->second].value;
    check_carrier(carried, *body);
    if (carried.is_new) add("nodes", carried.node, node_of_point(carried, *body));
    also[found->second].push_back(make_scalar(carried.node, *carried.place));
  }
  for (auto& [place, nodes] : also) {
    Tree& body = elements.pairs[place].value;
    if (const Tree given = find_value(*body, "also"))
      nodes.insert(nodes.begin(), given->items.begin(), given->items.end());
    const YamlNode& first = *nodes.back();
    body = with(*body, "also", make_list(nodes, first));
  }
}

Tree WrittenModel::finish(const YamlNode& root) {
  carry_nodes();
  for (auto& [name, list] : hydraulic_lists_)
    sections_["hydraulics"].pairs.push_back({make_scalar(name, root), make_map(std::move(list.pairs), root)});
  Pairs pairs;
  for (const YamlNode::Pair& pair : root.pairs) {
    const std::string& name = pair.key->scalar;
    if (name == "parts" || name == "definitions") continue;
    const auto found = sections_.find(name);
    if (found == sections_.end()) {
      if (name != "hydraulics" && !is_among(name, sections_of_entries())) pairs.push_back(pair);
      continue;
    }
    pairs.push_back({pair.key, make_map(std::move(found->second.pairs), *pair.value)});
    sections_.erase(found);
  }
  std::vector<std::string> sections_of_parts = sections_of_entries();
  sections_of_parts.emplace_back("hydraulics");
  for (const std::string& name : sections_of_parts)
    if (const auto found = sections_.find(name); found != sections_.end() && !found->second.pairs.empty())
      pairs.push_back({make_scalar(name, root), make_map(std::move(found->second.pairs), root)});
  return make_map(std::move(pairs), root);
}

}  // namespace bielle::mechanism
