# Installs into the build folder, then configures, builds and runs the installed example against that, as a user
# would.
set(prefix ${PROJECT_BINARY_DIR}/tests/install/prefix)
set(installed_docs ${prefix}/${CMAKE_INSTALL_DATAROOTDIR}/doc/${PROJECT_NAME})
add_test(NAME "install: into a prefix"
  COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
set_tests_properties("install: into a prefix" PROPERTIES LABELS unit FIXTURES_SETUP installed)

if(STACKABILIZATION_SANITIZE)  # A program must carry the sanitizers of the libraries in it.
  set(foreign_flags -DCMAKE_CXX_FLAGS=-fsanitize=${STACKABILIZATION_SANITIZE})
endif()
add_test(NAME "install: the installed examples build, and measure a shape"
  COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${installed_docs}/examples
    ${PROJECT_BINARY_DIR}/tests/install/example
    --build-generator ${CMAKE_GENERATOR} --build-makeprogram ${CMAKE_MAKE_PROGRAM} --build-project Example
    --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
      -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} ${foreign_flags}
    --test-command measure ${installed_docs}/examples/cup.obj)
set_tests_properties("install: the installed examples build, and measure a shape" PROPERTIES LABELS unit
  FIXTURES_REQUIRED installed FIXTURES_SETUP installed_examples
  PASS_REGULAR_EXPRESSION "f_max = [0-9.]+ of 0[.][0-9]+, S = 0[.][0-9]+\n" TIMEOUT 600)
add_test(NAME "install: an installed example leaves a shape alone that stacks well enough"
  COMMAND ${PROJECT_BINARY_DIR}/tests/install/example/improve ${installed_docs}/examples/cup.obj 0.6
    ${PROJECT_BINARY_DIR}/tests/install/stackable.obj)
set_tests_properties("install: an installed example leaves a shape alone that stacks well enough" PROPERTIES LABELS unit
  FIXTURES_REQUIRED "installed;installed_examples" PASS_REGULAR_EXPRESSION "S = 0[.]77[0-9]* with 0 edits, D = 0\n" TIMEOUT 600)

find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME "install: every link of the installed pages leads somewhere"
    COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/tests/docs/links.py ${installed_docs})
  set_tests_properties("install: every link of the installed pages leads somewhere" PROPERTIES LABELS unit
    FIXTURES_REQUIRED installed)
endif()

# Inside another project: the libraries only, and that project's own settings left alone.
add_test(NAME "install: a project that includes this one keeps its settings"
  COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR}/tests/subproject -B ${PROJECT_BINARY_DIR}/tests/subproject
    -G ${CMAKE_GENERATOR} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -UCMAKE_BUILD_TYPE -USTACKABILIZATION_BUILD_*
    -DSTACKABILIZATION_SOURCE=${PROJECT_SOURCE_DIR})
set_tests_properties("install: a project that includes this one keeps its settings" PROPERTIES LABELS unit)

add_test(NAME "sources: house rules"
  COMMAND ${PROJECT_SOURCE_DIR}/scripts/check_source.sh)
set_tests_properties("sources: house rules" PROPERTIES LABELS unit)
