# Warnings, one library per folder, one test program per folder of tests.

# Templates compiled into Bielle's programs must not replace the same templates inside shared libraries: gmsh contains
# an Eigen compiled with another alignment, and freeing memory of one by the other is undefined behaviour.
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

add_library(bielle_warnings INTERFACE)
target_compile_options(bielle_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow)
if(BIELLE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # A class of a source may have members of types that are local to the source; in a batch GCC takes sources for
  # headers.
  target_compile_options(bielle_warnings INTERFACE -Wno-subobject-linkage)
endif()

# Warnings are errors where CMAKE_COMPILE_WARNING_AS_ERROR is set, as .ci/run does. GCC 12 finds some faults by following the
# flow of optimised code, and in batches it finds ones that do not exist: they stay warnings.
#   -Warray-bounds, -Wrestrict, -Wstringop-overflow: within std::string, after char_traits.h:431 (GCC's bugs 105329, 105651)
#   -Wmaybe-uninitialized, -Wuninitialized: of Eigen's dynamic storage, after DenseStorage.h:593 and :626
if(CMAKE_COMPILE_WARNING_AS_ERROR AND BIELLE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU
   AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(bielle_warnings INTERFACE -Wno-error=array-bounds -Wno-error=restrict -Wno-error=stringop-overflow
                                                   -Wno-error=maybe-uninitialized -Wno-error=uninitialized)
endif()

# The options of tests, linked after bielle_warnings. Tests spend their time in the libraries: their own sources are
# optimised less, which takes the compiler less time. In a batch of tests a local variable may have the name of a constant
# of another source; builds without batches warn about one in the same source.
add_library(bielle_test_options INTERFACE)
target_compile_options(bielle_test_options INTERFACE $<$<CONFIG:Release>:-O1>)
if(BIELLE_UNITY)
  target_compile_options(bielle_test_options INTERFACE -Wno-shadow)
endif()

add_library(bielle_options INTERFACE)
target_include_directories(bielle_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                    $<INSTALL_INTERFACE:include/bielle>)
target_compile_features(bielle_options INTERFACE cxx_std_20)
# Eigen must not start threads of its own inside Bielle's threads.
target_compile_definitions(bielle_options INTERFACE EIGEN_DONT_PARALLELIZE BIELLE_VERSION="${PROJECT_VERSION}")
# The option applies to every library and test: sources share a precompiled header, and flags that define macros must
# agree with it.
target_compile_options(bielle_options INTERFACE $<BUILD_INTERFACE:${OpenMP_CXX_FLAGS}>)
if(BIELLE_NATIVE)
  target_compile_options(bielle_options INTERFACE -march=native)
endif()
if(BIELLE_SANITIZE)
  # Checks of each pointer before its use (null, aligned, of the right class) triple the time of a build; the address
  # sanitizer finds most of these faults.
  target_compile_options(bielle_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined
    -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow,nonnull-attribute,returns-nonnull-attribute)
  target_link_options(bielle_options INTERFACE -fsanitize=address,undefined)
endif()

# A precompiled header, or Eigen alone, exceeds the memory [kB] from which on GCC collects garbage: it would then do so
# continually, which takes a fifth of the time.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=600000> $<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-expand=100>)
endif()

# bielle_library(NAME SOURCES a.cpp ... DEPENDS Bielle::x ...): the static library of one folder, as target Bielle::NAME,
# compiled with the precompiled header BIELLE_PRECOMPILED.
function(bielle_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(bielle_${name} STATIC ${ARG_SOURCES})
  add_library(Bielle::${name} ALIAS bielle_${name})
  set_target_properties(bielle_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(bielle_${name} PUBLIC bielle_options ${ARG_DEPENDS} PRIVATE $<BUILD_INTERFACE:bielle_warnings>)
  bielle_precompile(bielle_${name} ${BIELLE_PRECOMPILED})
  set_target_properties(bielle_${name} PROPERTIES UNITY_BUILD ${BIELLE_UNITY} UNITY_BUILD_BATCH_SIZE 6)
  set_property(GLOBAL APPEND PROPERTY BIELLE_LIBRARIES bielle_${name})
endfunction()

# Memory in huge pages: a page fault costs a virtual machine up to 20 us, and some tests have a million of them.
# bielle-reduce sets it for itself.
set(BIELLE_TEST_ENVIRONMENT GLIBC_TUNABLES=glibc.malloc.hugetlb=1)

# bielle_tests(NAME SOURCES test_a.cpp ... DEPENDS Bielle::x ... [LABELS long] [WITH_LONG_CASES test_a ...]): one Catch2 program;
# the cases of each of its sources test_* are one ctest, "NAME: test_a". A ctest for each case would take a minute and a half
# more: that of starting a program, with gmsh's libraries a tenth of a second, two thousand times. Cases with the tag [long] in
# the sources WITH_LONG_CASES are a ctest of their own, "NAME: long cases of test_a", with the label long.
function(bielle_tests name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LABELS;ENVIRONMENT;WITH_LONG_CASES" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} Bielle::test_main Bielle::test_eigenvalues bielle_warnings bielle_test_options)
  target_compile_definitions(test_${name} PRIVATE BIELLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                                  BIELLE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  if("${ARG_DEPENDS}" MATCHES "Bielle::(mesh|test_meshes|fe|reduction|body_file|report|matrices|distributed)")
    add_dependencies(test_${name} bielle-gmsh)  # loaded at run time
  endif()
  bielle_precompile(test_${name} bielle_test_precompiled)
  set_target_properties(test_${name} PROPERTIES UNITY_BUILD ${BIELLE_UNITY} UNITY_BUILD_BATCH_SIZE 6)
  set(environment ${BIELLE_TEST_ENVIRONMENT} ${ARG_ENVIRONMENT})
  foreach(source ${ARG_SOURCES})
    cmake_path(GET source STEM LAST_ONLY stem)
    if(stem MATCHES "^test_")  # the others help; a test without cases fails
      set(cases "[#${stem}]")
      if(stem IN_LIST ARG_WITH_LONG_CASES)
        set(cases "[#${stem}]~[long]")
        add_test(NAME "${name}: long cases of ${stem}" COMMAND test_${name} --warn NoTests --filenames-as-tags "[#${stem}][long]")
        set_tests_properties("${name}: long cases of ${stem}" PROPERTIES LABELS long TIMEOUT 3600 ENVIRONMENT "${environment}")
      endif()
      add_test(NAME "${name}: ${stem}" COMMAND test_${name} --warn NoTests --filenames-as-tags "${cases}")
      set_tests_properties("${name}: ${stem}" PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 3600 ENVIRONMENT "${environment}")
    endif()
  endforeach()
endfunction()

# bielle_python_test(NAME MODULE [SHARED] [TIMEOUT seconds] [LABELS long] [ENVIRONMENT VARIABLE=value ...]): a unittest of Python,
# or some of it, in the current folder. Debian's interpreter is named in full: its packages belong to no other. The compiled
# modules are kept in the build, so that the folders of the sources stay clean and no test compiles them again. Python 3.11
# accepts a module without tests; ctest does not. SHARED: a third of the cases that the module divides (tests/contract/shares.py)
# is run everyday, and the others in "NAME, the rest", with the label long.
function(bielle_python_test name module)
  cmake_parse_arguments(ARG "SHARED" "TIMEOUT" "LABELS;ENVIRONMENT" ${ARGN})
  if(ARG_SHARED)
    bielle_python_test("${name}, the rest" "${module}" TIMEOUT ${ARG_TIMEOUT} LABELS long ENVIRONMENT ${ARG_ENVIRONMENT} BIELLE_SHARE=rest)
    list(APPEND ARG_ENVIRONMENT BIELLE_SHARE=everyday)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  add_test(NAME "${name}" COMMAND /usr/bin/python3 -m unittest -v ${module} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set(environment BIELLE_PROGRAMS=${CMAKE_RUNTIME_OUTPUT_DIRECTORY} BIELLE_BUILD=${PROJECT_BINARY_DIR} PYTHONDONTWRITEBYTECODE=
                  PYTHONPYCACHEPREFIX=${PROJECT_BINARY_DIR}/pycache ${BIELLE_TEST_ENVIRONMENT} ${ARG_ENVIRONMENT})
  set_tests_properties("${name}" PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${ARG_LABELS}" FAIL_REGULAR_EXPRESSION "\nRan 0 tests in "
    ENVIRONMENT "${environment}")
endfunction()

# bielle_uncritical(): the libraries of this folder that follow read, check and describe, and leave the computation to
# others. In a release they are optimised less, which takes the compiler half the time, and so is their precompiled
# header: GCC optimises functions as the precompiled header was, whatever the options of the source are.
macro(bielle_uncritical)
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    add_compile_options(-O1)
    set(BIELLE_PRECOMPILED ${BIELLE_PRECOMPILED}_uncritical)
  endif()
endmacro()

# bielle_fast_to_compile(SOURCE ...): sources of the current folder that consist of headers of others and are not
# critical for speed (CLI11, Catch2's main): optimising them takes the compiler seconds and has no benefit.
function(bielle_fast_to_compile)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O1>" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# bielle_library_headers(NAME header ...): a precompiled header for all libraries that follow, besides the heavy
# headers, and in a release a second one for uncritical libraries. Libraries are position-independent code, and so must
# be their precompiled headers.
function(bielle_library_headers name)
  set(precompiled ${name})
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    list(APPEND precompiled ${name}_uncritical)
  endif()
  foreach(target ${precompiled})
    bielle_precompiled_header(${target} ${BIELLE_HEAVY_HEADERS} ${ARGN})
    if(TARGET ${target})
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    endif()
  endforeach()
  if(TARGET ${name}_uncritical)
    target_compile_options(${name}_uncritical PRIVATE -O1)
  endif()
  set(BIELLE_PRECOMPILED ${name} PARENT_SCOPE)
endfunction()
bielle_library_headers(bielle_precompiled)
