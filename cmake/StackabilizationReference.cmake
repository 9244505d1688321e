# The API reference: target `reference` writes HTML into the folder `reference` of the build, and fails where an installed
# header leaves something undocumented or a page refers to nothing. Only where doxygen is installed; nothing depends on it.
find_program(DOXYGEN_EXECUTABLE doxygen)
mark_as_advanced(DOXYGEN_EXECUTABLE)
if(DOXYGEN_EXECUTABLE)
  file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*.dox
    ${PROJECT_SOURCE_DIR}/*.md ${PROJECT_SOURCE_DIR}/experiments/*.md ${PROJECT_SOURCE_DIR}/experiments/*/*.md)
  list(TRANSFORM pages REPLACE "(.+)" "\"\\1\"" OUTPUT_VARIABLE quoted_pages)
  list(TRANSFORM installed_headers REPLACE "(.+)" "\"\\1\"" OUTPUT_VARIABLE quoted_headers)
  list(JOIN quoted_pages " " reference_pages)
  list(JOIN quoted_headers " " reference_headers)
  configure_file(docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/reference)
  add_custom_target(reference
    COMMAND ${DOXYGEN_EXECUTABLE} ${PROJECT_BINARY_DIR}/Doxyfile
    COMMENT "Writing reference/index.html" VERBATIM)
endif()
