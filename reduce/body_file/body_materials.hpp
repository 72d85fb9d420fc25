// The `materials` of a body file.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/input/key_form.hpp"
#include "reduce/fe/material.hpp"

namespace bielle {
class YamlValue;
}

namespace bielle::reduce {

/// Returns the forms of a material, the keys of its three kinds. Its reader chooses between them.
KeyForms material_forms();

/// Reads one material, of one of three kinds, told apart by its keys:
/// isotropic `young`, `poisson`; orthotropic `E1 E2 E3 nu12 nu13 nu23 G12 G13 G23`; anisotropic `stiffness`, 6x6 in the
/// order xx yy zz yz xz xy with engineering shear strains. All have a `density` [kg/m^3]; the latter two may have
/// `axes`, the directions of the material's own axes in those of the body, or around a line.
/// @throws InputError with the place: keys of two kinds, moduli out of range, an unstable material
Material read_material(const YamlValue& value);

/// Adds a warning for constants that are possible but that no solid has; another system of units is the likely cause
/// (plausible.hpp).
/// @param value  a material that read_material has accepted
void warn_of_material(const YamlValue& value);

}  // namespace bielle::reduce
