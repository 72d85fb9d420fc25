# Debian packages of what is installed, by CPack (`tools/package`): the components of BielleInstall.cmake.
# Shared libraries that the programs need are found by dpkg-shlibdeps; the packages below are those of the tools.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME bielle)
set(CPACK_PACKAGE_VENDOR "the Bielle developers")
set(CPACK_PACKAGE_CONTACT "the Bielle developers <bielle@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/PackagedFiles.cmake)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME bielle)
set(CPACK_DEBIAN_PROGRAMS_DESCRIPTION "Flexible mechanisms by finite elements
 Reduces solid bodies to superelements, and computes the motion of machines of
 rigid bodies, beams, superelements, joints, drives and hydraulics.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "python3, python3-numpy, python3-scipy, python3-h5py, python3-yaml, python3-meshio, python3-matplotlib")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "python3-vtk9, xvfb, fonts-dejavu-core, libjs-three, libjs-chart.js")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "python3-bielle, ffmpeg, paraview")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbielle-dev)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Flexible mechanisms by finite elements: libraries
 Static libraries and headers, by which C++ programs compute mechanisms.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "bielle, libeigen3-dev, libsuitesparse-dev, libopenblas-dev, libarpack2-dev, libhdf5-dev, libyaml-dev, libudunits2-dev, nlohmann-json3-dev, libmuparser-dev, libcli11-dev, libfmt-dev, libgmsh-dev")

get_property(packaged GLOBAL PROPERTY BIELLE_LIBRARIES)
list(APPEND packaged bielle-reduce bielle-gmsh bielle-mechanism)
get_property(folder GLOBAL PROPERTY BIELLE_PYTHON_FOLDER)
if(folder)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-bielle)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Flexible mechanisms by finite elements: Python
 Models, motions step by step, and results as arrays of NumPy.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  # The module is compiled for this version of Python.
  string(REGEX MATCH "python3\\.([0-9]+)" ignored "${BIELLE_PYTHON_INSTALL}")
  math(EXPR next "${CMAKE_MATCH_1} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${CMAKE_MATCH_1}), python3 (<< 3.${next}), python3-numpy")
  list(APPEND packaged bielle_python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "bielle, python3-h5py, python3-scipy")
endif()
if(TARGET bielle-reduce-mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
  list(APPEND packaged bielle-reduce-mpi)
  set(CPACK_DEBIAN_MPI_PACKAGE_NAME bielle-mpi)
  set(CPACK_DEBIAN_MPI_DESCRIPTION "Flexible mechanisms by finite elements: reduction on several machines
 Reduces bodies that do not fit into the memory of one machine, by SLEPc and MUMPS.")
  set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "bielle, mpi-default-bin")
endif()
# Everything that is packed, without the tests.
add_custom_target(package_files DEPENDS ${packaged})
include(CPack)
