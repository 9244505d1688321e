include(CMakePackageConfigHelpers)
get_property(libraries GLOBAL PROPERTY STACKABILIZATION_LIBRARIES)
install(TARGETS ${libraries} EXPORT StackabilizationTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/stackabilization DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT StackabilizationTargets NAMESPACE stackabilization::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Stackabilization)
