#include "step_assembly.hpp"

#include <fstream>
#include <iterator>
#include <regex>
#include <vector>

#include "import_support.hpp"
#include <fmt/format.h>

namespace bielle::test {

namespace {

// Returns the texts that the groups of a pattern capture, for each match.
std::vector<std::vector<std::string>> captures(const std::string& text, const std::string& pattern) {
  std::vector<std::vector<std::string>> result;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    result.emplace_back(std::next(match->begin()), match->end());
  return result;
}

void replace(std::string& text, const std::string& old, const std::string& by) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
}

// Returns the entities of an instance of the product definition `part` with the representation `shape` in its assembly,
// moved from one placement to another.
std::string instance(int first, const std::string& name, const std::string& assembly, const std::string& part,
                     const std::string& assembly_shape, const std::string& shape, const std::string& from,
                     const std::string& to) {
  return fmt::format(
      "#{0}=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{1},#{3});\n"
      "#{1}=(REPRESENTATION_RELATIONSHIP('','',{8},{7})REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{2})"
      "SHAPE_REPRESENTATION_RELATIONSHIP());\n"
      "#{2}=ITEM_DEFINED_TRANSFORMATION('','',{9},{10});\n"
      "#{3}=PRODUCT_DEFINITION_SHAPE('Placement','Placement of an item',#{4});\n"
      "#{4}=NEXT_ASSEMBLY_USAGE_OCCURRENCE('{5}','{5}','',{6},{11},$);\n",
      first, first + 1, first + 2, first + 3, first + 4, name, assembly, assembly_shape, shape, from, to, part);
}

}  // namespace

std::string step_assembly(const TemporaryFolder& folder) {
  const std::string geo = folder.file("gripper.geo",
                                      "SetFactory(\"OpenCASCADE\");\n"
                                      "Box(1) = {0, 0, 0, 100, 10, 10}; Box(2) = {100, 0, 0, 20, 10, 10};\n");
  const std::string path = folder / "gripper.step";
  gmsh_convert(geo, path, 0, 1);
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  // gmsh writes an assembly of both boxes with names that it chooses. The second box becomes the part of a finger; the
  // product of the finger is added with two instances.
  const auto uses = captures(text, "NEXT_ASSEMBLY_USAGE_OCCURRENCE\\('\\d+','','',(#\\d+),(#\\d+),\\$\\)");
  const auto products = captures(text, "PRODUCT\\('([^']+)'");
  const auto shapes = captures(text, "REPRESENTATION_RELATIONSHIP\\('','',(#\\d+),(#\\d+)\\)");
  const auto places = captures(text, "ITEM_DEFINED_TRANSFORMATION\\('','',(#\\d+),(#\\d+)\\)");
  const auto contexts = captures(text, "'',\\((#\\d+)\\)\\);\\s*#\\d+ = PRODUCT_CONTEXT");
  const auto designs = captures(text, "(#\\d+) = PRODUCT_DEFINITION_CONTEXT");
  const auto units = captures(text, "SHAPE_REPRESENTATION\\('',\\([#\\d,]+\\),(#\\d+)\\)");
  const std::string root = uses[1][0], tip = uses[1][1], root_shape = shapes[1][1], tip_shape = shapes[1][0];
  const std::string origin = places[1][0], place = places[1][1];
  replace(text, fmt::format("'','',{},{},$)", root, tip), fmt::format("'','',#90003,{},$)", tip));
  replace(text, fmt::format("REPRESENTATION_RELATIONSHIP('','',{},{})", tip_shape, root_shape),
          fmt::format("REPRESENTATION_RELATIONSHIP('','',{},#90005)", tip_shape));
  std::string added = fmt::format(
      "#90001=PRODUCT('finger','finger','',({}));\n"
      "#90002=PRODUCT_DEFINITION_FORMATION('','',#90001);\n#90003=PRODUCT_DEFINITION('design','',#90002,{});\n"
      "#90004=PRODUCT_DEFINITION_SHAPE('','',#90003);\n#90005=SHAPE_REPRESENTATION('',({},{}),{});\n"
      "#90006=SHAPE_DEFINITION_REPRESENTATION(#90004,#90005);\n"
      "#90007=CARTESIAN_POINT('',(0.,0.,50.));\n#90008=DIRECTION('',(0.,0.,1.));\n#90009=DIRECTION('',(1.,0.,0.));\n"
      "#90010=AXIS2_PLACEMENT_3D('',#90007,#90008,#90009);\n",
      contexts[0][0], designs[0][0], origin, place, units[0][0]);
  added += instance(90020, "left", root, "#90003", root_shape, "#90005", origin, place);
  added += instance(90030, "right", root, "#90003", root_shape, "#90005", origin, "#90010");
  text.insert(text.rfind("ENDSEC;"), added);
  const char* const names[] = {"gripper", "arm", "tip"};
  for (const int k : {2, 1, 0}) replace(text, products[k][0], names[k]);  // the first name is contained in the others
  return folder.file("gripper.step", text);
}

}  // namespace bielle::test
