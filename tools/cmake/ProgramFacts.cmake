# Facts that are compiled into programs: commit, build, versions of libraries (reduce/common/build.hpp) and the
# explanations of messages (reduce/common/explanations.hpp).
set(BIELLE_GENERATED ${PROJECT_BINARY_DIR}/generated)

# The commit is asked for at each build. Its source changes only with the commit: a new one compiles this source and links
# the programs, nothing else.
add_custom_target(bielle_commit_source BYPRODUCTS ${BIELLE_GENERATED}/commit.cpp
  COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D OUTPUT=${BIELLE_GENERATED}/commit.cpp
          -P ${CMAKE_CURRENT_LIST_DIR}/WriteCommit.cmake
  COMMENT "")
add_library(bielle_commit OBJECT ${BIELLE_GENERATED}/commit.cpp)
add_dependencies(bielle_commit bielle_commit_source)

file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/mechanism/manual/messages/*.md)
list(FILTER pages EXCLUDE REGEX "/README\\.md$")
add_custom_command(OUTPUT ${BIELLE_GENERATED}/explanations.cpp
  COMMAND ${CMAKE_COMMAND} -D "PAGES=${pages}" -D OUTPUT=${BIELLE_GENERATED}/explanations.cpp
          -P ${CMAKE_CURRENT_LIST_DIR}/WriteExplanations.cmake
  DEPENDS ${pages} ${CMAKE_CURRENT_LIST_DIR}/WriteExplanations.cmake VERBATIM COMMENT "Explanations of messages")
add_library(bielle_explanations OBJECT ${BIELLE_GENERATED}/explanations.cpp)
foreach(facts bielle_commit bielle_explanations)
  target_link_libraries(${facts} PRIVATE bielle_options)
  set_target_properties(${facts} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endforeach()

# Reads the version of a library from macros of its header.
function(bielle_version_in_header variable header)
  file(READ ${header} text)
  set(numbers "")
  foreach(macro ${ARGN})
    if(text MATCHES "#define +${macro} +\"?([0-9.]+)")
      list(APPEND numbers ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(JOIN numbers . numbers)
  set(${variable} ${numbers} PARENT_SCOPE)
endfunction()
bielle_version_in_header(suitesparse_VERSION ${suitesparseconfig_INCLUDE}/SuiteSparse_config.h
                         SUITESPARSE_MAIN_VERSION SUITESPARSE_SUB_VERSION SUITESPARSE_SUBSUB_VERSION)
bielle_version_in_header(gmsh_VERSION ${gmsh_INCLUDE}/gmsh.h GMSH_API_VERSION)
set(BIELLE_LIBRARY_VERSIONS
    "Eigen ${Eigen3_VERSION}" "SuiteSparse ${suitesparse_VERSION}" "OpenBLAS ${openblas_VERSION}" "ARPACK-NG ${arpack_VERSION}"
    "HDF5 ${hdf5_shared_VERSION}" "libyaml ${yaml_VERSION}" "UDUNITS ${udunits_VERSION}" "muParser ${muparser_VERSION}"
    "fmt ${fmt_VERSION}" "CLI11 ${CLI11_VERSION}" "nlohmann JSON ${nlohmann_json_VERSION}")

# bielle_program_facts(TARGET ["NAME VERSION" ...]): TARGET knows the facts. The further libraries are those that it links
# besides the ones of all.
function(bielle_program_facts target)
  list(JOIN BIELLE_LIBRARY_VERSIONS ", " libraries)
  foreach(further ${ARGN})
    string(APPEND libraries ", ${further}")
  endforeach()
  set(source ${BIELLE_GENERATED}/${target}_build.cpp)
  file(GENERATE OUTPUT ${source} CONTENT "#include \"reduce/common/build.hpp\"

const char* bielle::build_facts() {
  return \"build      $<CONFIG>, ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, ${CMAKE_SYSTEM_PROCESSOR}\\n\"
         \"libraries  ${libraries}\\n\";
}
")
  set_source_files_properties(${source} PROPERTIES GENERATED ON SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${source})
  target_link_libraries(${target} PRIVATE bielle_commit bielle_explanations)
endfunction()
