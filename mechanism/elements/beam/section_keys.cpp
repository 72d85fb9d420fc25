#include "mechanism/elements/beam/section_keys.hpp"

namespace bielle::mechanism {
namespace {

KeyForm length() { return keys::number("m").positive(); }
KeyForms one_or_two_lengths() { return {length(), keys::list_of(2, length())}; }
Key height_key() { return {"height", length(), keys::required, "Height along z."}; }
Key width_key() { return {"width", length(), keys::required, "Width along y."}; }

const KeyTable& i_keys() {
  using namespace keys;
  static const KeyTable table{
      "an i section",
      "A double-T with its web along z.",
      {{"width", one_or_two_lengths(), required, "Width of the flanges, or `[below, above]`."},
       height_key(),
       {"web", length(), required, "Thickness of the web."},
       {"flange", one_or_two_lengths(), required, "Thickness of the flanges, or `[below, above]`."}}};
  return table;
}

const KeyTable& t_keys() {
  using namespace keys;
  static const KeyTable table{"a t section",
                              "A T with its flange on the +z side.",
                              {{"width", length(), required, "Width of the flange."},
                               height_key(),
                               {"web", length(), required, "Thickness of the web."},
                               {"flange", length(), required, "Thickness of the flange."}}};
  return table;
}

const KeyTable& l_keys() {
  using namespace keys;
  static const KeyTable table{
      "an l section",
      "An angle with legs along +y and +z from their corner.",
      {width_key(),
       height_key(),
       {"thickness", one_or_two_lengths(), required, "Thickness of the legs, or `[leg along y, leg along z]`."}}};
  return table;
}

const KeyTable& box_keys() {
  using namespace keys;
  static const KeyTable table{"a box section",
                              "A hollow rectangle.",
                              {width_key(),
                               height_key(),
                               {"thickness", one_or_two_lengths(), required,
                                "Thickness of the walls, or `[walls across y, walls across z]`."}}};
  return table;
}

KeyForm poissons_ratio() {
  KeyForm form = keys::number().between(-1, 0.5);
  form.above = true;
  return form;
}

Key offset_key(const char* about) {
  using namespace keys;
  return {"offset", list_of(2, number("m")), otherwise("[0, 0]"), about};
}

}  // namespace

const KeyTable& shape_section_keys() {
  using namespace keys;
  static const KeyTable table{
      "a section of a shape",
      "A homogeneous section by its shape, its dimensions and its material.",
      {{"rectangle", list_of(2, length()), optional, "Width along y and height along z."},
       {"circle", length(), optional, "Radius."},
       {"tube", tuple({{length()}, {number("m").non_negative()}}), optional, "Outer and inner radius."},
       {"i", nested(i_keys), optional, "Dimensions of a double-T."},
       {"t", nested(t_keys), optional, "Dimensions of a T."},
       {"l", nested(l_keys), optional, "Dimensions of an angle."},
       {"box", nested(box_keys), optional, "Dimensions of a hollow rectangle."},
       {"young", number("Pa").positive(), required, "Young's modulus."},
       {"poisson", poissons_ratio(), optional, "Poisson's ratio; a section has either this or the modulus `shear`."},
       {"shear", number("Pa").positive(), optional, "Shear modulus, in place of `poisson`."},
       {"density", number("kg/m^3").non_negative(), otherwise("0"), "Density."},
       {"shear_factors", list_of(2, number().positive()), computed("those of the shape"),
        "Shear factors along y and z."},
       offset_key("Offset of the centroid from the node line, along y and z."),
       {"stress_points", list_of(list_of(2, number("m"))).items_at_least(1), optional,
        "Points at which stresses are recorded, from the centroid along y and z."}}};
  return table;
}

const KeyTable& constants_section_keys() {
  using namespace keys;
  static const KeyTable table{
      "a section by constants",
      "A section by its stiffness constants, about its axes y and z.",
      {{"EA", number("N").positive(), required, "Axial stiffness."},
       {"GAy", number("N").positive(), required, "Shear stiffness along y."},
       {"GAz", number("N").positive(), required, "Shear stiffness along z."},
       {"GJ", number("N m^2").positive(), required, "Torsional stiffness."},
       {"EIy", number("N m^2").positive(), required, "Bending stiffness about y, which resists loads along z."},
       {"EIz", number("N m^2").positive(), required, "Bending stiffness about z, which resists loads along y."},
       {"mass_per_length", number("kg/m").non_negative(), optional,
        "Mass per length; a section has all four values of mass or none."},
       {"Jx", number("kg m").non_negative(), optional, "Mass moment about x per length."},
       {"Jy", number("kg m").non_negative(), optional, "Mass moment about y per length."},
       {"Jz", number("kg m").non_negative(), optional, "Mass moment about z per length."},
       offset_key("Offset of the section's origin from the node line, along y and z.")}};
  return table;
}

const KeyTable& matrices_section_keys() {
  using namespace keys;
  static const KeyTable table{
      "a section by matrices",
      "A section by matrices in the order forces x y z, moments x y z.",
      {{"stiffness", matrix(6, 6, "N or N m or N m^2"), required, "Symmetric positive definite stiffness."},
       {"mass", matrix(6, 6, "kg/m or kg or kg m"), optional, "Mass per length."},
       offset_key("Offset of the section's origin from the node line, along y and z.")}};
  return table;
}

KeyForms section_forms() {
  using namespace keys;
  const KeyForms one{nested(shape_section_keys), nested(constants_section_keys), nested(matrices_section_keys)};
  KeyForms forms = one;
  forms.push_back(list_of(2, one));
  return forms;
}

}  // namespace bielle::mechanism
