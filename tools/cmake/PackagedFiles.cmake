# CPack runs this script before it packs. Debian's policy asks for a file `copyright` in each package.
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} name)
  set(documents /usr/share/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  file(COPY ${CMAKE_CURRENT_LIST_DIR}/copyright DESTINATION ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}${documents})
endforeach()

# Debian's Python finds modules of packages in /usr/lib/python3/dist-packages,
# those of /usr/local in a folder of its version.
file(GLOB found "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/usr/lib/python3.*/dist-packages")
foreach(folder ${found})
  cmake_path(GET folder PARENT_PATH of_version)
  cmake_path(GET of_version PARENT_PATH lib)
  file(MAKE_DIRECTORY ${lib}/python3)
  file(RENAME ${folder} ${lib}/python3/dist-packages)
  file(REMOVE_RECURSE ${of_version})
endforeach()
