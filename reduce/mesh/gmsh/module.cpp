// The module bielle-gmsh, which `gmsh_work` loads.
#include "reduce/mesh/gmsh/describe_source.hpp"
#include "reduce/mesh/gmsh/import_source.hpp"
#include "reduce/mesh/gmsh/surface_of_source.hpp"
#include "reduce/mesh/gmsh_work.hpp"

extern "C" __attribute__((visibility("default"))) const bielle::reduce::GmshWork bielle_gmsh_work;

const bielle::reduce::GmshWork bielle_gmsh_work = {
    {}, bielle::reduce::import_source, bielle::reduce::describe_source, bielle::reduce::surface_of_source};
