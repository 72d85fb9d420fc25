# Precompiled headers: the headers of other projects that take most of the compilers' reading time.
#
# They only save time: every source and header includes what it uses, and compiles with BIELLE_PRECOMPILE=OFF, as the
# preset `sanitize` does. A header of Bielle belongs here only if almost every source includes it: a change of it
# recompiles everything.
set(BIELLE_HEAVY_HEADERS
    <Eigen/Dense> <Eigen/SparseCore>
    <fmt/format.h> <fmt/ranges.h>
    <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers> <numeric>
    <optional> <set> <span> <sstream> <stdexcept> <string> <utility> <variant> <vector>)

# bielle_precompiled_header(NAME header ...): headers that are compiled once, with the flags of Bielle's targets.
function(bielle_precompiled_header name)
  if(NOT BIELLE_PRECOMPILE)
    return()
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// A target needs a source; ${name} is about its precompiled header.\n")
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE bielle_options bielle_warnings Eigen3::Eigen fmt::fmt)
  target_precompile_headers(${name} PRIVATE ${ARGN})
  bielle_cache_precompiled(${name})
endfunction()

# bielle_precompile(TARGET NAME): TARGET's sources are compiled with the precompiled header NAME.
function(bielle_precompile target name)
  if(BIELLE_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${name})
    bielle_cache_precompiled(${target})
  endif()
endfunction()

# ccache must see in GCC's preprocessed source that a precompiled header was read.
function(bielle_cache_precompiled target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE -fpch-preprocess)
  endif()
endfunction()
