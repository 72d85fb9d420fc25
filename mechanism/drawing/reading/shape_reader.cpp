#include "mechanism/drawing/reading/shape_reader.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/drawing/reading/colour.hpp"
#include "mechanism/drawing/reading/drawn_meshes.hpp"
#include "mechanism/reading/read_file.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "mechanism/reading/solid_forms.hpp"

namespace bielle::mechanism {
namespace {

void read_drawn_box(const YamlValue& value, DrawnItem& item) {
  item.values = {{"size", numbers_of(read_numbers(value, 3, "three edges [a, b, c]"))}};
}

void read_drawn_sphere(const YamlValue& value, DrawnItem& item) { item.values = {{"radius", value.number()}}; }

void read_drawn_cylinder(const YamlValue& value, DrawnItem& item) {
  const VectorX e = read_numbers(value, 2, "[radius, length]");
  item.values = {{"radius", e[0]}, {"length", e[1]}};
}

void read_drawn_tube(const YamlValue& value, DrawnItem& item) {
  const VectorX e = read_numbers(value, 3, "[outer radius, inner radius, length]");
  if (e[1] >= e[0]) value.fail("the inner radius must be smaller than the outer one");
  item.values = {{"radius", e[0]}, {"inner_radius", e[1]}, {"length", e[2]}};
}

void read_drawn_cone(const YamlValue& value, DrawnItem& item) {
  const VectorX e = read_numbers(value, 3, "[radius below, radius above, length]");
  if (e[0] == 0 && e[1] == 0) value.fail("one of the two radii must be greater than 0");
  item.values = {{"radii", std::vector<double>{e[0], e[1]}}, {"length", e[2]}};
}

void read_drawn_ring(const YamlValue& value, DrawnItem& item) {
  const VectorX e = read_numbers(value, 2, "[radius of the centre line, radius of the section]");
  if (e[1] > e[0]) value.fail("the radius of the section must not exceed that of the centre line");
  item.shape = "mesh";
  item.mesh = mesh_of_ring(e[0], e[1]);
}

/// A form in which a shape or a solid is given, by its key.
struct DrawnForm {
  const char* name;
  void (*read)(const YamlValue&, DrawnItem&);
};
constexpr std::array<DrawnForm, 6> drawn_forms = {{{"box", read_drawn_box},
                                                   {"sphere", read_drawn_sphere},
                                                   {"cylinder", read_drawn_cylinder},
                                                   {"tube", read_drawn_tube},
                                                   {"cone", read_drawn_cone},
                                                   {"ring", read_drawn_ring}}};

/// Reads the form of a map, which must contain exactly one form (files may be given in addition), and its place.
DrawnItem read_form(const YamlValue& map, int node) {
  DrawnItem item;
  for (const DrawnForm& form : drawn_forms) {
    if (!map.has(form.name)) continue;
    item.shape = form.name;
    form.read(map.at(form.name), item);
  }
  item.places = {{node, read_frame(map)}};
  return item;
}

const KeyTable& drawn_shape_keys() {
  using namespace keys;
  static const KeyTable table{
      "a shape", "A shape by which a node or a body is drawn. It changes no result.",
      joined({solid_form_keys(),
              {{"stl", file("STL"), optional, "Surface of triangles, binary or text."},
               {"step", file("geometry"), optional,
                "Geometry (STEP, IGES, BREP), of which bielle-reduce makes triangles."},
               {"scale", number().positive(), otherwise("1"),
                "Length of the unit of an STL file in metres: 0.001 for a file in millimetres."}},
              own_frame_keys(),
              {{"colour", text(), optional, "Colour: \"#rrggbb\", or a usual name such as `steelblue`."},
               {"opacity", number().between(0, 1), otherwise("1"), "Opacity, from 0 (invisible) to 1."}}})};
  return table;
}

void read_drawn_shape(const YamlValue& value, const Entry& entry, int node, Model& model) {
  const YamlValue map = value.keyed(drawn_shape_keys());
  std::vector<std::string> names, given;
  for (const DrawnForm& form : drawn_forms) names.emplace_back(form.name);
  names.insert(names.end(), {"stl", "step"});
  for (const std::string& name : names)
    if (map.has(name)) given.push_back(name);
  if (given.size() != 1) map.fail(fmt::format("expected exactly one of '{}'", fmt::join(names, "', '")));
  if (const auto scale = map.find("scale"); scale && given.front() != "stl")
    scale->fail("belongs to an STL file; a geometry has its unit, and the lengths of all other shapes are in metres");
  DrawnItem item = read_form(map, node);
  if (given.front() == "step") {
    item.shape = "mesh";
    item.mesh = read_named_file(map.at("step"), mesh_of_geometry);
  }
  if (given.front() == "stl") {
    const double scale = map.at("scale").number();
    item.shape = "mesh";
    item.mesh = read_named_file(map.at("stl"), [&](const std::string& path) { return mesh_of_stl(path, scale); });
  }
  if (const auto colour = map.find("colour")) item.colour = read_colour(*colour);
  item.opacity = map.at("opacity").number();
  model.add_shape(entry, std::move(item));
}

}  // namespace

Key shape_key() {
  using namespace keys;
  return {"shape",
          {nested(drawn_shape_keys), list_of(nested(drawn_shape_keys)).items_at_least(1)},
          optional,
          "Shape, or list of shapes, by which it is drawn; it changes no result."};
}

void read_shapes(const YamlValue& value, const Entry& entry, int node, Model& model) {
  if (!value.is_sequence()) return read_drawn_shape(value, entry, node, model);
  if (value.size() == 0) value.fail("expected at least one shape");
  for (const YamlValue& item : value.items()) read_drawn_shape(item, entry, node, model);
}

void draw_solid(const YamlValue& solid, const Entry& entry, int node, const Vector3& offset, Model& model) {
  DrawnItem item = read_form(solid, node);
  if (solid.at("cut").boolean()) item.role = "cut";
  item.places.front().frame.x += offset;
  model.add_shape(entry, std::move(item));
}

}  // namespace bielle::mechanism
