# Installs the manual, the examples and the meshes of Getting started. They keep the folders of the sources, so that the
# links between the pages lead somewhere, and `$BIELLE/meshes/conrod.step` of the pages exists.
foreach(pattern mechanism/*.md mechanism/*.schema.json mechanism/examples/*.yaml
                mechanism/examples/*.csv reduce/*.md reduce/*.schema.json tools/*.md meshes/*.md meshes/*.yaml
                meshes/*.geo meshes/*.step meshes/*.inp tests/performance/*.md tests/verification/*.md)
  file(GLOB_RECURSE found CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/${pattern})
  foreach(document ${found})
    cmake_path(GET document PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${document} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT programs)
  endforeach()
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md ${PROJECT_SOURCE_DIR}/LICENSE
              ${PROJECT_SOURCE_DIR}/LICENSES.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
