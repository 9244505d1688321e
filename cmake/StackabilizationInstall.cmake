# Two export sets: the libraries, and the pictures with their VTK dependency (component `rendering`).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Stackabilization)

get_property(libraries GLOBAL PROPERTY STACKABILIZATION_LIBRARIES)
set(rendering_libraries ${libraries})
list(FILTER rendering_libraries INCLUDE REGEX "^stackabilization_rendering$")
list(FILTER libraries EXCLUDE REGEX "^stackabilization_rendering$")

install(TARGETS ${libraries} EXPORT StackabilizationTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT StackabilizationTargets NAMESPACE stackabilization:: DESTINATION ${package_dir})
# Headers that show third-party types stay at home; scripts/check_source.sh lets no others do so. So do those of
# namespace detail.
set(header_filter FILES_MATCHING PATTERN "*.h" PATTERN "formats" EXCLUDE PATTERN "rational_number.h" EXCLUDE)
file(GLOB_RECURSE headers CONFIGURE_DEPENDS src/stackabilization/*.h)
set(installed_headers)
foreach(header ${headers})
  file(STRINGS ${header} detail REGEX "^namespace stackabilization::detail" LIMIT_COUNT 1)
  if(detail)
    get_filename_component(name ${header} NAME)
    list(APPEND header_filter PATTERN ${name} EXCLUDE)
  elseif(NOT header MATCHES "/formats/|/rational_number\\.h$")
    list(APPEND installed_headers ${header})
  endif()
endforeach()
if(rendering_libraries)
  install(TARGETS ${rendering_libraries} EXPORT StackabilizationRenderingTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT StackabilizationRenderingTargets NAMESPACE stackabilization:: DESTINATION ${package_dir})
else()
  list(APPEND header_filter PATTERN "rendering" EXCLUDE)
endif()
install(DIRECTORY src/stackabilization DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${header_filter})

configure_package_config_file(cmake/StackabilizationConfig.cmake.in
  ${PROJECT_BINARY_DIR}/StackabilizationConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/StackabilizationConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/StackabilizationConfig.cmake
  ${PROJECT_BINARY_DIR}/StackabilizationConfigVersion.cmake DESTINATION ${package_dir})

# What people read, in the folders that the pages link to, and a first project of their own.
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
file(GLOB_RECURSE pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
  docs/*.md docs/*.png experiments/*.md experiments/*.png experiments/*.svg)
foreach(page ${pages})
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()
install(FILES docs/examples/CMakeLists.txt docs/examples/main.cpp data/models/cup.obj data/models/table.obj
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples)
