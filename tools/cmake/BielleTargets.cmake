# Warnings, one library per folder, one test program per folder of tests.

# Templates compiled into our programs must not take the place of the same templates inside shared libraries: gmsh carries
# an Eigen of its own, compiled with other alignment, and memory of one freed by the other is undefined behaviour.
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

add_library(bielle_warnings INTERFACE)
target_compile_options(bielle_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow)

add_library(bielle_options INTERFACE)
target_include_directories(bielle_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                    $<INSTALL_INTERFACE:include/bielle>)
target_compile_features(bielle_options INTERFACE cxx_std_20)
# Eigen must not start threads of its own inside ours.
target_compile_definitions(bielle_options INTERFACE EIGEN_DONT_PARALLELIZE BIELLE_VERSION="${PROJECT_VERSION}")
if(BIELLE_NATIVE)
  target_compile_options(bielle_options INTERFACE -march=native)
endif()
if(BIELLE_SANITIZE)
  target_compile_options(bielle_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(bielle_options INTERFACE -fsanitize=address,undefined)
endif()

# bielle_library(NAME SOURCES a.cpp ... DEPENDS Bielle::x ...): the static library of one folder, as target Bielle::NAME.
function(bielle_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(bielle_${name} STATIC ${ARG_SOURCES})
  add_library(Bielle::${name} ALIAS bielle_${name})
  set_target_properties(bielle_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(bielle_${name} PUBLIC bielle_options ${ARG_DEPENDS} PRIVATE $<BUILD_INTERFACE:bielle_warnings>)
  set_property(GLOBAL APPEND PROPERTY BIELLE_LIBRARIES bielle_${name})
endfunction()

# bielle_tests(NAME SOURCES a.cpp ... DEPENDS Bielle::x ... [LABELS long]): one Catch2 program; each test case is a ctest.
function(bielle_tests name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} Bielle::test_main bielle_warnings)
  target_compile_definitions(test_${name} PRIVATE BIELLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                                  BIELLE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  set(properties "")
  if(ARG_LABELS)
    set(properties PROPERTIES LABELS "${ARG_LABELS}")
  endif()
  catch_discover_tests(test_${name} TEST_PREFIX "${name}: " ${properties})
endfunction()
