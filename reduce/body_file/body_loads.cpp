#include "reduce/body_file/body_loads.hpp"

#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/body_file/body_surfaces.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

const KeyTable& load_keys() {
  using namespace keys;
  static const KeyTable table{
      "a load",
      "A pattern of load on a surface, which the mechanism scales in time: a pressure, a traction or a force.",
      {{"surface", surface_forms(), required,
        "The surface: a physical surface by its name, a shape, or a list of both, which is their union."},
       {"pressure", number("Pa"), optional, "Pressure, positive against the surface."},
       {"traction", vector3("Pa"), optional, "Force per area, in the axes of the body."},
       {"force", vector3("N"), optional, "Total force in the axes of the body, spread evenly over the area."},
       {"residual", boolean(), otherwise("false"),
        "Residual vectors make the static response to the pattern exact, following the body or fixed in space."}}};
  return table;
}

LoadRequest read_load(const std::string& name, const YamlValue& value, MeshRequest& mesh) {
  check_name(name, value);
  LoadRequest load;
  load.name = name;
  load.subject = value.path();
  load.group = read_surface(value, "surface", mesh);
  load.residual = value.at("residual").boolean();
  if (value.has("pressure") + value.has("traction") + value.has("force") != 1)
    value.fail("expected exactly one of pressure [Pa], traction [x, y, z in Pa], force [x, y, z in N]");
  if (const auto pressure = value.find("pressure")) {
    load.pressure = pressure->number();
    if (*load.pressure == 0) pressure->fail("a pattern of zero pressure loads nothing");
    return load;
  }
  const YamlValue vector = value.at(value.has("traction") ? "traction" : "force");
  (value.has("traction") ? load.traction : load.force) = vector.vector3();
  if (vector.vector3().isZero(0)) vector.fail("a pattern of zero force loads nothing");
  return load;
}

}  // namespace bielle::reduce
