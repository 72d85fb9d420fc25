#include "mechanism/reading/solid_forms.hpp"

namespace bielle::mechanism {

std::vector<Key> solid_form_keys() {
  using namespace keys;
  const KeyForm length = number("m").positive(), radius = number("m").non_negative();
  return {{"box", list_of(3, length), optional, "Edges along x, y and z."},
          {"sphere", length, optional, "Radius."},
          {"cylinder", list_of(2, length), optional, "Radius, and length along z."},
          {"tube", tuple({{length}, {radius}, {length}}), optional, "Outer radius, inner radius, and length along z."},
          {"cone", tuple({{radius}, {radius}, {length}}), optional,
           "Radius at the end at -z, radius at the end at +z, and length."},
          {"ring", list_of(2, length), optional, "Radius of the centre line around z, and radius of the section."}};
}

}  // namespace bielle::mechanism
