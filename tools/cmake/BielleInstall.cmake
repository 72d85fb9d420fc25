# Installs programs, tools, libraries with their headers, and the CMake package by which others link them:
#     find_package(Bielle 0.1)
#     target_link_libraries(mine PRIVATE Bielle::superelement)
# Headers keep the folders of the sources below include/bielle, so that `#include "reduce/common/error.hpp"` works
# anywhere.
#
# Components, which become Debian packages (BiellePackages.cmake): programs and tools, mpi, python, development.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(BIELLE_INSTALL_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/Bielle)
set(BIELLE_INSTALL_TOOLS ${CMAKE_INSTALL_DATADIR}/bielle/tools)

install(TARGETS bielle-reduce bielle-mechanism RUNTIME COMPONENT programs)
install(TARGETS bielle-gmsh LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/bielle COMPONENT programs)
if(TARGET bielle-reduce-mpi)
  install(TARGETS bielle-reduce-mpi RUNTIME COMPONENT mpi)
endif()

# The tools are installed beside their Python package; those for users are linked from the folder of programs.
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/convert_mesh.py DESTINATION ${BIELLE_INSTALL_TOOLS} COMPONENT programs)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/bielle_tools DESTINATION ${BIELLE_INSTALL_TOOLS} COMPONENT programs FILES_MATCHING PATTERN "*.py"
        PATTERN "*.js" PATTERN "*.css" PATTERN "*.html"
        PATTERN __pycache__ EXCLUDE
        PATTERN gallery EXCLUDE)  # needs the examples of the repository
foreach(tool bielle-animate bielle-exchange bielle-loads bielle-paraview bielle-plot bielle-rainflow bielle-table bielle-study bielle-view)
  install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/${tool} DESTINATION ${BIELLE_INSTALL_TOOLS} COMPONENT programs)
  set(link "\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}/${tool}")
  file(RELATIVE_PATH target /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${BIELLE_INSTALL_TOOLS}/${tool})
  install(CODE "file(CREATE_LINK \"${target}\" \"${link}\" SYMBOLIC)" COMPONENT programs)
endforeach()

get_property(libraries GLOBAL PROPERTY BIELLE_LIBRARIES)
set_target_properties(bielle_options PROPERTIES EXPORT_NAME options)
install(TARGETS ${libraries} bielle_options EXPORT BielleTargets ARCHIVE COMPONENT development)
file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} reduce/*.hpp mechanism/*.hpp)
list(FILTER headers EXCLUDE REGEX "^mechanism/python/")  # headers of the Python module, which is not linked
foreach(header ${headers})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bielle/${folder} COMPONENT development)
endforeach()

install(EXPORT BielleTargets NAMESPACE Bielle:: DESTINATION ${BIELLE_INSTALL_CMAKE} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/BielleConfig.cmake.in ${PROJECT_BINARY_DIR}/BielleConfig.cmake
                              INSTALL_DESTINATION ${BIELLE_INSTALL_CMAKE})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/BielleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/BielleConfig.cmake ${PROJECT_BINARY_DIR}/BielleConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake
        DESTINATION ${BIELLE_INSTALL_CMAKE} COMPONENT development)
include(BielleDocuments)
