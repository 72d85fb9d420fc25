#include "mechanism/elements/superelement/body_points.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "mechanism/elements/superelement/point_shapes.hpp"
#include "mechanism/elements/superelement/superelement_reading.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "reduce/common/error.hpp"
#include "reduce/superelement/named_points.hpp"
#include "reduce/superelement/point_weights.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the entry of the superelement that is named by a point.
YamlValue element_of(const YamlValue& point, const std::optional<YamlValue>& elements) {
  const YamlValue value = point.at("element");
  const std::string name = value.text();
  std::vector<std::string> superelements;
  if (elements)
    for (const auto& [element, entry] : elements->entries()) {
      if (!entry.is_map() || !entry.has("type") || entry.at("type").text() != "superelement") {
        if (element == name) value.fail(fmt::format("'{}' is no superelement: points are inside superelements", name));
        continue;
      }
      if (element == name) return entry.keyed(superelement_keys());
      superelements.push_back(element);
    }
  value.fail(fmt::format("there is no superelement '{}'{}", name, did_you_mean(name, superelements)));
}

/// Returns the point of the body's file that an entry names.
PointInFile point_in_file(const YamlValue& value, const YamlValue& element) {
  const YamlValue file = element.at("file");
  const std::string name = value.text();
  std::map<std::string, PointInFile> points;
  try {
    points = read_points_of_file(file.file_path());
  } catch (const InputError& error) {
    file.fail(error.what());
  }
  if (const auto found = points.find(name); found != points.end()) return std::move(found->second);
  std::vector<std::string> names;
  for (const auto& [known, point] : points) names.push_back(known);
  value.fail(names.empty() ? fmt::format("{} names no points: give `at`, or name '{}' under `points` in the body file",
                                         file.text(), name)
                           : fmt::format("'{}' is no point of {}{}", name, file.text(), did_you_mean(name, names)));
}

/// A body and the motion of a point in its coordinates.
struct Attachment {
  SuperelementBody* body = nullptr;
  MatrixX shapes;  ///< (6,n), in the file's coordinates
  std::array<bool, 6> residual{};
};

/// Returns the body, or its piece, that contains the named point.
Attachment attach_named(const std::vector<Component*>& pieces, const PointInFile& named) {
  for (Component* component : pieces) {
    auto& body = dynamic_cast<SuperelementBody&>(*component);
    if (body.file().group == named.group) return {&body, named.point.shapes, named.point.residual};
  }
  throw InputError("its piece of the body is missing");
}

/// Returns the body, or the piece of it, whose mesh is nearest to the point.
Attachment attach_at(const std::vector<Component*>& pieces, const Vector3& at) {
  SuperelementBody* nearest = nullptr;
  Superelement best;
  double least = 0;
  for (Component* component : pieces) {
    auto& body = dynamic_cast<SuperelementBody&>(*component);
    Superelement mesh = read_superelement(body.file());
    const double distance = distance_from_mesh(mesh.mesh.points, at);
    if (nearest && distance >= least) continue;
    least = distance;
    nearest = &body;
    best = std::move(mesh);
  }
  return {nearest, point_shapes(best, at), {}};
}

/// An entry of the section `points`.
struct PointEntry {
  std::string name;
  YamlValue entry;
  Frame placement;  ///< placement of its body
  Vector3 X;        ///< in body axes
  std::optional<PointInFile> named;
};

/// Returns whether a node follows the rotation of the body. A moving node with fixed rotations only transmits forces.
bool tells_rotation(const Node& node) {
  const auto rotations = node.freedom.begin() + 3;
  const bool moves = std::count(node.freedom.begin(), rotations, Freedom::free) > 0;
  return !moves || std::count(rotations, node.freedom.end(), Freedom::fixed) < 3;
}

void join(const PointEntry& point, int index, Model& model) {
  const std::vector<Component*> pieces = model.components_of({Section::elements, point.entry.at("element").text()});
  Attachment attachment;
  try {
    attachment = point.named ? attach_named(pieces, *point.named) : attach_at(pieces, point.X);
  } catch (const InputError& error) {
    point.entry.at(point.named ? "point" : "at").fail(error.what());
  }
  SuperelementBody& body = *attachment.body;
  RigidlyFollowed interfaces{{}, {}, body.matrices().gyration};
  for (const int node : body.nodes()) interfaces.add(node, tells_rotation(model.node(node)));
  follow_rigidly(index, interfaces, model);
  SuperelementBody::Point attached;
  attached.name = point.name;
  attached.node = index;
  attached.place.X = point.X;
  attached.place.T = body.matrices().columns_in_rows(attachment.shapes);
  attached.residual = attachment.residual;
  body.attach(std::move(attached));
}

PointEntry read_point(const std::string& name, const YamlValue& given, const std::optional<YamlValue>& elements) {
  const YamlValue entry = given.keyed(point_keys());
  const YamlValue element = element_of(entry, elements);
  if (entry.has("at") == entry.has("point"))
    entry.fail(
        "expected either `at`, a place [x, y, z] in the axes of the mesh, or `point`, one that the body file names");
  PointEntry point{name, entry, read_frame(element), Vector3::Zero(), {}};
  if (entry.has("point")) point.named = point_in_file(entry.at("point"), element);
  point.X = point.named ? point.named->point.position : entry.at("at").vector3();
  return point;
}

}  // namespace

const KeyTable& point_keys() {
  using namespace keys;
  static const KeyTable table{
      "a point",
      "A node that moves with a point of a superelement.",
      {{"element", name_of("element"), required, "The superelement."},
       {"at", vector3("m"), optional, "Place in the axes of the mesh; a point has either this or `point`."},
       {"point", text(), optional, "Name of a point that the body file has, in place of `at`."}}};
  return table;
}

void read_body_points(const YamlValue& points, const std::optional<YamlValue>& elements, Model& model) {
  for (const auto& [name, entry] : points.entries()) {
    PointEntry point = read_point(name, entry, elements);
    Node node;
    node.name = name;
    node.frame = point.placement * Frame{point.X, Matrix3::Identity()};
    int index = 0;
    try {
      index = model.add_node(std::move(node));
    } catch (const InputError& error) {
      entry.fail(error.what());
    }
    model.when_read(Model::Stage::connections,
                    [point = std::move(point), index, &model] { join(point, index, model); });
  }
}

}  // namespace bielle::mechanism
