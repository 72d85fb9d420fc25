# Install: the two programs. (Libraries, headers and an exported CMake package follow below so that others can link.)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
