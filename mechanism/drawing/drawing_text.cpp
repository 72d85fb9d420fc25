#include "mechanism/drawing/drawing_text.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a vector as a list. The numbers are finite, because JSON cannot represent others.
Json json_of(const Vector3& v) { return {v[0], v[1], v[2]}; }

/// Writes a place into an object; a position or rotation that is zero is left out.
void write_place(const DrawnPlace& place, const DrawnMechanism& mechanism, Json& object) {
  object["node"] = mechanism.nodes[static_cast<std::size_t>(place.node)];
  if (const auto inner = mechanism.inner.find(place.node); inner != mechanism.inner.end()) {
    object["element"] = inner->second.first;
    object["station"] = inner->second.second;
  }
  if (!place.frame.x.isZero(0)) object["position"] = json_of(place.frame.x);
  if (place.frame.R.isIdentity(0)) return;
  const Eigen::Quaterniond q(place.frame.R);
  object["rotation"] = {q.w(), q.x(), q.y(), q.z()};
}

Json json_of(const std::vector<DrawnPlace>& places, const DrawnMechanism& mechanism) {
  Json list = Json::array();
  for (const DrawnPlace& place : places) {
    list.push_back(Json::object());
    write_place(place, mechanism, list.back());
  }
  return list;
}

/// Returns the key of a list of places; empty: the only place belongs to the shape itself.
std::string list_of_places(const std::string& shape) {
  static const std::map<std::string, std::string> keys = {
      {"bar", "ends"},  {"coil", "ends"},    {"damper", "ends"},   {"coil_damper", "ends"}, {"jack", "ends"},
      {"rope", "ends"}, {"joint", "frames"}, {"course", "points"}, {"stiffness", "places"}};
  const auto found = keys.find(shape);
  return found == keys.end() ? "" : found->second;
}

Json json_of(const std::vector<DrawnSection>& sections) {
  Json list = Json::array();
  for (const DrawnSection& section : sections) {
    Json each = {{"at", section.at}, {"outer", section.outer}};
    if (!section.inner.empty()) each["inner"] = section.inner;
    list.push_back(std::move(each));
  }
  return list;
}

Json json_of(const DrawnItem& item, const DrawnMechanism& mechanism, const DrawnMeshes& meshes) {
  Json object = {{"entry", item.entry}, {"type", item.type}, {"shape", item.shape}};
  const std::string list = list_of_places(item.shape);
  if (!list.empty())
    object[list] = json_of(item.places, mechanism);
  else if (!item.places.empty())
    write_place(item.places.front(), mechanism, object);
  for (const auto& [key, value] : item.values)
    object[key] = std::visit([](const auto& given) { return Json(given); }, value);
  for (std::size_t k = 0; k < item.pulleys.size(); ++k) {
    object[list][k]["radius"] = item.pulleys[k].radius;
    if (item.pulleys[k].radius > 0) object[list][k]["side"] = item.pulleys[k].side;
  }
  if (!item.sections.empty()) object["sections"] = json_of(item.sections);
  if (item.mesh) object["mesh"] = meshes.name_of(*item.mesh);
  if (!item.colour.empty()) object["colour"] = item.colour;
  if (item.opacity != 1) object["opacity"] = item.opacity;
  if (!item.role.empty()) object["role"] = item.role;
  return object;
}

}  // namespace

DrawnMeshes::DrawnMeshes(const Drawing& drawing) {
  std::multimap<std::size_t, std::size_t> of_size;  // meshes, by number of points
  std::set<std::string> names;
  for (const DrawnItem& item : drawing.items()) {
    if (!item.mesh || index_.contains(item.mesh.get())) continue;
    const DrawnMesh& mesh = *item.mesh;
    const auto [begin, end] = of_size.equal_range(mesh.points.size());
    const auto same = std::find_if(begin, end, [&](const auto& known) {
      const DrawnMesh& other = *all_[known.second].mesh;
      return other.points == mesh.points && other.triangles == mesh.triangles;
    });
    index_[&mesh] = same != end ? same->second : all_.size();
    if (same != end) continue;
    of_size.emplace(mesh.points.size(), all_.size());
    std::string name = mesh.name;
    for (int number = 2; !names.insert(name).second; ++number) name = fmt::format("{}_{}", mesh.name, number);
    all_.push_back({name, item.mesh});
  }
}

std::string drawing_text(const Drawing& drawing, const DrawnMechanism& mechanism, const DrawnMeshes& meshes) {
  Json text = {{"format", "bielle drawing"}, {"version", 1}, {"name", mechanism.name}, {"gravity", mechanism.gravity}};
  Json& items = text["items"] = Json::array();
  for (const DrawnItem& item : drawing.items()) items.push_back(json_of(item, mechanism, meshes));
  return text.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace bielle::mechanism
