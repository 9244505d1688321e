# Two export sets: the libraries, and the pictures with their VTK dependency (component `rendering`).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Stackabilization)

get_property(libraries GLOBAL PROPERTY STACKABILIZATION_LIBRARIES)
set(rendering_libraries ${libraries})
list(FILTER rendering_libraries INCLUDE REGEX "^stackabilization_rendering$")
list(FILTER libraries EXCLUDE REGEX "^stackabilization_rendering$")

install(TARGETS ${libraries} EXPORT StackabilizationTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT StackabilizationTargets NAMESPACE stackabilization:: DESTINATION ${package_dir})
set(public_headers_without)
file(GLOB_RECURSE installed_headers CONFIGURE_DEPENDS include/stackabilization/*.h)
if(rendering_libraries)
  install(TARGETS ${rendering_libraries} EXPORT StackabilizationRenderingTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT StackabilizationRenderingTargets NAMESPACE stackabilization:: DESTINATION ${package_dir})
else()
  list(FILTER installed_headers EXCLUDE REGEX "/rendering/")
  set(public_headers_without PATTERN "rendering" EXCLUDE)
endif()
install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${public_headers_without})

configure_package_config_file(cmake/StackabilizationConfig.cmake.in
  ${PROJECT_BINARY_DIR}/StackabilizationConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/StackabilizationConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/StackabilizationConfig.cmake
  ${PROJECT_BINARY_DIR}/StackabilizationConfigVersion.cmake DESTINATION ${package_dir})

# What people read, in the folders that the pages link to, and a first project of their own.
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
file(GLOB_RECURSE pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
  docs/*.md docs/*.ipynb docs/*.png docs/*.gif experiments/*.md experiments/*.png experiments/*.svg)
foreach(page ${pages})
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()
install(FILES docs/examples/CMakeLists.txt docs/examples/measure.cpp docs/examples/improve.cpp data/models/cup.obj data/models/table.obj
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples)
