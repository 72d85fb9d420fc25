#include "mechanism/results/model_drawing.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "mechanism/drawing/drawing_text.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/direction_words.hpp"
#include "reduce/common/files/hdf5_file.hpp"

namespace bielle::mechanism {
namespace {

using DrawnShapes = std::map<Entry, std::vector<const DrawnItem*>>;

/// Begins an entry with the shapes that it was given.
void begin_drawn(const Entry& entry, const std::string& type, const DrawnShapes& shapes, bool first, Drawing& drawing) {
  const auto given = shapes.find(entry);
  drawing.begin(results_path(entry), type, given != shapes.end());
  if (!first || given == shapes.end()) return;
  for (const DrawnItem* shape : given->second) drawing.add(*shape);
}

/// Returns whether the node has a point mass and moves freely: its rotations are held because they have no inertia, not
/// by a support.
bool is_point_mass(const Node& node, int index, const std::set<int>& point_masses) {
  return point_masses.contains(index) &&
         std::all_of(node.freedom.begin(), node.freedom.begin() + 3, [](Freedom f) { return f == Freedom::free; });
}

std::vector<std::string> directions_that_are(Freedom wanted, const Node& node) {
  std::vector<std::string> directions;
  for (std::size_t k = 0; k < 6; ++k)
    if (node.freedom[k] == wanted) directions.emplace_back(direction_words[k]);
  return directions;
}

std::set<int> nodes_of_point_masses(const Model& model) {
  std::set<int> nodes;
  for (const Member& member : model.members()) {
    if (member.component->type() != "point_mass") continue;
    Declaration declaration;
    member.component->declare(declaration);
    nodes.insert(declaration.nodes.begin(), declaration.nodes.end());
  }
  return nodes;
}

void draw_nodes(const Model& model, const DrawnShapes& shapes, Drawing& drawing) {
  const std::set<int> point_masses = nodes_of_point_masses(model);
  for (int k = 1; k < static_cast<int>(model.nodes().size()); ++k) {
    const Node& node = model.node(k);
    if (node.internal) continue;
    begin_drawn({Section::nodes, node.name}, "node", shapes, true, drawing);
    drawing.add({.shape = "node", .places = {{k, {}}}});
    const std::vector<std::string> fixed = directions_that_are(Freedom::fixed, node),
                                   moved = directions_that_are(Freedom::prescribed, node);
    if ((fixed.empty() && moved.empty()) || is_point_mass(node, k, point_masses)) continue;
    DrawnItem support{.shape = "support", .places = {{k, {}}}, .values = {{"fixed", fixed}}, .role = "support"};
    if (!moved.empty()) support.values.emplace_back("moved", moved);
    drawing.add(std::move(support));
  }
}

DrawnMechanism drawn_mechanism(const Model& model) {
  const Vector3& g = model.environment.gravity;
  DrawnMechanism mechanism{model.title, {g[0], g[1], g[2]}, {}, {}};
  for (const Node& node : model.nodes()) mechanism.nodes.push_back(node.name);
  for (const Chain& chain : model.chains())
    for (std::size_t k = 0; k < chain.nodes.size(); ++k)
      if (model.node(chain.nodes[k]).internal)
        mechanism.inner[chain.nodes[k]] = {results_path(chain.entry), static_cast<int>(k)};
  return mechanism;
}

template <class Number>
std::vector<Number> in_a_row(const std::vector<std::array<Number, 3>>& triples) {
  std::vector<Number> numbers;
  numbers.reserve(3 * triples.size());
  for (const auto& triple : triples) numbers.insert(numbers.end(), triple.begin(), triple.end());
  return numbers;
}

}  // namespace

Drawing draw_model(const Model& model) {
  DrawnShapes shapes;
  for (const auto& [entry, shape] : model.shapes()) shapes[entry].push_back(&shape);
  Drawing drawing;
  draw_nodes(model, shapes, drawing);
  std::map<Entry, std::string> types;  // the type of an entry is that of its first component
  for (const Member& member : model.members()) {
    const auto [known, first] = types.emplace(member.entry, member.component->type());
    begin_drawn(member.entry, known->second, shapes, first, drawing);
    member.component->draw(drawing);
  }
  return drawing;
}

void write_drawing(Hdf5File& file, const Model& model) {
  for (const char* old : {"/drawing", "/drawing_meshes"})
    if (file.has(old)) file.remove(old);
  const Drawing drawing = draw_model(model);
  const DrawnMeshes meshes(drawing);
  file.write_text("/drawing", drawing_text(drawing, drawn_mechanism(model), meshes));
  for (const NamedMesh& each : meshes.all()) {
    const std::string group = "/drawing_meshes/" + each.name;
    file.make_group(group);
    file.write_floats(group + "/points", in_a_row(each.mesh->points), {each.mesh->points.size(), 3}, "m");
    file.write_indices(group + "/triangles", in_a_row(each.mesh->triangles), {each.mesh->triangles.size(), 3},
                       "corners, from 0, anticlockwise seen from outside");
  }
}

}  // namespace bielle::mechanism
