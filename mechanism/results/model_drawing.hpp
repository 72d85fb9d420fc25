// The drawing of a model, gathered from its nodes and components, and its place in the results file.
#pragma once

#include "mechanism/drawing/drawing.hpp"

namespace bielle {
class Hdf5File;
}

namespace bielle::mechanism {

class Model;

/// Gathers the items by which a model is drawn: nodes with their supports first, then entries in the order in which
/// they were read.
Drawing draw_model(const Model& model);

/// Writes `/drawing` and `/drawing_meshes`, in place of those that the file has.
void write_drawing(Hdf5File& file, const Model& model);

}  // namespace bielle::mechanism
