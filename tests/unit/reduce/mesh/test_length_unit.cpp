// Tests of units of length: names, and declarations in STEP files.
#include "import_support.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/length_unit.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;
using namespace bielle::test;

namespace {

std::string step(const std::string& units, const std::string& assigned) {
  return "ISO-10303-21;\nHEADER;\nFILE_NAME('LENGTH_UNIT of a part','');\nENDSEC;\nDATA;\n" + units +
         fmt::format(
             "#20=( GEOMETRIC_REPRESENTATION_CONTEXT(3)\n GLOBAL_UNIT_ASSIGNED_CONTEXT(({}))\n "
             "REPRESENTATION_CONTEXT('','') );\n",
             assigned) +
         "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace

TEST_CASE("units of length are found by name") {
  CHECK(metres_per("m") == 1);
  CHECK(metres_per("mm") == 1e-3);
  CHECK(metres_per("in") == 0.0254);
  CHECK(unit_name(1e-3) == "mm");
  CHECK(unit_name(0.5) == "0.5 m");
  CHECK_THAT(message_of<InputError>([] { metres_per("inch"); }), Catch::StartsWith("'inch' is not a unit of length"));
}

TEST_CASE("the unit of a STEP file is the unit of length that its context assigns") {
  const TemporaryFolder folder;
  const std::string mm = "#1 = ( LENGTH_UNIT() NAMED_UNIT(*)\n SI_UNIT(.MILLI., .METRE.) );\n";
  const std::string m = "#2=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n";
  const std::string angle = "#3=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n";
  const std::string inch =
      "#5=(CONVERSION_BASED_UNIT('INCH',#6)LENGTH_UNIT()NAMED_UNIT(#7));\n"
      "#6=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#1);\n";
  const auto unit = [&](const std::string& text) { return step_length_unit(folder.file("part.step", text)); };
  CHECK(unit(step(mm + angle, "#1,#3")) == 1e-3);
  CHECK(unit(step(m + angle, "#3,#2")) == 1.0);
  CHECK(unit(step(mm + inch + angle, "#5,#3")) == 0.0254);  // the mm here only define the inch
  CHECK(unit(step(mm + m, "#1,#2")) == std::nullopt);       // two units contradict each other
  CHECK(unit(step(angle, "#3")) == std::nullopt);
}

TEST_CASE("STEP files in inches and in metres are imported in metres, independently of length_unit") {
  const TemporaryFolder folder;
  const std::string geo = folder.file("box.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0, 2,1,1};");
  gmsh_convert(geo, folder / "box.step", 1, 1);
  std::ifstream file(folder / "box.step");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string declared = "SI_UNIT(.MILLI.,.METRE.)";
  REQUIRE(text.find(declared) != std::string::npos);
  const auto extent = [&](const std::string& unit) {
    std::string changed = text;
    changed.replace(text.find(declared), declared.size(), unit);
    MeshRequest wish = request(folder.file("changed.step", changed));
    wish.size = 10;
    wish.order = 1;
    return import(wish).points.row(0).maxCoeff();
  };
  CHECK(extent(declared) == Approx(0.002).epsilon(1e-9));
  CHECK(extent("SI_UNIT($,.METRE.)") == Approx(2).epsilon(1e-9));
  CHECK(extent("SI_UNIT(.CENTI.,.METRE.)") == Approx(0.02).epsilon(1e-9));
}
