# Packages for Debian, by the target `package`: program, Python module, libraries.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stackabilization)
set(CPACK_PACKAGE_CONTACT "The Stackabilization maintainers <maintainers@stackabilization.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(STACKABILIZATION_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Each package begins its description with a synopsis of its own, not with that of the project.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME stackabilization)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "measure exactly how well 3D shapes stack
 The program stackabilize measures how far each further copy of a chair, a cup
 or a crate sits above the one below it, finds the direction along which it
 stacks best, and changes designs so that they stack better.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-stackabilization)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3-numpy")
if(STACKABILIZATION_BUILD_PYTHON)
  # The module is for one version of Python.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    ", python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}~), python3 (<< ${Python_VERSION_MAJOR}.${next_minor})")
endif()
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python module that measures how well 3D shapes stack
 The module stackabilization has the commands of the program stackabilize as
 functions, and takes arrays as meshes.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libstackabilization-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)  # static libraries
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev, libtbb-dev, libgmp-dev, libmpfr-dev, libpugixml-dev, libminizip-dev, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libvtk9-dev, libegl-dev")  # the component rendering
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "libraries that measure how well 3D shapes stack
 Static libraries and headers of stackabilization, with a CMake package, the
 documentation, and a first project.")

# What Debian asks of every package, and of man pages. gzip without its time: the same bytes from every build.
find_program(GZIP_PROGRAM gzip)
function(stackabilization_install_compressed source name destination component)
  install(CODE "
    set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${destination}\")
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND ${GZIP_PROGRAM} -9nc \"${PROJECT_SOURCE_DIR}/${source}\"
      OUTPUT_FILE \"\${folder}/${name}.gz\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
endfunction()
if(GZIP_PROGRAM)
  stackabilization_install_compressed(docs/stackabilize.1 stackabilize.1 ${CMAKE_INSTALL_MANDIR}/man1 program)
endif()
foreach(component program python development)
  string(TOUPPER ${component} upper)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES cmake/copyright DESTINATION ${folder} COMPONENT ${component})
  if(GZIP_PROGRAM)
    stackabilization_install_compressed(CHANGELOG.md changelog ${folder} ${component})
  endif()
endforeach()
include(CPack)
